// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The numbers of a figure as a table, for those who cannot see it.

import { make } from "../dom.js";
import { groupsOf } from "./bars.js";
import { nameOfAxis } from "./svg.js";

const rowsMax = 200;

/** At most so many rows, evenly chosen. */
const fewOf = (rows) => {
  const every = Math.ceil(rows.length / rowsMax);
  return rows.filter((_, i) => i % every === 0);
};

const curveRows = (figure) => figure.series.flatMap(({ name, points, scatter = [] }) =>
  [...points, ...scatter].map(([x, y]) => [name, x, y]));

const barRows = (figure) => groupsOf(figure).flatMap(({ name, bars }) =>
  bars.map((bar) => [name, bar.tip || bar.text, bar.value, bar.low ?? "", bar.high ?? ""]));

const cellRows = (figure) => figure.series.flatMap(({ cells }) =>
  cells.map((cell) => [figure.x.categories[cell.x], figure.y.categories[cell.y], cell.tip]));

/** {heads, rows} of any figure. */
export const numbersOf = (figure) => {
  const [x, y] = [nameOfAxis(figure.x) || "group", nameOfAxis(figure.y) || "value"];
  if (figure.kind === "curves") return { heads: ["curve", x, y], rows: curveRows(figure) };
  if (figure.kind === "bars") return { heads: [x, "bar", y, "low", "high"], rows: barRows(figure) };
  return { heads: [x, y, "values"], rows: cellRows(figure) };
};

/** A folded table, which is filled when it is opened. */
export const foldedTable = (figure) => {
  const fill = ({ currentTarget }) => {
    if (!currentTarget.open || currentTarget.querySelector("table")) return;
    const { heads, rows } = numbersOf(figure);
    const shown = fewOf(rows);
    const rest = shown.length < rows.length ? `, ${shown.length} of ${rows.length} rows` : "";
    currentTarget.append(make("div", { class: "scroll", role: "region", tabindex: 0,
      "aria-label": figure.title },
    make("table", {}, make("caption", {}, figure.title + rest),
      make("thead", {}, make("tr", {}, ...heads.map((head) => make("th", { scope: "col" }, head)))),
      make("tbody", {}, ...shown.map(([name, ...cells]) => make("tr", {},
        make("th", { scope: "row" }, name),
        ...cells.map((cell) => make("td", {}, String(cell)))))))));
  };
  return make("details", { class: "as-table", ontoggle: fill }, make("summary", {}, "Table"));
};
