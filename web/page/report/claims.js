// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The results that are compared with the paper, and the claims beyond it.

import { firstLookOf, shortfallWords } from "./runs.js";
import {
  badge, banner, bold, claimOf, distinct, exactLimit, figures, general, hasInterval,
  inWords, median, name, ours, panels, paragraph, rowsOf, shown, spreadName,
  table, tierMark, wordBadge, words,
} from "./words.js";

const table1Line = (row) => ["Table 1, ", bold(row.algorithm),
  `: mean ${shown(row.mean_mm, 2)}, std ${shown(row.std_mm, 2)}, max ${shown(row.max_mm, 1)} mm `
  + `(paper: ${shown(row.paper_mean_mm, 2)}, ${shown(row.paper_std_mm, 2)}, `
  + `${shown(row.paper_max_mm, 1)}), ${row.class}`];

const limitLine = (row, least) => {
  const paper = row.paper_limit === null ? "–" : exactLimit(row, row.paper_limit);
  const interval = !hasInterval(row) || row.ci_high === null ? ""
    : `, ${spreadName(row.seeds, least)}: ${shown(row.ci_low, 1)} … ${shown(row.ci_high, 1)}`;
  return [`Limit of ${inWords(row.impairment)}, `, bold(row.algorithm),
    `, worst of the tasks: ${exactLimit(row)} (paper: ${paper})${interval}, ${row.class}`];
};

const kinds = ["calibrated", "selected", "by-construction", "met", "undecided", "missed"];

/** What Table 1 and the worst of the tasks say: lines by kind. Green is for predictions alone. */
const mainClaims = ({ tables, interval_seeds_min: least }) => {
  const lines = Object.fromEntries(kinds.map((kind) => [kind, []]));
  const add = (claim, { class: origin }, line) => {
    if (!claim) return;
    const isSure = claim === "missed" || claim === "undecided";
    lines[isSure || !kinds.slice(0, 3).includes(origin) ? (isSure ? claim : "met") : origin]
      .push(line);
  };
  rowsOf(tables.table1).forEach((row) => add(row.verdict, row, table1Line(row)));
  rowsOf(tables.limits).filter(({ task }) => task === "worst")
    .forEach((row) => add(claimOf(row.status), row, limitLine(row, least)));
  return lines;
};

const kindWords = {
  met: "predicted and met", missed: "missed", undecided: "undecided", calibrated: "calibrated",
  selected: "selected", "by-construction": "the same by construction",
};

/** One sentence: how many results there are for each verdict against the paper. */
export const besideThePaper = (data) => {
  const lines = mainClaims(data);
  const short = shortfallWords(data) || (firstLookOf(data, "limits")?.words ?? "");
  const counts = Object.entries(kindWords).filter(([kind]) => lines[kind].length > 0)
    .map(([kind, said]) => `${lines[kind].length} ${said}`);
  if (counts.length === 0)
    return shortfallWords(data) ? [paragraph([bold(shortfallWords(data))])] : [];
  return [paragraph([...(short ? [bold(short), " "] : []),
    `Beside the paper’s numbers: ${counts.join(", ")}. `,
    { a: "What these words mean", href: "#claims" }])];
};

export const claims = (section, data) => {
  const lines = mainClaims(data);
  const look = firstLookOf(data, "limits");
  return [
    ...(look ? [banner("", [bold(look.words), " Of the limits nothing is settled yet."])] : []),
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
    [condition, ...names.map((task) => ours(cellOf(condition, task)))]);
  if (lines.every(([, ...cells]) => cells.every(({ text }) => text === ""))) return [];
  return [
    paragraph("No claim is about this number, and “usable” does not see it: two copies that pull "
      + "at each other a few times a second."),
    table("Force above 2 Hz that the network adds, N: median of the seeds (largest)",
      ["conditions", ...names], lines),
  ];
};

const withUnit = (text, unit) => (unit ? `${text} ${unit}` : text);

/** To three digits; what is next to nothing is said to be less than that. */
const few = (value) => (value > 0 && value < 1e-3 ? "< 0.001" : general(value, 3));

/** " (95 %: 0.9 to 1.1)": how far what was measured spreads; nothing where it does not. */
const spread = ({ low, high, judged_by: by, sessions }, least) => {
  if (low === null || high === null || low === high || sessions < 2) return "";
  const isInterval = by === "mean" && sessions >= least;
  return ` (${isInterval ? "95 %: " : ""}${few(low)} to ${few(high)})`;
};

