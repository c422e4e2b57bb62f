// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What draws figures, without a browser: axes, curves, bars, heat maps, their numbers as tables.

import assert from "node:assert/strict";
import { test } from "node:test";

import "./svg_double.mjs";
import { drawnBars, groupsOf } from "../../web/page/figures/bars.js";
import {
  curvesOf, drawnCurves, follow, spansOf, valueNear,
} from "../../web/page/figures/curves.js";
import { drawnDots, heightOfDots } from "../../web/page/figures/dots.js";
import { drawnHeatMap } from "../../web/page/figures/heat_map.js";
import { nearest, roundMarks, roundSpan, scaleOf, spanOf } from "../../web/page/figures/scales.js";
import { nameOfAxis, wrapped } from "../../web/page/figures/svg.js";
import { namedIn } from "../../web/page/figures/still.js";
import { numbersOf } from "../../web/page/figures/table.js";
import { Zoom } from "../../web/page/figures/zoom.js";

const curve = (name, points, more = {}) => ({ name, colour: "base", points, ...more });
const figure = (series, more = {}) => ({
  id: "f", kind: "curves", title: "t", x: { label: "time", unit: "s" },
  y: { label: "x", unit: "mm" }, series, ...more,
});
const size = { width: 400, height: 200 };

test("a legend names a curve with gaps once, and curves without a name not at all", () => {
  const data = figure([curve("a", [[0, 1]]), curve("", [[0, 2]]), curve("a", [[5, 1]]),
    curve("b", [[0, 3]])]);
  assert.deepEqual(namedIn(data).map(({ name, points }) => [name, points[0][0]]),
    [["a", 0], ["b", 0]]);
});

test("a zoom stays within the whole, and comes back to it to the bit", () => {
  const zoom = new Zoom([2, 32]);
  zoom.show(12, 7);
  assert.deepEqual(zoom.range, [7, 12]);
  zoom.move(-10);
  assert.deepEqual(zoom.range, [2, 7]);
  zoom.scale(100);
  assert.ok(zoom.isWhole);
  zoom.show(10, 10);
  assert.ok(zoom.range[1] > zoom.range[0], "there is always something to see");
  zoom.reset();
  assert.deepEqual(zoom.range, [2, 32]);
});

test("a logarithmic zoom is even in decades", () => {
  const zoom = new Zoom([1, 10000], true);
  zoom.scale(0.5);
  const [low, high] = zoom.range;
  assert.ok(Math.abs(low - 10) < 1e-9 && Math.abs(high - 1000) < 1e-6, `${low} to ${high}`);
});

test("keys zoom, move and show all; others do nothing", () => {
  const zoom = new Zoom([0, 8]);
  let changes = 0;
  zoom.addEventListener("change", () => { changes += 1; });
  for (const key of ["+", "ArrowRight"]) assert.ok(zoom.key(key));
  assert.deepEqual(zoom.range, [3, 7]);
  assert.equal(zoom.key("Tab"), false);
  assert.ok(zoom.key("0"));
  assert.ok(zoom.isWhole);
  assert.equal(changes, 3);
});

test("points are put in order, and a logarithmic axis leaves out what has no logarithm", () => {
  const [one] = curvesOf(figure([curve("base", [[3, 30], [0, 1], [1, 10]])], {
    x: { label: "ticks", scale: "log" },
  }));
  assert.deepEqual([one.x, one.y], [[1, 3], [10, 30]]);
});

test("an axis spans its levels, bands and range too, and never nothing", () => {
  const { x, y } = spansOf(figure([curve("base", [[1, 1]], { band: [[1, -5, 5]] })],
    { levels: [{ y: 50, name: "limit" }] }));
  assert.deepEqual(x, [0, 1]);
  assert.ok(y[0] < -5 && y[1] > 50, `${y}`);
  assert.deepEqual(spansOf(figure([curve("a", [[1, 1], [2, 3]])],
    { y: { label: "", range: [0, 9] } })).y, [0, 10]);
  assert.deepEqual(spanOf([], false), [-1, 1]);
  assert.deepEqual(spanOf([0.02, 3], true), [0.01, 10]);
  assert.deepEqual([[0, 0], [320], [-5]].map((values) => spanOf(values, false)),
    [[0, 1], [0, 320], [-5, 0]], "a single value stands at the end of an axis from zero");
});

