// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Rows of figures for the charts, from live frames and from the history that the server sends.

import { delayOf, jitterOf, lossOf } from "./units.js";

const band = (figure) => (figure ? [figure.mean, figure.min, figure.max] : NaN);
const sum = (counts) => Object.values(counts ?? {}).reduce((total, count) => total + count, 0);

/** What stands in front of a setting of one direction: "up.", "wan.up."; a link between two peers
 * is called as its ways are: "1-2." is from 1 to 2, "2-1." the way back. */
export const prefixOf = (path, direction) => {
  const pair = /^([0-9]+)-([0-9]+)$/.exec(path);
  if (pair) return direction === "up" ? `${path}.` : `${pair[2]}-${pair[1]}.`;
  return path === "" ? `${direction}.` : `${path}.${direction}.`;
};

/** The conditions of one direction by key, of `state.emulator.conditions`. */
export const conditionsOf = (conditions, path, direction) => {
  const prefix = prefixOf(path, direction);
  const found = {};
  for (const [key, value] of Object.entries(conditions ?? {})) {
    if (key.startsWith(prefix)) found[key.slice(prefix.length)] = value;
  }
  return found;
};

/** The delay that was asked for, as [mean, least, most] in ms; NaN where it is not plain. */
export const askedDelay = (conditions) => {
  const delay = delayOf(conditions.delay);
  const jitter = jitterOf(conditions.jitter ?? "0ms");
  const mean = delay.mean + jitter.mean;
  const spread = delay.spread + jitter.spread;
  return [mean, Math.max(0, mean - spread), mean + spread];
};

/** How far the longest of the delays asked for is from the shortest, in ms. */
export const askedSpread = (conditions) => {
  const [, least, most] = askedDelay(conditions);
  return most - least;
};

/**
 * Keeps the last second of each direction, for shares and spreads that one frame cannot show. The
 * spread is that of one setting: what was sent under an earlier one does not count once the last of
 * it can have arrived.
 */
export class RowMaker {
  constructor() {
    this.recent = new Map();
    this.settings = new Map();
  }

  clear() {
    this.recent.clear();
    this.settings.clear();
  }

  /** The time from which all delays are of the newest setting of a direction. */
  #settled(name, at, asked) {
    const setting = `${asked.delay} ${asked.jitter}`;
    const longest = askedDelay(asked)[2];
    const before = this.settings.get(name);
    if (before?.setting === setting) return before.from;
    const rest = Number.isFinite(before?.longest) ? before.longest / 1000 : 0;
    const from = before ? at + rest : -Infinity;
    this.settings.set(name, { setting, longest, from });
    return from;
  }

  #lastSecond(name, at, direction, asked) {
    const recent = this.recent.get(name) ?? [];
    this.recent.set(name, recent);
    const from = this.#settled(name, at, asked);
    recent.push({
      at,
      received: direction.received,
      dropped: sum(direction.dropped),
      least: direction.delay_ms?.min ?? NaN,
      most: direction.delay_ms?.max ?? NaN,
    });
    while (recent[0].at < at - 1) recent.shift();
    const received = recent.reduce((total, one) => total + one.received, 0);
    const dropped = recent.reduce((total, one) => total + one.dropped, 0);
    const delays = recent.filter((one) => one.most >= 0 && (at < from || one.at >= from));
    const spread =
      Math.max(...delays.map((one) => one.most)) - Math.min(...delays.map((one) => one.least));
    return {
      loss: received > 0 ? (100 * dropped) / received : NaN,
      spread: delays.length > 0 ? spread : NaN,
    };
  }

  /** One row of {name: value or [value, least, most]}, named as the history's columns. */
  rowOf(frame, conditions) {
    const row = {};
    for (const pair of frame.pairs ?? []) row[`apart_mm:${pair.a}-${pair.b}`] = pair.apart_mm;
    for (const peer of frame.peers ?? []) {
      if (!peer || peer.repeated) continue;
      row[`force_n:${peer.peer}`] = peer.force_n?.max;
      row[`peer_late_us:${peer.peer}`] = peer.late_us?.max;
      row[`heard_delay_ms:${peer.peer}`] = band(peer.heard?.[0]?.delay_ms);
    }
    if (!frame.emulator || frame.emulator.repeated) return row;
    for (const one of frame.emulator.others ?? []) row[`other_mm:${one.algorithm}`] = one.apart_mm;
    for (const path of frame.emulator.paths ?? []) {
      for (const way of ["up", "down"]) {
        const direction = path[way];
        if (!direction) continue;
        const asked = conditionsOf(conditions, path.name, way);
        const { loss, spread } =
          this.#lastSecond(`${way}:${path.name}`, frame.at_s, direction, asked);
        row[`${way}.delay_ms:${path.name}`] = band(direction.delay_ms);
        row[`${way}.asked_ms:${path.name}`] = askedDelay(asked);
        row[`${way}.loss:${path.name}`] = loss;
        row[`${way}.asked_loss:${path.name}`] = lossOf(asked.loss);
        row[`${way}.spread_ms:${path.name}`] = spread;
        row[`${way}.asked_spread_ms:${path.name}`] = askedSpread(asked);
        row[`${way}.late_us:${path.name}`] = direction.late_us?.max;
      }
    }
    return row;
  }
}

/** The rows of a history message as [time, row]; shares of drops become losses over a second. */
export const rowsOfHistory = ({ columns, rows }) => {
  const drops = new Map();
  const meanOf = (name, at, share) => {
    const recent = drops.get(name) ?? [];
    drops.set(name, recent);
    if (share !== null) recent.push({ at, share });
    while (recent.length > 0 && recent[0].at < at - 1) recent.shift();
    return recent.length > 0
      ? (100 * recent.reduce((total, one) => total + one.share, 0)) / recent.length
      : null;
  };
  return rows.map((cells) => {
    const row = {};
    columns.forEach((name, i) => {
      if (i === 0 || cells[i] === null) return;
      const dropped = /^(up|down)\.dropped:(.*)$/.exec(name);
      const cell = cells[i];
      if (!dropped) row[name] = Array.isArray(cell) ? [(cell[0] + cell[1]) / 2, ...cell] : cell;
      else if (!Array.isArray(cell))
        row[`${dropped[1]}.loss:${dropped[2]}`] = meanOf(name, cells[0], cell);
      else {
        const percent = cell.map((share) => 100 * share);
        row[`${dropped[1]}.loss:${dropped[2]}`] = [(percent[0] + percent[1]) / 2, ...percent];
      }
    });
    return [cells[0], row];
  });
};