/** Whether what was measured lies inside what is accepted. */
const isInside = ({ value, accept_low: low, accept_high: high }) =>
  (low === null || value >= low) && (high === null || value <= high);

/** How a number that was measured stands to what is accepted: "" inside it. */
const standing = (one, look) => {
  if (one.kept === false) return look ? ", outside" : ", not kept";
  return look && !isInside(one) ? ", undecided" : "";
};

/** "100 ms: 0.98 (...)": what was measured of a claim, a line for each of its numbers. */
const measured = (numbers, look, least) => numbers.map((one) => {
  const outside = one.value === null ? "" : standing(one, look);
  const said = one.value === null
    ? `not measured: ${look?.endsEarly || "no session of its conditions exercises it"}`
    : `${withUnit(few(one.value), one.unit)}${spread(one, least)}${outside}`;
  return one.number ? `${one.number}: ${said}` : said;
}).join("\n");

/**
 * Of a first look, how what was measured so far stands to what the claim accepts. Undecided is a
 * value outside it whose interval reaches inside.
 */
const soFar = (numbers) => {
  if (numbers.length === 0 || numbers.some(({ value }) => value === null)) return "not measured";
  if (numbers.some(({ kept }) => kept === false)) return "outside";
  return numbers.every(isInside) ? "inside" : "undecided";
};

const accepted = (numbers) => numbers.map(({ accept_low: low, accept_high: high, unit }) => {
  if (low !== null && high !== null) return withUnit(`${general(low)} to ${general(high)}`, unit);
  return withUnit(low === null ? `≤ ${general(high)}` : `≥ ${general(low)}`, unit);
}).join("\n");

const verdictCell = (row, numbers, look) => {
  if (look) return name(`first look: ${soFar(numbers)}`);
  return name(row.verdict === "undecided" ? badge(row.verdict, "seen") : wordBadge(row.verdict));
};

export const beyond = ({ groups }, data) => {
  const { tables, interval_seeds_min: least } = data;
  const look = firstLookOf(data, "claims");
  const rows = rowsOf(tables.claims);
  const numbers = rowsOf(tables.claims_numbers);
  const quantiles = rowsOf(tables.claims_quantiles);
  const count = (verdict) => rows.filter((row) => row.verdict === verdict).length;
  const open = count("undecided") > 0 ? `, ${count("undecided")} undecided` : "";
  return [
    look ? paragraph([bold(look.words)])
      : paragraph(`Of ${rows.length} claims: ${count("met")} met, ${count("missed")} missed`
        + `${open}.`),
    panels("", figures(groups.flatMap((group) => group.figures)).toSpliced(1, 0, tierMark)),
    paragraph("A claim is met when the worst of the sessions that judge keeps each of its numbers, "
      + "or their mean where the claim is of a mean. In brackets: the 95 % interval of a mean of "
      + `${least} sessions or more where it says so, otherwise the least and the most `
      + "of the sessions. The claims were made before the first run."),
    table("Each claim: what was measured, what it accepts, and what nine of ten of all seeds keep",
      ["claim", "measured", "accepted", "verdict", "nine of ten", "seeds"],
      rows.map((row) => {
        const of = numbers.filter(({ claim }) => claim === row.claim);
        const all = quantiles.find(({ claim }) => claim === row.claim);
        return [row.claim,
          words(of.length > 0 ? measured(of, look, least) : String(row.value)),
          name(of.length > 0 ? accepted(of) : String(row.accept)), verdictCell(row, of, look),
          words(all ? all.quantile.replaceAll("; ", "\n") : ""), all ? String(all.seeds) : ""];
      })),
    ...slowForces(rowsOf(tables.claim_sessions)),
  ];
};

/** The figures of a page, in which nothing of a first look at claims is red. */
export const withoutVerdicts = (data) => {
  if (!firstLookOf(data, "claims")) return data.figures;
  const ids = data.sections.filter(({ id }) => id === "beyond")
    .flatMap(({ groups }) => groups.flatMap((group) => group.figures));
  return data.figures.map((figure) => (!ids.includes(figure.id) ? figure : {
    ...figure,
    caption: figure.caption.replace("Red: not kept.", "Nothing is judged."),
    series: figure.series.map((series) => ({
      ...series, dots: series.dots.map(({ missed, ...dot }) => dot),
    })),
  }));
};
