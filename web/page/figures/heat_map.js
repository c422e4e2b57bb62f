// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A field of colours with symbols that say the same, drawn as SVG.

import { SvgSurface } from "./surface.js";
import { boxOf, drawing, element, paintNames, paintOf, text } from "./svg.js";

/** The figure as a drawing of that size. Row 0 is the lowest. */
export const drawnHeatMap = (figure, size, { top } = {}) => {
  const svg = drawing(size, figure.title);
  const surface = new SvgSurface(svg);
  const box = boxOf(size, { top });
  const [columns, rows] = [figure.x.categories, figure.y.categories];
  const width = (box.right - box.left) / Math.max(columns.length, 1);
  const height = (box.bottom - box.top) / Math.max(rows.length, 1);
  columns.forEach((name, i) =>
    text(svg, [box.left + (i + 0.5) * width, box.bottom + 16], "middle", name));
  rows.forEach((name, i) =>
    text(svg, [box.left - 6, box.bottom - (i + 0.5) * height + 4], "end", name));
  paintNames(surface, box, figure);
  for (const cell of figure.series.flatMap((series) => series.cells)) {
    const left = box.left + cell.x * width;
    const upper = box.bottom - (cell.y + 1) * height;
    const group = element(svg, "g", { class: "part", "data-tip": cell.tip });
    element(group, "title", {}, cell.tip);
    const gap = Math.min(0.5, 0.1 * width);
    element(group, "rect", {
      x: left + gap, y: upper + gap, width: width - 2 * gap, height: height - 2 * gap,
      fill: paintOf(cell.colour), "fill-opacity": cell.opacity,
    });
    if (cell.symbol) {
      text(group, [left + width / 2, upper + height / 2 + 4], "middle", cell.symbol,
        { fill: "#000" });
    }
  }
  return svg;
};
