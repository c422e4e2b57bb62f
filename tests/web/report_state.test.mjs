// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The state behind a report's player, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";

import { pictureOf } from "../../web/page/paint/picture.js";
import { Replay } from "../../web/page/report/replay.js";

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
