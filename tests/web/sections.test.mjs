// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The words and tables of a page of results, without a browser: blocks made of the tables that the
// page carries.

import assert from "node:assert/strict";
import { test } from "node:test";

import { layOut } from "../../web/page/report/sections.js";
import { fewDigits, general, shown } from "../../web/page/report/words.js";

/** A table as results.json has it, of lines with commas; an empty cell is null. */
const tableOf = (lines) => {
  const [heads, ...rows] = lines.trim().split("\n").map((line) => line.trim().split(","));
  const cellOf = (text) => {
    if (text === "") return null;
    if (text === "true" || text === "false") return text === "true";
    return Number.isNaN(Number(text)) ? text : Number(text);
  };
  return { columns: heads.map((key) => ({ key })), rows: rows.map((row) => row.map(cellOf)) };
};

const table1 = tableOf(`
  algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,verdict,class,max_class,mean_low_mm,mean_high_mm,std_low_mm,std_high_mm,max_low_mm,max_high_mm
  base,13.611,0,47.251,10.683,13.789,46.01,10.986,calibrated,calibrated,calibrated,12.4101,15.1679,9.8874,12.0846,41.409,50.611
  sep,13.62,0,47.2,10.69,13.991,50.12,10.808,met,by-construction,by-construction,13.2,14.02,10.36,11,45.83,48.67
  dead-reckoning,3.402,0,66.61,4.19,3.341,58.85,3.84,missed,selected,predicted,2.84,3.84,3.26,4.42,40,65`);
const limits = tableOf(`
  algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds,band
  base,delay,T1,320,>,ms,,,predicted,320,,320,,40,
  base,delay,worst,160,=,ms,160,calibrated,calibrated,160,150,157,163,40,152 to 168
  dead-reckoning,delay,worst,145,=,ms,150,predicted-met,predicted,145,140,143,147,40,130 to 155
  dead-reckoning,jitter,worst,2.5,=,ms,5,selected-missed,selected,2.5,2,2.4,2.6,40,3 to 6
  base,burst-loss,worst,95,>,of_100,40,selected-missed,selected,95,,95,,40,35 to 45`);

const section = (id, groups = [{ title: "", figures: [] }]) => ({ id, title: id, groups });
const page = (sections, tables, more = {}) => layOut({
  subject: "experiments", title: "", played: [], runs: [], sessions: [], figures: [], sections,
  interval_seeds_min: 6,
  tables, ...more,
});
const blocksOf = (...words) => page(...words).sections[0].blocks;
const holds = (json, part) => JSON.stringify(json).includes(part);

test("Table 1 stands beside the paper's with its bands, misses in red", () => {
  const [, , { table }] = blocksOf([section("table1")], { table1 });
  assert.deepEqual(table.rows[0].slice(0, 3), ["base", { text: "13.61", style: "ours" },
    { text: "13.79\n12.41 to 15.17", style: "paper" }]);
  assert.deepEqual(table.rows[2].slice(5, 7), [{ text: "66.61", style: "ours missed" },
    { text: "58.85\n40.00 to 65.00", style: "paper" }]);
  const verdictOf = (row) => row[8].text;
  assert.deepEqual(verdictOf(table.rows[0]), { badge: "calibrated", style: "calibrated" });
  assert.deepEqual(verdictOf(table.rows[1]), { badge: "met", style: "seen" }, "it is no prediction");
  assert.match(blocksOf([section("table1")], { table1 })[1].p,
    /What is by construction is held against base of this run, and not against the paper\.$/);
});

test("one's own experiment stands beside nothing, and nothing of it is red", () => {
  const own = tableOf(`
    algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,verdict,class,max_class,mean_low_mm,mean_high_mm
    base,0.19,0,0.7,0.1,,,,,,,,`);
  const blocks = blocksOf([section("table1")], { table1: own });
  assert.deepEqual(blocks[2].table.rows, [["base", ...["0.19", "0.10", "0.70", "0.00"]
    .map((text) => ({ text, style: "ours" }))]]);
  assert.ok(!/paper|TiDeC|missed/.test(JSON.stringify(blocks)));
  const alone = tableOf(`
    algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds,band
    base,delay,worst,160,=,ms,,,,160,150,157,163,40,`);
  const groups = [{ title: "delay", figures: [] }];
  assert.ok(!holds(blocksOf([section("fig6a", groups)], { limits: alone }), "paper"));
});

