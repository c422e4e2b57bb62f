// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The wire between two worlds: a cell for each frame and direction, filled by the fate of its
// datagrams. Up runs from A to the right, down from B to the left; the newest is at its sender.

import { make, say } from "./dom.js";
import { onColours, readColours } from "./paint/palette.js";
import { spoken } from "./units.js";

const cellWidth = 5;
const causes = [
  [/^(random|block|periodic|listed|pattern|trace)_?loss$|^outage$/, "missed"],
  [/^(burst_loss|gilbert_elliott|four_state)$/, "dead-reckoning"],
  [/^(rate_|queue_)/, "other"],
];
const colourOfCause = (cause) => causes.find(([names]) => names.test(cause))?.[1] ?? "muted";

const laneOf = (way, from, to) => {
  const canvas = make("canvas", { class: "lane", "aria-hidden": "true" });
  const words = make("span", { class: "words" });
  const root = make(
    "div",
    { class: `wire ${way}` },
    make("span", { class: "end" }, way === "up" ? from : `◂ ${from}`),
    canvas,
    make("span", { class: "end" }, way === "up" ? `▸ ${to}` : to),
    words,
  );
  return { way, root, canvas, words, cells: [] };
};

export class Lamps {
  constructor(container, model) {
    Object.assign(this, { container, model, path: null, colours: readColours(), calm: false });
    const still = matchMedia("(prefers-reduced-motion: reduce)");
    this.calm = still.matches;
    still.addEventListener("change", () => {
      this.calm = still.matches;
    });
    onColours(() => {
      this.colours = readColours();
    });
    model.addEventListener("frame", ({ detail }) => this.#take(detail));
    model.addEventListener("clear", () =>
      this.lanes?.forEach((lane) => {
        lane.cells = [];
      }),
    );
    this.drawn = 0;
  }

  /** Shows that path; its ends are the letters of the peers it joins. */
  show(path, [a, b]) {
    if (path === this.path && this.ends === a + b) return;
    Object.assign(this, { path, ends: a + b });
    this.lanes = [laneOf("up", a, b), laneOf("down", a, b)];
    this.container.replaceChildren(...this.lanes.map((lane) => lane.root));
  }

  #take(frame) {
    const found = frame.emulator?.paths?.find((path) => path.name === this.path);
    if (!found || !this.lanes || frame.emulator.repeated) return;
    for (const lane of this.lanes) {
      lane.cells.unshift({ ...found[lane.way] });
      lane.cells.length = Math.min(lane.cells.length, 400);
    }
  }

  #draw(lane) {
    const { canvas } = lane;
    const ratio = Math.min(2, devicePixelRatio);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio)) {
      Object.assign(canvas, {
        width: Math.round(width * ratio),
        height: Math.round(height * ratio),
      });
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const count = Math.floor(width / cellWidth);
    lane.cells.slice(0, count).forEach((cell, i) => {
      const x = lane.way === "up" ? i * cellWidth : width - (i + 1) * cellWidth;
      const dropped = Object.entries(cell.dropped ?? {});
      const lost = dropped.reduce((sum, [, number]) => sum + number, 0);
      const whole = Math.max(1, (cell.delivered ?? 0) + lost);
      let y = 0;
      const bar = (share, colour) => {
        context.fillStyle = this.colours[colour];
        context.fillRect(x, y, cellWidth - 1, share * height);
        y += share * height;
      };
      context.globalAlpha = 1 - 0.55 * (i / count);
      dropped.forEach(([cause, number]) => bar(number / whole, colourOfCause(cause)));
      if (cell.delivered > 0) bar(cell.delivered / whole, lane.way === "up" ? "left" : "right");
    });
    context.globalAlpha = 1;
  }

  draw(now) {
    if (!this.lanes || now - this.drawn < (this.calm ? 1000 : 33)) return;
    this.drawn = now;
    this.lanes.forEach((lane) => this.#draw(lane));
  }

  describe() {
    for (const lane of this.lanes ?? []) {
      const loss = this.model.fine.summary(`${lane.way}.loss:${this.path}`, 0.3)?.mean;
      const delay = this.model.fine.summary(`${lane.way}.delay_ms:${this.path}`, 1)?.mean;
      const flying = lane.cells[0]?.in_flight;
      say(
        lane.words,
        delay === undefined && loss === undefined
          ? "nothing passes"
          : `${spoken(delay)} ms · ${spoken(loss)} % lost · ${spoken(flying, 0)} in flight`,
      );
    }
  }
}
