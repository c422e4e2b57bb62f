// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A pane for each peer with its world in it, painted by whichever painter there is, and labels
// over bodies that must be told apart, each with its colour.

import { byId, make, say } from "./dom.js";
import { colourOfAlgorithm } from "./paint/palette.js";
import { pictureOf } from "./paint/picture.js";
import { makePane } from "./pane.js";
import { isOver } from "./status.js";
import { spoken } from "./units.js";

const states = {
  waiting: "waiting for the other peer", countdown: "about to begin", running: "running",
  hands_off: "hands off", alone: "alone", ended: "ended", calibrating: "not calibrated",
  emergency_stop: "emergency stop", fault: "fault",
};

/** "simulated Omni" of "sim: simulated Omni (held by ...)", which the tooltip has as a whole. */
const shortDevice = (device) => (device ?? "").replace(/^\w+: /, "").replace(/ \(.*$/, "");

const [lineHigh, roomAbove, least] = [18, 6, 2]; // pixels

/** The middle of a label's foot: in the view, and over none of the others. */
const placed = (half, { left, top }, view, others) => {
  const x = Math.min(Math.max(left, half + least), Math.max(half, view.clientWidth - half - least));
  let y = Math.min(Math.max(top - roomAbove, lineHigh), view.clientHeight - least);
  const lies = (one) => Math.abs(one.x - x) < one.half + half && Math.abs(one.y - y) < lineHigh;
  const step = y > (others.length + 1) * lineHigh ? -lineHigh : lineHigh;
  while (others.some(lies)) y += step;
  return { x, y, half };
};

/** Shows `names` {name, tint} at `places` {left, top} of the view. */
const showNames = (view, names, places) => {
  const labels = [...view.querySelectorAll(":scope > .name")];
  while (labels.length > names.length) labels.pop().remove();
  while (labels.length < names.length) {
    labels.push(view.appendChild(make("span", { class: "name", "aria-hidden": "true" })));
  }
  const boxes = [];
  names.forEach(({ name, tint }, i) => {
    const label = labels[i];
    if (label.textContent !== name) {
      say(label, name);
      label.style.setProperty("--tint", `var(--${tint})`);
      label.half = label.offsetWidth / 2; // measured once: it costs a layout
    }
    const box = placed(label.half, places[i], view, boxes);
    boxes.push(box);
    label.style.transform = `translate(${box.x - box.half}px, ${box.y - lineHigh}px)`;
  });
};

const paneOf = (peer, place, orbit) => {
  const state = make("span", { class: "state" });
  const { root, view, figures } = makePane(
    { id: peer.id, place, letter: peer.letter, who: `${peer.letter}'s world` },
    [make("span", { class: "device", title: peer.device }, shortDevice(peer.device)), state],
    ["force", "cube x", "tick late"],
    orbit,
  );
  const [force, cube, late] = figures;
  return { root, view, parts: { state, force, place: cube, late } };
};

export class Worlds {
  #panes = [];
  #signature = "";
  #dirty = true;
  painter = null;
  painted = 0; // pictures

  constructor(container, model, orbit) {
    Object.assign(this, { container, model, orbit });
    for (const name of ["frame", "state", "look", "clear"]) {
      model.addEventListener(name, () => { this.#dirty = true; });
    }
    orbit.addEventListener("change", () => { this.#dirty = true; });
    new ResizeObserver(() => { this.#dirty = true; }).observe(container);
    matchMedia("(prefers-color-scheme: dark)")
      .addEventListener("change", () => { this.#dirty = true; });
  }

  #arrange() {
    const { peers } = this.model;
    const signature = peers.map((peer) => `${peer.id} ${peer.letter} ${peer.device}`).join();
    if (signature === this.#signature) return;
    this.#signature = signature;
    this.#panes.forEach((pane) => pane.root.remove());
    this.#panes = peers.map((peer, place) => paneOf(peer, place, this.orbit));
    this.container.append(...this.#panes.map((pane) => pane.root));
    this.container.dataset.count = String(peers.length);
  }

  /** Paints what has changed since the last call. */
  paint() {
    if (!this.#dirty || !this.painter) return;
    this.#dirty = false;
    this.#arrange();
    const sides = this.model.moment?.sides ?? new Map();
    const { peers } = this.model;
    const views = this.#panes.map(({ view }, place) => {
      const scene = this.model.sceneOf(place);
      const picture = pictureOf(scene, sides, peers[place].id);
      const name = (places) => showNames(view, picture.names, places);
      return { pane: view, scene, picture, name };
    });
    this.painter.paint(views, this.orbit);
    this.painted += 1;
  }

  /** The other algorithms whose copies are seen through, with their colours. */
  #tellOthers() {
    const others = (this.model.frame?.emulator?.others ?? []).map(({ algorithm }) => algorithm);
    const place = byId("others-legend");
    if (place.dataset.names === others.join()) return;
    place.dataset.names = others.join();
    const nameOf = (name) => {
      const swatch = make("span", { class: "swatch box", "aria-hidden": "true" });
      swatch.style.color = `var(--${colourOfAlgorithm(name)})`;
      return make("span", { class: "other" }, swatch, " ", name);
    };
    place.replaceChildren(...(others.length === 0 ? []
      : ["Coloured: its copy with another algorithm under the same network: ",
        ...others.map(nameOf)]));
  }

  /**
   * Figures as text, a few times a second: more could not be read. The two worlds of the pair
   * `farthest` tell the positions that its distance is of.
   */
  describe(farthest) {
    this.#arrange();
    this.#tellOthers();
    this.#panes.forEach(({ root, parts }, place) => {
      const peer = this.model.peers[place];
      const side = this.model.moment?.sides.get(peer.id);
      const scene = this.model.sceneOf(place);
      const cube = side?.bodies.get(scene.shared);
      const { lookingAt, fine } = this.model;
      const late = fine.summary(`peer_late_us:${peer.id}`, 1, lookingAt ?? undefined);
      root.classList.toggle("away", !peer.attached);
      const state = states[peer.state] ?? peer.state ?? "";
      const away = isOver(this.model.state) ? states.ended : "not attached";
      const isOther = say(parts.state, peer.attached ? state : away);
      say(parts.force, side?.force ? `${Math.hypot(...side.force).toFixed(2)} N` : "–");
      const compared = farthest ? [farthest.a, farthest.b].indexOf(peer.id) : -1;
      const x = compared < 0 ? cube?.at[0] : farthest.x[compared];
      say(parts.place, x === undefined ? "–" : `${x.toFixed(1)} mm`);
      say(parts.late, late ? `${spoken(late.most, 0)} µs` : "–");
      if (isOther) this.#dirty = true; // a longer text may move the view that it stands over
    });
  }
}