test("a limit that is a bound is written as one, and green is for predictions alone", () => {
  const groups = [{ title: "delay", figures: ["failing-delay", "limit-delay"] }];
  const [first, , panels, worst, folded] = blocksOf([section("fig6a", groups)], { limits });
  assert.deepEqual([first, panels], [{ figure: "failing-delay" },
    { panels: "", blocks: [{ figure: "limit-delay" }] }], "what the limit is fitted to comes first");
  assert.deepEqual(worst.table.rows[1], ["dead-reckoning", { text: "worst", style: "name" },
    { text: "145 ms", style: "ours" }, "143.0 … 147.0", "140.0", "40",
    { text: "150 ms", style: "paper" }, { text: "130 to 155", style: "band" },
    { text: { badge: "predicted-met", style: "met" }, style: "name" },
    { text: { badge: "predicted", style: "" }, style: "name" }]);
  const [alone] = folded.blocks[0].table.rows;
  assert.deepEqual(alone[2], { text: "> 320 ms", style: "ours" });
  assert.equal(alone[3], "> 320.0", "no seed failed as far as was tried");
  const loss = blocksOf([section("fig6b", [{ title: "burst loss", figures: [] }])], { limits });
  assert.ok(holds(loss, '"> 95 of 100"'));
});

const requirements = tableOf(`
  algorithm,task,tier,delay_ms,delay_bound,delay_variation_ms,delay_variation_bound,loss_percent,loss_bound,burst_of_100,burst_bound,interval_ms,interval_bound,messages_per_s,rate_kbit_s,classes,seeds,first_seed
  base,T1,good,,none,,none,,none,,none,,none,,,none,8,1001
  base,worst,usable,160.4,=,59.94,=,92.9,=,43.3,=,12,=,83.33,112.1,0 1,8,1001
  lag,worst,usable,1000,>,199.8,>,99,>,95,>,50,>,20,26.9,0 1 2 3 4,8,1001`);
const classes = tableOf(`
  class,delay_ms,delay_variation_ms,loss_percent
  0,100,50,0.1
  4,1000,,0.1
  0,100,50,0.1`);

test("what a network must offer is a number, at least the most that was tried, or none", () => {
  const tables = { requirements, network_classes: classes, limits };
  const [measured, convention, ours, beside, folded] =
    blocksOf([section("requirements")], tables);
  assert.ok(holds(measured, "Seeds 1001 to 1008"));
  assert.ok(holds(convention, "each of its bounds alone"));
  const cells = (row) => row.slice(3).map((cell) => cell.text ?? cell);
  assert.deepEqual(cells(ours.table.rows[0]),
    ["160", "59.9", "92.9", "43", "112\n(83 a second)", "0, 1"]);
  assert.deepEqual(cells(ours.table.rows[1]), ["at least 1000", "at least 199.8", "at least 99.0",
    "at least 95", "at most 27\n(20 a second)", "0, 1, 2, 3, 4"]);
  assert.deepEqual(cells(folded.blocks[0].table.rows[0]), Array(6).fill("none"));
  assert.deepEqual(beside.table.rows, [["0", "100", "50", "0.1"], ["4", "1000", "–", "0.1"]],
    "each class once, whatever the number of folders");
});

test("limits of the tier good stand in what a network must offer alone", () => {
  const both = tableOf(`
    algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds,tier,band
    base,delay,worst,60,=,ms,,,,60,50,57,63,40,good,
    base,delay,worst,160,=,ms,160,calibrated,calibrated,160,150,157,163,40,usable,152 to 168`);
  const blocks = blocksOf([section("fig6a", [{ title: "delay", figures: [] }])], { limits: both });
  assert.ok(holds(blocks, '"160 ms"') && !holds(blocks, '"60 ms"'));
});

test("what stands against the paper is sorted by how it came about", () => {
  const all = page([section("claims")], { table1, limits });
  const counts = all.sections[0].blocks[1].claims.map(({ title, list }) => [title, list.length]);
  assert.deepEqual(counts, [["Calibrated", 2], ["Selected, and agrees", 0],
    ["The same by construction", 1], ["Predicted and met", 1], ["Undecided", 0], ["Missed", 3]]);
  const { list } = all.sections[0].blocks[1].claims[5];
  assert.deepEqual(list[1], ["Limit of jitter, ", { b: "dead-reckoning" },
    ", worst of the tasks: 2.5 ms (paper: 5 ms), 95 %: 2.4 … 2.6, selected"]);
  assert.deepEqual(all.head.at(-1).p, ["Beside the paper’s numbers: 1 predicted and met, 3 missed, "
    + "2 calibrated, 1 the same by construction. ",
  { a: "What these words mean", href: "#claims" }]);
  assert.ok(!holds(page([section("qos")], {}).head, "paper"));
});

