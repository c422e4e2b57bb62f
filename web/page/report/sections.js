// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The sections of a page of results: words, tables and figures, as blocks of document.js, from the
// tables that the page carries.

import { algorithms, tasks as taskWords } from "../words.js";
import { beyond, besideThePaper, claims, withoutVerdicts } from "./claims.js";
import { firstLookOf, runs, validity } from "./runs.js";
import { leadOfSessions, repeat, sessions } from "./sessions.js";
import {
  badge, banner, classBadge, claimOf, distinct, exactLimit, figures, folded, general, hasInterval,
  heading, inWords, limitText, name, ours, panels, paragraph, rowsOf, shown, spreadName,
  statusBadge, styled, table, textTable, tierBadge, tierMark, wordBadge, words, zoomed, bold,
} from "./words.js";

const allFigures = ({ groups }) => groups.flatMap((group) => figures(group.figures));

const hasPaper = (rows) => rows.some(({ paper_mean_mm: mm }) => typeof mm === "number");

/** Of one's own experiment there is nothing that the paper says: nothing stands against it. */
const ownRows = (rows) => rows.map((row) => [row.algorithm,
  ...["mean", "std", "max", "min"].map((part) => ours(shown(row[`${part}_mm`], 2)))]);

const table1Rows = (rows) => rows.map((row) => {
  const cells = ["mean", "std", "max"].flatMap((part) => {
    const [value, low, high] = ["", "_low", "_high"].map((end) => row[`${part}${end}_mm`]);
    const isOutside = low !== null && low !== undefined && (value < low || value > high);
    const hasBand = high !== null && high !== undefined;
    const band = hasBand ? `\n${shown(low, 2)} to ${shown(high, 2)}` : "";
    return [ours(shown(value, 2), isOutside),
      styled("paper")(`${shown(row[`paper_${part}_mm`], 2)}${band}`)];
  });
  const isGreen = row.verdict !== "met" || row.class === "predicted";
  return [row.algorithm, ...cells, ours(shown(row.min_mm, 2)),
    name(isGreen ? wordBadge(row.verdict) : badge("met", "seen")), name(row.max_class === row.class
      ? classBadge(row.class)
      : [classBadge(row.class), "\nmax: ", classBadge(row.max_class)])];
});

const table1Heads = ["algorithm",
  ...["mean", "std", "max"].flatMap((part) => [part, "paper"]), "min", "verdict", "class"];

const table1 = (section, data) => {
  const rows = rowsOf(data.tables.table1);
  const caption = "|x at A − x at B| of the cube in task P1, mm";
  return [
    panels("small", allFigures(section)),
    paragraph("One hand moves the cube as prescribed; the other side sees it late. The "
      + "distance between the two copies is what the network costs. Where nothing on the network "
      + "is drawn by lot, every seed plays the same session, and there is no interval."
      + (hasPaper(rows) ? " Sep stands where the paper has TiDeC." : "")
      + (rows.some((row) => row.class === "by-construction")
        ? " What is by construction is held against base of this run, and not against the paper."
        : "")),
    hasPaper(rows)
      ? table(`${caption}: this run, and the paper; below the paper’s number what agrees with it`,
        table1Heads, table1Rows(rows))
      : table(caption, ["algorithm", "mean", "std", "max", "min"], ownRows(rows)),
  ];
};

const worst = "worst";
/** Of a limit beyond all that was tried there is no more to say. */
const intervalOf = (row) => {
  if (!hasInterval(row)) return "–";
  if (row.ci_high !== null) return `${shown(row.ci_low, 1)} … ${shown(row.ci_high, 1)}`;
  const beyond = `> ${shown(row.p50, 1)}`;
  return row.ci_low >= row.p50 ? beyond : `${shown(row.ci_low, 1)} … ${beyond}`;
};

const paperCells = (row, look) => [
  styled("paper")(row.paper_limit === null ? "–" : exactLimit(row, row.paper_limit)),
  styled("band")(row.band ?? ""), name(statusBadge(row.status, look !== null)),
  name(classBadge(row.class))];

/** What reaches from low to high of rows with seeds, for the head of a column. */
const spreadHead = (rows, { interval_seeds_min: least }) =>
  spreadName(Math.min(...rows.map(({ seeds }) => seeds)), least);

