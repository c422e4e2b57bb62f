// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The numbers of a figure as a table, for those who cannot see it.

import { make } from "../dom.js";
import { groupsOf } from "./bars.js";
import { nameOfAxis } from "./svg.js";

const rowsMax = 200;

/** A number to four digits, a whole one in full; a text as it is. */
const numberText = (cell) => {
  if (typeof cell !== "number" || Number.isInteger(cell)) return String(cell);
  return String(Math.abs(cell) >= 1000 ? Math.round(cell) : Number(cell.toPrecision(4)));
};

/** At most so many rows, evenly chosen. */
const fewOf = (rows) => {
  const every = Math.ceil(rows.length / rowsMax);
  return rows.filter((_, i) => i % every === 0);
};

const hasBands = (figure) => figure.series.some(({ band }) => band);

const curveRows = (figure) => figure.series.flatMap(({ name, points, scatter = [], band = [] }) => {
  const ends = new Map(band.map(([x, low, high]) => [x, [low, high]]));
  return [...points, ...scatter].map(([x, y]) =>
    [name, x, y, ...(hasBands(figure) ? ends.get(x) ?? ["", ""] : [])]);
});

const dotRows = (figure) => figure.series.flatMap(({ dots }) => dots.map((row) =>
  [figure.y.categories[row.at], row.value ?? "", row.low ?? "", row.high ?? ""]));

const barRows = (figure) => groupsOf(figure).flatMap(({ name, bars }) =>
  bars.map((bar) => [name, bar.tip || bar.text, bar.value, bar.low ?? "", bar.high ?? ""]));

const cellRows = (figure) => figure.series.flatMap(({ cells }) =>
  cells.map((cell) => [figure.x.categories[cell.x], figure.y.categories[cell.y], cell.tip]));

/** {heads, rows} of any figure. */
export const numbersOf = (figure) => {
  const [x, y] = [nameOfAxis(figure.x) || "group", nameOfAxis(figure.y) || "value"];
  if (figure.kind === "curves") {
    const ends = hasBands(figure) ? ["low", "high"] : [];
    return { heads: ["curve", x, y, ...ends], rows: curveRows(figure) };
  }
  if (figure.kind === "dots") return { heads: [y, x, "low", "high"], rows: dotRows(figure) };
  if (figure.kind === "bars") return { heads: [x, "bar", y, "low", "high"], rows: barRows(figure) };
  return { heads: [x, y, "values"], rows: cellRows(figure) };
};

/** Says of a table that is wider than its place that it scrolls. */
const tellOfScrolling = (place) => {
  const hint = make("p", { class: "scrolls", hidden: true }, "The table scrolls sideways.");
  new ResizeObserver(() => {
    hint.hidden = place.scrollWidth <= place.clientWidth;
  }).observe(place);
  return hint;
};

/** A folded table, which is filled when it is opened. */
export const foldedTable = (figure) => {
  const fill = ({ currentTarget }) => {
    if (!currentTarget.open || currentTarget.querySelector("table")) return;
    const { heads, rows } = numbersOf(figure);
    const shown = fewOf(rows);
    const rest = shown.length < rows.length ? `, ${shown.length} of ${rows.length} rows` : "";
    const place = make("div", { class: "scroll", role: "region", tabindex: 0,
      "aria-label": figure.title },
    make("table", {}, make("caption", {}, figure.title + rest),
      make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
      make("tbody", {}, ...shown.map(([name, ...cells]) => make("tr", {},
        make("th", { scope: "row" }, name),
        ...cells.map((cell) => make("td", {}, numberText(cell))))))));
    currentTarget.append(tellOfScrolling(place), place);
  };
  return make("details", { class: "as-table", ontoggle: fill }, make("summary", {}, "Table"));
};
