// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Which part of the x axis is seen: state alone, in the coordinate in which the axis is even.

const leastShare = 1e-3; // of the whole: nearer no figure has more to show

export class Zoom extends EventTarget {
  /** `whole` is [low, high]; of a logarithmic axis `isLog`, and both above zero. */
  constructor(whole, isLog = false) {
    super();
    this.isLog = isLog;
    this.whole = whole.map((value) => this.#map(value));
    [this.from, this.to] = this.whole;
  }

  #map(value) { return this.isLog ? Math.log10(value) : value; }
  #back(at) { return this.isLog ? 10 ** at : at; }

  /** The ends that are seen, as values. */
  get range() { return [this.#back(this.from), this.#back(this.to)]; }
  get isWhole() { return this.from === this.whole[0] && this.to === this.whole[1]; }

  #set(from, to) {
    const [low, high] = this.whole;
    const span = Math.min(Math.max(to - from, leastShare * (high - low)), high - low);
    this.from = Math.min(Math.max(from, low), high - span);
    this.to = this.from + span;
    this.dispatchEvent(new Event("change"));
  }

  /** Shows what lies between two values, in either order. */
  show(a, b) {
    const ends = [this.#map(a), this.#map(b)];
    this.#set(Math.min(...ends), Math.max(...ends));
  }

  /** Shows `factor` times as much, about the middle. */
  scale(factor) {
    const middle = (this.from + this.to) / 2;
    const half = ((this.to - this.from) / 2) * factor;
    this.#set(middle - half, middle + half);
  }

  /** Goes on by this share of what is seen. */
  move(share) {
    const way = share * (this.to - this.from);
    this.#set(this.from + way, this.to + way);
  }

  reset() { this.#set(...this.whole); }

  /** What a key does; false: nothing. */
  key(name) {
    const actions = {
      "+": () => this.scale(0.5), "-": () => this.scale(2), 0: () => this.reset(),
      ArrowLeft: () => this.move(-0.25), ArrowRight: () => this.move(0.25),
    };
    if (!Object.hasOwn(actions, name)) return false;
    actions[name]();
    return true;
  }
}
