// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Draws the figures of a page from its data (the element #figures). What stands there before, the
// static drawing, is for pages without scripts, and for papers. A painter for each kind of figure.
"use strict";
(() => {
  const margins = { left: 60, right: 15, top: 34, bottom: 44 };
  const narrow = 600; // below it a legend has a line of its own

  const element = (parent, name, attributes, words) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (words !== undefined) made.textContent = words;
    if (parent !== null) parent.append(made);
    return made;
  };
  const text = (svg, [x, y], anchor, words, more = {}) =>
    element(svg, "text", { x, y, "text-anchor": anchor, ...more }, words);
  const across = (svg, box, y, more) =>
    element(svg, "line", {
      x1: box.left, x2: box.right, y1: y, y2: y, stroke: "currentColor", ...more,
    });

  /** 1, 2 or 5 times a power of ten: about `wanted` of them in `span`. */
  const roundStep = (span, wanted) => {
    const power = 10 ** Math.floor(Math.log10(span / wanted));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= span / wanted);
  };

  /** An axis from values to pixels: { pixel(value), marks }. */
  const makeAxis = (isLog, [low, high], [from, to]) => {
    const map = isLog ? Math.log10 : (value) => value;
    let [begin, end] = [map(low), map(high)];
    if (isLog) [begin, end] = [Math.floor(begin), Math.max(Math.ceil(end), Math.floor(begin) + 1)];
    if (!(end > begin)) [begin, end] = [begin - 1, begin + 1];
    const pixelOf = (at) => from + ((to - from) * (at - begin)) / (end - begin);
    const step = isLog ? 1 : roundStep(end - begin, 5);
    const marks = [];
    for (let at = Math.ceil(begin / step) * step; at <= end + 1e-9 * step; at += step) {
      const value = isLog ? 10 ** at : at;
      marks.push({ pixel: pixelOf(at), words: String(Number(value.toPrecision(6))) });
    }
    return { pixel: (value) => pixelOf(map(value)), marks };
  };

  /** An empty drawing with its titles and its legend, and the box for what is drawn. */
  const frame = (data, entries) => {
    const { width, height } = data;
    const isNarrow = width < narrow;
    const box = {
      left: margins.left,
      right: width - margins.right,
      top: margins.top + (entries.length > 0 && isNarrow ? 18 : 0),
      bottom: height - margins.bottom,
    };
    const viewBox = `0 0 ${width} ${height}`;
    const svg = element(null, "svg", { viewBox, role: "img", "aria-label": data.title });
    const middle = (box.top + box.bottom) / 2;
    text(svg, [box.left, 16], "start", data.title, { "font-weight": "bold" });
    text(svg, [(box.left + width) / 2, height - 8], "middle", data.x);
    text(svg, [14, middle], "middle", data.y, { transform: `rotate(-90 14 ${middle})` });
    const room = (entry) => 8 * entry.name.length + 16;
    const whole = entries.reduce((sum, entry) => sum + room(entry), 0);
    let at = isNarrow ? box.left : box.right - whole;
    for (const entry of entries) {
      text(svg, [at, isNarrow ? 34 : 16], "start", entry.name, { fill: entry.colour });
      at += room(entry);
    }
    return { svg, box };
  };

  const grid = (svg, box, axis) => {
    for (const mark of axis.marks) {
      across(svg, box, mark.pixel, { "stroke-opacity": 0.15 });
      text(svg, [box.left - 6, mark.pixel + 4], "end", mark.words);
    }
  };

  const paintCurve = (svg, data, curve, place) => {
    const points = curve.points.map(place).filter(([x, y]) => isFinite(x) && isFinite(y));
    if (curve.width > 0) {
      element(svg, "polyline", {
        points: points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "),
        fill: "none",
        stroke: curve.colour,
        "stroke-width": curve.width,
        "stroke-dasharray": curve.dashes,
      });
    }
    if (!curve.dots) return;
    for (const point of curve.points) {
      const [cx, cy] = place(point);
      if (!isFinite(cx) || !isFinite(cy)) continue;
      const dot = element(svg, "circle", { cx, cy, r: 2.5, fill: curve.colour });
      const words = point.map((value) => Number(value.toPrecision(4))).join(", ");
      element(dot, "title", {}, `${curve.name || data.title}: ${words}`);
    }
  };

  /** Curves over an axis: lines, and a dot that says its values. */
  const paintPlot = (data) => {
    const named = data.curves.filter((curve) => curve.name !== "");
    const { svg, box } = frame(data, named);
    const points = data.curves
      .flatMap((curve) => curve.points)
      .filter(([x, y]) => (!data.log_x || x > 0) && (!data.log_y || y > 0));
    const span = (values) => [Math.min(...values), Math.max(...values)];
    const xs = points.map(([x]) => x).concat(data.range_x);
    const ys = points.map(([, y]) => y).concat(data.range_y, data.levels.map((level) => level.y));
    const x = makeAxis(data.log_x, span(xs), [box.left, box.right]);
    const y = makeAxis(data.log_y, span(ys), [box.bottom, box.top]);
    for (const mark of x.marks) text(svg, [mark.pixel, box.bottom + 16], "middle", mark.words);
    grid(svg, box, y);
    for (const level of data.levels) {
      across(svg, box, y.pixel(level.y), { "stroke-dasharray": "4 4" });
      text(svg, [box.right - 4, y.pixel(level.y) - 4], "end", level.name);
    }
    const place = (point) => [x.pixel(point[0]), y.pixel(point[1])];
    for (const curve of [...data.curves].reverse()) paintCurve(svg, data, curve, place);
    return svg;
  };

  const barPath = (bar, { left, width, top, bottom }) => {
    const right = left + width;
    if (!bar.open) return `M${left} ${bottom}V${top}H${right}V${bottom}`;
    const shoulder = Math.min(top + 8, bottom); // of an arrow
    const tip = `${left + width / 2} ${top}`;
    return `M${left} ${bottom}V${shoulder}L${tip}L${right} ${shoulder}V${bottom}`;
  };

  const paintBar = (svg, bar, place, y) => {
    const group = element(svg, "g", {});
    element(group, "title", {}, bar.tip || bar.label);
    element(group, "path", {
      d: barPath(bar, place),
      fill: bar.colour,
      stroke: bar.colour,
      "fill-opacity": bar.outlined ? 0.12 : 0.85,
      "stroke-dasharray": bar.outlined ? "4 2" : "none",
    });
    const middle = place.left + place.width / 2;
    let top = place.top;
    if (bar.high !== undefined) {
      const [low, high] = [y.pixel(bar.low), y.pixel(bar.high)];
      const ends = `M${middle - 4} ${low}h8M${middle - 4} ${high}h8`;
      const d = `M${middle} ${low}V${high}${ends}`;
      element(group, "path", { d, stroke: "currentColor", "stroke-width": 1.2, fill: "none" });
      top = Math.min(top, high);
    }
    const fitting = (1.1 * place.width) / (0.62 * Math.max(bar.label.length, 1));
    const style = { "font-size": Math.min(12, Math.max(8, fitting)) };
    if (bar.missed) Object.assign(style, { fill: "var(--missed)", "font-weight": "bold" });
    text(group, [middle, top - 4], "middle", bar.label, style);
  };

  /** Groups of bars from zero, each with its interval. */
  const paintBars = (data) => {
    const { svg, box } = frame(data, data.legend);
    const ends = data.groups.flatMap((group) =>
      group.bars.map((bar) => 1.12 * Math.max(bar.value, bar.high ?? 0)),
    );
    const y = makeAxis(false, [0, Math.max(0, ...ends) || 1], [box.bottom, box.top]);
    grid(svg, box, y);
    const room = (box.right - box.left) / Math.max(data.groups.length, 1);
    data.groups.forEach((group, index) => {
      const step = Math.min((0.85 * room) / Math.max(group.bars.length, 1), 48);
      let at = box.left + index * room + (room - step * group.bars.length) / 2;
      for (const bar of group.bars) {
        const width = 0.9 * step;
        const top = y.pixel(bar.value);
        paintBar(svg, bar, { left: at + 0.05 * step, width, top, bottom: box.bottom }, y);
        at += step;
      }
      text(svg, [box.left + (index + 0.5) * room, box.bottom + 16], "middle", group.name);
    });
    return svg;
  };

  const painters = { plot: paintPlot, bars: paintBars };

  const file = document.getElementById("figures");
  if (file === null) return;
  const all = JSON.parse(file.textContent);
  for (const place of document.querySelectorAll("figure[data-figure]")) {
    const data = all[place.dataset.figure];
    const still = place.querySelector("svg");
    if (data !== undefined && still !== null) still.replaceWith(painters[data.kind](data));
  }
})();
