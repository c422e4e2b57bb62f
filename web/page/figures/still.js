// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A figure as a file of its own: with its title and legend, in the light colours of the palette.

import { make } from "../dom.js";
import { drawnBars } from "./bars.js";
import { drawnCurves } from "./curves.js";
import { drawnHeatMap } from "./heat_map.js";
import { element, paintOf, text } from "./svg.js";

const kinds = { curves: drawnCurves, bars: drawnBars, "heat-map": drawnHeatMap };
const ink = "#1b1f24";
const besideTitle = 600; // pixels: a narrower figure has its legend below its title

/** The figure without title and legend, as a drawing of that size. */
export const drawn = (figure, size, options = {}) => kinds[figure.kind](figure, size, options);

/** The series that a legend names: {name, colour, dash}. None where one has several colours. */
export const namedIn = (figure) => {
  const isTold = figure.series.every((series) => series.colour !== undefined);
  return isTold ? figure.series.filter((series) => series.name !== "") : [];
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
  const svg = drawn(figure, figure, { hidden, range, top: hasLegend && !isBeside ? 48 : 30 });
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

/** A button that saves the figure which `current()` returns as {figure, hidden, range}. */
export const saveButton = (current) => make("button", {
  type: "button", class: "save",
  onclick: () => {
    const { figure, ...options } = current();
    const file = new Blob([fileOf(figure, options)], { type: "image/svg+xml" });
    const link = make("a", { href: URL.createObjectURL(file), download: `${figure.id}.svg` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  },
}, "Save as SVG");
