// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A figure as a file of its own: with its title and legend, in the light colours of the palette.
// A figure brings the functions that draw it, so a page loads no others: `draw(figure, size,
// options)`, and `heightAt(figure, width)` where the height follows from the data.

import { make } from "../dom.js";
import { element, paintOf, text } from "./svg.js";

const ink = "#1b1f24";
const besideTitle = 600; // pixels: a narrower figure has its legend below its title

const head = 26; // of the height that a figure asks for: its title, which stands outside

/** How high the drawing of a figure is, without its title, at that width. */
export const heightOf = (figure, width) =>
  figure.heightAt?.(figure, width) ?? Math.max(70, figure.height - head);

/** The mark that the series is drawn with, for its legend: a line, dots, both, or a box. */
export const markOf = (figure, { width, dots, scatter, outlined }) => {
  if (figure.kind === "bars") return outlined ? "box dash" : "box";
  if (width === 0) return "dot";
  return dots || scatter ? "line dotted" : "line";
};

/**
 * The series that a legend names: {name, colour, dash}; of several with one name, the parts of a
 * curve with gaps, the first. None where one has several colours.
 */
export const namedIn = ({ series: all }) => {
  const isTold = all.every((series) => series.colour !== undefined);
  const isFirst = ({ name }, i) => all.findIndex((other) => other.name === name) === i;
  return isTold ? all.filter((series, i) => series.name !== "" && isFirst(series, i)) : [];
};

const paintLegend = (svg, figure, hidden, isBeside) => {
  const shown = namedIn(figure).filter((series) => !hidden.has(series.name));
  const widthOf = ({ name }) => 7 * name.length + 16;
  let across = isBeside
    ? figure.width - 18 - shown.reduce((sum, series) => sum + widthOf(series), 0) : 60;
  for (const series of shown) {
    text(svg, [across, isBeside ? 16 : 34], "start", series.name, { fill: paintOf(series.colour) });
    across += widthOf(series);
  }
};

/** The whole figure, as it is saved. */
export const stillOf = (figure, { hidden = new Set(), range } = {}) => {
  const isBeside = figure.width >= besideTitle;
  const hasLegend = namedIn(figure).length > 0;
  const top = hasLegend && !isBeside ? 48 : 30;
  const size = { width: figure.width,
    height: figure.heightAt ? top + heightOf(figure, figure.width) : figure.height };
  const svg = figure.draw(figure, size, { hidden, range, top });
  text(svg, [60, 16], "start", figure.title, { "font-weight": "bold" });
  paintLegend(svg, figure, hidden, isBeside);
  for (const words of svg.querySelectorAll("text:not([fill])")) words.setAttribute("fill", ink);
  for (const [key, value] of Object.entries({
    "font-family": "sans-serif", "font-size": 12, color: ink,
  })) svg.setAttribute(key, value);
  svg.prepend(element(null, "rect", { width: "100%", height: "100%", fill: "#fff" }));
  return svg;
};

/** The first of all values of a colour: that of light pages. */
const lightColour = (name) => {
  for (const sheet of document.styleSheets) {
    for (const rule of sheet.cssRules) {
      const value = rule.selectorText === ":root" ? rule.style.getPropertyValue(name) : "";
      if (value !== "") return value.trim();
    }
  }
  return ink;
};

/** The figure as the text of an SVG file. */
export const fileOf = (figure, options) =>
  new XMLSerializer().serializeToString(stillOf(figure, options))
    .replace(/var\((--[a-z-]+)\)/g, (_, name) => lightColour(name));

/** A button that saves the file which `current()` returns as {name, text}. */
export const fileButton = (label, type, current) => make("button", {
  type: "button", class: "save",
  onclick: () => {
    const { name, text: words } = current();
    const file = new Blob([words], { type });
    const link = make("a", { href: URL.createObjectURL(file), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  },
}, label);

/** A button that saves the figure which `current()` returns as {figure, hidden, range}. */
export const saveButton = (current) => fileButton("Save as SVG", "image/svg+xml", () => {
  const { figure, ...options } = current();
  return { name: `${figure.id}.svg`, text: fileOf(figure, options) };
});