test("a claim beyond the paper has its numbers of the seeds that judge and of all", () => {
  const tables = {
    claims: tableOf(`claim,value,accept,verdict
      stiffness at 100 ms,0.98 to 1.46,0.75 to 1.25,missed
      mean,5.97,<= 6,met`),
    claims_numbers: tableOf(`claim,number,value,low,high,accept_low,accept_high,unit,judged_by,sessions,kept
      stiffness at 100 ms,each,1.46,0.98,1.46,0.75,1.25,,worst,10,false
      stiffness at 100 ms,mean,1.1,1.05,1.2,0.85,,,mean,10,true
      mean,,5.97,5.5,6.3,,6,mm,mean,10,true`),
    claims_quantiles: tableOf(`claim,quantile,seeds
      stiffness at 100 ms,0.98 to 1.32,40`),
    claim_sessions: tableOf(`algorithm,condition,task,force_above_2hz_n
      remote-proxy,100ms,T1,0.05
      remote-proxy,100ms,T1,0.09
      remote-proxy,100ms,T1,0.07
      base,100ms,T1,0.9`),
  };
  const groups = [{ title: "", figures: ["claims-mm"] }];
  const [text, figures, , claims, , forces] = blocksOf([section("beyond", groups)], tables);
  assert.equal(text.p, "Of 2 claims: 1 met, 1 missed.");
  assert.deepEqual(figures.blocks, [{ figure: "claims-mm" }]);
  assert.deepEqual(claims.table.rows[0].slice(1), [
    { text: "each: 1.46 (0.98 to 1.46), not kept\nmean: 1.1 (95 %: 1.05 to 1.2)", style: "words" },
    { text: "0.75 to 1.25\n≥ 0.85", style: "name" },
    { text: { badge: "missed", style: "missed" }, style: "name" },
    { text: "0.98 to 1.32", style: "words" }, "40"]);
  assert.deepEqual(claims.table.rows[1].slice(1, 3), [{ text: "5.97 mm (95 %: 5.5 to 6.3)", style: "words" },
    { text: "≤ 6 mm", style: "name" }]);
  assert.deepEqual(forces.table.rows, [["100ms", { text: "0.070 (0.090)", style: "ours" }]],
    "of the first algorithm");
  // A folder of an older version has the numbers as text alone.
  const [, , , older] = blocksOf([section("beyond")], { claims: tables.claims });
  assert.equal(older.table.rows[1][1].text, "5.97");
});

/** A run of an experiment of that kind which plays less than the built-in one. */
const shortRun = (kind, played) => ({ folder: "r", manifest: { kind, valid: true },
  amounts: { played: { seeds: 40, duration_s: 30, ...played }, meant: { seeds: 40, duration_s: 30 } } });

const fewNumbers = {
  claims: tableOf(`claim,value,accept,verdict
    stiffness,,0.75 to 1.25,undecided
    mean,10.5,<= 6,missed
    apart,0.00001,<= 1,met`),
  claims_numbers: tableOf(`claim,number,value,low,high,accept_low,accept_high,unit,judged_by,sessions,kept
    stiffness,,,,,0.75,1.25,,worst,0,
    mean,,10.5,9,11,,6,mm,mean,3,false
    apart,,0.00001,0.00001,0.00001,,1,mm,worst,1,true`),
};

test("claims that are played with less than they are stated for are a first look", () => {
  const figures = [{ id: "claims-mm", kind: "dots", caption: "Red: not kept.", y: { label: "claim" },
    x: { label: "measured", unit: "mm" },
    series: [{ dots: [{ at: 0, value: 10.5, missed: true }] }] }];
  const groups = [{ title: "", figures: ["claims-mm"] }];
  const runs = [shortRun("claims", { seeds: 3, duration_s: 6 })];
  const all = page([section("beyond", groups)], fewNumbers, { runs, figures });
  const [first, , , { table: { rows } }] = all.sections[0].blocks;
  assert.deepEqual(first.p,
    [{ b: "Played with 3 of 40 seeds and 6 of 30 s: a first look, not a verdict." }]);
  assert.deepEqual(rows.map((row) => [row[1].text, row[3].text]), [
    ["not measured: the sessions last 6 of 30 s", "first look: not measured"],
    ["10.5 mm (9 to 11), outside", "first look: outside"], ["< 0.001 mm", "first look: inside"]]);
  assert.ok(!/met|missed|kept/.test(JSON.stringify(all.figures)), "and nothing is red");
  const whole = page([section("beyond", groups)], fewNumbers,
    { runs: [shortRun("claims", {})], figures });
  assert.equal(whole.sections[0].blocks[0].p, "Of 3 claims: 1 met, 1 missed, 1 undecided.");
  assert.ok(holds(whole.sections[0], '"badge":"missed"'));
  assert.ok(holds(whole.sections[0], "not measured: no session of its conditions exercises it"));
  assert.ok(holds(whole.figures, "missed"));
});

