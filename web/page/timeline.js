// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The timeline: how far apart the copies were, and marks for what happened. Live, it looks back at
// the last minutes; in virtual time it goes anywhere.

import { post } from "./api.js";
import { announce, byId, say } from "./dom.js";
import { onColours, readColours } from "./paint/palette.js";

const liveSeconds = 120;
const colourOfKind = {
  conditions: "accent",
  stage: "sep",
  trap: "missed",
  keep: "missed",
  mark: "ink",
  peer: "right",
  emulator: "right",
  pace: "other",
};

export class Timeline {
  #drawn = 0;

  constructor(model, seek) {
    Object.assign(this, { model, seek, colours: readColours() });
    onColours(() => {
      this.colours = readColours();
    });
    this.canvas = byId("timeline-canvas");
    this.range = byId("timeline-range");
    this.range.addEventListener("input", () => this.#moved());
    byId("now").addEventListener("click", () => this.#backToNow());
    byId("mark").addEventListener("submit", (event) => {
      event.preventDefault();
      this.#mark(byId("mark-text"));
    });
  }

  get #span() {
    const { pace } = this.model.state ?? {};
    if (pace) return [0, pace.length_s];
    const newest = this.model.fine.newest || 0;
    return [newest - liveSeconds, newest];
  }

  #moved() {
    const [from, to] = this.#span;
    const time = from + (Number(this.range.value) / 1000) * (to - from);
    if (this.model.state?.pace) this.seek(time);
    else if (Number(this.range.value) >= 1000) this.#backToNow();
    else this.model.lookAt(time);
  }

  #backToNow() {
    this.range.value = "1000";
    this.model.lookAt(null);
  }

  async #mark(input) {
    const text = input.value.trim().slice(0, 80);
    if (text === "") return;
    try {
      await post("/api/mark", { text });
      input.value = "";
      announce(`Marked: ${text}`);
    } catch (error) {
      announce(error.message);
    }
  }

  #curve(context, from, to, width, height) {
    const name = [...this.model.fine.columns.keys()].find((key) => key.startsWith("apart_mm:"));
    if (!name) return;
    const {
      times,
      series: [apart],
    } = this.model.fine.sampled([name], from, to, width / 2);
    const most = Math.max(2, ...apart.most.filter((value) => value !== null)) * 1.1;
    context.beginPath();
    context.moveTo(((times[0] - from) / (to - from)) * width, height);
    times.forEach((time, i) =>
      context.lineTo(
        ((time - from) / (to - from)) * width,
        height - ((apart.most[i] ?? 0) / most) * (height - 10),
      ),
    );
    context.lineTo(((times.at(-1) - from) / (to - from)) * width, height);
    context.fillStyle = this.colours.accent;
    context.globalAlpha = 0.3;
    context.fill();
    context.globalAlpha = 1;
  }

  #marks(context, from, to, width, height) {
    for (const event of this.model.events) {
      if (event.at_s < from || event.at_s > to) continue;
      const x = ((event.at_s - from) / (to - from)) * width;
      context.fillStyle = this.colours[colourOfKind[event.kind] ?? "muted"];
      context.fillRect(x - 1, 0, 2, height);
      context.beginPath();
      context.arc(x, 5, 4, 0, 2 * Math.PI);
      context.fill();
    }
  }

  draw(now) {
    if (now - this.#drawn < 250) return;
    this.#drawn = now;
    const { canvas, model } = this;
    const [from, to] = this.#span;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const ratio = Math.min(2, devicePixelRatio);
    if (canvas.width !== Math.round(width * ratio)) {
      Object.assign(canvas, {
        width: Math.round(width * ratio),
        height: Math.round(height * ratio),
      });
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    if (to > from) {
      this.#curve(context, from, to, width, height);
      this.#marks(context, from, to, width, height);
    }
    const { pace } = model.state ?? {};
    const at = pace ? pace.at_s : model.lookingAt;
    if (at !== null && document.activeElement !== this.range) {
      this.range.value = String((1000 * (at - from)) / (to - from));
    }
    if (at !== null && !pace && at < from) model.lookAt(from);
    const back = model.lookingAt === null ? 0 : to - model.lookingAt;
    const words = pace
      ? `${at.toFixed(2)} s of ${to.toFixed(2)} s`
      : back > 0
        ? `${back.toFixed(1)} s ago`
        : "now";
    this.range.setAttribute("aria-valuetext", words);
    say(byId("timeline-at"), words);
    byId("now").hidden = Boolean(pace) || model.lookingAt === null;
  }
}
