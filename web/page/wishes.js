// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sends settings to the emulator: at most ten requests a second, of each key the newest wish.

import { post } from "./api.js";
import { spoken } from "./units.js";

const apartMs = 110;

export class Wishes {
  #wanted = new Map(); // key -> {value, done}
  #timer = null;
  #sent = -Infinity;

  /** `tell(text, isError)` shows how it went, `lasts()` gives the text of `for`, or null. */
  constructor(tell, lasts) { Object.assign(this, { tell, lasts }); }

  /** Asks for settings {key: text}; `done` is called when they are answered. */
  ask(settings, done = () => {}) {
    for (const [key, value] of Object.entries(settings)) {
      this.#wanted.get(key)?.done();
      this.#wanted.set(key, { value, done });
    }
    this.#later();
  }

  #later() {
    if (this.#timer !== null) return;
    const wait = Math.max(0, this.#sent + apartMs - performance.now());
    this.#timer = setTimeout(() => this.#send(), wait);
  }

  async #send() {
    const wanted = this.#wanted;
    this.#wanted = new Map();
    this.#sent = performance.now();
    const settings = Object.fromEntries([...wanted].map(([key, { value }]) => [key, value]));
    const request = { command: "set", settings };
    const lasts = this.lasts();
    if (lasts) request.for = lasts;
    try {
      this.tell(effectOf(settings, await post("/api/emulator", request), this.#sent), false);
    } catch (error) {
      this.tell(error.message, true);
    }
    this.#timer = null;
    wanted.forEach(({ done }, key) => { if (!this.#wanted.has(key)) done(); });
    if (this.#wanted.size > 0) this.#later();
  }
}

/** From when a change holds, by the reply's own words. */
export const effectOf = (settings, reply, sentMs) => {
  const what = Object.entries(settings).map(([key, value]) => `${key} ${value}`).join(", ");
  const at = reply.effective_at ?? {};
  const numbers = at.up !== undefined ? at : Object.values(at)[0] ?? {};
  const from = numbers.up === undefined ? ""
    : ` from datagram ${spoken(numbers.up, 0)} of A → B and `
      + `${spoken(numbers.down, 0)} of B → A`;
  const took = performance.now() - sentMs;
  const held = reply.changed === false ? "held already" : `generation ${reply.generation}`;
  return `${what}:${from}${from ? "," : ""} ${held}, answered in ${spoken(took, 1)} ms`;
};
