// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A figure of curves that answers: point at it for values, drag across it to zoom, and hide curves
// by its legend. It takes the place of the still drawing.

import { make, say } from "../dom.js";
import { legendOf } from "../legend.js";
import { onColours, readColours } from "../paint/palette.js";
import { rowsOf, spansOf, stylesOf, valueNear } from "./curves.js";

const headAndFoot = 78; // of the still drawing, in pixels: title, marks and the name of the axis
const leastDrag = 5; // pixels
const leastWidth = 80; // pixels: in less there is no room for the scale

const spoken = (value) => (value === null ? "–" : String(Number(value.toPrecision(4))));

export class Plot {
  /** `zoom` is that of all figures that zoom together, `group` their name. */
  constructor(place, data, { makeChart, zoom, group }) {
    Object.assign(this, { place, data, zoom, hidden: new Set(), colours: readColours() });
    this.styles = stylesOf(data);
    this.rows = rowsOf(data);
    this.spans = spansOf(data);
    this.area = make("div", {
      class: "plot zoomable", tabindex: 0, role: "group",
      "aria-label": `${data.title}. Drag to zoom, or use plus, minus, arrow keys, and 0 for all.`,
    });
    this.area.style.height = `${Math.max(120, data.height - headAndFoot)}px`;
    this.named = this.styles.filter((style) => style.label !== "");
    const { buttons, values } = legendOf(this.named, this.hidden, () => this.draw());
    this.values = values;
    this.pointedAt = make("output", { class: "figure pointed" });
    this.root = make("div", { class: "chart" },
      make("p", { class: "head" }, make("b", {}, data.title), ` ${data.y}`), this.area,
      make("p", { class: "foot" }, this.pointedAt, make("span", {}, data.x)),
      make("div", { class: "legend" }, ...buttons));
    place.querySelector("svg").replaceWith(this.root);
    this.chart = makeChart(this.area, { group, onPoint: () => this.#point() });
    this.#listen();
    new ResizeObserver(() => this.#resize()).observe(this.area);
    this.draw();
  }

  #listen() {
    this.zoom.addEventListener("change", () => this.draw());
    onColours(() => {
      this.colours = readColours();
      this.draw();
    });
    this.area.addEventListener("dblclick", () => this.zoom.reset());
    this.area.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (this.zoom.key(event.key)) event.preventDefault();
    });
    let begin = null;
    const band = make("div", { class: "zoom-band", hidden: true });
    this.area.append(band);
    const ends = (event) => {
      const { left, width } = this.chart.area();
      return [begin, event.clientX].map((at) => Math.min(Math.max(at, left), left + width))
        .sort((a, b) => a - b);
    };
    this.area.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.drawn) return;
      begin = event.clientX;
      this.area.setPointerCapture(event.pointerId);
    });
    this.area.addEventListener("pointermove", (event) => {
      if (begin === null) return;
      const [from, to] = ends(event);
      const { left } = this.area.getBoundingClientRect();
      band.hidden = to - from < leastDrag;
      Object.assign(band.style, { left: `${from - left}px`, width: `${to - from}px` });
    });
    const finish = (event) => {
      if (begin === null) return;
      const [from, to] = ends(event);
      begin = null;
      band.hidden = true;
      if (event.type !== "pointerup" || to - from < leastDrag) return;
      this.zoom.show(this.chart.valueAt(from), this.chart.valueAt(to));
    };
    this.area.addEventListener("pointerup", finish);
    this.area.addEventListener("pointercancel", finish);
  }

  #resize() {
    if (this.area.clientWidth < leastWidth) return;
    if (this.drawn) this.chart.resize();
    else this.draw();
  }

  /** What stands under the cursor, in the legend. */
  #point() {
    const row = this.chart.pointed();
    const isKnown = row !== null && row !== undefined;
    say(this.pointedAt, isKnown ? `at ${spoken(this.rows.times[row])}` : "");
    this.named.forEach((style, i) => {
      const curves = this.styles.flatMap((one, k) => (one.name === style.name ? [k] : []));
      const found = isKnown
        ? curves.map((k) => valueNear(this.rows, k, row, this.zoom.range))
          .find((value) => value !== null)
        : undefined;
      say(this.values[i], isKnown ? spoken(found ?? null) : "");
    });
  }

  /** Draws anew, once there is room: not in a part of the page that is folded. */
  draw() {
    if (this.area.clientWidth < leastWidth || this.rows.times.length === 0) return;
    const curves = this.styles.map((style) => ({ ...style, hidden: this.hidden.has(style.name) }));
    const view = {
      x: this.zoom.range, y: this.spans.y, logX: this.data.log_x, logY: this.data.log_y,
      levels: this.data.levels,
    };
    this.drawn = true;
    const { times, series } = this.rows; // the first curve lies on top
    const data = { times, series: [...series].reverse(), curves: curves.reverse() };
    this.chart.update(data, view, this.colours);
  }
}