test("of a first look, what lies outside with an interval that reaches inside is undecided", () => {
  const tables = {
    claims: tableOf(`claim,value,accept,verdict
      usable,66.7,>= 90,undecided
      force,0.05,<= 0.08,undecided`),
    claims_numbers: tableOf(`claim,number,value,low,high,accept_low,accept_high,unit,judged_by,sessions,kept
      usable,160 ms,66.7,16.7,100,90,,% usable,mean,6,
      force,,0.05,0.04,,,0.08,N,quantile,6,`),
  };
  const all = page([section("beyond", [{ title: "", figures: [] }])], tables,
    { runs: [shortRun("claims", { seeds: 2 })] });
  const [, , , { table: { rows } }] = all.sections[0].blocks;
  assert.deepEqual(rows.map((row) => [row[1].text, row[3].text]), [
    ["160 ms: 66.7 % usable (95 %: 16.7 to 100), undecided", "first look: undecided"],
    ["0.05 N", "first look: inside"]]);
});

test("a built-in experiment that is played with less than it is meant for is a first look", () => {
  const builtIn = (kind, played, folder = "r") => {
    const run = shortRun(kind, played);
    return { ...run, folder, amounts: { ...run.amounts, built_in: true } };
  };
  const headOf = (...runs) => page([section("qos")], {}, { runs }).head;
  assert.deepEqual(headOf(builtIn("plane", { seeds: 3 })),
    [{ p: [{ b: "Played with 3 of 40 seeds: a first look." }] }]);
  assert.deepEqual(headOf(builtIn("limits", { duration_s: 8 }))[0].p,
    [{ b: "Played with 8 of 30 s: a first look, not a verdict." }]);
  assert.deepEqual(headOf(builtIn("table1", { seeds: 2 }, "a"), builtIn("plane", {}, "b"),
    builtIn("plane", { seeds: 3 }, "c"))[0].p,
  [{ b: "Played with a 2 of 40 seeds; c 3 of 40 seeds: a first look." }]);
  assert.deepEqual(headOf(builtIn("plane", {})), [], "all of it");
  assert.deepEqual(headOf(shortRun("plane", { seeds: 3 })), [], "one's own is as long as one likes");
});

test("limits of fewer seeds stand beside the paper as a first look", () => {
  const groups = [{ title: "delay", figures: [] }];
  const runs = [shortRun("limits", { seeds: 10 })];
  const all = page([section("fig6a", groups)], { limits }, { runs });
  assert.deepEqual(all.head[0].p[0], { b: "Played with 10 of 40 seeds: a first look, not a verdict." });
  assert.ok(holds(all.sections, '"badge":"first look: met","style":"seen"'));
  assert.ok(!holds(all.sections, "predicted-met"));
  const own = tableOf(`
    algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds,band
    base,delay,worst,160,=,ms,,,,160,150,157,163,10,`);
  assert.deepEqual(page([section("fig6a", groups)], { limits: own }, { runs }).head, [],
    "nothing of it is judged");
});

test("what few seeds give is no 95 % interval, and one seed gives none", () => {
  const groups = [{ title: "delay", figures: [] }];
  const of = (seeds) => tableOf(`
    algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,ci_high,seeds,band
    base,delay,worst,160,=,ms,,,,160,150,157,163,${seeds},`);
  const tableFor = (seeds) =>
    blocksOf([section("fig6a", groups)], { limits: of(seeds) })
      .find((block) => block.table).table;
  assert.equal(tableFor(3).heads[3], "least to most of 3 seeds");
  assert.equal(tableFor(6).heads[3], "95 %");
  assert.equal(tableFor(1).rows[0][3], "–");
  const paired = (seeds) => tableOf(`algorithm,reference,task,measure,seeds,difference,ci_low,ci_high,sign_test_p
    sep,base,T3,mean_mm,${seeds},0.27,0.2,0.3,0.5`);
  const headOf = (seeds) => blocksOf([section("paired")], { paired: paired(seeds) })[1]
    .blocks[0].table.heads[6];
  assert.deepEqual([headOf(3), headOf(40)], ["least to most of 3 seeds", "95 %"]);
});

