// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sentences for viewers: how far apart the copies are and why, and whether a session under these
// conditions is usable by the convention of scripts/criteria/paper.toml.

import { askedDelay, conditionsOf } from "./rows.js";
import { isOver } from "./status.js";
import { spoken } from "./units.js";

export const delayUsable = 160; // ms one way: stiffness of `base` is calibrated to end there
export const vibrationUsable = 1.05; // mm RMS above 20 Hz, by a high-pass of first order
const timeConstant = 1 / (2 * Math.PI * 20); // s, of that high-pass
const window = 2; // s

/** RMS above 20 Hz of each side's x in mm, from the frames: 60 a second see part of it. */
const rmsOf = (moments, id) => {
  let [last, high, sum, count] = [null, 0, 0, 0];
  for (const { at, sides } of moments) {
    const x = sides.get(id)?.bodies.values().next().value?.at[0];
    if (x === undefined) continue;
    if (last !== null && at > last.at) {
      high = ((high + x - last.x) * timeConstant) / (timeConstant + at - last.at);
      sum += high * high;
      count += 1;
    }
    last = { at, x };
  }
  return count > 20 ? Math.sqrt(sum / count) : null;
};

/** The vibration that the network adds to the worse side, mm; null while too little is known. */
export const vibrationOf = (moments, a, b) => {
  const newest = moments.at(-1)?.at ?? 0;
  const recent = moments.slice(moments.findIndex((moment) => moment.at > newest - window));
  const [one, other] = [rmsOf(recent, a), rmsOf(recent, b)];
  return one === null || other === null ? null : Math.sqrt(Math.abs(one * one - other * other));
};

/** The largest mean delay that any direction is asked for, ms. */
export const worstAskedDelay = (model) =>
  Math.max(
    0,
    ...model.paths.flatMap((path) =>
      ["up", "down"].map((way) => askedDelay(conditionsOf(model.conditions, path, way))[0] ?? 0),
    ),
  );

/** {tier, says}: what the convention says of the present conditions. */
export const verdictOf = (model) => {
  if (model.lookingAt !== null) return { tier: "none", says: "no verdict on the past" };
  const pairs = model.frame?.pairs ?? [];
  if (pairs.every((pair) => pair.apart_mm === null)) {
    const says = isOver(model.state) ? "no verdict after the end" : "no verdict yet";
    return { tier: "none", says };
  }
  const delay = worstAskedDelay(model);
  const algorithm = model.peers[0]?.algorithm;
  if (algorithm === "base" && delay > delayUsable) {
    return {
      tier: "unusable",
      says: `beyond the paper's limits: at ${spoken(delay, 0)} ms the cube feels too soft`,
    };
  }
  const [{ a, b, vibration_mm: said }] = pairs;
  const vibration = said ?? vibrationOf(model.moments, a, b);
  if (vibration !== null && vibration > vibrationUsable) {
    const about = said === undefined ? "about " : "";
    return {
      tier: "unusable",
      says:
        "beyond the paper's limits: the cube vibrates by " +
        `${about}${spoken(vibration)} mm`,
    };
  }
  return { tier: "usable", says: "within the paper's limits" };
};

const letterOf = (model, id) => model.peers.find((peer) => peer.id === id)?.letter ?? String(id);

/** To a tenth, as it is shown. */
const tenths = (mm) => Math.round(10 * mm) / 10 + 0; // never -0

/**
 * The pair that is farthest apart in the moment that is shown: {a, b, x, apart, mean}, in mm; null
 * where no positions are known. `x` are the two positions as they are shown, `apart` is their
 * difference, and `mean` that of the 0.4 s before.
 */
export const farthestOf = (model) => {
  const { moment } = model;
  const pairs = (moment?.pairs ?? []).map((pair) => {
    const x = pair.x.map(tenths);
    return { ...pair, x, apart: tenths(Math.abs(x[0] - x[1])) };
  });
  const farthest = pairs.sort((one, other) => other.apart - one.apart)[0];
  if (!farthest) return null;
  const { a, b } = farthest;
  const mean = model.fine.summary(`apart_mm:${a}-${b}`, 0.4, moment.at)?.mean ?? null;
  return { ...farthest, mean };
};

/** One sentence about that pair. */
export const sentenceOf = (model, farthest) => {
  if (farthest === null) return "";
  const { apart, x, uncertainty_ms: doubt } = farthest;
  const [a, b] = [letterOf(model, farthest.a), letterOf(model, farthest.b)];
  const places = `${a}'s cube is at x = ${x[0].toFixed(1)} mm, ${b}'s at ${x[1].toFixed(1)} mm`;
  const clocks = doubt > 1 ? ` The clocks are known to ± ${spoken(doubt)} ms.` : "";
  const { moment } = model;
  const speed = moment.sides.get(farthest.a)?.speed ?? 0; // m/s, and so mm/ms
  const delay = model.fine.summary(`heard_delay_ms:${farthest.b}`, 1, moment.at)?.mean;
  const explains = apart >= 1 && delay > 20 && Math.abs(apart - speed * delay) < 0.35 * apart;
  return explains
    ? `${places}: about where ${a}'s was ${spoken(delay, 0)} ms ago.${clocks}`
    : `${places}.${clocks}`;
};

/** The pair and its mean, small below the sentence. */
export const meanOf = (model, farthest) => {
  if (farthest === null || farthest.mean === null) return "";
  const [a, b] = [letterOf(model, farthest.a), letterOf(model, farthest.b)];
  return `Mean distance of ${a} and ${b} in the last 0.4 s: ${farthest.mean.toFixed(1)} mm.`;
};
