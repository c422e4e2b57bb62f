// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The charts with their legends, whose buttons hide curves, and the same figures as a table.

import { byId, make, say } from "./dom.js";
import { Chart } from "./figures/chart.js";
import { drawnCurves } from "./figures/curves.js";
import { nearest } from "./figures/scales.js";
import { fileButton, saveButton } from "./figures/still.js";
import { legendOf } from "./legend.js";
import { plotsOf } from "./plots.js";
import { whyEmpty } from "./status.js";
import { spoken } from "./units.js";

const pointsMax = 500;
const steps = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10];
// This share of the values is usual; a peak is this many times above it.
const [usual, isPeak] = [0.98, 1.5];
const unseenEvery = 10; // a chart out of sight is drawn this much less often
const farApart = 0.25; // s between two values that a line joins, where the chart could show more

/** The next round value at or above. */
const roundUp = (value) => {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * steps.find((step) => step * power >= value * 0.9999);
};

/** The value below which that share of them lies; 0 of none. */
const quantile = (values, share) => {
  const ascending = values.filter(Number.isFinite).sort((a, b) => a - b);
  return ascending[Math.floor(share * (ascending.length - 1))] ?? 0;
};

const mostOf = (lists) => lists.flat().reduce((most, value) => Math.max(most, value ?? 0), 0);

/**
 * The value that a scale has to reach: what is `beside` counts up to half as much again, and of a
 * plot that is `robust` peaks that are rare do not.
 */
export const reachOf = (plot, curves, series) => {
  const listsOf = (isBeside) => series.filter((_, i) =>
    !curves[i].hidden && Boolean(curves[i].beside) === isBeside).map(({ most }) => most);
  const reached = (lists) => {
    const most = mostOf(lists);
    const often = quantile(lists.flat(), usual);
    return plot.robust && often > 0 && most > isPeak * often ? 1.25 * often : most;
  };
  const [own, beside] = [reached(listsOf(false)), reached(listsOf(true))];
  return Math.max(plot.span, own, own > 0 ? Math.min(beside, isPeak * own) : beside);
};

const timeAxis = { label: "time", unit: "s" };

/** The charts as data, for whoever reads the page by a program: docs/formats/live.md. */
const tellFigures = (plots) => {
  const figures = plots.filter(({ curves }) => curves.length > 0).map((plot) => ({
    id: `hapnet-${plot.key}`, title: plot.title, x: timeAxis,
    y: { label: plot.label, unit: plot.unit }, source: plot.source,
    series: plot.curves.map(({ label, name }) => ({ name: label, column: name })),
  }));
  say(byId("hapnet-data"), JSON.stringify({ figures }));
};

const inSeconds = (mark) => (mark === 0 ? "now" : `${mark} s`);

