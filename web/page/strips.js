// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Charts without a library: lines, dots and bands on a canvas, with scales. Where uPlot is missing.

import { paintRules, roundMarks } from "./rules.js";

const margins = { left: 44, bottom: 20, top: 8, right: 18 };
const plain = (mark) => String(Number(mark.toPrecision(6)));

/** From values to pixels and back, with round values to mark. */
const scaleOf = ([low, high], [from, to], isLog, count) => {
  const [map, back] = isLog ? [Math.log10, (at) => 10 ** at] : [(at) => at, (at) => at];
  const [begin, end] = [map(low), map(high)];
  const pixel = (value) => from + ((map(value) - begin) / (end - begin)) * (to - from);
  const value = (at) => back(begin + ((at - from) / (to - from)) * (end - begin));
  const whole = isLog ? Math.max(1, Math.ceil((end - begin) / 6)) : 0;
  const marks = () => (isLog
    ? Array.from({ length: 1 + Math.floor((Math.floor(end) - Math.ceil(begin)) / whole) },
      (_, i) => 10 ** (Math.ceil(begin) + i * whole))
    : roundMarks(low, high, count));
  return { pixel, value, marks };
};

const groups = new Map(); // of each group {x, listeners}: the value of x that is pointed at
const groupOf = (name) => {
  if (!groups.has(name)) groups.set(name, { x: null, listeners: new Set() });
  return groups.get(name);
};

/** The index of the time that is nearest to x. */
export const nearest = (times, x) => {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < x) low = middle + 1;
    else high = middle;
  }
  return low > 0 && x - times[low - 1] < times[low] - x ? low - 1 : low;
};

class Strip {
  kind = "strips";
  #size = { width: 0, height: 0 };
  #ratio = 1;
  #data = null;
  #view = null;

  constructor(element, { group = "page", onPoint = () => {} }) {
    Object.assign(this, { element, group: groupOf(group), onPoint });
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    element.append(this.canvas);
    this.context = this.canvas.getContext("2d");
    const point = (x) => {
      this.group.x = x;
      this.group.listeners.forEach((listener) => listener());
    };
    element.addEventListener("pointermove", ({ clientX }) => {
      if (this.#view) point(this.valueAt(clientX));
    });
    element.addEventListener("pointerleave", () => point(null));
    this.listener = () => {
      if (!this.#view) return;
      this.#draw();
      this.onPoint();
    };
    this.group.listeners.add(this.listener);
  }

  resize() {
    this.#ratio = Math.min(2, devicePixelRatio);
    this.#size = { width: this.element.clientWidth, height: this.element.clientHeight };
    const { width, height } = this.#size;
    Object.assign(this.canvas, { width: width * this.#ratio, height: height * this.#ratio });
    this.context.setTransform(this.#ratio, 0, 0, this.#ratio, 0, 0);
    if (this.#view) this.#draw();
  }

  #box() {
    const { width, height } = this.#size;
    return {
      left: margins.left, right: width - margins.right,
      top: margins.top, bottom: height - margins.bottom,
    };
  }

  #scales() {
    const box = this.#box();
    const { x, y, logX, logY } = this.#view;
    const marks = Math.max(4, (box.right - box.left) / 120);
    return {
      x: scaleOf(x, [box.left, box.right], logX, marks),
      y: scaleOf(y, [box.bottom, box.top], logY, 4),
    };
  }

  #axes({ x, y }) {
    const { context, colours } = this;
    const box = this.#box();
    const says = this.#view.says ?? plain;
    context.font = "11px system-ui, sans-serif";
    Object.assign(context, { fillStyle: colours.muted, strokeStyle: colours.line, lineWidth: 1 });
    context.textAlign = "right";
    for (const mark of y.marks()) {
      const down = Math.round(y.pixel(mark)) + 0.5;
      context.fillText(plain(mark), box.left - 6, down + 4);
      context.beginPath();
      context.moveTo(box.left, down);
      context.lineTo(box.right, down);
      context.stroke();
    }
    context.textAlign = "center";
    for (const mark of x.marks()) context.fillText(says(mark), x.pixel(mark), box.bottom + 15);
  }

  #band(times, series, { x, y }, colour) {
    const { context } = this;
    context.beginPath();
    times.forEach((time, i) => {
      if (series.most[i] !== null) context.lineTo(x.pixel(time), y.pixel(series.most[i]));
    });
    for (let i = times.length - 1; i >= 0; i -= 1) {
      if (series.least[i] !== null) context.lineTo(x.pixel(times[i]), y.pixel(series.least[i]));
    }
    context.globalAlpha = 0.22;
    context.fillStyle = colour;
    context.fill();
    context.globalAlpha = 1;
  }

  #line(times, values, { x, y }, curve, colour) {
    const { context } = this;
    context.beginPath();
    let pen = false;
    times.forEach((time, i) => {
      if (values[i] === null) {
        pen &&= Boolean(curve.spans);
        return;
      }
      if (pen) context.lineTo(x.pixel(time), y.pixel(values[i]));
      else context.moveTo(x.pixel(time), y.pixel(values[i]));
      pen = true;
    });
    context.setLineDash(curve.dash ? [5, 4] : []);
    const width = curve.width ?? (curve.dash ? 1.25 : 1.75);
    Object.assign(context, { strokeStyle: colour, lineWidth: width });
    if (width > 0) context.stroke();
    context.setLineDash([]);
  }

  #dots(times, values, { x, y }, colour) {
    this.context.fillStyle = colour;
    times.forEach((time, i) => {
      if (values[i] === null) return;
      this.context.beginPath();
      this.context.arc(x.pixel(time), y.pixel(values[i]), 2.5, 0, 2 * Math.PI);
      this.context.fill();
    });
  }

