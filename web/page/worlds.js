// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A pane for each peer with its world in it, painted by whichever painter there is.

import { make, say } from "./dom.js";
import { pictureOf } from "./paint/picture.js";
import { makePane } from "./pane.js";
import { spoken } from "./units.js";

const states = {
  waiting: "waiting for the other peer", countdown: "about to begin", running: "running",
  hands_off: "hands off", alone: "alone", ended: "ended", calibrating: "not calibrated",
  emergency_stop: "emergency stop", fault: "fault",
};

const paneOf = (peer, place, orbit) => {
  const state = make("span", { class: "state" });
  const { root, view, figures } = makePane(
    { id: peer.id, place, letter: peer.letter, who: `${peer.letter}'s world` },
    [make("span", { class: "device" }, peer.device ?? ""), state],
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
      return { pane: view, scene, picture: pictureOf(scene, sides, peers[place].id) };
    });
    this.painter.paint(views, this.orbit);
    this.painted += 1;
  }

  /** Figures as text, a few times a second: more could not be read. */
  describe() {
    this.#arrange();
    this.#panes.forEach(({ root, parts }, place) => {
      const peer = this.model.peers[place];
      const side = this.model.moment?.sides.get(peer.id);
      const scene = this.model.sceneOf(place);
      const cube = side?.bodies.get(scene.shared);
      const { lookingAt, fine } = this.model;
      const late = fine.summary(`peer_late_us:${peer.id}`, 1, lookingAt ?? undefined);
      root.classList.toggle("away", !peer.attached);
      say(parts.state, peer.attached ? states[peer.state] ?? peer.state ?? "" : "not attached");
      say(parts.force, side?.force ? `${Math.hypot(...side.force).toFixed(2)} N` : "–");
      say(parts.place, cube ? `${cube.at[0].toFixed(1)} mm` : "–");
      say(parts.late, late ? `${spoken(late.most, 0)} µs` : "–");
    });
  }
}
