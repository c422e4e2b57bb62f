// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The state behind a report's figures and player, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";

import { rowsOf, spanOf, spansOf, stylesOf, valueNear } from "../../web/page/report/curves.js";
import { Replay } from "../../web/page/report/replay.js";
import { Zoom } from "../../web/page/report/zoom.js";
import { pictureOf } from "../../web/page/paint/picture.js";
import { roundMarks } from "../../web/page/rules.js";
import { nearest } from "../../web/page/strips.js";

const curve = (name, points, more = {}) =>
  ({ name, colour: "var(--base)", width: 1.2, dots: false, dashes: "none", points, ...more });
const plot = (curves, more = {}) => ({
  kind: "plot", title: "t", log_x: false, log_y: false, range_x: [], range_y: [], levels: [],
  curves, ...more,
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

test("curves with other x share one list of them, and several points at one x stay", () => {
  const { times, series } = rowsOf(plot([
    curve("base", [[1, 10], [3, 30]]),
    curve("", [[2, 5], [1, 7], [1, 8]]),
  ]));
  assert.deepEqual(times, [1, 1, 2, 3]);
  assert.deepEqual(series.map((one) => one.value), [[10, null, null, 30], [7, 8, 5, null]]);
});

test("a logarithmic axis leaves out what has no logarithm and spans whole decades", () => {
  const data = plot([curve("base", [[0, 0], [1, 0.02], [2, 3]])], { log_y: true });
  assert.deepEqual(rowsOf(data).times, [1, 2]);
  assert.deepEqual(spansOf(data), { x: [0, 2], y: [0.01, 10] });
});

test("an axis spans its levels too, and never nothing", () => {
  const data = plot([curve("base", [[1, 1]])], { levels: [{ y: 50, name: "limit" }] });
  const { x, y } = spansOf(data);
  assert.deepEqual(x, [0, 2]);
  assert.ok(y[0] < 1 && y[1] > 50);
  assert.deepEqual(spanOf([], false), [-1, 1]);
});

test("what has no name is hidden with the curve before it", () => {
  const styles = stylesOf(plot([curve("base", []), curve("", [], { width: 0, dots: true })]));
  assert.deepEqual(styles.map((style) => style.name), ["base", "base"]);
  assert.deepEqual(styles.map((style) => style.label), ["base", ""]);
  assert.deepEqual(styles.map((style) => style.width), [1.25, 0]);
  assert.equal(styles[0].colour, "base");
});

test("a curve's value under the cursor is its nearest one, and none far away", () => {
  const rows = rowsOf(plot([curve("a", [[0, 1], [10, 2]]), curve("b", [[0.05, 5], [5, 6]])]));
  assert.equal(valueNear(rows, 0, 1, [0, 10]), 1); // at 0.05: that at 0
  assert.equal(valueNear(rows, 0, 2, [0, 10]), null); // at 5: nothing within 0.1
});

test("the point nearest to the cursor is found, beyond the ends, too", () => {
  const times = [1, 2, 4, 4, 7];
  assert.deepEqual([0, 1.4, 1.6, 3.1, 5, 9].map((x) => nearest(times, x)), [0, 0, 1, 2, 3, 4]);
});

test("marks are round and lie within", () => {
  assert.deepEqual(roundMarks(-0.3, 0.31, 5), [-0.2, 0, 0.2]);
  assert.deepEqual(roundMarks(0, 30, 5), [0, 10, 20, 30]);
});

/** A column as the report packs it. */
const packed = (values, step) => {
  const bytes = Buffer.alloc(2 * values.length);
  values.forEach((value, i) => bytes.writeInt16LE(Math.round(value / step), 2 * i));
  return { step, data: bytes.toString("base64") };
};
const still = { x: 0, y: 0, z: 0 };
const box = { at: [0, 0, 0], q: [1, 0, 0, 0], half: [20, 20, 20], rounding: 0 };
const replayData = (turns) => ({
  algorithm: "base", task: "T3", shared: [0], floor: -20, hip_radius: 5, start_s: 1, step_s: 0.01,
  count: 3,
  bodies: [
    { name: "cube", movable: true, turns, parts: [box], at: [0, 0, 0], q: [1, 0, 0, 0] },
    { name: "post", movable: false, turns: false, at: [99, 0, 0], q: [1, 0, 0, 0],
      parts: [{ ...box, half: [0, 0, 0], rounding: 7 }, { ...box, half: [9, 0, 0], rounding: 4 }] },
  ],
  sides: [
    { name: "L", hand: still, force: { x: 1.5, y: 0, z: 0 },
      bodies: [{ x: packed([0, 1, 2], 0.5), y: 0, z: 0 }] },
    { name: "peer 7", hand: still, force: still,
      bodies: [{ x: packed([0, -1, -3], 0.5), y: 0, z: 0, qw: 0, qx: 0, qy: 0, qz: 2 }] },
  ],
});

test("a replay unpacks its columns and tells how far the copies are apart", () => {
  const replay = new Replay(replayData(false));
  assert.equal(replay.timeAt(2), 1.02);
  assert.deepEqual([0, 1, 2].map((row) => replay.apartAt(row).millimetres), [0, 2, 5]);
  assert.equal(replay.apartAt(2).degrees, 0, "a body that cannot turn has its first orientation");
  assert.deepEqual(replay.sidesAt(1).get(1).bodies.get(0).at, [-1, 0, 0]);
});

test("a body that turns has an orientation of length 1, and an angle to the other copy", () => {
  const replay = new Replay(replayData(true));
  assert.deepEqual(replay.sidesAt(0).get(1).bodies.get(0).turn, [0, 0, 0, 1]);
  assert.ok(Math.abs(replay.apartAt(0).degrees - 180) < 1e-9);
});

test("the painters of the live page take what a replay gives", () => {
  const replay = new Replay(replayData(false));
  const { solids, hands } = pictureOf(replay.scene, replay.sidesAt(2), 0);
  assert.deepEqual(solids.map((solid) => [solid.shape, solid.look]), [
    ["box", "cube"], ["sphere", "static-cube"], ["capsule", "static-cube"], ["box", "ghost"],
  ]);
  assert.deepEqual(solids[2].half, [13, 4, 4]);
  assert.deepEqual(solids[3].at, [-3, 0, 0]);
  assert.deepEqual(hands.map((hand) => hand.look), ["ghost", "hand"]);
  assert.deepEqual(hands[1].force, [1.5, 0, 0]);
});
