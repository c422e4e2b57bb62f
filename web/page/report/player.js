// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Plays what all sides of a session did: their worlds by the painters of the live page, and the
// place of one body in a chart, in which a click goes there.

import { fillSelect, make, say } from "../dom.js";
import { Chart } from "../figures/chart.js";
import { legendOf } from "../legend.js";
import { Orbit } from "../orbit.js";
import { colourOfPeer } from "../paint/palette.js";
import { pictureOf } from "../paint/picture.js";
import { length } from "../paint/vector.js";
import { painterFor } from "../painters.js";
import { makePane } from "../pane.js";
import { Rhythm } from "../rhythm.js";
import { Replay } from "./replay.js";

const stripPoints = 1500; // of a curve: finer than pixels
const thrown = 400; // mm: a body that flew off is cut

/** "A" of "A", "3" of "peer 3". */
const letterOf = (name) => name.split(" ").at(-1).slice(0, 2);

const speeds = [["0.1", "⅒"], ["0.25", "¼"], ["1", "1"], ["2", "2"], ["5", "5"]];

/** The elements that a player changes, by their classes. */
const partsOf = () => {
  const speed = make("select", { class: "speed" });
  fillSelect(speed, speeds, "1");
  return {
    algorithm: make("select", { class: "algorithm" }), task: make("select", { class: "task" }),
    play: make("button", { type: "button", class: "play", "aria-label": "play or stop" }, "▶"),
    time: make("input", {
      type: "range", class: "time", min: "0", value: "0", step: "1", "aria-label": "time",
    }),
    speed, clock: make("output", { class: "clock" }), apart: make("output", { class: "apart" }),
    worlds: make("div", { class: "worlds" }),
  };
};

export class Player {
  at = 0; // row, with a fraction
  #last = null; // time stamp of the frame before; null: stopped
  #asked = false; // the frame that will paint
  #hidden = new Set();

  constructor(root, data) {
    Object.assign(this, { root, data, parts: partsOf() });
    this.replays = data.map(() => null); // unpacked when first shown
    this.#build();
    this.orbit = new Orbit();
    this.chart = new Chart(this.stripArea, { group: "player", isLive: true });
    this.#listen();
  }