test("what usable and good mean stands once, where one of them is used first", () => {
  const criteria = {
    usable: { discrepancy_max_mm: 13.8, vibration_max_mm: 0.97, slow_stiffness_error_max: 0.859,
      force_vibration_max_n: 0.1, scored_share_min: 0.95 },
    good: { discrepancy_max_mm: 5, stiffness_error_max: 0.23, force_discrepancy_max: 0.1,
      contact_lost_max: 0.05, drag_max_n: 0.3 },
  };
  const tasks = tableOf(`algorithm,task,seeds,tier,limited_by
    base,T1,3,unusable,vibration 1.2 mm > 1 mm`);
  const all = page([section("table1"), section("tasks"), section("curves")], { table1, tasks },
    { criteria });
  const meanings = all.sections.map(({ blocks }) => JSON.stringify(blocks)
    .split('{"b":"Usable"}').length - 1);
  assert.deepEqual(meanings, [0, 1, 0]);
  assert.match(JSON.stringify(all.sections[1]), /13\.8 mm apart.*0\.97 mm above 20 Hz.*95 % of the.*23 %.*0\.3 N/);
  assert.ok(!JSON.stringify(all.sections).includes('"tiers"'));
});

test("each value of an axis has its verdicts and what limits them, and its limits", () => {
  const tables = {
    tasks_by_axis: tableOf(`parameter,value,algorithm,task,seeds,vibration_mm,stiffness_ratio,force_vibration_n,tier,limited_by
      both.delay,160ms,base,T3,3,0.278,,0.104,unusable,force vibration added 0.102 N > 0.1 N`),
    limits_by_axis: tableOf(`parameter,value,algorithm,impairment,task,limit,bound,unit,ci_low,ci_high,p50,seeds
      both.delay,1ms,base,random-loss,worst,93,=,percent,92,94,93,10`),
  };
  const blocks = blocksOf([section("axis", [{ title: "How far", figures: ["a"] }])], tables);
  assert.ok(blocks.some(({ p }) => p === "A session fails when it is not usable."));
  const [limitsTable, tasksTable] = blocks.filter((block) => block.table).map(({ table }) => table);
  assert.deepEqual(limitsTable.rows[0].slice(3), [{ text: "worst", style: "name" },
    { text: "93 %", style: "ours" }, "92.0 … 94.0", "10"]);
  assert.deepEqual(tasksTable.rows[0].slice(0, 5), ["160ms", { text: "base", style: "name" },
    { text: "T3", style: "name" },
    { text: { badge: "× unusable", style: "tier-unusable" }, style: "name" },
    { text: "force vibration added 0.102 N > 0.1 N", style: "words" }]);
});

test("the worst of a single task is not told twice", () => {
  const heads = "parameter,value,algorithm,impairment,task,limit,bound,unit,ci_low,ci_high,p50,seeds";
  const row = (task) => `both.delay,1ms,base,random-loss,${task},93,=,percent,92,94,93,10`;
  const tasksOf = (...names) => blocksOf([section("axis")], {
    limits_by_axis: tableOf([heads, ...names.map(row)].join("\n")),
  }).find((block) => block.table).table.rows.map((cells) => cells[3].text);
  assert.deepEqual(tasksOf("T1", "worst"), ["T1"]);
  assert.deepEqual(tasksOf("T1", "T2", "worst"), ["T1", "T2", "worst"]);
});

test("figures of one group with one name on their axes have one scale", () => {
  const curve = (id, label, ...ys) => ({ id, kind: "curves", x: { label: "delay", unit: "ms" },
    y: { label, unit: "mm" }, series: [{ dots: true, points: ys.map((y, x) => [x, y]) }] });
  const dots = (id, value) => ({ id, kind: "dots", x: { label: "mean", unit: "mm", range: [0, 0] },
    y: { label: "algorithm" }, series: [{ dots: [{ at: 0, value }] }] });
  const figures = [curve("a", "mean", 1, 4), curve("b", "mean", 2, 9), curve("c", "std", 3, 5),
    curve("other", "mean", 50), dots("d", 2), dots("e", 7)];
  const groups = [["a", "b", "c", "d", "e"], ["other"]]
    .map((ids) => ({ title: "", figures: ids }));
  const drawn = page([section("axis", groups)], {}, { figures }).figures;
  const rangeOf = (id, side) => drawn.find((figure) => figure.id === id)[side].range;
  assert.deepEqual([rangeOf("a", "y"), rangeOf("b", "y")], [[1, 9], [1, 9]]);
  assert.deepEqual([rangeOf("c", "y"), rangeOf("other", "y")], [[3, 5], [50, 50]]);
  assert.deepEqual([rangeOf("d", "x"), rangeOf("e", "x")], [[0, 7], [0, 7]]);
});

