// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sentences about what one sees: how far apart the copies are and why, and whether a session under
// these conditions is usable by the convention of scripts/criteria/paper.toml.

import { askedDelay, conditionsOf } from "./rows.js";
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
  const pairs = model.frame?.pairs ?? [];
  if (pairs.every((pair) => pair.apart_mm === null))
    return { tier: "none", says: "no verdict yet" };
  const delay = worstAskedDelay(model);
  const algorithm = model.peers[0]?.algorithm;
  if (algorithm === "base" && delay > delayUsable) {
    return {
      tier: "unusable",
      says: `unusable by the paper's convention: at ${spoken(delay, 0)} ms the cube feels too soft`,
    };
  }
  const [{ a, b, vibration_mm: said }] = pairs;
  const vibration = said ?? vibrationOf(model.moments, a, b);
  if (vibration !== null && vibration > vibrationUsable) {
    const about = said === undefined ? "about " : "";
    return {
      tier: "unusable",
      says:
        "unusable by the paper's convention: the cube vibrates by " +
        `${about}${spoken(vibration)} mm`,
    };
  }
  return { tier: "usable", says: "usable by the paper's convention" };
};

const letterOf = (model, id) => model.peers.find((peer) => peer.id === id)?.letter ?? String(id);

/** The pair that is farthest apart and its mean of 0.4 s, mm: {pair, mean}; null of none. */
export const farthestOf = (model) => {
  const known = (model.frame?.pairs ?? []).filter((pair) => Number.isFinite(pair.apart_mm));
  const to = model.lookingAt ?? undefined;
  const means = known.map((pair) => ({
    pair,
    mean: model.fine.summary(`apart_mm:${pair.a}-${pair.b}`, 0.4, to)?.mean ?? pair.apart_mm,
  }));
  return means.sort((one, other) => other.mean - one.mean)[0] ?? null;
};

/** One sentence about that pair. */
export const sentenceOf = (model, farthest) => {
  if (farthest === null) return "";
  const { pair, mean } = farthest;
  const [a, b] = [letterOf(model, pair.a), letterOf(model, pair.b)];
  const doubt =
    pair.uncertainty_ms > 1 ? `, clocks known to ± ${spoken(pair.uncertainty_ms)} ms` : "";
  if (mean < 1)
    return `The cubes of ${a} and ${b} agree within ${spoken(Math.max(mean, 0.1))} mm${doubt}.`;
  const apart = `${b}'s cube is ${spoken(mean)} mm from ${a}'s`;
  const speed = model.moments.at(-1)?.sides.get(pair.a)?.speed ?? 0; // m/s, and so mm/ms
  const delay = model.fine.summary(`heard_delay_ms:${pair.b}`, 1)?.mean;
  const explains = delay > 20 && Math.abs(mean - speed * delay) < 0.35 * mean;
  return explains
    ? `${apart}: it is where ${a}'s was ${spoken(delay, 0)} ms ago${doubt}.`
    : `${apart}${doubt}.`;
};
