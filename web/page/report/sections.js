// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The sections of a page of results: words, tables and figures, as blocks of document.js, from the
// tables that the page carries.

import { beyond, claims, tiles } from "./claims.js";
import { runs, validity } from "./runs.js";
import {
  badge, banner, classBadge, claimOf, distinct, exactLimit, figures, folded, general, heading,
  inWords, limitText, name, notValid, ours, panels, paragraph, rowsOf, shown, statusBadge, styled,
  table, textTable, tierBadge, wordBadge, words, zoomed, bold,
} from "./words.js";

const allFigures = ({ groups }) => groups.flatMap((group) => figures(group.figures));

const table1Rows = (rows) => rows.map((row) => {
  const cells = ["mean", "std", "max"].flatMap((part) => {
    const [value, low, high] = ["", "_low", "_high"].map((end) => row[`${part}${end}_mm`]);
    const isOutside = low !== null && low !== undefined && (value < low || value > high);
    const hasBand = high !== null && high !== undefined;
    const band = hasBand ? `${shown(low, 2)} to ${shown(high, 2)}` : "–";
    return [ours(shown(value, 2), isOutside), styled("paper")(shown(row[`paper_${part}_mm`], 2)),
      styled("band")(band)];
  });
  const isGreen = row.verdict !== "met" || row.class === "predicted";
  return [row.algorithm, ...cells, ours(shown(row.min_mm, 2)),
    isGreen ? wordBadge(row.verdict) : badge("met", "seen"), classBadge(row.class),
    classBadge(row.max_class)];
});

const table1Heads = ["algorithm",
  ...["mean", "std", "max"].flatMap((part) => [part, "paper", "band"]), "min", "verdict", "class",
  "class\nof max"];

const table1 = (section, data) => [
  paragraph("One hand carries the cube; the other side sees it late. The distance between the two "
    + "copies is what the network costs. Sep stands where the paper has TiDeC. The hand follows a "
    + "prescribed path and the delay is constant: nothing is drawn by lot, so there is one session "
    + "of each algorithm, whatever the seed, and no interval."),
  table("|x at L − x at R| of the cube in task P1, mm: this run, the paper, and from where to "
    + "where it agrees", table1Heads, table1Rows(rowsOf(data.tables.table1))),
  panels("small", allFigures(section)),
];

const worst = "worst";
const intervalOf = (row) => (row.ci_low === null ? "–"
  : `${shown(row.ci_low, 1)} … ${row.ci_high === null ? `> ${shown(row.p50, 1)}`
    : shown(row.ci_high, 1)}`);

const limitsTable = (impairment, rows) => table(`Limits of ${impairment}: the level at which half `
  + "of the seeds fail, its 95 % interval, and the level at which a tenth fails",
["algorithm", "task", "limit", "95 %", "a tenth", "seeds", "paper", "band", "status", "class"],
rows.map((row) => [row.algorithm, name(row.task),
  ours(`${limitText(row)} ${inWords(row.unit)}`, claimOf(row.status) === "missed"), intervalOf(row),
  shown(row.p10, 1), String(row.seeds),
  styled("paper")(row.paper_limit === null ? "–" : exactLimit(row, row.paper_limit)),
  styled("band")(row.band ?? ""), statusBadge(row.status), classBadge(row.class)]));

const limits = (text) => ({ groups }, data) => [paragraph(text), ...groups.flatMap((group) => {
  const rows = rowsOf(data.tables.limits).filter((row) => inWords(row.impairment) === group.title);
  return [heading(group.title), panels("", figures(group.figures)),
    limitsTable(group.title, rows.filter(({ task }) => task === worst)),
    folded("Each task on its own",
      [limitsTable(group.title, rows.filter(({ task }) => task !== worst))])];
})];

const curves = ({ groups }, data) => [
  paragraph("Every point is a session: all seeds at each level that counts. The line joins their "
    + "medians."),
  ...(data.figures.some(({ id, levels }) => groups[0].figures.includes(id) && levels)
    ? [paragraph("The dashed line is where usable ends.")] : []),
  ...groups.flatMap((group) => {
    const drawn = data.figures.filter(({ id }) => group.figures.includes(id))
      .map(({ y }) => y.label);
    const unmeasured = ["vibration", "stiffness", "force-vibration"]
      .filter((criterion) => !drawn.includes(criterion));
    return [heading(group.title), panels("small", figures(group.figures)),
      ...(unmeasured.length === 0 ? [] : [banner("", "Not measured in any of these sessions, so no "
        + `session can have failed by it: ${unmeasured.join(", ")}.`)])];
  }),
];