test("the table of precision has each value's difference and the errors of some seeds", () => {
  const table = tableOf(`
    algorithm,task,figure,parameter,value,reference,seeds,ticks,found,difference,ci_low,ci_high,error,order
    base,P1,mean_mm,tick,4ms,0.5ms,1,60000,13.9,0.7,,,0.7,1.02
    base,P1,mean_mm,tick,0.5ms,0.5ms,1,480000,13.2,0,,,0,1.02
    base,T1,vibration_mm,tick,4ms,0.5ms,1,120000,0.5,0.1,0.08,0.12,0.22,
    base,T1,vibration_mm,tick,4ms,0.5ms,10,1200000,0.5,0.1,0.08,0.12,0.11,
    base,T1,vibration_mm,tick,0.5ms,0.5ms,1,480000,0.4,0,0,0,0.2,
    base,T1,vibration_mm,tick,0.5ms,0.5ms,10,4800000,0.4,0,0,0,0.063,`);
  const groups = [{ title: "base", figures: ["precision-base-P1-mean-mm"] }];
  const [, { table: { rows } }, drawn] = blocksOf([section("precision", groups)],
    { precision: table });
  assert.deepEqual(rows[0].slice(2), [{ text: "mean, mm", style: "words" }, "13.2", "0.7",
    "reference", "1.0", "–", "–", "–"]);
  assert.deepEqual(rows[1].slice(4), ["0.1\n(0.08 … 0.12)", "reference", "–", "0.2", "0.063",
    "0.063"]);
  assert.deepEqual(drawn.blocks, [{ figure: "precision-base-P1-mean-mm" }]);
});

test("differences of two algorithms have their intervals and the sign test", () => {
  const table = tableOf(`algorithm,reference,task,measure,seeds,difference,ci_low,ci_high,sign_test_p
    sep,base,T3,mean_mm,10,0.27,0.2,0.3,0.00196
    sep,base,T3,p50,10,,,,`);
  const [, { blocks: [{ table: { rows } }] }] = blocksOf([section("paired")], { paired: table });
  assert.deepEqual(rows[0].slice(4), ["10", "0.270", "0.200 … 0.300", "0.002"]);
  assert.deepEqual(rows[1].slice(5), ["–", "–", "–"]);
});

test("limits by filter and hands span from the least to the most", () => {
  const table = tableOf(`algorithm,impairment,task,filter_order,hand,limit,bound,unit,seeds
    base,delay,T1,1,nominal,145,=,ms,10
    base,delay,T1,4,nominal,182,>,ms,10`);
  const [, shownTable] = blocksOf([section("trust")], { limits_by_convention: table });
  assert.deepEqual(shownTable.table.heads.slice(3), ["order 1\nnominal", "order 4\nnominal"]);
  assert.deepEqual(shownTable.table.rows[0].slice(2),
    [{ text: "145.0 … > 182.0", style: "ours" }, "145", "> 182"]);
});

test("a run in real time that is not valid is excluded", () => {
  const table = tableOf(`algorithm,where,mean_mm,std_mm,max_mm,virtual_mean_mm,virtual_std_mm,virtual_max_mm,valid,invalid_because
    base,loopback,13,10.6,44.6,13.61,10.68,47.25,true,
    base,namespaces,9.99,10.6,44.6,13.61,10.68,47.25,false,late ticks`);
  const [, { table: { rows } }] = blocksOf([section("real-time")], { real_time: table });
  assert.deepEqual(rows[0].slice(2, 5), ["13.00", "13.61", { text: "-4.5 %", style: "ours" }]);
  assert.deepEqual(rows[1].slice(2, 5), [{ text: "9.99", style: "excluded" }, "13.61", "–"]);
  assert.deepEqual(rows[1].at(-1), { text: "excluded: late ticks", style: "words" });
});

