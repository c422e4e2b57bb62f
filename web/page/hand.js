// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The hand of A where a page may move it: by mouse, touch and keys on A's world. One page holds it
// at a time, and it may grip what it is near. The force is drawn by the painters, and told here as
// a number.

import { announce, make, say } from "./dom.js";
import { halfHeightOf } from "./paint/picture.js";

const againMs = 40; // the server releases a hand after 250 ms of silence
const reachMm = 250;
const keyMm = 2;
const wheelMm = 0.05; // per unit of the wheel
const fromAbove = 0.8; // rad: from there on the picture shows more of x and z than of x and y
const touchesN = 0.05;
const leastCosine = 0.4; // an axis that points at the viewer would outrun every pointer

const clamp = (value) => Math.min(reachMm, Math.max(-reachMm, value));
const moves = {
  ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0],
  PageUp: [0, 0, -1], PageDown: [0, 0, 1],
};

export class Hand {
  #root = null; // of the pane with the listeners
  #goal = null; // mm, while this page holds the hand or asks for it
  #timer = 0;
  #touches = false;
  #grips = false;

  /** `send` sends a message to the server. */
  constructor({ model, orbit, send }) {
    Object.assign(this, { model, orbit, send });
    this.button = make("button", { type: "button", "aria-pressed": "false" }, "Hold the hand");
    this.grip = make("button", { type: "button", "aria-pressed": "false",
      title: "hold what the hand is near, and carry it (key G)" }, "Grip");
    this.force = make("output", { id: "hand-force", "aria-live": "off" });
    this.says = make("span", { id: "hand-says", role: "status" });
    this.line = make("p", { id: "hand" }, this.button, this.grip, this.force, this.says);
    this.button.addEventListener("click", () => (this.#goal ? this.letGo() : this.hold()));
    this.grip.addEventListener("click", () => this.setGrip(!this.#grips));
    this.line.addEventListener("keydown", (event) => this.#key(event));
    globalThis.addEventListener("blur", () => this.letGo());
    globalThis.addEventListener("pagehide", () => this.letGo());
  }

  get #peer() {
    const { hand } = this.model.state ?? {};
    return this.model.peers.find((peer) => hand?.peer !== null && peer.id === hand?.peer);
  }

  get #side() { return this.model.moment?.sides.get(this.#peer?.id); }

  /** Where the hand is now, whatever moment the page looks back at. */
  get #hip() { return this.model.moments.at(-1)?.sides.get(this.#peer?.id)?.hip; }

  get isHeld() { return this.#goal !== null; }

  hold() {
    const hip = this.#hip;
    if (!hip || this.isHeld) return;
    this.#goal = hip.map(clamp);
    this.#timer = setInterval(() => this.#tell(), againMs);
    this.#tell();
    this.#show("");
  }

  letGo(says = "") {
    if (!this.isHeld) return;
    this.#goal = null;
    clearInterval(this.#timer);
    this.send({ hand: null });
    this.#show(says);
  }

  /** Whether the hand grips what it is near, while this page holds it. */
  setGrip(grips) {
    this.#grips = grips;
    this.grip.setAttribute("aria-pressed", String(grips));
    if (this.isHeld) this.#tell();
  }

  /**
   * The server's word: whether this page holds the hand. A refusal gives its reason. The answer to
   * letting go gives none, and may come when the page has taken the hand again.
   */
  told({ holds, says }) {
    if (holds || !says || !this.isHeld) return;
    this.letGo(says);
    announce(says);
  }

  #show(says) {
    this.button.setAttribute("aria-pressed", String(this.isHeld));
    say(this.button, this.isHeld ? "Let the hand go" : "Hold the hand");
    say(this.says, says);
  }

  #tell() {
    const [x, y, z] = this.#goal.map((value) => value / 1000);
    this.send({ hand: this.#grips ? { x, y, z, grip: true } : { x, y, z } });
  }

  /** By mm: right and up in the picture, and towards the user, the third axis of the view. */
  move([right, up, near]) {
    if (!this.isHeld) return;
    const isAbove = this.orbit.pitch > fromAbove;
    const by = isAbove ? [right, near, -up] : [right, up, near];
    this.#goal = this.#goal.map((value, axis) => clamp(value + by[axis]));
    this.#tell();
  }

  /** By pixels right and up, so that the hand stays under the pointer, as far as it is seen so. */
  #drag(view, right, up) {
    const { clientWidth: width, clientHeight: height } = view;
    const { pitch, yaw, zoom } = this.orbit;
    const scene = this.model.sceneOf(this.model.peers.indexOf(this.#peer));
    const mm = (2 * halfHeightOf(scene, width / height)) / height / zoom;
    const vertical = pitch > fromAbove ? Math.sin(pitch) : Math.cos(pitch);
    this.move([(right * mm) / Math.max(leastCosine, Math.abs(Math.cos(yaw))),
      (up * mm) / Math.max(leastCosine, Math.abs(vertical)), 0]);
  }

  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "Escape") this.letGo();
    if (event.key.toLowerCase() === "g") this.setGrip(!this.#grips);
    if (!Object.hasOwn(moves, event.key)) return;
    event.preventDefault();
    event.stopPropagation();
    this.hold();
    this.move(moves[event.key].map((way) => way * keyMm * (event.shiftKey ? 0.25 : 1)));
  }

  /** In place of the camera, which the other worlds turn; with Alt it turns here, too. */
  #listen(root) {
    const view = root.querySelector(".view");
    let last = null;
    const on = (name, act) =>
      view.addEventListener(name, act, { capture: true, passive: false });
    const isHere = () => this.#root === root;
    on("pointerdown", (event) => {
      if (!isHere() || event.altKey || event.button !== 0) return;
      event.stopImmediatePropagation();
      event.preventDefault();
      view.focus({ preventScroll: true });
      view.setPointerCapture(event.pointerId);
      last = { id: event.pointerId, x: event.clientX, y: event.clientY };
      this.hold();
    });
    on("pointermove", (event) => {
      if (last?.id !== event.pointerId) return;
      event.stopImmediatePropagation();
      this.#drag(view, event.clientX - last.x, last.y - event.clientY);
      last = { id: last.id, x: event.clientX, y: event.clientY };
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
      on(name, (event) => {
        if (last?.id !== event.pointerId) return;
        last = null;
        this.letGo();
      });
    }
    on("dblclick", (event) => { // two quick grasps do not reset the view
      if (isHere() && !event.altKey) event.stopImmediatePropagation();
    });
    on("wheel", (event) => {
      if (!this.isHeld || event.ctrlKey) return;
      event.stopImmediatePropagation();
      event.preventDefault();
      this.move([0, 0, event.deltaY * wheelMm]);
    });
    on("keydown", (event) => {
      if (!isHere()) return;
      if (Object.hasOwn(moves, event.key)) event.stopImmediatePropagation();
      this.#key(event);
    });
    view.addEventListener("blur", () => { if (last === null) this.letGo(); });
  }

  #attach() {
    const root = this.#peer
      ? document.querySelector(`#worlds .pane[data-peer="${this.#peer.id}"]`) : null;
    if (root === this.#root && (!root || root.contains(this.line))) return;
    this.letGo();
    this.#root = root;
    this.line.remove();
    if (!root) return;
    root.append(this.line);
    root.querySelector(".view").setAttribute("aria-label", "World of A, whose hand you move: drag "
      + "here, or use the arrow keys. The wheel, Page Up and Page Down move it along the third "
      + "axis. G grips what it is near. Escape lets it go.");
    if (root.dataset.hand !== "listens") this.#listen(root);
    root.dataset.hand = "listens";
  }

  get #advice() {
    const { pace } = this.model.state;
    if (pace && pace.state !== "playing") return "time stands still: press Play, then drag here";
    return this.#peer.task === "P1"
      ? "drag the hand to the cube, then Grip and carry it" : "drag here to push the cube";
  }

  /** A few times a second. */
  describe() {
    this.#attach();
    if (!this.#root) return;
    const force = this.#side?.force;
    const newtons = force ? Math.hypot(...force) : 0;
    say(this.force, force ? `force on the hand ${newtons.toFixed(2)} N` : "force on the hand –");
    const touches = newtons > touchesN;
    if (touches !== this.#touches && this.isHeld)
      announce(touches ? `The hand touches: ${newtons.toFixed(1)} newtons` : "The hand is free");
    this.#touches = touches;
    const { held } = this.model.state.hand;
    const isOthers = held && !this.isHeld;
    if (isOthers && this.says.textContent === "") say(this.says, "another page holds the hand");
    if (!held && !this.isHeld) say(this.says, this.#advice);
  }
}