  #curves(scales) {
    const { times, series, curves } = this.#data;
    const box = this.#box();
    this.context.save();
    this.context.beginPath();
    this.context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    this.context.clip();
    curves.forEach((curve, i) => {
      if (curve.hidden) return;
      const colour = this.colours[curve.colour];
      const values = series[i][curve.show === "most" ? "most" : "value"];
      if (curve.band) this.#band(times, series[i], scales, colour);
      this.#line(times, values, scales, curve, colour);
      if (curve.dots) this.#dots(times, values, scales, colour);
    });
    if (this.group.x !== null) {
      this.context.fillStyle = this.colours.muted;
      this.context.fillRect(scales.x.pixel(this.group.x) - 0.5, box.top, 1, box.bottom - box.top);
    }
    this.context.restore();
  }

  #draw() {
    if (this.#size.width <= margins.left + margins.right) return;
    this.context.clearRect(0, 0, this.#size.width, this.#size.height);
    const scales = this.#scales();
    this.#axes(scales);
    this.#curves(scales);
    const box = { ...this.#box(), x: scales.x.pixel, y: scales.y.pixel };
    paintRules(this.context, box, this.#view, this.colours, 1);
  }

  /** As charts.js. */
  update(data, view, colours) {
    this.#data = data;
    this.#view = view;
    this.colours = colours;
    if (this.#size.width !== this.element.clientWidth) this.resize();
    else this.#draw();
  }

  area() {
    const { left, top, height } = this.element.getBoundingClientRect();
    const box = this.#box();
    return {
      left: left + box.left, width: box.right - box.left,
      top: top + box.top, height: height - margins.top - margins.bottom,
    };
  }

  valueAt(pixel) {
    const { left, width } = this.area();
    const along = Math.min(Math.max(pixel - left, 0), width);
    return this.#scales().x.value(margins.left + along);
  }

  pointed() {
    const { x } = this.group;
    return x === null || !this.#data?.times.length ? null : nearest(this.#data.times, x);
  }

  destroy() {
    this.group.listeners.delete(this.listener);
    this.canvas.remove();
  }
}

/** As that of charts.js. */
export const makeChart = (element, options = {}) => new Strip(element, options);
