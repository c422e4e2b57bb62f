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
  [label, unit, scale === "log" ? "log scale" : ""].filter((part) => part !== "").join(", ");

/** An empty drawing; screen readers have its title, and the table below the figure. */
export const drawing = ({ width, height }, title) => element(null, "svg", {
  width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title,
});

/** The room that is left for curves, bars and fields: with the names of the axes, or without. */
export const boxOf = ({ width, height }, { names = true, top = 8 } = {}) => ({
  left: names ? 60 : 44, right: width - 18, top, bottom: height - (names ? 40 : 20),
});

/** Lines across the box at round values of y, with their texts; on a surface. */
export const paintGrid = (surface, box, y) => {
  const lines = surface.begin();
  for (const mark of y.marks(Math.max(2, (box.bottom - box.top) / 32))) {
    const down = Math.round(y.pixel(mark)) + 0.5;
    lines.moveTo(box.left, down);
    lines.lineTo(box.right, down);
    surface.text([box.left - 6, down + 4], "end", y.says(mark));
  }
  surface.draw(lines, { stroke: "currentColor", "stroke-opacity": 0.15 });
};

/** What both axes are called; `axes` is {x, y}. */
export const paintNames = (surface, box, { x, y }) => {
  const middle = (box.top + box.bottom) / 2;
  surface.text([(box.left + box.right) / 2, box.bottom + 34], "middle", nameOfAxis(x));
  surface.text([14, middle], "middle", nameOfAxis(y), { transform: `rotate(-90 14 ${middle})` });
};
