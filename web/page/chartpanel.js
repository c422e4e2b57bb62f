// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The charts with their legends, whose buttons hide curves, and the same figures as a table.

import { make, say } from "./dom.js";
import { Chart } from "./figures/chart.js";
import { nearest } from "./figures/scales.js";
import { saveButton } from "./figures/still.js";
import { legendOf } from "./legend.js";
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
  constructor(plot) {
    Object.assign(this, { plot, hidden: new Set(), seen: true, most: 0, curves: [] });
    this.area = make("div", { class: "plot" });
    this.legend = make("div", { class: "legend" });
    this.root = make(
      "figure",
      { class: "chart", "data-chart": plot.key },
      make("figcaption", {}, make("b", {}, plot.title), ` ${plot.unit}`),
      this.area,
      this.legend,
      saveButton(() => ({ figure: this.#figure() })),
    );
    this.chart = new Chart(this.area, { isLive: true });
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

  /** What is shown now, as a figure to be saved. */
  #figure() {
    const pointsOf = ({ x, y }) => x.flatMap((time, i) => (y[i] === null ? [] : [[time, y[i]]]));
    const bandOf = ({ x, low, high }) =>
      x.flatMap((time, i) => (low[i] === null ? [] : [[time, low[i], high[i]]]));
    const series = this.curves.filter((curve) => !curve.hidden).map((curve) => ({
      name: curve.label, colour: curve.colour, width: curve.width, dash: curve.dash,
      points: pointsOf(curve), band: curve.band ? bandOf(curve.band) : undefined,
    }));
    return {
      id: `hapnet-${this.plot.key}`, kind: "curves", title: this.plot.title, series,
      width: 900, height: 280, x: { label: "time", unit: "s", range: this.view.x },
      y: { label: "", unit: this.plot.unit, range: this.view.y },
    };
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

  update(columns, from, to) {
    if (!this.seen) return;
    const { curves } = this.plot;
    const { times, series } = columns.sampled(curves.map(({ name }) => name), from, to, pointsMax);
    const x = times.map((time) => time - to);
    this.curves = curves.map((curve, i) => ({
      label: curve.label, colour: curve.colour, hidden: this.hidden.has(curve.name), x,
      y: curve.show === "most" ? series[i].most : series[i].value,
      width: curve.dash ? 1.25 : 1.75, dash: curve.dash ? "5 4" : undefined,
      band: curve.band ? { x, low: series[i].least, high: series[i].most } : undefined,
    }));
    this.view = { x: [from - to, 0], y: [0, this.#top(series, this.curves)], says: inSeconds };
    this.chart.update([...this.curves].reverse(), this.view); // what was asked lies on top
    const { pointed } = this.chart;
    const point = pointed === null ? x.length - 1 : nearest(x, pointed);
    this.curves.forEach(({ y }, i) => say(this.values[i], spoken(y[point] ?? null)));
  }
}

export class ChartPanel {
  seconds = 30;
  #panels = [];
  #drawn = 0;

  constructor(container, table, model) {
    Object.assign(this, { container, table, model });
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
      this.#panels = plots.map((plot) => new Panel(plot));
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
    this.#panels.forEach((panel) => panel.update(columns, to - this.seconds, to));
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