class Panel {
  constructor(plot) {
    Object.assign(this, { plot, hidden: new Set(), seen: true, most: 0, left: 0, curves: [] });
    this.area = make("div", { class: "plot" });
    this.legend = make("div", { class: "legend" });
    this.source = make("span", { class: "source" });
    this.note = make("p", { class: "note" });
    this.root = make(
      "figure",
      { class: "chart", "data-chart": plot.key, "data-figure": `hapnet-${plot.key}` },
      make("figcaption", {}, make("b", {}, plot.title), ` ${plot.unit}, over time in s`),
      this.area,
      this.note,
      this.legend,
      make("p", { class: "saves" }, this.source,
        saveButton(() => ({ figure: this.#figure() })),
        fileButton("Save as CSV", "text/csv", () =>
          ({ name: `hapnet-${this.plot.key}.csv`, text: this.#table() }))),
    );
    this.chart = new Chart(this.area, { isLive: true });
    new IntersectionObserver(([entry]) => {
      this.seen = entry.isIntersecting;
    }).observe(this.root);
  }

  setPlot(plot) {
    this.plot = plot;
    this.root.hidden = plot.curves.length === 0;
    say(this.source, `Source: ${plot.source}.`);
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
      id: `hapnet-${this.plot.key}`, kind: "curves", draw: drawnCurves, title: this.plot.title,
      series,
      width: 900, height: 280, x: { ...timeAxis, range: this.view.x },
      y: { label: this.plot.label, unit: this.plot.unit, range: this.view.y },
    };
  }

  /** What is shown now as CSV: a line for each moment, empty where nothing is known. */
  #table() {
    const shown = this.curves.filter((curve) => !curve.hidden);
    const unit = this.plot.unit;
    const heads = shown.flatMap(({ label, band }) =>
      [label, ...(band ? [`${label} least`, `${label} most`] : [])]
        .map((head) => `"${head}, ${unit}"`));
    const times = shown[0]?.x ?? [];
    const cell = (value) => (Number.isFinite(value) ? String(Number(value.toPrecision(6))) : "");
    const lines = times.map((time, i) => [
      (this.to + time).toFixed(3),
      ...shown.flatMap(({ y, band }) =>
        [y[i], ...(band ? [band.low[i], band.high[i]] : [])].map(cell)),
    ].join());
    return [['"at, s"', ...heads].join(), ...lines, ""].join("\n");
  }

  /** The top of the scale: grows at once, shrinks when there is much room. */
  #top(series, curves) {
    const wanted = roundUp(reachOf(this.plot, curves, series) * 1.08);
    if (wanted > this.most || wanted < 0.6 * this.most) this.most = wanted;
    return this.most;
  }

  /** What one has to know of the drawing: why it is empty, what is cut off, what was not seen. */
  #notes(series, x, top, why) {
    const isShown = (_, i) => !this.curves[i].hidden;
    const values = series.filter(isShown).flatMap(({ most }) => most);
    if (!values.some(Number.isFinite)) return why;
    const cut = this.curves.flatMap(({ label, hidden }, i) => {
      const most = mostOf([series[i].most]);
      return !hidden && most > top ? [`${label} (up to ${spoken(most)} ${this.plot.unit})`] : [];
    });
    const gaps = x.slice(1).map((time, i) => time - x[i]);
    const widest = Math.max(0, ...gaps);
    const canShow = (3 * (this.view.x[1] - this.view.x[0])) / pointsMax;
    return [
      cut.length > 0 ? `Cut off at the top: ${cut.join(", ")}.` : "",
      widest > Math.max(farApart, canShow)
        ? `Lines join values up to ${spoken(widest)} s apart: nothing was seen between.` : "",
    ].filter((words) => words !== "").join(" ");
  }

  /** Nothing has come yet. */
  tellEmpty(why) { say(this.note, why); }

  update(columns, from, to, why) {
    this.left = this.seen ? 0 : (this.left + 1) % unseenEvery;
    if (this.left > 0) return;
    const { curves } = this.plot;
    const { times, series } = columns.sampled(curves.map(({ name }) => name), from, to, pointsMax);
    const x = times.map((time) => time - to);
    this.curves = curves.map((curve, i) => ({
      label: curve.label, colour: curve.colour, hidden: this.hidden.has(curve.name), x,
      beside: curve.beside,
      y: curve.show === "most" ? series[i].most : series[i].value,
      width: curve.dash ? 1.25 : 1.75, dash: curve.dash ? "5 4" : undefined,
      band: curve.band ? { x, low: series[i].least, high: series[i].most } : undefined,
    }));
    this.to = to;
    this.view = { x: [from - to, 0], y: [0, this.#top(series, this.curves)], says: inSeconds };
    say(this.note, this.#notes(series, x, this.view.y[1], why));
    this.chart.update([...this.curves].reverse(), this.view); // requested values lie on top
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
    tellFigures(plots);
    return plots;
  }

  draw(now) {
    if (now - this.#drawn < 100) return;
    this.#drawn = now;
    const plots = this.#plots();
    const columns = this.#columns();
    const to = this.model.lookingAt ?? columns.newest;
    const why = plots.map((plot) => whyEmpty(this.model.state, plot));
    const isAny = plots.some(({ curves }) => curves.length > 0);
    say(byId("charts-empty"), isAny ? "" : `No figure yet. ${why[0]}`);
    if (Number.isFinite(to))
      this.#panels.forEach((panel, i) => panel.update(columns, to - this.seconds, to, why[i]));
    else this.#panels.forEach((panel, i) => panel.tellEmpty(why[i]));
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
