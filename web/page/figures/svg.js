// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Elements of SVG, and what all figures have: axes with their marks and names.

const namespace = "http://www.w3.org/2000/svg";

/** An element in `parent`; `words` is its text. */
export const element = (parent, name, attributes = {}, words) => {
  const made = document.createElementNS(namespace, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== undefined) made.setAttribute(key, value);
  }
  if (words !== undefined) made.textContent = words;
  parent?.append(made);
  return made;
};

export const text = (parent, [x, y], anchor, words, more = {}) =>
  element(parent, "text", { x, y, "text-anchor": anchor, ...more }, words);

/** A colour of the palette by its name, as attributes take it. */
export const paintOf = (colour) => `var(--${colour})`;

/** "delay, ms" of {label: "delay", unit: "ms"}; a logarithmic axis says so. */
export const nameOfAxis = ({ label = "", unit = "", scale }) =>
  [label, unit === "1" ? "" : unit, scale === "log" ? "log scale" : ""]
    .filter((part) => part !== "").join(", ");

const widthOfCharacter = 6.6; // pixels, of 12 pixels' height, on average

/** How wide a text is, about, in pixels. */
export const widthOf = (words) => widthOfCharacter * words.length;

/** The text in lines that are about so wide at most, broken at spaces and after hyphens. */
export const wrapped = (words, width) => {
  const lines = [""];
  const whole = words.replace(/(\d) (?=%|m?[msNJ]\b)/g, "$1\u00a0"); // a number with its unit
  for (const part of whole.match(/[^ -]+-? *| +|-/g) ?? [""]) {
    if (lines.at(-1) !== "" && widthOf(lines.at(-1) + part.trimEnd()) > width) lines.push("");
    lines[lines.length - 1] += part;
  }
  return lines.map((line) => line.trimEnd());
};

/** An empty drawing; screen readers have its title, and the table below the figure. */
export const drawing = ({ width, height }, title) => element(null, "svg", {
  width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title,
});

const leastLeft = 60; // pixels: so most figures stand in line

const marksOfGrid = (y, height) => y.marks(Math.max(2, height / 32));

/** Where the box begins beside the marks of this axis and its name. */
export const leftOf = (y, height) => Math.max(leastLeft,
  32 + Math.max(...marksOfGrid(y, height).map((mark) => widthOf(y.says(mark)))));

/**
 * The room that is left for curves, bars and fields: with the names of the axes, or without;
 * `further` lines stand below the marks of x.
 */
export const boxOf = ({ width, height }, {
  names = true, top = 8, further = 0, left = names ? leastLeft : 44,
} = {}) => ({
  left, right: width - 18, top,
  bottom: height - (names ? 40 + 14 * further : 20),
});

/** Lines across the box at round values of y, with their texts; on a surface. */
export const paintGrid = (surface, box, y) => {
  const lines = surface.begin();
  for (const mark of marksOfGrid(y, box.bottom - box.top)) {
    const down = Math.round(y.pixel(mark)) + 0.5;
    lines.moveTo(box.left, down);
    lines.lineTo(box.right, down);
    surface.text([box.left - 6, down + 4], "end", y.says(mark));
  }
  surface.draw(lines, { stroke: "currentColor", "stroke-opacity": 0.15 });
};

/** What both axes are called; `axes` is {x, y}. */
export const paintNames = (surface, box, { x, y }, further = 0) => {
  const middle = (box.top + box.bottom) / 2;
  const below = box.bottom + 34 + 14 * further;
  surface.text([(box.left + box.right) / 2, below], "middle", nameOfAxis(x));
  surface.text([14, middle], "middle", nameOfAxis(y), { transform: `rotate(-90 14 ${middle})` });
};
