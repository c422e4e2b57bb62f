// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A figure that answers: point at it for values, hide a series by the legend, zoom curves, save the
// drawing, and open its numbers as a table.

import { make, say } from "../dom.js";
import { toggleOf } from "../legend.js";
import { Chart } from "./chart.js";
import { drawnBars } from "./bars.js";
import { curvesOf, drawnCurves, spansOf, valueNear } from "./curves.js";
import { drawnDots, heightOfDots } from "./dots.js";
import { drawnHeatMap } from "./heat_map.js";
import { heightOf, markOf, namedIn, saveButton } from "./still.js";
import { paintOf } from "./svg.js";
import { foldedTable } from "./table.js";

const kinds = {
  curves: { draw: drawnCurves }, bars: { draw: drawnBars }, "heat-map": { draw: drawnHeatMap },
  dots: { draw: drawnDots, heightAt: heightOfDots },
};
const leastDrag = 5; // pixels
const leastWidth = 80; // pixels

const spoken = (value) => (value === null ? "–" : String(Number(value.toPrecision(4))));

/** What all kinds have: `root` is the element, `area` the place of the drawing. */
class Figure {
  constructor(data) {
    Object.assign(this, { data, hidden: new Set() });
    this.named = namedIn(data);
    this.values = this.named.map(() => make("span", { class: "figure" }));
    this.pointedAt = make("output", { class: "figure pointed" });
    this.area = make("div", { class: "plot" });
    this.area.style.height = `${heightOf(data, data.width)}px`;
    const toggle = (name) => () => {
      if (!this.hidden.delete(name)) this.hidden.add(name);
      this.draw();
      return !this.hidden.has(name);
    };
    const buttons = this.named.map((series, i) => toggleOf(
      {
        label: series.name, colour: paintOf(series.colour), dash: series.dash,
        mark: markOf(data, series),
      }, true,
      toggle(series.name), " ", this.values[i]));
    this.root = make("div", { class: "chart" },
      make("p", { class: "head" }, make("b", {}, data.title)), this.area,
      make("p", { class: "foot" }, this.pointedAt,
        saveButton(() => ({ figure: data, hidden: this.hidden, range: this.zoom?.range }))),
      buttons.length > 0 ? make("div", { class: "legend" }, ...buttons) : null,
      foldedTable(data));
  }
}

/** Bars and heat maps: the part under the pointer tells what it is. */
class Still extends Figure {
  constructor(data) {
    super(data);
    new ResizeObserver(() => this.draw()).observe(this.area);
    this.area.addEventListener("pointerover", ({ target }) =>
      say(this.pointedAt, target.closest(".part")?.dataset.tip ?? ""));
    // A finger leaves with every tap: the value stays shown until the next one.
    this.area.addEventListener("pointerleave", ({ pointerType }) => {
      if (pointerType !== "touch") say(this.pointedAt, "");
    });
  }

  draw() {
    const { clientWidth: width } = this.area;
    if (width < leastWidth) return;
    const height = heightOf(this.data, width);
    this.area.style.height = `${height}px`;
    const { data, hidden } = this;
    this.area.replaceChildren(data.draw(data, { width, height }, { hidden }));
  }
}

/** Curves: `zoom` is that of all figures that zoom together, `group` their name. */
class Curves extends Figure {
  constructor(data, { zoom, group }) {
    super(data);
    this.zoom = zoom;
    this.curves = curvesOf(data);
    this.spans = spansOf(data);
    this.area.classList.add("zoomable");
    Object.assign(this.area, {
      tabIndex: 0, role: "group",
      ariaLabel: `${data.title}. Drag to zoom, or use plus, minus, arrow keys, and 0 for all.`,
    });
    this.chart = new Chart(this.area, { group, onPoint: () => this.#point() });
    this.#listen();
    this.draw();
  }

  #listen() {
    this.zoom.addEventListener("change", () => this.draw());
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
      if (event.button !== 0 || !this.chart.isDrawn) return;
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

  /** The values under the cursor, in the legend. */
  #point() {
    const x = this.chart.pointed;
    say(this.pointedAt, x === null ? "" : `at ${spoken(x)}`);
    const [from, to] = this.zoom.range;
    this.named.forEach((series, i) => {
      const found = this.curves.filter((one) => one.name === series.name)
        .map((part) => valueNear(part, x, 0.02 * (to - from))).filter((value) => value !== null);
      say(this.values[i], x === null ? "" : spoken(found[0] ?? null));
    });
  }

  draw() {
    const curves = this.curves.map((curve) => ({ ...curve, hidden: this.hidden.has(curve.name) }));
    this.chart.update(curves, {
      x: this.zoom.range, y: this.spans.y, logX: this.data.x.scale === "log",
      logY: this.data.y.scale === "log", levels: this.data.levels,
      moments: this.data.moments, names: this.data,
    });
  }
}

export const makeFigure = (data, options) => {
  const figure = { ...data, ...kinds[data.kind] };
  return data.kind === "curves" ? new Curves(figure, options) : new Still(figure);
};
