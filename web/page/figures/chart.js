// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Curves in an element of a page that may change at any time, with one cursor for all charts of a
// group. The curves are those that curves.js takes.

import { make } from "../dom.js";
import { onColours, readColours } from "../paint/palette.js";
import { flatContext } from "../painters.js";
import { paintCurves } from "./curves.js";
import { CanvasSurface, SvgSurface } from "./surface.js";
import { drawing } from "./svg.js";

const leastWidth = 80; // pixels: a chart in less has no room for its scale

const groups = new Map(); // of each group {x, listeners}: the value of x that is pointed at
const groupOf = (name) => {
  if (!groups.has(name)) groups.set(name, { x: null, listeners: new Set() });
  return groups.get(name);
};

/** Draws with elements of SVG: for what changes only when someone acts. */
class Elements {
  constructor(place) { this.place = place; }

  draw(size, paint) {
    const svg = drawing(size, "");
    svg.removeAttribute("role"); // the element around it has a name, the table the values
    svg.setAttribute("aria-hidden", "true");
    const drawn = paint(new SvgSurface(svg));
    if (this.svg) this.svg.replaceWith(svg);
    else this.place.prepend(svg);
    this.svg = svg;
    return drawn;
  }
}

/** Draws on a canvas: for what changes all the time. */
class Pixels {
  constructor(place, redraw) {
    this.canvas = make("canvas", { "aria-hidden": true });
    place.prepend(this.canvas);
    this.context = flatContext(this.canvas);
    this.colours = readColours();
    onColours(() => {
      this.colours = readColours();
      redraw();
    });
  }

  draw(size, paint) {
    const ratio = Math.min(2, devicePixelRatio);
    const [width, height] = [size.width, size.height].map((pixels) => Math.round(ratio * pixels));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      Object.assign(this.canvas, { width, height });
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, size.width, size.height);
    return paint(new CanvasSurface(this.context, this.colours, "12px system-ui, sans-serif"));
  }
}

export class Chart {
  #drawn = null; // {box, x, y} of the last drawing
  #curves = null;
  #view = null;

  /** `isLive`: it changes all the time. */
  constructor(place, { group = "page", onPoint = () => {}, isLive = false } = {}) {
    Object.assign(this, { place, group: groupOf(group) });
    this.painter = isLive ? new Pixels(place, () => this.draw()) : new Elements(place);
    this.cursor = make("div", { class: "cursor", hidden: true });
    place.append(this.cursor);
    const point = (x) => {
      this.group.x = x;
      this.group.listeners.forEach((listener) => listener());
    };
    place.addEventListener("pointermove", ({ clientX }) => {
      if (this.#drawn) point(this.valueAt(clientX));
    });
    place.addEventListener("pointerleave", () => point(null));
    this.group.listeners.add(() => {
      if (!this.#drawn) return;
      this.#moveCursor();
      onPoint();
    });
    new ResizeObserver(() => this.draw()).observe(place);
  }

  /** Draws these curves in this view; nothing while there is no room, as in a folded part. */
  update(curves, view) {
    this.#curves = curves;
    this.#view = view;
    this.draw();
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (!this.#view || width < leastWidth) return;
    this.#drawn = this.painter.draw({ width, height }, (surface) =>
      paintCurves(surface, { width, height }, this.#curves, this.#view));
    this.#moveCursor();
  }

  #moveCursor() {
    const { box, x } = this.#drawn;
    const across = this.pointed === null ? -1 : x.pixel(this.pointed);
    this.cursor.hidden = !(across >= box.left && across <= box.right);
    Object.assign(this.cursor.style, {
      left: `${across}px`, top: `${box.top}px`, height: `${box.bottom - box.top}px`,
    });
  }

  get isDrawn() { return this.#drawn !== null; }

  /** The value of x under the cursor of the group; null: none. */
  get pointed() { return this.group.x; }

  /** Where the curves are, across the window, in pixels. */
  area() {
    const { left } = this.place.getBoundingClientRect();
    const { box } = this.#drawn;
    return { left: left + box.left, width: box.right - box.left };
  }

  /** The value of x at this pixel of the window, of the nearest end outside the curves. */
  valueAt(pixel) {
    const { left, width } = this.area();
    const along = Math.min(Math.max(pixel - left, 0), width);
    return this.#drawn.x.value(this.#drawn.box.left + along);
  }
}
