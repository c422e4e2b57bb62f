// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The words and tables of a page of results, without a browser: blocks made of the tables that the
// page carries.

import assert from "node:assert/strict";
import { test } from "node:test";

import { layOut } from "../../web/page/report/sections.js";
import { general, shown } from "../../web/page/report/words.js";

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
  subject: "experiments", title: "", missing: [], runs: [], sessions: [], figures: [], sections,
  tables, ...more,
});
const blocksOf = (...words) => page(...words).sections[0].blocks;
const holds = (json, part) => JSON.stringify(json).includes(part);

test("Table 1 stands beside the paper's with its bands, misses in red", () => {
  const [, { table }] = blocksOf([section("table1")], { table1 });
  assert.deepEqual(table.rows[0].slice(0, 4), ["base", { text: "13.61", style: "ours" },
    { text: "13.79", style: "paper" }, { text: "12.41 to 15.17", style: "band" }]);
  assert.deepEqual(table.rows[2].slice(7, 10), [{ text: "66.61", style: "ours missed" },
    { text: "58.85", style: "paper" }, { text: "40.00 to 65.00", style: "band" }]);
  assert.deepEqual(table.rows[0][11], { badge: "calibrated", style: "calibrated" });
  assert.deepEqual(table.rows[1][11], { badge: "met", style: "seen" }, "it is no prediction");
});

test("a limit that is a bound is written as one, and green is for predictions alone", () => {
  const groups = [{ title: "delay", figures: ["limit-delay"] }];
  const [, heading, panels, worst, folded] = blocksOf([section("fig6a", groups)], { limits });
  assert.deepEqual([heading, panels], [{ heading: "delay" },
    { panels: "", blocks: [{ figure: "limit-delay" }] }]);
  assert.deepEqual(worst.table.rows[1], ["dead-reckoning", { text: "worst", style: "name" },
    { text: "145 ms", style: "ours" }, "143.0 … 147.0", "140.0", "40",
    { text: "150 ms", style: "paper" }, { text: "130 to 155", style: "band" },
    { badge: "predicted-met", style: "met" }, { badge: "predicted", style: "" }]);
  const [alone] = folded.blocks[0].table.rows;
  assert.deepEqual(alone[2], { text: "> 320 ms", style: "ours" });
  assert.equal(alone[3], "320.0 … > 320.0");
  const loss = blocksOf([section("fig6b", [{ title: "burst loss", figures: [] }])], { limits });
  assert.ok(holds(loss, '"> 95 of 100"'));
});

test("what stands against the paper is sorted by how it came about", () => {
  const all = page([section("claims")], { table1, limits });
  const counts = all.sections[0].blocks[1].claims.map(({ title, list }) => [title, list.length]);
  assert.deepEqual(counts, [["Calibrated", 2], ["Selected, and agrees", 0],
    ["The same by construction", 1], ["Predicted and met", 1], ["Undecided", 0], ["Missed", 3]]);
  const { list } = all.sections[0].blocks[1].claims[5];
  assert.deepEqual(list[1], ["Limit of jitter, ", { b: "dead-reckoning" },
    ", worst of the tasks: 2.5 ms (paper: 5 ms), 95 %: 2.4 … 2.6, selected"]);
  const { tiles } = all.head.at(-1);
  assert.deepEqual(tiles.map(({ count }) => count), [2, 1, 1, 0, 3]);
  assert.ok(!holds(page([section("qos")], {}).head, "tiles"));
});

test("a claim beyond the paper has its numbers of the seeds that judge and of all", () => {
  const tables = {
    claims: tableOf(`claim,value,accept,verdict
      stiffness at 100 ms,0.98 to 1.46,0.75 to 1.25,missed
      mean,5.97,<= 6,met`),
    claims_quantiles: tableOf(`claim,quantile,seeds
      stiffness at 100 ms,0.98 to 1.32,40`),
    claim_sessions: tableOf(`algorithm,condition,task,force_above_2hz_n
      remote-proxy,100ms,T1,0.05
      remote-proxy,100ms,T1,0.09
      remote-proxy,100ms,T1,0.07
      base,100ms,T1,0.9`),
  };
  const [text, claims, , forces] = blocksOf([section("beyond")], tables);
  assert.match(text.p, /^2 claims, made before the first run; 1 missed\./);
  assert.deepEqual(claims.table.rows[0].slice(2), [
    { text: "0.98 to 1.46", style: "ours missed" }, { text: "0.98 to 1.32", style: "ours" }, "40",
    { badge: "missed", style: "missed" }]);
  assert.deepEqual(forces.table.rows, [["100ms", "0.070 (0.090)"]], "of the first algorithm");
  assert.equal(blocksOf([section("beyond")], { claims: tables.claims }).length, 2);
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
  const rowOf = (tasks) => blocksOf([section("tasks")], { tasks: tableOf(tasks) })[1].table;
  assert.equal(rowOf(`${heads}\n${cells}`).heads.length, 17);
  assert.deepEqual(rowOf(`${heads}\n${cells}`).rows[0].slice(2, 5), [
    { text: { badge: "○ usable", style: "tier-usable" }, style: "name" }, "10", "1.25"]);
  assert.equal(rowOf(`${heads}\n${cells}`).rows[0][11], "25.0", "of a share in percent");
  const turned = rowOf(`${heads},turned_apart_deg\n${cells},12.348`);
  assert.equal(turned.heads.at(-1), "turned\napart, max deg");
  assert.equal(turned.rows[0].at(-1), "12.35");
});

