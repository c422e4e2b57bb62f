// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What of the results stands against the paper, and what is claimed beyond it.

import {
  badge, bold, claimOf, distinct, exactLimit, inWords, median, ours, paragraph, rowsOf, shown,
  styled, table, wordBadge,
} from "./words.js";

const table1Line = (row) => ["Table 1, ", bold(row.algorithm),
  `: mean ${shown(row.mean_mm, 2)}, std ${shown(row.std_mm, 2)}, max ${shown(row.max_mm, 1)} mm `
  + `(paper: ${shown(row.paper_mean_mm, 2)}, ${shown(row.paper_std_mm, 2)}, `
  + `${shown(row.paper_max_mm, 1)}), ${row.class}`];

const limitLine = (row) => {
  const paper = row.paper_limit === null ? "–" : exactLimit(row, row.paper_limit);
  const interval = row.ci_low === null || row.ci_high === null ? ""
    : `, 95 %: ${shown(row.ci_low, 1)} … ${shown(row.ci_high, 1)}`;
  return [`Limit of ${inWords(row.impairment)}, `, bold(row.algorithm),
    `, worst of the tasks: ${exactLimit(row)} (paper: ${paper})${interval}, ${row.class}`];
};

const kinds = ["calibrated", "selected", "by-construction", "met", "undecided", "missed"];

/** What Table 1 and the worst of the tasks say: lines by kind. Green is for predictions alone. */
const mainClaims = ({ tables }) => {
  const lines = Object.fromEntries(kinds.map((kind) => [kind, []]));
  const add = (claim, { class: origin }, line) => {
    if (!claim) return;
    const isSure = claim === "missed" || claim === "undecided";
    lines[isSure || !kinds.slice(0, 3).includes(origin) ? (isSure ? claim : "met") : origin]
      .push(line);
  };
  rowsOf(tables.table1).forEach((row) => add(row.verdict, row, table1Line(row)));
  rowsOf(tables.limits).filter(({ task }) => task === "worst")
    .forEach((row) => add(claimOf(row.status), row, limitLine(row)));
  return lines;
};

/** The number of results for each verdict against the paper. */
export const tiles = (data) => {
  const lines = mainClaims(data);
  if (kinds.every((kind) => lines[kind].length === 0)) return [];
  const tile = (text, style, ...of) =>
    ({ count: of.reduce((sum, kind) => sum + lines[kind].length, 0), text, style });
  return [{ tiles: [tile("calibrated", "calibrated", "calibrated"),
    tile("selected, or by construction", "seen", "selected", "by-construction"),
    tile("predicted and met", "met", "met"), tile("undecided", "seen", "undecided"),
    tile("missed", "missed", "missed")] }];
};

export const claims = (section, data) => {
  const lines = mainClaims(data);
  return [
    paragraph([bold("Calibrated"), ": fitted to the paper’s number, so agreeing shows nothing. ",
      bold("Selected"), ": it follows from a reading of the paper that was chosen among several "
      + "with a look at this very number. ", bold("By construction"), ": sep is base there. ",
      bold("Predicted"), ": the number had no part in any choice. ", bold("Undecided"), ": the 95 "
      + "% interval lies across the edge of what would agree. The paper’s numbers are of all tasks "
      + "together, so single tasks are not held against them."]),
    { claims: [["Calibrated", "calibrated", "calibrated"],
      ["Selected, and agrees", "seen", "selected"],
      ["The same by construction", "seen", "by-construction"],
      ["Predicted and met", "met", "met"], ["Undecided", "seen", "undecided"],
      ["Missed", "missed", "missed"]]
      .map(([title, style, kind]) => ({ title, style, list: lines[kind] })) },
  ];
};

/** What no verdict sees: how hard the copies pull at each other slowly. */
const slowForces = (rows) => {
  const measured = rows.filter((row) => row.algorithm === rows[0].algorithm);
  const names = distinct(rows, ({ task }) => task);
  const cellOf = (condition, task) => {
    const values = measured.filter((row) => row.condition === condition && row.task === task)
      .map(({ force_above_2hz_n: force }) => force).filter((force) => typeof force === "number");
    const largest = shown(Math.max(...values), 3);
    return values.length === 0 ? "" : `${shown(median(values), 3)} (${largest})`;
  };
  const lines = distinct(rows, ({ condition }) => condition).map((condition) =>
    [condition, ...names.map((task) => cellOf(condition, task))]);
  if (lines.every(([, ...cells]) => cells.every((cell) => cell === ""))) return [];
  return [
    paragraph("No claim is about this number, and “usable” does not see it: two copies that pull "
      + "at each other a few times a second."),
    table("Force above 2 Hz that the network adds, N: median of the seeds (largest)",
      ["conditions", ...names], lines),
  ];
};

export const beyond = (section, { tables }) => {
  const rows = rowsOf(tables.claims);
  const quantiles = rowsOf(tables.claims_quantiles);
  const missed = rows.filter(({ verdict }) => verdict === "missed").length;
  return [
    paragraph(`${rows.length} claims, made before the first run; ${missed} missed. A claim is met `
      + "when the worst of the seeds that judge keeps all its numbers, or their mean where it is "
      + "of a mean. Hands are simulated."),
    table("Each claim, with its numbers in the seeds that judge and in all", ["claim", "accepted",
      "worst of the seeds\nthat judge", "nine of ten\nkeep", "seeds", "verdict"],
    rows.map((row) => {
      const all = quantiles.find(({ claim }) => claim === row.claim);
      return [row.claim, styled("band")(row.accept), ours(row.value, row.verdict === "missed"),
        ours(all ? all.quantile : ""), all ? String(all.seeds) : "",
        row.verdict === "undecided" ? badge(row.verdict, "seen") : wordBadge(row.verdict)];
    })),
    ...slowForces(rowsOf(tables.claim_sessions)),
  ];
};