test("the name of a level makes way for points", () => {
  const anchorOf = (points, more = {}) => {
    const svg = drawnCurves(figure([curve("base", points, more)],
      { levels: [{ y: 5, name: "usable" }], y: { label: "", range: [0, 10] } }), size);
    const all = (node) => [node, ...node.children.flatMap(all)];
    return all(svg).find((node) => node.textContent === "usable").attributes["text-anchor"];
  };
  assert.equal(anchorOf([[0, 1], [10, 1]]), "end");
  assert.equal(anchorOf([[0, 1], [10, 5.3]]), "start");
  assert.equal(anchorOf([], { scatter: [[0, 1], [9.9, 5.3]] }), "start");
  assert.equal(anchorOf([[0, 5.3], [10, 5.3]]), "end", "no room at either end");
});

test("marks are round and lie within", () => {
  assert.deepEqual(roundMarks(-0.3, 0.31, 5), [-0.2, 0, 0.2]);
  assert.deepEqual(roundMarks(0, 30, 5), [0, 10, 20, 30]);
  assert.deepEqual(scaleOf([1, 10000], [0, 1], true).marks(5), [1, 10, 100, 1000, 10000]);
  assert.deepEqual(scaleOf([2, 40], [0, 1], true).marks(5), [2, 5, 10, 20]);
  assert.equal(scaleOf([1, 1e6], [0, 1], true).says(1e5), "1e5");
});

test("an axis ends at round values, and reaches beyond the data", () => {
  assert.deepEqual(roundSpan([0, 47.25]), [0, 50]);
  assert.deepEqual(roundSpan([-0.31, 0.12]), [-0.4, 0.2]);
  assert.deepEqual(roundSpan([0, 100]), [0, 100], "what is round already stays");
});

test("dots at the ends of an axis have room beside them", () => {
  const { x } = spansOf(figure([curve("base", [[0, 1], [100, 2]], { dots: true })]));
  assert.deepEqual(x, [-3, 103]);
  assert.deepEqual(spansOf(figure([curve("base", [[0, 1], [100, 2]])])).x, [0, 100]);
});

test("a text is broken where it may be, and never between a number and its unit", () => {
  assert.deepEqual(wrapped("dead-reckoning", 60), ["dead-", "reckoning"]);
  assert.deepEqual(wrapped("three peers at 97 % loss", 90), ["three peers", "at 97\u00a0% loss"]);
  assert.deepEqual(wrapped("", 80), [""]);
});

test("pixels and values are inverse, on logarithmic axes too", () => {
  for (const isLog of [false, true]) {
    const scale = scaleOf([2, 200], [60, 380], isLog);
    assert.ok(Math.abs(scale.value(scale.pixel(37)) - 37) < 1e-9);
    assert.deepEqual([scale.pixel(2), scale.pixel(200)], [60, 380]);
  }
});

/** Keeps what a path goes through. */
const pathDouble = () => {
  const moves = [];
  return {
    moves, moveTo: (...at) => moves.push(["M", ...at]), lineTo: (...at) => moves.push(["L", ...at]),
  };
};
const plain = { x: scaleOf([0, 100], [0, 100]), y: scaleOf([0, 100], [0, 100]) };

test("a gap in a curve lifts the pen, unless the curve spans gaps", () => {
  const gap = { x: [0, 1, 2], y: [5, null, 7] };
  const pens = (spans) => follow(pathDouble(), { ...gap, spans }, plain, [0, 100])
    .moves.map(([pen]) => pen).join("");
  assert.equal(pens(false), "MM");
  assert.equal(pens(true), "ML");
});

test("a dense curve is thinned to its columns of pixels, and keeps its peaks", () => {
  const x = Array.from({ length: 10_000 }, (_, i) => i / 100);
  const y = x.map((_, i) => (i === 6173 ? 99 : i % 2));
  const { moves } = follow(pathDouble(), { x, y }, plain, [0, 100]);
  assert.ok(moves.length <= 2 * 102, `${moves.length} points`);
  assert.ok(moves.some(([, , down]) => down === 99), "the peak");
  const part = follow(pathDouble(), { x, y }, plain, [50, 51]).moves;
  assert.ok(part.length < 15, "only what is seen, and a point more at each end");
});