const trustTable = (rows) => {
  const methods = distinct(rows, (row) => `order ${row.filter_order}\n${row.hand}`);
  const lines = distinct(rows, (row) => `${row.algorithm}\n${row.task}`).map((line) => {
    const alike = rows.filter((row) => `${row.algorithm}\n${row.task}` === line);
    const found = methods.map((method) =>
      alike.find((row) => `order ${row.filter_order}\n${row.hand}` === method));
    const all = found.filter((row) => row).map(({ limit }) => limit);
    const high = Math.max(...all);
    const isOpen = found.some((row) => row?.bound === ">" && row.limit >= high);
    const span = `${shown(Math.min(...all), 1)} … ${isOpen ? "> " : ""}${shown(high, 1)}`;
    return [alike[0].algorithm, name(alike[0].task), ours(span),
      ...found.map((row) => (row ? limitText(row) : "–"))];
  });
  return table(`Limit of ${inWords(rows[0].impairment)}, ${inWords(rows[0].unit)}, by the order of `
    + "the 20 Hz filter and the hands", ["algorithm", "task", "from … to", ...methods], lines);
};

const trust = (section, data) => {
  const rows = rowsOf(data.tables.limits_by_convention);
  return [
    paragraph("A limit is where a measure crosses a threshold, so it moves with how the measure is "
      + "taken: with the order of the filter that separates vibration from motion, and with how "
      + "firmly the hand holds. What moves little is a finding; what moves much is a convention."),
    ...allFigures(section),
    ...distinct(rows, ({ impairment }) => impairment).map((impairment) =>
      trustTable(rows.filter((row) => row.impairment === impairment))),
  ];
};

const differenceOf = (row) => {
  if (row.value === row.reference) return "reference";
  const difference = general(row.difference, 3);
  return row.ci_low === null || row.ci_high === null ? difference
    : `${difference}\n(${general(row.ci_low, 3)} … ${general(row.ci_high, 3)})`;
};

/** "vibration_mm" as "vibration, mm"; what has its unit already stays. */
const figureWords = (figure) =>
  figure.replace(/_mm$/, ", mm").replace(/_n$/, ", N").replaceAll("_", " ");

const precisionTable = (rows) => {
  const values = distinct(rows, ({ value }) => value);
  const keyOf = (row) => [row.algorithm, row.task, row.figure].join("\n");
  const lines = distinct(rows, keyOf).map((key) => {
    const alike = rows.filter((row) => keyOf(row) === key);
    const here = alike.filter(({ value, reference }) => value === reference);
    const errorBy = (seeds) => {
      const row = here.find((one) => one.seeds === seeds);
      return here.length < 2 || !row ? "–" : general(row.error, 3);
    };
    const found = values.map((value) => alike.findLast((row) => row.value === value));
    return [alike[0].algorithm, name(alike[0].task), words(figureWords(alike[0].figure)),
      here.length === 0 ? "–" : general(here[0].found, 3),
      ...found.map((row) => (row ? differenceOf(row) : "–")), shown(alike[0].order, 1), errorBy(1),
      errorBy(10), here.length === 0 ? "–" : errorBy(here.at(-1).seeds)];
  });
  return table("Differences from the reference, with their 95 % intervals; the order in which they "
    + "fall, by the differences that chance does not explain; and how far the result of 1, of 10 "
    + "and of all seeds is off at the reference",
  ["algorithm", "task", "figure", "at the\nreference",
    ...values.map((value) => `${rows[0].parameter}\n${value}`), "order", "1 seed", "10 seeds",
    "all seeds"], lines);
};

const precision = ({ groups }, data) => {
  const rows = rowsOf(data.tables.precision);
  const left = [...groups];
  return [
    paragraph(["Each point is a result by fewer seeds, or at a coarser step: how far it is off "
      + "from the same figure by all seeds at the reference, as the root mean square over many "
      + "draws of the seeds. The cost is in ticks of all players, on perfect networks, too; the "
      + "processor time of the run stands under ", { a: "how to repeat it", href: "#runs" }, ". A "
      + "curve that no longer falls with more seeds has reached the error of its step."]),
    ...distinct(rows, ({ parameter }) => parameter).flatMap((parameter) => {
      const alike = rows.filter((row) => row.parameter === parameter);
      const algorithms = distinct(alike, ({ algorithm }) => algorithm);
      return [precisionTable(alike), ...algorithms.map((algorithm, i) => {
        const drawn = panels("small", figures(left.shift().figures));
        return i === 0 ? drawn : folded(`Error against cost: ${algorithm}`, [drawn]);
      })];
    }),
  ];
};