test("a criterion that no session has exercised is named", () => {
  const groups = [{ title: "delay", figures: ["a", "b"] }];
  const figures = [{ id: "a", y: { label: "vibration" }, levels: [{ y: 1 }] },
    { id: "b", y: { label: "force-vibration" } }, { id: "c", y: { label: "stiffness" } }];
  const blocks = blocksOf([section("curves", groups)], {}, { figures });
  assert.equal(blocks[1].p, "The dashed line is where usable ends.");
  assert.match(blocks.at(-1).banner, /no session can have failed by it: stiffness\.$/);
});

test("the page says whether it is valid and why not", () => {
  const head = (...runs) => page([section("runs")], {}, { runs }).head[0];
  assert.deepEqual(head({ folder: "r", manifest: { valid: true } }).banner[0], { b: "Valid." });
  assert.match(page([section("qos")], {}).head[0].banner, /There is no manifest\.json/);
  const stopped = { folder: "r/fig7", manifest: { valid: false, invalid_because: ["stopped"] } };
  assert.deepEqual(head(stopped).list, ["r/fig7: stopped"]);
  assert.deepEqual(head({ folder: "r", manifest: {} }).list, ["r: does not say why"]);
  assert.deepEqual(head({ folder: "r", manifest: { kind: "real-time", valid: false } }).list,
    ["r: not every session over real UDP kept its timing"]);
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

test("commands make what is missing", () => {
  const missing = [{ what: "Fig. 6b", command: "scripts/fig6b.sh --out r/fig6b" }];
  const { sections } = page([section("qos")], {}, { missing });
  assert.deepEqual(sections.at(-1).blocks[1].list,
    [["Fig. 6b: ", { code: "scripts/fig6b.sh --out r/fig6b" }]]);
  assert.equal(page([section("qos")], {}).sections.length, 1);
});

test("a recorded session has its tables and says whether it counts", () => {
  const session = {
    peers: [1, 2], algorithm: "base", valid: false, invalid_because: ["late"], clock: "One clock",
    tables: [{ caption: "c", unit: "mm", heads: ["mean"], remarks: ["a remark"],
      rows: [{ name: "x", cells: ["1.00"], note: "" }, { name: "y", cells: [], note: "n" }] }],
  };
  const groups = [{ title: "Task T3", figures: ["session-T3-apart"] }];
  const all = page([section("sessions", groups)], {}, { subject: "session", sessions: [session] });
  const [, heading, who, banner, zoomed, panels, clock] = all.sections[0].blocks;
  assert.deepEqual([heading.heading, who.p, clock.p],
    ["Task T3", "A is peer 1, B is peer 2; algorithm base.", "One clock."]);
  assert.deepEqual([banner.style, banner.list], ["missed", ["late"]]);
  assert.deepEqual(zoomed.blocks, [{ figure: "session-T3-apart" }]);
  assert.deepEqual(panels.blocks[0].table.rows, [["x", "1.00", { text: "", style: "words" }],
    ["y", "", { text: "n", style: "words" }]]);
  assert.deepEqual(panels.blocks[1], { p: "a remark" });
  assert.deepEqual([all.head, all.foot], [[], ""]);
});

test("numbers have their decimals, ties as the program rounds them, and no minus nothing", () => {
  assert.deepEqual([shown(22.5, 0), shown(23.5, 0), shown(0.125, 2), shown(2.675, 2)],
    ["22", "24", "0.12", "2.67"]);
  assert.deepEqual([shown(-0.001, 2), shown(null, 1), shown(-22.5, 0)], ["0.00", "–", "-22"]);
  assert.deepEqual([general(160), general(4.5), general(0.00196, 2), general(1.234e-7, 3),
    general(12345.6, 4), general(0)], ["160", "4.5", "0.002", "1.23e-07", "1.235e+04", "0"]);
});