test("tasks say how far copies are turned apart where a body turns", () => {
  const heads = "task,algorithm,tier,seeds,mean_mm,std_mm,max_mm,vibration_mm,stiffness_ratio,"
    + "force_vibration_n,force_discrepancy,contact_lost,force_step_n,drag_n,energy_mj,limited_by";
  const cells = "T2,base,usable,10,1.25,0.5,3,0.012,0.113,0.015,0.25,,0.4,,0.1,stiffness";
  const tablesOf = (tasks) => {
    const [, , main, further] = blocksOf([section("tasks")], { tasks: tableOf(tasks) });
    return [main.table, further.blocks[0].table];
  };
  const [main, further] = tablesOf(`${heads}\n${cells}`);
  assert.deepEqual(main.rows[0].slice(2, 5), [
    { text: { badge: "○ usable", style: "tier-usable" }, style: "name" }, "10", "1.25"]);
  assert.deepEqual(further.rows[0].slice(0, 2), ["T2", { text: "base", style: "name" }]);
  assert.equal(further.rows[0][3], "25.0", "of a share in percent");
  const [, turned] = tablesOf(`${heads},turned_apart_deg\n${cells},12.348`);
  assert.equal(turned.heads.at(-1), "turned\napart, max deg");
  assert.equal(turned.rows[0].at(-1), "12.35");
});

test("a criterion that no session has exercised is named", () => {
  const groups = [{ title: "delay", figures: ["a", "b"] }];
  const figures = [{ id: "a", y: { label: "vibration" }, levels: [{ y: 1 }] },
    { id: "b", y: { label: "force-vibration" } }, { id: "c", y: { label: "stiffness" } }];
  const blocks = blocksOf([section("curves", groups)], {}, { figures });
  assert.equal(blocks[1].p, "The dashed line is where usable ends.");
  assert.match(blocks.at(-1).banner, /no session can have failed by it:$/);
  assert.deepEqual(blocks.at(-1).list,
    ["stiffness: it is taken from presses at 1 Hz, which T2 alone has, in sessions that are long "
      + "enough for them"]);
});

test("the page says what was played, whether it counts, and why not", () => {
  const all = (...runs) => page([section("runs")], {}, { runs, played: ["Hands played T1."] });
  const head = (...runs) => all(...runs).head[0];
  assert.equal(all({ folder: "r", manifest: { valid: true } }).lead,
    "Hands played T1. All sessions completed and passed their checks.");
  assert.deepEqual(all({ folder: "r", manifest: { valid: true } }).head, []);
  assert.equal(all({ folder: "r", manifest: { valid: false } }).lead, "Hands played T1.");
  assert.match(page([section("qos")], {}).head[0].banner, /There is no manifest\.json/);
  const stopped = (folder) =>
    ({ folder, manifest: { valid: false, invalid_because: ["stopped", "late", "stopped"] } });
  assert.deepEqual(head(stopped("/a/b/fig7")).list, ["stopped", "late"], "each once, no folder");
  assert.deepEqual(head(stopped("/a/fig7"), stopped("/a/qos")).list,
    ["fig7, qos: stopped", "fig7, qos: late"]);
  assert.deepEqual(head({ folder: "r", manifest: {} }).list, ["the manifest does not say why"]);
  assert.deepEqual(head({ folder: "r", manifest: { kind: "real-time", valid: false } }).list,
    ["not every session over real UDP kept its timing"]);
});

test("runs say how to repeat them, long values below the others", () => {
  const manifest = {
    command: "hapnet-lab run", title: "a", seeds: [1, 2, 3, 4], wall_time_s: 61.5312, valid: true,
    configuration: "seeds = 4\n", sessions: { played: 42, reused: 0 },
  };
  const [overview, details] = blocksOf([section("runs")], {}, { runs: [{ folder: "r", manifest }] });
  assert.deepEqual(overview.table.rows[0].slice(2), ["61.53", "–", "–",
    { text: "played 42, reused 0", style: "name" }, { text: "1 to 4", style: "name" },
    { text: "valid", style: "name" }]);
  assert.deepEqual(details.folded, ["r: ", { code: "hapnet-lab run" }]);
  assert.ok(holds(details.blocks[0], '["wall time, s",{"text":"61.53","style":"words"}]'));
  assert.deepEqual(details.blocks.slice(1), [{ p: "configuration:" }, { pre: "seeds = 4\n" }]);
});

test("tasks and algorithms that were played are told in a sentence each, others not", () => {
  const { sections } = page([section("qos")], {}, { played: ["Hands played T2 with base."] });
  assert.deepEqual(sections.at(-1).blocks[0].list.map(([word]) => word.b), ["T2", "base"]);
  assert.equal(page([section("qos")], {}).sections.length, 1);
});