const axis = (section) => [
  paragraph("The limits again, for other readings of the paper and other conditions that it does "
    + "not state. The worst of the tasks; lines are 95 % intervals."),
  panels("", allFigures(section)),
];

const points = (section) => [
  paragraph("An algorithm bears a point when it is at least usable there."),
  panels("", allFigures(section)),
];

const paired = (section, data) => [
  paragraph("The p of a row is for that row alone: of a hundred rows without any difference five "
    + "have p below 0.05."),
  folded("The table", [table("Algorithms that met the same hands and the same network, seed by "
    + "seed: their difference, its 95 % interval by resampling the seeds, and the sign test",
  ["algorithm", "minus", "task", "of", "seeds", "difference", "95 %", "p"],
  rowsOf(data.tables.paired).map((row) => {
    const isKnown = row.ci_low !== null || row.ci_high !== null;
    return [row.algorithm, name(row.reference), name(row.task), words(row.measure),
      String(row.seeds), shown(row.difference, 3),
      isKnown ? `${shown(row.ci_low, 3)} … ${shown(row.ci_high, 3)}` : "–",
      general(row.sign_test_p, 2)];
  }))]),
];

const fig7 = (section) => {
  const isMore = ({ figure }) => /^fig7-(hands|forces)-/.test(figure);
  const all = allFigures(section);
  return [zoomed([...all.filter((block) => !isMore(block)),
    folded("Hands and forces", all.filter(isMore))])];
};

const qos = ({ groups }) => [
  paragraph("The whole plane of delay and jitter, once for each loss."),
  paragraph([...["good", "usable", "unusable"].flatMap((tier) => [tierBadge(tier), " "]),
    "worst of the tasks; point at a field for its numbers"]),
  ...groups.flatMap((group) => [heading(group.title), panels("tiny", figures(group.figures))]),
];

const percent = (share) => shown(share === null ? null : 100 * share, 1);
const taskColumns = [
  ["task", ({ task }) => task], ["algorithm", ({ algorithm }) => name(algorithm)],
  ["tier", ({ tier }) => name(tierBadge(tier))], ["seeds", ({ seeds }) => String(seeds)],
  ["mean\nmm", ({ mean_mm: mm }) => shown(mm, 2)], ["std\nmm", ({ std_mm: mm }) => shown(mm, 2)],
  ["max\nmm", ({ max_mm: mm }) => shown(mm, 2)],
  ["vibration\nmm", ({ vibration_mm: mm }) => shown(mm, 3)],
  ["stiffness\nratio", ({ stiffness_ratio: ratio }) => shown(ratio, 3)],
  ["force\nvibration, N", ({ force_vibration_n: force }) => shown(force, 3)],
  ["force above\n2 Hz, N", ({ force_above_2hz_n: force }) => shown(force, 3)],
  ["forces\napart, %", ({ force_discrepancy: share }) => percent(share)],
  ["contact\nlost, %", ({ contact_lost: share }) => percent(share)],
  ["force\nstep, N", ({ force_step_n: force }) => shown(force, 3)],
  ["drag\nN", ({ drag_n: force }) => shown(force, 3)],
  ["energy\nmJ", ({ energy_mj: energy }) => shown(energy, 2)],
  ["limited by", ({ limited_by: reason }) => words(reason)],
];
const turnedColumn = ["turned\napart, max deg", ({ turned_apart_deg: deg }) => shown(deg, 2)];

const tasks = (section, data) => {
  const rows = rowsOf(data.tables.tasks);
  const turn = rows.some(({ turned_apart_deg: deg }) => deg !== null && deg !== undefined);
  const columns = [...taskColumns, ...(turn ? [turnedColumn] : [])];
  const ordered = distinct(rows, ({ task }) => task).flatMap((task) =>
    rows.filter((row) => row.task === task));
  return [
    paragraph("In P1 the cube follows a path whatever is felt. In these tasks both hands act on "
      + "what they feel, so the numbers are not Table 1’s: they say what the same network does to "
      + "people who work together."),
    table("Closed-loop tasks: worst of the seeds; discrepancy mean and std: mean over the seeds",
      columns.map(([head]) => head), ordered.map((row) => columns.map(([, cell]) => cell(row)))),
    panels("small", allFigures(section)),
  ];
};