/** The paper stands there only where it says something of one of the rows. */
const limitsTable = (impairment, rows, data) => {
  const look = firstLookOf(data, "limits");
  const isBeside = rows.some((row) => row.paper_limit !== null || row.status);
  return table(`Limits of ${impairment}: the level at which half of the seeds fail, how sure that `
    + "is, and the level at which a tenth fails",
  ["algorithm", "task", "limit", spreadHead(rows, data), "a tenth", "seeds",
    ...(isBeside ? ["paper", "band", "status", "class"] : [])],
  rows.map((row) => [row.algorithm, name(row.task),
    ours(`${limitText(row)} ${inWords(row.unit)}`, !look && claimOf(row.status) === "missed"),
    intervalOf(row), shown(row.p10, 1), String(row.seeds),
    ...(isBeside ? paperCells(row, look) : [])]));
};

/** The limits of the tier usable: an experiment may search those of good, too. */
const usableLimits = (all) => rowsOf(all).filter(({ tier }) => tier !== "good");

const limits = (text) => ({ groups }, data) => groups.flatMap((group, i) => {
  const rows = usableLimits(data.tables.limits)
    .filter((row) => inWords(row.impairment) === group.title);
  const isFirst = (id) => id.startsWith("failing-");
  return [...(groups.length > 1 ? [heading(group.title)] : []),
    ...figures(group.figures.filter(isFirst)), ...(i === 0 ? [tierMark, paragraph(text)] : []),
    panels("", figures(group.figures.filter((id) => !isFirst(id)))),
    limitsTable(group.title, rows.filter(({ task }) => task === worst), data),
    folded("Each task on its own",
      [limitsTable(group.title, rows.filter(({ task }) => task !== worst), data)])];
});

/** "95", "at least 320" where no level that was tried fails, or "none" where it fails at rest. */
const borne = (row, value, bound, decimals) => {
  if (row[bound] === "none") return "none";
  return `${row[bound] === ">" ? "at least " : ""}${shown(row[value], decimals)}`;
};
/** The rate of the longest interval between messages that is borne. */
const rateOf = (row) => {
  if (row.interval_bound === "none") return "none";
  const words = row.interval_bound === ">" ? "at most " : "";
  return `${words}${shown(row.rate_kbit_s, 0)}\n(${shown(row.messages_per_s, 0)} a second)`;
};

const requirementsTable = (caption, rows) => table(caption,
  ["algorithm", "task", "tier", "delay\nms", "delay variation\nms", "loss\n%",
    "burst\nof 100", "rate\nkbit/s", "classes\nthat suffice"],
  rows.map((row) => [name(row.algorithm), name(row.task), name(tierBadge(row.tier)),
    borne(row, "delay_ms", "delay_bound", 0),
    borne(row, "delay_variation_ms", "delay_variation_bound", 1),
    borne(row, "loss_percent", "loss_bound", 1), borne(row, "burst_of_100", "burst_bound", 0),
    rateOf(row), name(row.classes.replaceAll(" ", ", "))]));

const requirements = ({ groups }, data) => {
  const rows = rowsOf(data.tables.requirements);
  const classes = rowsOf(data.tables.network_classes)
    .filter((row, i, all) => all.findIndex((one) => one.class === row.class) === i);
  const [{ seeds, first_seed: first }] = rows;
  return [
    paragraph([bold("Measured"), ": how much of each factor half of the sessions bear, by a search "
      + "for each factor on its own, the same both ways, while the others are at rest: no delay, "
      + "no jitter, no loss, a message in every tick. Delay is constant. Delay variation is how "
      + "far the 99.9th percentile of the delay exceeds the least, where every message is delayed "
      + "by an even draw and may overtake others. A burst is that many messages in a row of every "
      + "100. The rate is that of the fewest messages, with IP and UDP headers, in each "
      + `direction. Seeds ${first} to ${first + seeds - 1} of simulated hands.`]),
    paragraph([bold("A convention"), ": what good and usable mean, that half of the sessions "
      + "count, and the steps of the search. “At least” is the highest level that was tried, and "
      + "no more is known; “none” is what fails without any impairment. Of the worst, each factor "
      + "has the task that bears least of it. A class suffices where each of its bounds alone is "
      + "borne. A network that reaches all of them at once may be worse than each. A class that "
      + "leaves the delay variation open suffices only where no jitter that was tried fails."]),
    tierMark,
    requirementsTable("What each algorithm bears in the worst of the tasks",
      rows.filter(({ task }) => task === worst)),
    table("The classes 0 to 4 of ITU-T Recommendation Y.1541: the most that such a network does",
      ["class", "mean delay\nms", "delay variation\nms", "loss\n%"],
      classes.map((row) => [String(row.class), shown(row.delay_ms, 0),
        shown(row.delay_variation_ms, 0), shown(row.loss_percent, 1)])),
    folded("Each task on its own", [requirementsTable("What each algorithm bears in each task",
      rows.filter(({ task }) => task !== worst))]),
    ...groups.flatMap((group) => [heading(group.title), panels("", figures(group.figures))]),
  ];
};

