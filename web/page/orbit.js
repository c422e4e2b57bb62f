// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// One camera for all worlds: drag one, all turn. By mouse, touch, wheel (with Ctrl) and keys.

const start = { yaw: 0.32, pitch: 0.42, zoom: 1 };
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
const perPixel = 0.008; // rad

export class Orbit extends EventTarget {
  yaw = start.yaw;
  pitch = start.pitch;
  zoom = start.zoom;

  turn(yaw, pitch) {
    this.yaw = clamp(this.yaw + yaw, -1.5, 1.5);
    this.pitch = clamp(this.pitch + pitch, 0.03, 1.5);
    this.dispatchEvent(new Event("change"));
  }

  scale(factor) {
    this.zoom = clamp(this.zoom * factor, 0.4, 4);
    this.dispatchEvent(new Event("change"));
  }

  reset() {
    Object.assign(this, start);
    this.dispatchEvent(new Event("change"));
  }

  /** Lets the viewer turn the camera on this element. */
  listen(element) {
    const pointers = new Map();
    const spread = () => {
      const [a, b] = [...pointers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    element.addEventListener("pointerdown", (event) => {
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      const last = pointers.get(event.pointerId);
      if (!last) return;
      const before = pointers.size === 2 ? spread() : 0;
      const moved = { x: event.clientX - last.x, y: event.clientY - last.y };
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (pointers.size === 2) this.scale(spread() / Math.max(before, 1));
      else this.turn(-moved.x * perPixel, moved.y * perPixel);
    });
    for (const name of ["pointerup", "pointercancel"]) {
      element.addEventListener(name, (event) => pointers.delete(event.pointerId));
    }
    element.addEventListener("dblclick", () => this.reset());
    element.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return; // the page scrolls
      event.preventDefault();
      this.scale(Math.exp(-event.deltaY * 0.002));
    }, { passive: false });
    element.addEventListener("keydown", (event) => this.#key(event));
  }

  #key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = event.shiftKey ? 0.3 : 0.08;
    const actions = {
      ArrowLeft: () => this.turn(-step, 0),
      ArrowRight: () => this.turn(step, 0),
      ArrowUp: () => this.turn(0, step),
      ArrowDown: () => this.turn(0, -step),
      "+": () => this.scale(1.15),
      "-": () => this.scale(1 / 1.15),
      0: () => this.reset(),
      Home: () => this.reset(),
    };
    if (!Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
  }
}