const agreementPercent = 5; // of mean and std, for a run that is valid
const timesRow = (row) => {
  const differs = (part) => {
    const [real, virtual] = [row[`${part}_mm`], row[`virtual_${part}_mm`]];
    if (real === null || !virtual || !row.valid) return "–";
    const off = (100 * (real - virtual)) / virtual;
    return ours(`${off < 0 ? "" : "+"}${shown(off, 1)} %`, Math.abs(off) > agreementPercent);
  };
  const real = (part) => (row.valid ? (text) => text : styled("excluded"))(shown(row[part], 2));
  return [row.algorithm, name(row.where), real("mean_mm"), shown(row.virtual_mean_mm, 2),
    differs("mean"), real("std_mm"), shown(row.virtual_std_mm, 2), differs("std"), real("max_mm"),
    shown(row.virtual_max_mm, 2), words(row.valid ? "valid" : `excluded: ${row.invalid_because}`)];
};

const realTime = (section, data) => [
  paragraph("The same sessions with the programs themselves, over real UDP. A run whose own timing "
    + "was off says more about the machine than about Hapnet: it is named and left out."),
  table("Real time over UDP beside virtual time, mm",
    ["algorithm", "where", "mean\nreal", "mean\nvirtual", "differs", "std\nreal", "std\nvirtual",
      "differs", "max\nreal", "max\nvirtual", "valid"],
    rowsOf(data.tables.real_time).map(timesRow)),
  ...allFigures(section),
];

const demo = (section, data) => [...data.demo.flatMap(textTable),
  paragraph("While the left hand moves the cube in P1, the right copy is where the left one was "
    + "160 ms ago. Where x stays flat at its highest, the cube stands at the static cube. At the "
    + "end both hands are off, and the copies agree again.")];

const replay = () => [
  paragraph("Each computer holds a copy of what is blue. Each picture shows one of them, with the "
    + "hand that is there; dashed outlines are what the others have at the same moment: the "
    + "bodies, and their hands. Arrows are forces on the hands. In 3-D, drag a picture to turn "
    + "them all."),
  { player: true },
];

const isValid = [bold("Valid."), " Both loops kept their time, and both sides were in session "
  + "together."];
const sessions = ({ groups }, data) => [
  paragraph("Times count from the start of the session on A’s clock. Each session ends with hands "
    + "off: then the two copies of each body should agree again."),
  ...groups.flatMap((group, i) => {
    const { peers: [a, b], algorithm, valid, invalid_because: reasons, tables, clock }
      = data.sessions[i];
    return [heading(group.title),
      paragraph(`A is peer ${a}, B is peer ${b}${algorithm ? `; algorithm ${algorithm}` : ""}.`),
      valid ? banner("met", isValid, reasons) : notValid(reasons),
      zoomed(figures(group.figures)), panels("", tables.flatMap(textTable)),
      ...(clock ? [paragraph(`${clock}.`)] : [])];
  }),
];

const layouts = {
  demo, replay, sessions, table1, curves, trust, precision, axis, points, paired, fig7, qos, tasks,
  "real-time": realTime, claims, beyond, runs,
  fig6a: limits("A limit is the level at which half of the sessions fail in the task that bears "
    + "least: all seeds are played at eight levels, and a psychometric curve is fitted to how many "
    + "fail."),
  fig6b: limits("Random loss in percent; burst loss as messages lost in a row of every 100. The "
    + "path has no delay of its own."),
};

const leads = {
  experiments: "Two simulated hands push one cube over a bad network; each computer has its own "
    + "copy of the cube, and this page shows how far the copies drift apart and when the push "
    + "stops feeling right, beside the paper’s numbers.",
  demo: "Two simulated hands push one cube through the emulator, over real UDP, under the paper’s "
    + "160 ms. This page shows how far the two copies of the cube drift apart, beside the paper’s "
    + "numbers.",
  session: "Two hands push one cube over a network; each computer has its own copy of the cube. "
    + "This page shows what the two records say: how far the copies drift apart, what the network "
    + "did, and whether the run counts.",
};

const missing = (list) => (list.length === 0 ? [] : [{
  id: "missing", title: "Not in this folder",
  blocks: [
    paragraph("These commands make the rest; report the folder again afterwards."),
    { list: list.map(({ what, command }) => [`${what}: `, { code: command }]) },
  ],
}]);

/** The data of a page with its words and blocks, as document.js takes them. */
export const layOut = (data) => ({
  ...data,
  lead: leads[data.subject],
  head: [...validity(data), ...tiles(data)],
  sections: [...data.sections.map((section) => ({
    id: section.id, title: section.title, blocks: layouts[section.id](section, data),
  })), ...missing(data.missing)],
  foot: data.subject === "session" ? ""
    : "The hands are simulated. A verdict is a calibrated convention, not a finding about people.",
});