test("the value under the cursor is the nearest one, and none far away", () => {
  const [one] = curvesOf(figure([curve("a", [[0, 1], [10, 2]], { scatter: [[5, 7]] })]));
  assert.equal(valueNear(one, 0.05, 0.1), 1);
  assert.equal(valueNear(one, 5, 0.1), 7);
  assert.equal(valueNear(one, 7, 0.1), null);
  const times = [1, 2, 4, 4, 7];
  assert.deepEqual([0, 1.4, 1.6, 3.1, 5, 9].map((x) => nearest(times, x)), [0, 0, 1, 2, 3, 4]);
});

test("a dashed curve lies on all others, which show between its dashes", () => {
  const points = [[0, 1], [1, 2]];
  const drawing = drawnCurves(figure([curve("A to B", points, { colour: "left" }),
    curve("B to A", points, { colour: "right", dash: "6 3" }), curve("law", points)]), size);
  const paths = drawing.all("svg")[0].all("path").map(({ attributes }) => attributes);
  assert.deepEqual(paths.map(({ stroke }) => stroke), ["var(--base)", "var(--left)", "var(--right)"]);
  assert.equal(paths[2]["stroke-dasharray"], "6 3");
});

test("curves are drawn in the colours of the palette, the first on top, hidden ones not", () => {
  const all = figure([curve("a", [[0, 0], [1, 1]]),
    curve("b", [[0, 1], [1, 0]], { colour: "sep" })]);
  const strokes = (svg) => svg.all("svg")[0].all("path").map((one) => one.attributes.stroke);
  assert.deepEqual(strokes(drawnCurves(all, size)), ["var(--sep)", "var(--base)"]);
  const one = drawnCurves(all, size, { hidden: new Set(["a"]) });
  assert.deepEqual(strokes(one), ["var(--sep)"]);
  assert.equal(one.attributes["aria-label"], "t");
});

const bars = (list, more = {}) => ({
  id: "b", kind: "bars", title: "t", x: { label: "", categories: ["one", "two"] },
  y: { label: "limit", unit: "ms" }, series: list, ...more,
});
const bar = (at, value, more = {}) => ({ at, value, text: String(value), tip: "", ...more });

test("bars stand from zero to their value, the highest with room for its text", () => {
  const svg = drawnBars(bars([{ name: "run", colour: "base", bars: [bar(0, 100)] }]), size);
  // Between 8 and 160 pixels, the axis to 120: the next round value above 112.
  const { d } = svg.all("g")[0].all("path")[0].attributes;
  const [, top] = /V([0-9.]+)H/.exec(d);
  assert.ok(Math.abs(Number(top) - (160 - (152 * 100) / 150)) < 0.01, d);
  assert.ok(d.includes("160"));
  assert.deepEqual(svg.all("text").map((one) => one.textContent).slice(-2), ["one", "two"]);
});

test("bars are dashed for others, open for a bound, and red for a miss", () => {
  const [[others], [ours]] = groupsOf(bars([
    { name: "paper", colour: "base", outlined: true, bars: [bar(0, 5)] },
    { name: "run", bars: [bar(1, 6, { colour: "sep" })] },
  ])).map((group) => group.bars);
  assert.equal(others.outlined, true);
  assert.equal(ours.colour, "sep");
  const drawn = (more) => drawnBars(bars([{ name: "r", colour: "base", bars: [bar(0, 5, more)] }]), size);
  const shape = (svg) => svg.all("g")[0].all("path")[0].attributes;
  assert.match(shape(drawn({})).d, /H/);
  assert.doesNotMatch(shape(drawn({ open: true })).d, /H/, "no edge on top");
  const missed = drawn({ missed: true }).all("g")[0].all("text")[0].attributes;
  assert.equal(missed.fill, "var(--missed)");
  const interval = drawn({ low: 4, high: 6 }).all("g")[0].all("path")[1].attributes.d;
  assert.match(interval, /h8M/, "the ends of an interval");
});

