// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A surface for curves: elements of SVG, which print and save well, or pixels of a canvas, which
// cost a tenth at ten changes a second. A surface begins a path (moveTo, lineTo, closePath) and
// draws it in a style of SVG's attributes.

import { element } from "./svg.js";

const round = (pixel) => Math.round(10 * pixel) / 10;

class SvgPath {
  d = "";

  moveTo(x, y) { this.d += `M${round(x)} ${round(y)}`; }
  lineTo(x, y) { this.d += `${this.d === "" ? "M" : "L"}${round(x)} ${round(y)}`; }
  closePath() { this.d += "Z"; }
}

export class SvgSurface {
  constructor(parent) { this.parent = parent; }

  begin() { return new SvgPath(); }

  draw({ d }, style) { element(this.parent, "path", { d, fill: "none", ...style }); }

  text([x, y], anchor, words, style) {
    const place = { x: round(x), y: round(y), "text-anchor": anchor };
    element(this.parent, "text", { ...place, ...style }, words);
  }

  /** Calls back with a surface on which nothing outside the box is seen. */
  clipped(box, draw) {
    const [width, height] = [box.right - box.left, box.bottom - box.top];
    draw(new SvgSurface(element(this.parent, "svg", {
      x: box.left, y: box.top, width, height, overflow: "hidden",
      viewBox: `${box.left} ${box.top} ${width} ${height}`,
    })));
  }
}

const alignments = { start: "left", middle: "center", end: "right" };

export class CanvasSurface {
  /** `colours` are those of the palette, by name; `font` is that of the texts. */
  constructor(context, colours, font) { Object.assign(this, { context, colours, font }); }

  #colour(paint) {
    return paint === "currentColor" ? this.colours.ink : this.colours[paint.slice(6, -1)];
  }

  begin() { return new Path2D(); }

  draw(path, style) {
    const { context } = this;
    if (style.fill && style.fill !== "none") {
      context.globalAlpha = style["fill-opacity"] ?? 1;
      context.fillStyle = this.#colour(style.fill);
      context.fill(path);
    }
    if (style.stroke) {
      context.globalAlpha = style["stroke-opacity"] ?? 1;
      context.strokeStyle = this.#colour(style.stroke);
      context.lineWidth = style["stroke-width"] ?? 1;
      context.lineCap = style["stroke-linecap"] ?? "butt";
      context.lineJoin = style["stroke-linejoin"] ?? "miter";
      context.setLineDash((style["stroke-dasharray"] ?? "").split(" ").filter(Boolean).map(Number));
      context.stroke(path);
    }
    context.globalAlpha = 1;
  }

  text([x, y], anchor, words) {
    const { context } = this;
    Object.assign(context, {
      font: this.font, fillStyle: this.colours.muted, textAlign: alignments[anchor],
    });
    context.fillText(words, x, y);
  }

  clipped(box, draw) {
    const { context } = this;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.clip();
    draw(this);
    context.restore();
  }
}

/** Draws a straight line on a surface. */
export const drawLine = (surface, [fromX, fromY], [toX, toY], style) => {
  const path = surface.begin();
  path.moveTo(fromX, fromY);
  path.lineTo(toX, toY);
  surface.draw(path, style);
};
