// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Decides when to draw, and how well. Without a graphics card each picture delays the browser. Then
// the quality falls, and the browser gets as much time without a picture as one takes.

const onTimeMs = 25; // from turn to turn, at 60 Hz and a little late
const dearMs = 12; // a picture that delays the browser more gets worse quality
const cheapMs = 3;
const apartMsMax = 400; // between pictures, whatever they cost
const drawingsToJudge = 8;
const drawingsToTrust = 600; // 10 s at best
const drawingsMax = 20_000;

export class Rhythm extends EventTarget {
  #last = null; // time of the turn before
  #drawn = -Infinity;
  #late = 0; // of the turns since the last picture
  #cost = 0; // by how much a picture delays the browser, ms
  #judged = 0; // pictures since the quality was changed
  #trust = drawingsToTrust; // cheap pictures until a better quality is tried
  #isTrial = false; // the present quality

  /** 0 is the best quality, `worst` the cheapest; it begins with `level`. */
  constructor({ level = 0, worst = 2 } = {}) {
    super();
    Object.assign(this, { level, worst });
  }

  get cost() { return this.#cost; }

  /** Call it at each turn of the browser, with its time; true: draw now. */
  turn(now) {
    const passed = this.#last === null ? 0 : now - this.#last;
    this.#last = now;
    this.#late += Math.max(0, Math.min(passed, apartMsMax) - onTimeMs);
    const wait = Math.min(2 * this.#cost + onTimeMs, apartMsMax);
    if (this.#cost > cheapMs && now - this.#drawn < wait) return false;
    this.#judge();
    this.#drawn = now;
    this.#late = 0;
    return true;
  }

  /** The turns end here, as in a hidden tab; the next one is not late. */
  rest() { this.#last = null; }

  #judge() {
    this.#cost += 0.2 * (this.#late - this.#cost);
    this.#judged += 1;
    if (this.#cost > dearMs && this.#judged >= drawingsToJudge && this.level < this.worst) {
      // A quality that was too dear is tried less often.
      if (this.#isTrial) this.#trust = Math.min(2 * this.#trust, drawingsMax);
      this.#change(1);
    } else if (this.#cost < cheapMs && this.#judged >= this.#trust && this.level > 0) {
      this.#change(-1);
    }
  }

  #change(by) {
    this.level += by;
    this.#isTrial = by < 0;
    this.#judged = 0;
    this.#cost = 0; // judged anew
    this.dispatchEvent(new Event("change"));
  }
}