  #build() {
    const { algorithm, task, play, time, speed, clock, apart, worlds } = this.parts;
    this.stripArea = make("div", { class: "plot" });
    this.stripLegend = make("div", { class: "legend" });
    Object.assign(this.root, {
      tabIndex: 0, role: "group",
      ariaLabel: "Replay: space plays and stops, arrow keys step, Home and End go to the ends",
    });
    this.root.append(
      make("div", { class: "controls" }, make("label", {}, "algorithm ", algorithm),
        make("label", {}, "task ", task), play, time, make("label", {}, "speed ", speed)),
      make("p", { class: "numbers" }, clock, " ", apart), worlds,
      make("div", {
        class: "strip", role: "group",
        "aria-label": "x of a body in all copies over time; click to go there",
      }, this.stripArea, this.stripLegend));
  }

  get isPlaying() { return this.#last !== null; }

  async start() {
    this.painter = await painterFor(this.parts.worlds);
    this.rhythm = new Rhythm({ level: this.painter.level });
    this.rhythm.addEventListener("change", () => this.painter.setLevel(this.rhythm.level));
    const { algorithm } = this.parts;
    fillSelect(algorithm, [...new Set(this.data.map((one) => one.algorithm))]
      .map((name) => [name, name]));
    this.choose();
    this.goTo(0.2 * this.replay.count); // nothing happens at its beginning
    return this.painter.kind;
  }

  #listen() {
    const { algorithm, task, play, time } = this.parts;
    algorithm.addEventListener("change", () => this.choose());
    task.addEventListener("change", () => this.choose());
    play.addEventListener("click", () => this.toggle());
    time.addEventListener("input", () => this.goTo(Number(time.value)));
    this.stripArea.addEventListener("click", ({ clientX }) => {
      if (!this.chart.isDrawn) return;
      this.goTo((this.chart.valueAt(clientX) - this.replay.start) / this.replay.step);
    });
    this.root.addEventListener("keydown", (event) => this.#key(event));
    this.orbit.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.parts.worlds);
  }

  #key(event) {
    if (event.target !== this.root) return; // buttons, sliders and views have keys of their own
    const steps = (event.shiftKey ? 1 : 0.1) / this.replay.step;
    const actions = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.goTo(this.at - steps),
      ArrowRight: () => this.goTo(this.at + steps),
      Home: () => this.goTo(0),
      End: () => this.goTo(this.replay.count - 1),
    };
    if (!Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
  }

  /** Shows the replay that the two choices name. */
  choose() {
    const { algorithm, task, time, worlds } = this.parts;
    const wanted = this.data.flatMap((one, i) => (one.algorithm === algorithm.value ? [i] : []));
    fillSelect(task, wanted.map((i) => [this.data[i].task, this.data[i].task]));
    const chosen = wanted.find((i) => this.data[i].task === task.value);
    this.replays[chosen] ??= new Replay(this.data[chosen]);
    this.replay = this.replays[chosen];
    time.max = String(this.replay.count - 1);
    this.panes?.forEach((pane) => pane.root.remove());
    this.panes = this.replay.sides.map((side, place) => makePane(
      { id: place, place, letter: letterOf(side.name), who: `what ${side.name}’s computer holds` },
      [], ["force", "body x"], this.orbit,
    ));
    worlds.append(...this.panes.map((pane) => pane.root));
    worlds.dataset.count = String(this.panes.length);
    this.#setStrip();
    this.goTo(this.at);
  }

  /** x of one body in all copies. */
  #setStrip() {
    const { sides, count, farthest } = this.replay;
    const every = Math.max(1, Math.ceil(count / stripPoints));
    const rows = Array.from({ length: Math.ceil(count / every) }, (_, i) => i * every);
    const columns = sides.map((side) =>
      rows.map((row) => Math.min(thrown, Math.max(-thrown, side.bodies[farthest].x[row]))));
    this.strip = {
      times: rows.map((row) => this.replay.timeAt(row)),
      values: columns,
    };
    this.curves = sides.map((side, place) => ({
      name: side.name, label: `x at ${side.name}, mm`, colour: colourOfPeer(place),
    }));
    const all = columns.flat();
    const [low, high] = [Math.min, Math.max].map((pick) => all.reduce((a, b) => pick(a, b)));
    const room = high > low ? 0.04 * (high - low) : 1;
    this.range = [low - room, high + room];
    this.#hidden.clear();
    const { buttons, values } = legendOf(this.curves, this.#hidden, () => this.draw());
    this.stripValues = values;
    this.stripLegend.replaceChildren(...buttons);
  }

  goTo(row) {
    this.at = Math.min(Math.max(row, 0), this.replay.count - 1);
    this.draw();
  }

  toggle() {
    if (this.isPlaying) return this.#stop();
    if (this.at >= this.replay.count - 1) this.at = 0;
    this.#last = performance.now();
    this.parts.play.textContent = "❚❚";
    return this.draw();
  }

  #stop() {
    this.#last = null;
    this.rhythm.rest();
    this.parts.play.textContent = "▶";
  }

  /** Paints with the next frame of the browser. */
  draw() {
    if (this.#asked || !this.painter || !this.replay) return;
    this.#asked = true;
    requestAnimationFrame((now) => {
      this.#asked = false;
      if (this.isPlaying && !this.rhythm.turn(now)) return this.draw();
      this.#advance(now);
      this.#paint();
      if (this.isPlaying) this.draw();
    });
  }

  #advance(now) {
    if (!this.isPlaying) return;
    const seconds = Math.min(1, Math.max(0, now - this.#last) / 1000); // 1: a tab that was hidden
    this.at += (seconds / this.replay.step) * Number(this.parts.speed.value);
    this.#last = now;
    if (this.at < this.replay.count - 1) return;
    this.at = this.replay.count - 1;
    this.#stop();
  }

  #paint() {
    const { replay } = this;
    const row = Math.floor(this.at);
    const sides = replay.sidesAt(row);
    const views = this.panes.map(({ view }, place) =>
      ({ pane: view, scene: replay.scene, picture: pictureOf(replay.scene, sides, place) }));
    this.painter.paint(views, this.orbit);
    const drawn = replay.shared[replay.farthest];
    this.panes.forEach(({ figures }, place) => {
      const { force, bodies } = sides.get(place);
      const body = bodies.get(drawn);
      say(figures[0], `${length(force).toFixed(2)} N`);
      say(figures[1], body ? `${body.at[0].toFixed(1)} mm` : "–");
      say(this.stripValues[place], body ? body.at[0].toFixed(1) : "");
    });
    this.#tell(row);
    this.#paintStrip(row);
  }

  #tell(row) {
    const { time, clock, apart } = this.parts;
    const seconds = this.replay.timeAt(row);
    time.value = String(row);
    time.setAttribute("aria-valuetext", `${seconds.toFixed(1)} s`);
    const isOver = row >= this.replay.count - 1;
    say(clock, `t = ${seconds.toFixed(2)} s${isOver ? ": the hands let go, the replay ends" : ""}`);
    const { millimetres, degrees } = this.replay.apartAt(row);
    const turned = this.replay.turns ? `, ${degrees.toFixed(1)}°` : "";
    say(apart, `copies apart: ${millimetres.toFixed(1)} mm${turned}`);
  }

  #paintStrip(row) {
    const { times, values } = this.strip;
    const curves = this.curves.map((curve, i) => ({
      ...curve, x: times, y: values[i], width: 1.75, hidden: this.#hidden.has(curve.name),
    }));
    this.chart.update(curves, {
      x: [times[0], times.at(-1)], y: this.range, moment: this.replay.timeAt(row),
      says: (mark) => `${mark} s`,
    });
  }
}
