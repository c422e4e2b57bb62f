// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A figure of bars that answers: point at one for its words, and hide those of a colour by the
// legend. It takes the place of the still drawing.

import { make, say } from "../dom.js";
import { toggleOf } from "../legend.js";
import { roundMarks } from "../rules.js";

const margins = { left: 60, right: 15, top: 12, bottom: 26 };
const svgNames = "http://www.w3.org/2000/svg";

const element = (parent, name, attributes, words) => {
  const made = document.createElementNS(svgNames, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (words !== undefined) made.textContent = words;
  parent?.append(made);
  return made;
};
const text = (parent, [x, y], anchor, words, more = {}) =>
  element(parent, "text", { x, y, "text-anchor": anchor, ...more }, words);

const barPath = (bar, { left, width, top, bottom }) => {
  const right = left + width;
  if (!bar.open) return `M${left} ${bottom}V${top}H${right}V${bottom}`;
  const shoulder = Math.min(top + 8, bottom); // of an arrow
  const tip = `${left + width / 2} ${top}`;
  return `M${left} ${bottom}V${shoulder}L${tip}L${right} ${shoulder}V${bottom}`;
};

const paintInterval = (group, bar, middle, y) => {
  const [low, high] = [y(bar.low), y(bar.high)];
  const d = `M${middle} ${low}V${high}M${middle - 4} ${low}h8M${middle - 4} ${high}h8`;
  element(group, "path", { d, stroke: "currentColor", "stroke-width": 1.2, fill: "none" });
  return high;
};

const paintBar = (svg, bar, place, y, point) => {
  const group = element(svg, "g", { class: "one-bar" });
  element(group, "title", {}, bar.tip || bar.label);
  element(group, "path", {
    d: barPath(bar, place), fill: bar.colour, stroke: bar.colour,
    "fill-opacity": bar.outlined ? 0.12 : 0.85, "stroke-dasharray": bar.outlined ? "4 2" : "none",
  });
  const middle = place.left + place.width / 2;
  const end = bar.high === undefined ? place.top : paintInterval(group, bar, middle, y);
  const fitting = (1.1 * place.width) / (0.62 * Math.max(bar.label.length, 1));
  const style = { "font-size": Math.min(12, Math.max(8, fitting)) };
  if (bar.missed) Object.assign(style, { fill: "var(--missed)", "font-weight": "bold" });
  text(group, [middle, Math.min(place.top, end) - 4], "middle", bar.label, style);
  group.addEventListener("pointerenter", () => point(bar.tip || bar.label));
  group.addEventListener("pointerleave", () => point(""));
};

const paintGrid = (svg, box, top, y) => {
  for (const mark of roundMarks(0, top, 5)) {
    const down = y(mark);
    element(svg, "line", {
      x1: box.left, x2: box.right, y1: down, y2: down, stroke: "currentColor",
      "stroke-opacity": 0.15,
    });
    text(svg, [box.left - 6, down + 4], "end", String(mark));
  }
};

/** The drawing without the bars whose colours are hidden; `point` gets the words of one. */
export const paintBars = (data, hidden, point) => {
  const { width } = data;
  const height = data.height - 40; // the head and the legend stand beside it
  const svg = element(null, "svg", {
    viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": data.title,
  });
  const box = {
    left: margins.left, right: width - margins.right,
    top: margins.top, bottom: height - margins.bottom,
  };
  const shown = data.groups.map((group) =>
    ({ ...group, bars: group.bars.filter((bar) => !hidden.has(bar.colour)) }));
  const ends = shown.flatMap(({ bars }) =>
    bars.map((bar) => 1.12 * Math.max(bar.value, bar.high ?? 0)));
  const top = Math.max(0, ...ends) || 1;
  const y = (value) => box.bottom - ((box.bottom - box.top) * value) / top;
  paintGrid(svg, box, top, y);
  const room = (box.right - box.left) / Math.max(shown.length, 1);
  shown.forEach((group, index) => {
    const step = Math.min((0.85 * room) / Math.max(group.bars.length, 1), 48);
    let at = box.left + index * room + (room - step * group.bars.length) / 2;
    for (const bar of group.bars) {
      const place = {
        left: at + 0.05 * step, width: 0.9 * step, top: y(bar.value), bottom: box.bottom,
      };
      paintBar(svg, bar, place, y, point);
      at += step;
    }
    text(svg, [box.left + (index + 0.5) * room, box.bottom + 16], "middle", group.name);
  });
  return svg;
};

export class Bars {
  constructor(place, data) {
    Object.assign(this, { place, data, hidden: new Set() });
    this.pointedAt = make("output", { class: "figure pointed" });
    const toggle = (colour) => () => {
      if (!this.hidden.delete(colour)) this.hidden.add(colour);
      this.draw();
      return !this.hidden.has(colour);
    };
    const buttons = data.legend.map(({ name, colour }) =>
      toggleOf({ label: name, colour }, true, toggle(colour)));
    this.drawing = make("div", { class: "bars" });
    this.root = make("div", { class: "chart" },
      make("p", { class: "head" }, make("b", {}, data.title), ` ${data.y}`), this.drawing,
      make("p", { class: "foot" }, this.pointedAt, make("span", {}, data.x)),
      make("div", { class: "legend" }, ...buttons));
    place.querySelector("svg").replaceWith(this.root);
    this.draw();
  }

  draw() {
    const point = (words) => say(this.pointedAt, words);
    this.drawing.replaceChildren(paintBars(this.data, this.hidden, point));
  }
}
