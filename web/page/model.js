// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The page's data: the server's state, the frames of the last minutes, and figures over time.
// It decides nothing by itself: every value is one that the server sent.

import { Columns } from "./columns.js";
import { momentOf } from "./moment.js";
import { RowMaker, rowsOfHistory } from "./rows.js";
import { sceneOf } from "./scene.js";

const fineSeconds = 120;
const coarseSeconds = 1200;
const framesPerCoarseRow = 8;

/** Joins rows to one with the least and the most of each figure. */
const joined = (rows) => {
  const one = {};
  for (const row of rows) {
    for (const [name, cell] of Object.entries(row)) {
      const [value, least, most] = Array.isArray(cell) ? cell : [cell, cell, cell];
      if (!Number.isFinite(value)) continue;
      const had = one[name] ?? [value, least, most];
      one[name] = [value, Math.min(had[1], least), Math.max(had[2], most)];
    }
  }
  return one;
};

/** Sides and pairs that a moment does not know stay as they were in the one before. */
const keepMissing = (moment, before) => {
  for (const [id, side] of before?.sides ?? []) {
    if (!moment.sides.has(id)) moment.sides.set(id, side);
  }
  const isKnown = (pair) => moment.pairs.some(({ a, b }) => a === pair.a && b === pair.b);
  moment.pairs.push(...(before?.pairs ?? []).filter((pair) => !isKnown(pair)));
};

export class Model extends EventTarget {
  state = null;
  frame = null;
  scenes = [sceneOf(null)];
  moments = [];
  events = [];
  fine = new Columns(fineSeconds, 8000);
  coarse = new Columns(coarseSeconds, 10000);
  lookingAt = null; // null: now; else the time that the worlds show
  #rows = new RowMaker();
  #waiting = [];

  #say(name, detail) { this.dispatchEvent(new CustomEvent(name, { detail })); }

  hello(message) {
    this.version = message.version;
    this.clear();
    this.events = [];
    this.setState(message.state);
    for (const event of message.state.events ?? []) this.addEvent(event);
  }

  clear() {
    this.fine.clear();
    this.coarse.clear();
    this.#rows.clear();
    this.#waiting = [];
    this.moments = [];
    this.lookingAt = null;
    this.#say("clear");
  }

  setState(state) {
    this.state = state;
    const scenes = (state.scenes ?? []).map(sceneOf);
    const hashes = (list) => list.map((scene) => scene.hash + scene.name).join();
    if (scenes.length > 0 && hashes(scenes) !== hashes(this.scenes)) this.scenes = scenes;
    this.#say("state", state);
  }

  addHistory(message) {
    for (const [time, row] of rowsOfHistory(message)) this.fine.push(time, row);
    this.#say("history");
  }

  /** The coarse history of 20 minutes, put in front of what came since. */
  addCoarseHistory(message) {
    if (message.columns.length < 2) return;
    const coarse = new Columns(coarseSeconds, 10000);
    for (const [time, row] of rowsOfHistory(message)) coarse.push(time, row);
    this.coarse = coarse;
    this.#say("history");
  }

  addFrame(frame) {
    this.frame = frame;
    frame.received_ms = performance.now();
    const row = this.#rows.rowOf(frame, this.state?.emulator?.conditions);
    this.fine.push(frame.at_s, row);
    this.#waiting.push(row);
    if (this.#waiting.length === framesPerCoarseRow) {
      this.coarse.push(frame.at_s, joined(this.#waiting));
      this.#waiting = [];
    }
    const moment = momentOf(frame, this.peers, this.sceneOf(0).shared);
    // Between two sessions of a stage, and after the last, the worlds stay as they were.
    if (this.state?.stage?.available) keepMissing(moment, this.moments.at(-1));
    this.moments.push(moment);
    const oldest = frame.at_s - fineSeconds;
    while (this.moments.length > 1 && this.moments[0].at < oldest) this.moments.shift();
    this.#say("frame", frame);
  }

  addEvent(event) {
    if (this.events.some((one) => one.id === event.id)) return;
    this.events.push(event);
    if (this.events.length > 300) this.events.shift();
    this.#say("event", event);
  }

  get peers() { return this.state?.peers ?? []; }
  get paths() { return this.state?.emulator?.paths ?? []; }
  get conditions() { return this.state?.emulator?.conditions ?? {}; }

  /** The scene of the peer at that place. */
  sceneOf(place) { return this.scenes[this.peers[place]?.scene ?? 0] ?? this.scenes[0]; }

  /** What the worlds show: the newest moment, or the one that the viewer looks back at. */
  get moment() {
    if (this.lookingAt === null) return this.moments.at(-1) ?? null;
    const later = this.moments.findIndex((moment) => moment.at >= this.lookingAt);
    return later < 0 ? this.moments.at(-1) ?? null : this.moments[later];
  }

  lookAt(time) {
    this.lookingAt = time;
    this.#say("look", time);
  }
}