const recorded = (more = {}) => ({
  peers: [1, 2], algorithm: "base", played: "Two hands played T3.", valid: true,
  invalid_because: [], network: "Asked of the network: delay 80 ms.", clock: "One clock.",
  repeats: [{ what: "All:", commands: ["a", "b"] }],
  settings: [{ caption: "s", unit: "", heads: ["A", "B"], remarks: [],
    rows: [{ name: "seed", cells: ["7", "8"], note: "" }] }],
  tables: [{ caption: "c", unit: "mm", heads: ["mean"], remarks: ["a remark"],
    rows: [{ name: "x", cells: ["1.00"], note: "" }, { name: "y", cells: [], note: "n" }] }],
  ...more,
});
const ofSessions = (sections, sessions) => page(sections, {}, { subject: "session", sessions });

test("a recorded session has its tables and says whether it counts", () => {
  const groups = [{ title: "Task T3", figures: ["session-T3-apart"] }];
  const all = ofSessions([section("sessions", groups)],
    [recorded({ valid: false, invalid_because: ["late"] })]);
  const [banner, zoomed, , panels] = all.sections[0].blocks;
  assert.equal(all.lead,
    "Two hands played T3. Not valid, for the reasons that stand with its figures.");
  assert.deepEqual([banner.style, banner.list], ["missed", ["late"]]);
  assert.deepEqual(zoomed.blocks, [{ figure: "session-T3-apart" }], "no message came");
  const [{ blocks: [{ table: { rows } }, remark] }] = panels.blocks;
  assert.deepEqual(rows, [["x", "1.00", { text: "", style: "words" }],
    ["y", "", { text: "n", style: "words" }]]);
  assert.deepEqual(remark, { p: "a remark" }, "it stays below its table");
  assert.deepEqual([all.head, all.foot], [[], ""]);
});

test("a session's figures over time zoom together, and those of shares stand apart", () => {
  const names = ["apart", "delay", "loss", "delays", "lateness"].map((name) => `session-T3-${name}`);
  const { lead, sections } = ofSessions(
    [section("sessions", [{ title: "Task T3", figures: names }])], [recorded()]);
  assert.equal(lead, "Two hands played T3. Valid: both loops kept their time, and both sides were "
    + "in session together.");
  const [zoomed, shares] = sections[0].blocks;
  assert.deepEqual(zoomed.blocks, [{ figure: names[0] }, { heading: "What the network did" },
    { p: "Asked of the network: delay 80 ms." }, { figure: names[1] }, { figure: names[2] },
    { p: "One clock." }]);
  assert.deepEqual(shares.blocks, [{ figure: names[3] }, { figure: names[4] }]);
});

test("of several pairs each says what it was, and the page how many count", () => {
  const groups = ["1 and 2", "1 and 3"].map((title) => ({ title, figures: [] }));
  const all = ofSessions([section("sessions", groups)],
    [recorded(), recorded({ peers: [1, 3], valid: false, invalid_because: ["late"] })]);
  assert.match(all.lead, /^2 pairs of records, 1 of them valid: /);
  const texts = all.sections[0].blocks.filter((block) => block.p).map(({ p }) => p);
  assert.match(texts[0], /^Two hands played T3. Valid: /);
});

test("how to repeat a session: commands, and the settings of both peers", () => {
  const blocks = ofSessions([section("repeat")], [recorded()]).sections[0].blocks;
  assert.deepEqual(blocks.slice(0, 2), [{ p: "All:" }, { pre: "a\nb" }]);
  assert.deepEqual(blocks[2].table.rows,
    [["seed", { text: "7", style: "words" }, { text: "8", style: "words" }]]);
});

test("numbers have their decimals, ties as the program rounds them, and no minus nothing", () => {
  assert.deepEqual([shown(22.5, 0), shown(23.5, 0), shown(0.125, 2), shown(2.675, 2)],
    ["22", "24", "0.12", "2.67"]);
  assert.deepEqual([shown(-0.001, 2), shown(null, 1), shown(-22.5, 0)], ["0.00", "–", "-22"]);
  assert.deepEqual([general(160), general(4.5), general(0.00196, 2), general(1.234e-7, 3),
    general(12345.6, 4), general(0)], ["160", "4.5", "0.002", "1.23e-07", "1.235e+04", "0"]);
});

test("a page has four digits of a measured number, and all of a count", () => {
  assert.deepEqual(["101.985", "13764.294", "1000.00", "0.0000", "0.3547", "-5.719", "8000", "a.b"]
    .map(fewDigits), ["102.0", "13764", "1000", "0", "0.3547", "-5.719", "8000", "a.b"]);
});
