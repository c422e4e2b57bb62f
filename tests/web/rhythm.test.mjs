// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The rhythm of drawing against simulated browsers: a picture of that cost delays the next turns.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Rhythm } from "../../web/page/rhythm.js";

const frameMs = 1000 / 60;

/**
 * Turns of a browser for so many seconds, from `begin`; a picture takes it `costOf(level)` ms.
 * {perSecond, idle, end}: pictures, the share of time in turns that came in time, and the time then.
 */
const browse = (rhythm, seconds, costOf, begin = 0) => {
  let [now, drawn, turns, inTime] = [begin, 0, 0, 0];
  while (now < begin + 1000 * seconds) {
    const draws = rhythm.turn(now);
    const passed = draws ? Math.max(frameMs, costOf(rhythm.level)) : frameMs;
    drawn += draws ? 1 : 0;
    turns += 1;
    inTime += passed < 25 ? passed : 0;
    now += passed;
  }
  return { perSecond: drawn / seconds, idle: inTime / (now - begin), end: now };
};

test("draws at every turn, at its best, where pictures are cheap", () => {
  const rhythm = new Rhythm();
  assert.equal(browse(rhythm, 10, () => 5).perSecond > 59, true);
  assert.equal(rhythm.level, 0);
});

test("lowers quality where pictures are dear, and no further than it must", () => {
  const changes = [];
  const rhythm = new Rhythm();
  rhythm.addEventListener("change", () => changes.push(rhythm.level));
  browse(rhythm, 10, (level) => [200, 15, 5][level]);
  assert.deepEqual(changes, [1]);
  const dear = new Rhythm();
  browse(dear, 10, () => 200);
  assert.equal(dear.level, dear.worst);
});

test("leaves the browser half of its time where even the cheapest pictures are dear", () => {
  for (const cost of [60, 120, 200]) {
    const { idle, perSecond } = browse(new Rhythm({ level: 2 }), 20, () => cost);
    assert.ok(idle > 0.3, `${cost} ms: ${idle}`);
    assert.ok(perSecond > 2, `${cost} ms: ${perSecond} pictures a second`);
  }
});

test("tries a better quality once pictures are cheap, and rarely where that fails", () => {
  const recovered = new Rhythm({ level: 2 });
  const { end } = browse(recovered, 5, () => 100);
  browse(recovered, 60, () => 5, end);
  assert.equal(recovered.level, 0);
  let trials = 0;
  const doomed = new Rhythm({ level: 2 });
  doomed.addEventListener("change", () => { trials += doomed.level === 1 ? 1 : 0; });
  browse(doomed, 300, (level) => [200, 100, 5][level]);
  assert.ok(trials > 0 && trials <= 5, `${trials} trials in 5 minutes`);
});

test("time at rest is not held against pictures", () => {
  const rhythm = new Rhythm();
  let end = 0;
  for (let i = 0; i < 30; i += 1) {
    ({ end } = browse(rhythm, 0.5, () => 5, end + 60_000));
    rhythm.rest();
  }
  assert.equal(rhythm.level, 0);
  assert.equal(rhythm.cost, 0);
});
