// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Groups of bars from zero, with intervals and open ends, drawn as SVG.

import { roundSpan, scaleOf } from "./scales.js";
import { SvgSurface } from "./surface.js";
import {
  boxOf, drawing, element, leftOf, paintGrid, paintNames, paintOf, text, widthOf, wrapped,
} from "./svg.js";

const widestBar = 48; // pixels
const headRoom = 1.12; // for the text above the highest bar

const barPath = (bar, { left, width, top, bottom }) => {
  const right = left + width;
  if (!bar.open) return `M${left} ${bottom}V${top}H${right}V${bottom}`;
  const shoulder = Math.min(top + 8, bottom); // of an arrow
  const tip = `${left + width / 2} ${top}`;
  return `M${left} ${bottom}V${shoulder}L${tip}L${right} ${shoulder}V${bottom}`;
};

/** The line of an interval with its two ends; returns where its upper end is. */
const paintInterval = (group, bar, middle, y) => {
  const [low, high] = [y(bar.low), y(bar.high)];
  const d = `M${middle} ${low}V${high}M${middle - 4} ${low}h8M${middle - 4} ${high}h8`;
  element(group, "path", { d, stroke: "currentColor", "stroke-width": 1.2, fill: "none" });
  return high;
};

const paintBar = (svg, bar, place, { y, hasTexts }) => {
  const words = bar.tip || bar.text;
  const group = element(svg, "g", { class: "part", "data-tip": words });
  element(group, "title", {}, words);
  element(group, "path", {
    d: barPath(bar, place), fill: paintOf(bar.colour), stroke: paintOf(bar.colour),
    "fill-opacity": bar.outlined ? 0.12 : 0.85,
    "stroke-dasharray": bar.outlined ? "4 2" : undefined,
  });
  const middle = place.left + place.width / 2;
  const end = bar.high === undefined ? place.top : paintInterval(group, bar, middle, y);
  if (!hasTexts) return;
  const style = bar.missed ? { fill: paintOf("missed"), "font-weight": "bold" } : {};
  text(group, [middle, Math.min(place.top, end) - 4], "middle", bar.text, style);
};

/** The bars of each group of a figure, with the colour and look of their series. */
export const groupsOf = (figure, hidden = new Set()) => figure.x.categories.map((name, at) => ({
  name,
  bars: figure.series.filter((series) => !hidden.has(series.name)).flatMap((series) =>
    series.bars.filter((bar) => bar.at === at)
      .map((bar) => ({ colour: series.colour, outlined: series.outlined, ...bar }))),
}));

/** The figure as a drawing of that size, without the series whose names are hidden. */
export const drawnBars = (figure, size, { hidden, top } = {}) => {
  const svg = drawing(size, figure.title);
  const surface = new SvgSurface(svg);
  const groups = groupsOf(figure, hidden);
  const ends = groups.flatMap(({ bars }) =>
    bars.map((bar) => headRoom * Math.max(bar.value, bar.high ?? 0)));
  const most = Math.max(0, ...ends, headRoom * (figure.y.range?.[1] ?? 0));
  const span = roundSpan([0, most || 1]);
  const left = leftOf(scaleOf(span, [size.height, 0]), size.height);
  const room = (boxOf(size).right - left) / Math.max(groups.length, 1);
  const names = groups.map(({ name }) => wrapped(name, room - 4));
  const further = Math.max(...names.map((lines) => lines.length), 1) - 1; // lines of names
  const box = boxOf(size, { top, further, left });
  const scale = scaleOf(span, [box.bottom, box.top]);
  paintGrid(surface, box, scale);
  paintNames(surface, box, figure, further);
  const stepOf = ({ bars }) => Math.min((0.85 * room) / Math.max(bars.length, 1), widestBar);
  // Overlapping texts are left out: the axis, a bar's words and the table say the same.
  const hasTexts = groups.every((group) =>
    group.bars.every((bar) => widthOf(bar.text) + 4 <= stepOf(group)));
  groups.forEach((group, index) => {
    const step = stepOf(group);
    let at = box.left + index * room + (room - step * group.bars.length) / 2;
    for (const bar of group.bars) {
      const place = {
        left: at + 0.05 * step, width: 0.9 * step, top: scale.pixel(bar.value), bottom: box.bottom,
      };
      paintBar(svg, bar, place, { y: scale.pixel, hasTexts });
      at += step;
    }
    names[index].forEach((line, i) =>
      text(svg, [box.left + (index + 0.5) * room, box.bottom + 16 + 14 * i], "middle", line));
  });
  return svg;
};
