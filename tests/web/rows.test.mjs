// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The rows of the live page's charts, without a browser: what frames say beside what was asked.

import assert from "node:assert/strict";
import { test } from "node:test";

import { askedSpread, RowMaker } from "../../web/page/rows.js";

const frameS = 1 / 60;

/** A frame in which one direction passed datagrams of these delays, in ms. */
const frameOf = (at, least, most) => ({ at_s: at, emulator: { paths: [{ name: "",
  up: { received: 16, dropped: {}, delay_ms: { mean: (least + most) / 2, min: least, max: most } },
}] } });
const conditionsOf = (delay, jitter) => ({ "up.delay": `${delay}ms`, "up.jitter": `${jitter}ms` });

test("the spread that is asked for is that of the law of jitter", () => {
  assert.equal(askedSpread({ delay: "160ms", jitter: "15ms" }), 30);
  assert.equal(askedSpread({ delay: "160ms" }), 0);
  assert.equal(askedSpread({ delay: "5ms", jitter: "15ms" }), 20, "no delay is below nothing");
});

test("the spread of delay makes a step when jitter changes, up and down", () => {
  const maker = new RowMaker();
  const [delay, calm, wild] = [80, 2, 20];
  const jitterAt = (t) => (t < 3 || t >= 6 ? calm : wild);
  const measuredAt = (t) => jitterAt(t - delay / 1000); // what arrives was sent a delay ago
  const rows = [];
  for (let t = 0; t < 9; t += frameS) {
    const half = measuredAt(t);
    const row = maker.rowOf(frameOf(t, delay - half, delay + half), conditionsOf(delay, jitterAt(t)));
    rows.push({ t, asked: row["up.asked_spread_ms:"], measured: row["up.spread_ms:"] });
  }
  const between = (from, to) => rows.filter(({ t }) => t >= from && t < to);
  assert.ok(between(0, 3).every(({ asked, measured }) => asked === 4 && measured === 4));
  assert.ok(between(3.01, 6).every(({ asked }) => asked === 40), "asked at once");
  assert.ok(between(3.12, 6).every(({ measured }) => measured === 40), "and measured a delay later");
  assert.ok(between(6.01, 9).every(({ asked }) => asked === 4));
  const settled = 6 + (delay + wild) / 1000 + frameS;
  assert.ok(between(settled, 9).every(({ measured }) => measured === 4),
    "what was sent with the jitter before does not count for another second");
});

test("a change of the delay alone is no jitter, once the last datagram before it has come", () => {
  const maker = new RowMaker();
  const spreads = [];
  for (let t = 0; t < 4; t += frameS) {
    const arrives = t < 2.02 ? 20 : 100; // the first 100 ms take 100 ms, less those before them
    const row = maker.rowOf(frameOf(t, arrives, arrives), conditionsOf(t < 2 ? 20 : 100, 0));
    spreads.push([t, row["up.spread_ms:"]]);
  }
  assert.ok(spreads.filter(([t]) => t > 2.05).every(([, ms]) => ms === 0));
});