test("numbers of bars that would overlap are left out", () => {
  const texts = (count) => drawnBars(bars(Array.from({ length: count }, (_, i) =>
    ({ name: `${i}`, colour: "base", bars: [bar(0, 12.34)] }))), size).all("g")[0].all("text");
  assert.equal(texts(2).length, 1);
  assert.equal(texts(9).length, 0);
});

const dots = (rows) => ({
  id: "d", kind: "dots", title: "t", x: { label: "measured", unit: "mm" },
  y: { label: "claim", unit: "", categories: rows.map((_, i) => `row ${i}`) },
  series: [{ name: "t", dots: rows.map((row, at) => ({ at, colour: "base", tip: "", ...row })) }],
});

test("a row of dots has its value, its interval, each seed, and what is accepted", () => {
  const rows = dots([{ value: 4, low: 2, high: 6, accepted: true, to: 5, single: [2, 6] },
    { value: 9, missed: true }]);
  const svg = drawnDots(rows, { width: 320, height: heightOfDots(rows, 320) });
  const [first, second] = svg.all("g");
  assert.equal(first.all("circle").length, 3);
  const [line] = first.all("path").slice(1);
  assert.match(line.attributes.d, /^M[0-9.]+ [0-9.]+H[0-9.]+M.*v10M.*v10$/);
  const [value] = first.all("circle").slice(-1);
  const { x, width } = first.all("rect")[0].attributes;
  assert.equal(x, 14, "from the edge, as it has no least");
  assert.ok(value.attributes.cx < x + width, "within what is accepted");
  assert.deepEqual(first.all("text").map((one) => one.textContent), ["row 0", "4"]);
  assert.equal(second.all("circle")[0].attributes.fill, "var(--missed)");
  assert.deepEqual(numbersOf(rows).rows, [["row 0", 4, 2, 6], ["row 1", 9, "", ""]]);
});

test("the figure of dots is as high as its rows and their names take", () => {
  const one = { value: 1 };
  const step = heightOfDots(dots([one, one]), 320) - heightOfDots(dots([one]), 320);
  assert.ok(step > 30 && step < 60, `${step} px`);
  const long = dots([one]);
  long.y.categories = ["bears 200 ms and 30 ms of jitter and 97 % loss at once: vibration"];
  assert.ok(heightOfDots(long, 320) > heightOfDots(dots([one]), 320), "its name has two lines");
});

test("a curve shows where it crosses its limit, with the ends of the interval", () => {
  const svg = drawnCurves(figure([curve("a", [[0, 0], [10, 100]],
    { crossing: { y: 50, low: 4, high: 6 } })]), size);
  const paths = svg.all("svg")[0].all("path");
  assert.equal(paths.length, 2);
  assert.equal(paths[1].attributes.d.match(/M/g).length, 3);
});

test("a heat map has a field for each cell, with its words", () => {
  const map = {
    id: "h", kind: "heat-map", title: "t", x: { label: "delay", unit: "ms", categories: ["0", "9"] },
    y: { label: "jitter", unit: "ms", categories: ["0", "5"] },
    series: [{ name: "t", cells: [{ x: 1, y: 1, colour: "good", symbol: "×", tip: "a < b" }] }],
  };
  const svg = drawnHeatMap(map, size);
  const { x, y, width, height } = svg.all("rect")[0].attributes;
  assert.deepEqual([x, y, width, height], [221.5, 8.5, 160, 75]);
  assert.equal(svg.all("title")[0].textContent, "a < b");
  assert.deepEqual(numbersOf(map).rows, [["9", "5", "a < b"]]);
});

test("each figure has its numbers as a table", () => {
  const { heads, rows } = numbersOf(figure([curve("a", [[0, 1]], { scatter: [[0, 2]] })]));
  assert.deepEqual(heads, ["curve", "time, s", "x, mm"]);
  assert.deepEqual(rows, [["a", 0, 1], ["a", 0, 2]]);
  const limits = numbersOf(bars([{ name: "r", colour: "base", bars: [bar(1, 5, { low: 4, high: 6 })] }]));
  assert.deepEqual(limits.rows, [["two", "5", 5, 4, 6]]);
  assert.equal(nameOfAxis({ label: "error", unit: "", scale: "log" }), "error, log scale");
});