/** What a task has to have its hands do for a criterion to be measured. */
const measuredWhere = {
  vibration: "the body has to move while a hand is on it",
  stiffness: "it is taken from presses at 1 Hz, which T2 alone has, in sessions that are long "
    + "enough for them",
  "force-vibration": "the hands have to touch the body",
};

const curves = ({ groups }, data) => [
  paragraph("Every point is a session: all seeds at each level that counts. The line joins their "
    + "medians."), tierMark,
  ...(data.figures.some(({ id, levels }) => groups[0].figures.includes(id) && levels)
    ? [paragraph("The dashed line is where usable ends.")] : []),
  ...groups.flatMap((group) => {
    const drawn = data.figures.filter(({ id }) => group.figures.includes(id))
      .map(({ y }) => y.label);
    const unmeasured = ["vibration", "stiffness", "force-vibration"]
      .filter((criterion) => !drawn.includes(criterion));
    return [heading(group.title), panels("small", figures(group.figures)),
      ...(unmeasured.length === 0 ? [] : [banner("", "Not measured in any of these sessions, so no "
        + "session can have failed by it:",
      unmeasured.map((criterion) => `${criterion}: ${measuredWhere[criterion]}`))])];
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

const precisionTable = (rows, least) => {
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
  const most = Math.max(...rows.map(({ seeds }) => seeds));
  return table(`Differences from the reference (${spreadName(most, least)}); the order in which `
    + "they fall, by the differences that chance does not explain; and how far the result of 1, of "
    + "10 "
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
      return [precisionTable(alike, data.interval_seeds_min), ...algorithms.map((algorithm, i) => {
        const drawn = panels("small", figures(left.shift().figures));
        return i === 0 ? drawn : folded(`Error against cost: ${algorithm}`, [drawn]);
      })];
    }),
  ];
};

/** What the axes are called in the head of a column: "both.delay" or "value". */
const axisHead = (rows) => distinct(rows, ({ parameter }) => parameter).join(", ");

const tasksByAxis = (rows) => table("Each task at each value: how usable the worst of the seeds "
  + "was, and what kept it from the next better word, with its limit",
[axisHead(rows), "algorithm", "task", "worst", "limited by", "vibration\nmm", "stiffness\nratio",
  "force\nvibration, N", "seeds"],
rows.map((row) => [row.value, name(row.algorithm), name(row.task), name(tierBadge(row.tier)),
  words(row.limited_by ?? ""), shown(row.vibration_mm, 3), shown(row.stiffness_ratio, 3),
  shown(row.force_vibration_n, 3), String(row.seeds)]));

/** The worst of one task is that task. */
const withoutRepeats = (rows) => (distinct(rows, ({ task }) => task).length > 2 ? rows
  : rows.filter(({ task }, _, all) => task !== worst || all.every((row) => row.task === worst)));

const limitsByAxis = (rows, data) => table("The limits at each value: the level at which half of "
  + "the seeds fail, and how sure that is",
[axisHead(rows), "algorithm", "of", "task", "limit", spreadHead(rows, data), "seeds"],
withoutRepeats(rows).map((row) => [row.value, name(row.algorithm),
  name(inWords(row.impairment)), name(row.task), ours(`${limitText(row)} ${inWords(row.unit)}`),
  intervalOf(row), String(row.seeds)]));

const rowsAtSight = 24; // of a table whose figures are above it

const foldedIfLong = (block) => (block.table.rows.length <= rowsAtSight ? [block]
  : [folded(`All ${block.table.rows.length} limits as a table`, [block])]);

const axis = ({ groups }, data) => {
  const { tables } = data;
  const [byTask, byLimit] = [rowsOf(tables.tasks_by_axis), usableLimits(tables.limits_by_axis)];
  return [
    ...groups.flatMap((group) => [
      ...(group.title ? [heading(group.title)] : []),
      panels(group.title ? "small" : "", figures(group.figures)),
    ]),
    ...(byLimit.length > 0 ? [paragraph("A session fails when it is not usable."), tierMark,
      ...foldedIfLong(limitsByAxis(byLimit, data))] : []),
    ...(byTask.length > 0 ? [heading("How usable each task was"), tierMark, tasksByAxis(byTask),
      paragraph("Vibration and force vibration of this table are all that there is in the worst "
        + "of the seeds; the figures of the force have what the network adds to a perfect one."),
    ] : []),
  ];
};

/** The rows of one value and task in the order of their ranks. */
const rankingRows = (rows) => rows.map((row) => [row.value, name(row.task), name(row.algorithm),
  shown(row.mean_mm, 2), String(row.rank), shown(row.kendall_tau, 2),
  row.ci_low === null ? "–" : `${shown(row.ci_low, 2)} … ${shown(row.ci_high, 2)}`,
  row.subjects ? String(row.subjects) : "–", String(row.sessions)]);

const rankings = (section, data, rows = rowsOf(data.tables.rankings)) => [
  paragraph("Kendall’s τ says whether two orders agree: 1, they are the same; 0, they have nothing "
    + "in common; –1, one is the other backwards. It stands between the order with the hands of "
    + `the row and that with “${rows[0].value}”. Its interval is of resampling the subjects, or `
    + "the seeds of simulated hands. A conclusion about algorithms that holds with simulated hands "
    + "alone is one about these hands."),
  table("Algorithms by how far the two copies are apart, with each of the hands",
    ["hands", "task", "algorithm", "mean\nmm", "rank", "Kendall’s τ", "95 % interval", "subjects",
      "sessions"], rankingRows(rows)),
];

const points = (section) => [
  paragraph("An algorithm bears a point when it is at least usable there."),
  panels("", allFigures(section)), tierMark,
];

const paired = (section, data, rows = rowsOf(data.tables.paired)) => [
  paragraph("The p of a row is for that row alone: of a hundred rows without any difference five "
    + "have p below 0.05."),
  folded("The table", [table("Algorithms that met the same hands and the same network, seed by "
    + "seed: their difference, how sure it is by resampling the seeds, and the sign test",
  ["algorithm", "minus", "task", "of", "seeds", "difference", spreadHead(rows, data), "p"],
  rows.map((row) => {
    const isKnown = row.seeds !== 1 && (row.ci_low !== null || row.ci_high !== null);
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
  paragraph([...["good", "usable", "unusable"].flatMap((tier) => [tierBadge(tier), " "]),
    "in the worst of the tasks, over delay and jitter, once for each loss. Rest the pointer on a "
      + "field for its numbers, and for what keeps it from the next better word."]),
  ...groups.flatMap((group) => [heading(group.title), panels("tiny", figures(group.figures)),
    tierMark]),
];

const percent = (share) => shown(share === null ? null : 100 * share, 1);
const taskNames = [
  ["task", ({ task }) => task], ["algorithm", ({ algorithm }) => name(algorithm)],
];
const taskColumns = [
  ["tier", ({ tier }) => name(tierBadge(tier))], ["seeds", ({ seeds }) => String(seeds)],
  ["mean\nmm", ({ mean_mm: mm }) => shown(mm, 2)], ["std\nmm", ({ std_mm: mm }) => shown(mm, 2)],
  ["max\nmm", ({ max_mm: mm }) => shown(mm, 2)],
  ["vibration\nmm", ({ vibration_mm: mm }) => shown(mm, 3)],
  ["stiffness\nratio", ({ stiffness_ratio: ratio }) => shown(ratio, 3)],
  ["force\nvibration, N", ({ force_vibration_n: force }) => shown(force, 3)],
  ["limited by", ({ limited_by: reason }) => words(reason)],
];
const furtherColumns = [
  ["force above\n2 Hz, N", ({ force_above_2hz_n: force }) => shown(force, 3)],
  ["forces\napart, %", ({ force_discrepancy: share }) => percent(share)],
  ["contact\nlost, %", ({ contact_lost: share }) => percent(share)],
  ["force\nstep, N", ({ force_step_n: force }) => shown(force, 3)],
  ["drag\nN", ({ drag_n: force }) => shown(force, 3)],
  ["energy\nmJ", ({ energy_mj: energy }) => shown(energy, 2)],
];
const turnedColumn = ["turned\napart, max deg", ({ turned_apart_deg: deg }) => shown(deg, 2)];

/** Of recorded people: what the intervals are between. */
const betweenSubjects = (rows) => {
  const [row] = rows.filter(({ subjects }) => subjects);
  return row === undefined ? [] : [paragraph(`Recorded hands: ${row.trials} trials of ${
    row.subjects} ${row.subjects === 1 ? "subject" : "subjects"}. Means and intervals are between `
    + "subjects: each counts once, with the mean of its sessions, and the interval is of "
    + "resampling the subjects. No person reacted to a force: the motions were recorded without "
    + "Hapnet.")];
};

const tasks = (section, data) => {
  const rows = rowsOf(data.tables.tasks);
  const turn = rows.some(({ turned_apart_deg: deg }) => deg !== null && deg !== undefined);
  const further = [...furtherColumns, ...(turn ? [turnedColumn] : [])];
  const ordered = distinct(rows, ({ task }) => task).flatMap((task) =>
    rows.filter((row) => row.task === task));
  const tableOf = (caption, more) => {
    const columns = [...taskNames, ...more];
    return table(caption, columns.map(([head]) => head),
      ordered.map((row) => columns.map(([, cell]) => cell(row))));
  };
  return [
    panels("small", allFigures(section)),
    tierMark,
    paragraph("In P1 the cube moves as prescribed whatever is felt. In these tasks both hands act "
      + "on what they feel: the numbers say what the same network does to people who work "
      + "together."),
    ...betweenSubjects(rows),
    tableOf("Each task: worst of the seeds; mean and std of the distance: mean over the seeds; –: "
      + "the task does not exercise it",
      taskColumns),
    folded("Further measures", [tableOf("Worst of the seeds", further)]),
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
  paragraph("While the hand of A moves the cube in P1, the copy of B is where that of A was "
    + "160 ms ago. Where x stays flat at its highest, the cube stands at the static cube. At the "
    + "end both hands are off, and the copies agree again.")];

const replay = () => [
  paragraph("Each computer holds a copy of what is blue. Each picture shows one of them, with the "
    + "hand that is there; dashed outlines are what the others have at the same moment: the "
    + "bodies, and their hands. Arrows are forces on the hands. In 3-D, drag a picture to turn "
    + "them all. The replay ends when the hands let go: the last 3 s of a session, or its second "
    + "half where it is shorter than 6 s, are not in it."),
  { player: true },
];

const layouts = {
  demo, replay, sessions, table1, curves, trust, precision, axis, points, paired, fig7, qos, tasks,
  rankings, requirements,
  "real-time": realTime, claims, beyond, runs, repeat,
  fig6a: limits("A limit is the level at which half of the sessions fail in the task that bears "
    + "least: all seeds are played at eight levels, and a psychometric curve is fitted to how many "
    + "fail."),
  fig6b: limits("Random loss in percent; burst loss as messages lost in a row of every 100. The "
    + "path has no delay of its own."),
};

const leads = {
  demo: "Two simulated hands push one cube through the emulator, over real UDP, under the paper’s "
    + "160 ms. This page shows how far the two copies of the cube drift apart, beside the paper’s "
    + "numbers.",
};

/** The tasks and algorithms that are named: what each is, in a sentence. */
const meanings = ({ played, sessions: recorded, sections }) => {
  const said = [...played, ...recorded.map(({ algorithm }) => algorithm ?? ""),
    ...sections.flatMap(({ groups }) => groups.map(({ title }) => title))]
    .join(" ").match(/[A-Za-z][A-Za-z0-9-]*/g) ?? [];
  const lines = Object.entries({ ...taskWords, ...algorithms })
    .filter(([word]) => said.includes(word)).map(([word, text]) => [bold(word), `: ${text}`]);
  return lines.length === 0 ? []
    : [{ id: "names", title: "What the names mean", blocks: [{ list: lines }] }];
};

/** What was played, in a sentence. */
const leadOf = ({ subject, played, runs: all, sessions: recorded }) => {
  if (leads[subject]) return leads[subject];
  if (subject === "session") return leadOfSessions(recorded);
  if (all.length > 1) {
    const titles = all.map(({ manifest }) => manifest.title ?? manifest.kind).filter((one) => one);
    return `${all.length} experiments: ${titles.join("; ")}.`;
  }
  const counts = all.length > 0 && all.every(({ manifest }) => manifest.valid === true)
    ? " All sessions completed and passed their checks." : "";
  return `${played[0] ?? "Results of an experiment."}${counts}`;
};

/** What "usable" and "good" mean, with the limits that judged. */
const tierMeaning = ({ usable, good }) =>
  paragraph([bold("Usable"), ` is a session in which the two copies are at most ${
    general(usable.discrepancy_max_mm, 3)} mm apart on average, the body vibrates by at most ${
    general(usable.vibration_max_mm, 3)} mm above 20 Hz, what a slow press (0.5 Hz) feels is off `
    + `by at most ${general(100 * usable.slow_stiffness_error_max, 3)} % of what one shared world `
    + `gives, the network adds at most ${general(usable.force_vibration_max_n, 3)} N of vibration `
    + `to the force, and both sides are together for at least ${
      general(100 * usable.scored_share_min, 3)} % of the time; otherwise it is `,
  bold("unusable"), ". ", bold("Good"), ` is one whose copies besides are at most ${
    general(good.discrepancy_max_mm, 3)} mm apart, whose stiffness is off by at most ${
    general(100 * good.stiffness_error_max, 3)} % at 0.5, 1 and 2 Hz, whose forces differ by at `
    + `most ${general(100 * good.force_discrepancy_max, 3)} %, which loses at most ${
      general(100 * good.contact_lost_max, 3)} % of the contact and drags by at most ${
      general(good.drag_max_n, 3)} N. What a task does not exercise counts as kept. The limits are `
    + "a convention, not a finding about people."]);

/** The blocks with what tiers mean at the first of their marks, and no other mark. */
const withMeaning = (sections, { criteria }) => {
  const meaning = criteria ? [tierMeaning(criteria)] : [];
  const marked = (blocks) => blocks.flatMap((block) => {
    if (block === tierMark) return meaning.splice(0);
    return [block.blocks ? { ...block, blocks: marked(block.blocks) } : block];
  });
  return sections.map((section) => ({ ...section, blocks: marked(section.blocks) }));
};

const valueAxis = { curves: "y", bars: "y", dots: "x" };
/** All values that a figure shows along its axis of values. */
const valuesOf = (figure) => {
  const axisOf = figure[valueAxis[figure.kind]];
  const shownBy = {
    curves: ({ points, scatter = [], band = [] }) => [...[...points, ...scatter].map(([, y]) => y),
      ...band.flatMap(([, low, high]) => [low, high])],
    bars: ({ bars }) => bars.flatMap(({ value, low, high }) => [0, value, low, high]),
    dots: ({ dots }) => dots.flatMap(({ value, low, high, from, to, single = [] }) =>
      [value, low, high, from, to, ...single]),
  }[figure.kind];
  return figure.series.flatMap(shownBy).concat(axisOf.range ?? [])
    .filter((value) => Number.isFinite(value) && (axisOf.scale !== "log" || value > 0));
};

/** Figures of one group whose values have one name and one unit are compared: on one scale. */
const onSharedScales = (figures, sections) => {
  const groupOf = new Map(sections.flatMap(({ groups }) => groups)
    .flatMap((group, i) => group.figures.map((id) => [id, i])));
  const drawn = figures.filter((figure) =>
    valueAxis[figure.kind] && groupOf.has(figure.id) && valuesOf(figure).length > 0);
  const keyOf = (figure) => {
    const { label, unit, scale } = figure[valueAxis[figure.kind]];
    return [groupOf.get(figure.id), figure.kind, label, unit, scale].join("\n");
  };
  const spans = new Map(distinct(drawn, keyOf).map((key) => {
    const values = drawn.filter((figure) => keyOf(figure) === key).flatMap(valuesOf);
    const [low, high] = [Math.min, Math.max].map((pick) => values.reduce((a, b) => pick(a, b)));
    return [key, [low, high]];
  }));
  return figures.map((figure) => {
    if (!drawn.includes(figure)) return figure;
    const side = valueAxis[figure.kind];
    return { ...figure, [side]: { ...figure[side], range: spans.get(keyOf(figure)) } };
  });
};

/** The data of a page with its words and blocks, as document.js takes them. */
export const layOut = (data) => ({
  ...data,
  figures: onSharedScales(withoutVerdicts(data), data.sections),
  lead: leadOf(data),
  head: [...validity(data), ...besideThePaper(data)],
  sections: [...withMeaning(data.sections.map((section) => ({
    id: section.id, title: section.title, blocks: layouts[section.id](section, data),
  })), data), ...meanings(data)],
  foot: data.subject === "session" ? ""
    : "The hands are simulated. A verdict is a calibrated convention, not a finding about people.",
});
