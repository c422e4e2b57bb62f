// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The charts with their legends, whose buttons hide curves, and the same figures as a table.

import { make, say } from "./dom.js";
import { legendOf } from "./legend.js";
import { onColours, readColours } from "./paint/palette.js";
import { plotsOf } from "./plots.js";
import { spoken } from "./units.js";

const pointsMax = 500;
const steps = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];

/** The next round value at or above. */
const roundUp = (value) => {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * steps.find((step) => step * power >= value * 0.9999);
};

const inSeconds = (mark) => (mark === 0 ? "now" : `${mark} s`);

class Panel {
  constructor(plot, makeChart) {
    Object.assign(this, { plot, hidden: new Set(), seen: true, most: 0 });
    this.area = make("div", { class: "plot" });
    this.legend = make("div", { class: "legend" });
    this.root = make(
      "figure",
      { class: "chart", "data-chart": plot.key },
      make("figcaption", {}, make("b", {}, plot.title), ` ${plot.unit}`),
      this.area,
      this.legend,
    );
    this.chart = makeChart(this.area);
    new ResizeObserver(() => this.chart.resize()).observe(this.area);
    new IntersectionObserver(([entry]) => {
      this.seen = entry.isIntersecting;
    }).observe(this.root);
  }

  setPlot(plot) {
    this.plot = plot;
    const signature = plot.curves.map((curve) => curve.name + curve.label).join();
    if (signature === this.signature) return;
    this.signature = signature;
    const { buttons, values } = legendOf(plot.curves, this.hidden);
    this.values = values;
    this.legend.replaceChildren(...buttons);
  }

  /** The top of the scale: grows at once, shrinks when there is much room. */
  #top(series, curves) {
    let most = this.plot.span;
    series.forEach((one, i) => {
      if (!curves[i].hidden)
        one.most.forEach((value) => {
          most = Math.max(most, value ?? 0);
        });
    });
    const wanted = roundUp(most * 1.08);
    if (wanted > this.most || wanted < 0.6 * this.most) this.most = wanted;
    return this.most;
  }

  update(columns, from, to, colours) {
    if (!this.seen) return;
    const curves = this.plot.curves.map((curve) => ({
      ...curve,
      hidden: this.hidden.has(curve.name),
    }));
    const data = columns.sampled(
      curves.map((curve) => curve.name),
      from,
      to,
      pointsMax,
    );
    data.times = data.times.map((time) => time - to);
    const view = { x: [from - to, 0], y: [0, this.#top(data.series, curves)], says: inSeconds };
    this.chart.update({ ...data, curves }, view, colours);
    const point = this.chart.pointed?.() ?? data.times.length - 1;
    data.series.forEach((one, i) => {
      const list = curves[i].show === "most" ? one.most : one.value;
      say(this.values[i], spoken(list[point] ?? null));
    });
  }
}

export class ChartPanel {
  seconds = 30;
  #panels = [];
  #drawn = 0;

  constructor(container, table, model, makeChart) {
    Object.assign(this, { container, table, model, makeChart, colours: readColours() });
    onColours(() => {
      this.colours = readColours();
    });
  }

  show(path, ends) {
    Object.assign(this, { path, ends });
  }

  #columns() {
    return this.seconds > 120 ? this.model.coarse : this.model.fine;
  }

  #plots() {
    const plots = plotsOf(this.model, this.path ?? "", this.ends ?? ["A", "B"]);
    if (this.#panels.length === 0) {
      this.#panels = plots.map((plot) => new Panel(plot, this.makeChart));
      this.container.replaceChildren(...this.#panels.map((panel) => panel.root));
    }
    plots.forEach((plot, i) => this.#panels[i].setPlot(plot));
    return plots;
  }

  draw(now) {
    if (now - this.#drawn < 100) return;
    this.#drawn = now;
    this.#plots();
    const columns = this.#columns();
    const to = this.model.lookingAt ?? columns.newest;
    if (!Number.isFinite(to)) return;
    this.#panels.forEach((panel) => panel.update(columns, to - this.seconds, to, this.colours));
  }

  /** The table of the same figures, for those who cannot see the curves. */
  describe() {
    if (!this.table.parentElement.open) return;
    const columns = this.#columns();
    const to = this.model.lookingAt ?? columns.newest;
    const rows = this.#plots().flatMap((plot) =>
      plot.curves.map((curve) => {
        const all = columns.summary(curve.name, this.seconds, to);
        const newest = columns.summary(curve.name, 0.5, to);
        const cells = [newest?.mean, all?.mean, all?.least, all?.most].map((value) =>
          spoken(value, 2),
        );
        return [`${plot.title}, ${plot.unit}: ${curve.label}`, ...cells];
      }),
    );
    const heads = ["figure", "now", "mean", "least", "most"];
    if (this.table.tHead === null) {
      this.table
        .createTHead()
        .append(make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head))));
      this.table.createTBody();
    }
    const body = this.table.tBodies[0];
    while (body.rows.length > rows.length) body.deleteRow(-1);
    rows.forEach((cells, i) => {
      const row =
        body.rows[i] ??
        body.appendChild(
          make("tr", {}, make("th", { scope: "row" }), ...heads.slice(1).map(() => make("td"))),
        );
      cells.forEach((cell, column) => say(row.cells[column], cell));
    });
  }
}
