// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Rows of dots on lines, with their intervals and what is accepted, drawn as SVG. The name of a row
// stands above it, so that it fits a narrow page.

import { roundSpan, scaleOf, spanOf } from "./scales.js";
import { drawLine, SvgSurface } from "./surface.js";
import { boxOf, drawing, element, nameOfAxis, paintOf, text, wrapped } from "./svg.js";

const [lineHeight, laneHeight] = [14, 22]; // pixels: of a name, of the rest of a row
const [left, below] = [14, 42]; // pixels: the room beside and below the rows
const valueWidth = 64; // pixels: of the number at the right of a name

const dotsOf = (figure) => figure.series.flatMap(({ dots }) => dots);
const namesOf = (figure, width) => dotsOf(figure).map(({ at }) =>
  wrapped(figure.y.categories[at], width - 2 * left - valueWidth));

/** How high the figure has to be at that width. */
export const heightOfDots = (figure, width) => namesOf(figure, width)
  .reduce((sum, lines) => sum + lines.length * lineHeight + laneHeight, 8 + below);

const spoken = (value) => (value === undefined ? "–" : String(Number(value.toPrecision(3))));

const paintAccepted = (group, row, { x, box, middle }) => {
  const from = Math.max(x.pixel(row.from ?? -Infinity), box.left);
  const to = Math.min(x.pixel(row.to ?? Infinity), box.right);
  element(group, "rect", {
    x: from, y: middle - 9, width: Math.max(2, to - from), height: 18, rx: 3,
    fill: paintOf("met"), "fill-opacity": 0.16,
  });
};

const paintInterval = (group, row, { x, middle }, stroke) => {
  const [low, high] = [x.pixel(row.low), x.pixel(row.high)];
  const d = `M${low} ${middle}H${high}M${low} ${middle - 5}v10M${high} ${middle - 5}v10`;
  element(group, "path", { d, stroke, "stroke-width": 2, fill: "none" });
};

const paintRow = (svg, row, names, place) => {
  const group = element(svg, "g", { class: "part", "data-tip": row.tip });
  element(group, "title", {}, row.tip);
  const colour = paintOf(row.missed ? "missed" : row.colour);
  names.forEach((line, i) =>
    text(group, [left, place.top + (i + 1) * lineHeight - 3], "start", line));
  text(group, [place.box.right, place.top + lineHeight - 3], "end", spoken(row.value),
    { "font-weight": "bold", fill: row.missed ? colour : undefined });
  element(group, "path", { d: `M${place.box.left} ${place.middle}H${place.box.right}`,
    stroke: "currentColor", "stroke-opacity": 0.15 });
  if (row.accepted) paintAccepted(group, row, place);
  for (const value of row.single ?? []) {
    element(group, "circle", { cx: place.x.pixel(value), cy: place.middle, r: 3, fill: colour,
      "fill-opacity": 0.35 });
  }
  if (row.low !== undefined && row.high !== undefined) paintInterval(group, row, place, colour);
  if (row.value !== undefined) {
    element(group, "circle", { cx: place.x.pixel(row.value), cy: place.middle, r: 5,
      fill: colour });
  }
};

/** The figure as a drawing of that size. */
export const drawnDots = (figure, size, { top = 4 } = {}) => {
  const svg = drawing(size, figure.title);
  const surface = new SvgSurface(svg);
  const box = { ...boxOf(size, { top }), left, bottom: size.height - below };
  const rows = dotsOf(figure);
  const all = rows.flatMap(({ value, low, high, from, to, single = [] }) =>
    [value, low, high, from, to, ...single]).concat(figure.x.range ?? []);
  const x = scaleOf(roundSpan(spanOf(all, false)), [box.left + 6, box.right - 6]);
  const marks = x.marks(Math.max(3, (box.right - box.left) / 75));
  marks.forEach((mark) => {
    const across = Math.round(x.pixel(mark)) + 0.5;
    drawLine(surface, [across, box.top], [across, box.bottom],
      { stroke: "currentColor", "stroke-opacity": 0.12 });
    surface.text([across, box.bottom + 15], "middle", x.says(mark));
  });
  surface.text([(box.left + box.right) / 2, box.bottom + 34], "middle", nameOfAxis(figure.x));
  let down = box.top;
  namesOf(figure, size.width).forEach((names, i) => {
    const middle = down + names.length * lineHeight + 9;
    paintRow(svg, rows[i], names, { x, box, top: down, middle });
    down += names.length * lineHeight + laneHeight;
  });
  return svg;
};
