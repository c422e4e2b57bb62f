// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Curves with bands, dots and levels: of reports, of a run, and of the live page.

import { nearest, roundSpan, scaleOf, spanOf } from "./scales.js";
import { drawLine, SvgSurface } from "./surface.js";
import { boxOf, drawing, leftOf, paintGrid, paintNames, paintOf, widthOf } from "./svg.js";

const columnsOf = (points, { x, y }) => {
  const canShow = ([across, up]) =>
    (x.scale !== "log" || across > 0) && (y.scale !== "log" || up > 0);
  const shown = points.filter(canShow).sort((a, b) => a[0] - b[0]);
  return { x: shown.map((point) => point[0]), y: shown.map((point) => point[1]) };
};

/**
 * The series of a figure as the painter takes them: {name, colour, x, y} with ascending lists;
 * `low` and `high` of a band and `scatter` {x, y} where there are such.
 */
export const curvesOf = (figure) => figure.series.map((series) => {
  const curve = { width: 1.25, spans: true, ...series, ...columnsOf(series.points, figure) };
  if (series.scatter) curve.scatter = columnsOf(series.scatter, figure);
  if (series.band) {
    const band = [...series.band].sort((a, b) => a[0] - b[0]);
    curve.band = {
      x: band.map((one) => one[0]), low: band.map((one) => one[1]), high: band.map((one) => one[2]),
    };
  }
  return curve;
});

const dotRoom = 0.03; // of the x axis, beside dots at its ends

/** What both axes of a figure span: {x, y}; a linear y axis from one round value to another. */
export const spansOf = (figure) => {
  const all = figure.series.flatMap(({ points, scatter = [] }) => [...points, ...scatter]);
  const bands = figure.series.flatMap(({ band = [] }) =>
    band.flatMap(([, low, high]) => [low, high]));
  const levels = (figure.levels ?? []).map((level) => level.y);
  const [logX, logY] = [figure.x.scale === "log", figure.y.scale === "log"];
  const x = spanOf(all.map((point) => point[0]).concat(figure.x.range ?? []), logX);
  const hasDots = figure.series.some(({ dots, scatter }) => dots || scatter);
  if (hasDots && !logX) {
    const beside = dotRoom * (x[1] - x[0]);
    x[0] -= beside;
    x[1] += beside;
  }
  const y = spanOf(all.map((point) => point[1]).concat(bands, figure.y.range ?? [], levels), logY);
  return { x, y: logY ? y : roundSpan(y) };
};

/** The part of a list that is seen, with a point more at each end. */
const seen = (times, [from, to]) => {
  const [first, last] = [nearest(times, from), nearest(times, to)];
  return [Math.max(0, first - 1), Math.min(times.length, last + 2)];
};

/**
 * Goes through the points. Of those that fall into one column of pixels, the lowest and the highest
 * are drawn, so that no peak is lost.
 */
export const follow = (path, { x: times, y: values, spans }, { x, y }, range) => {
  const [begin, end] = seen(times, range);
  const isDense = end - begin > 4 * Math.abs(x.pixel(range[1]) - x.pixel(range[0]));
  let pen = false;
  const draw = (i) => {
    if (pen) path.lineTo(x.pixel(times[i]), y.pixel(values[i]));
    else path.moveTo(x.pixel(times[i]), y.pixel(values[i]));
    pen = true;
  };
  let [column, low, high] = [null, -1, -1];
  const flush = () => {
    if (column === null) return;
    draw(Math.min(low, high));
    if (low !== high) draw(Math.max(low, high));
    column = null;
  };
  for (let i = begin; i < end; i += 1) {
    if (values[i] === null || values[i] === undefined) {
      flush();
      pen &&= Boolean(spans);
    } else if (!isDense) {
      draw(i);
    } else {
      const here = Math.round(x.pixel(times[i]));
      if (here !== column) {
        flush();
        [column, low, high] = [here, i, i];
      }
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
  }
  flush();
  return path;
};

const around = (path, { x: times, low, high }, { x, y }, range) => {
  const [begin, end] = seen(times, range);
  for (let i = begin; i < end; i += 1) {
    if (high[i] !== null) path.lineTo(x.pixel(times[i]), y.pixel(high[i]));
  }
  for (let i = end - 1; i >= begin; i -= 1) {
    if (low[i] !== null) path.lineTo(x.pixel(times[i]), y.pixel(low[i]));
  }
  return path;
};

/** A line of no length with round ends is a disc. */
const dot = (path, { x: times, y: values }, { x, y }) => {
  times.forEach((time, i) => {
    if (values[i] === null) return;
    path.moveTo(x.pixel(time), y.pixel(values[i]));
    path.lineTo(x.pixel(time), y.pixel(values[i]));
  });
  return path;
};

/** Where a curve crosses a height: a line across, with its ends. */
const paintCrossing = (surface, { y: height, low, high }, { x, y }, stroke) => {
  const path = surface.begin();
  const [from, to, down] = [x.pixel(low), x.pixel(high), y.pixel(height)];
  path.moveTo(from, down);
  path.lineTo(to, down);
  for (const end of [from, to]) {
    path.moveTo(end, down - 6);
    path.lineTo(end, down + 6);
  }
  surface.draw(path, { stroke, "stroke-width": 3 });
};

const paintCurve = (surface, curve, scales, range) => {
  const stroke = paintOf(curve.colour);
  const dots = (points) => surface.draw(dot(surface.begin(), points, scales),
    { stroke, "stroke-width": 5, "stroke-linecap": "round" });
  if (curve.band) {
    surface.draw(around(surface.begin(), curve.band, scales, range),
      { fill: stroke, "fill-opacity": 0.22 });
  }
  if (curve.width > 0) {
    surface.draw(follow(surface.begin(), curve, scales, range), {
      stroke, "stroke-width": curve.width, "stroke-linejoin": "round",
      "stroke-dasharray": curve.dash,
    });
  }
  if (curve.dots) dots(curve);
  if (curve.scatter) dots(curve.scatter);
  if (curve.crossing) paintCrossing(surface, curve.crossing, scales, stroke);
};

/** Whether a point of the curves lies in that part of the drawing, in pixels. */
const hasPointIn = (curves, { x, y }, { left, right, top, bottom }) =>
  curves.some((curve) => !curve.hidden && [curve, curve.scatter ?? { x: [], y: [] }]
    .some(({ x: times, y: values }) => times.some((time, i) => {
      const [across, down] = [x.pixel(time), y.pixel(values[i] ?? NaN)];
      return across >= left && across <= right && down >= top && down <= bottom;
    })));

const textHeight = 13; // pixels

/** Lines across with their names: at the right end, or at the left where points lie there. */
const paintLevels = (surface, box, levels, curves, scales) => {
  for (const level of levels) {
    const down = scales.y.pixel(level.y);
    drawLine(surface, [box.left, down], [box.right, down],
      { stroke: "currentColor", "stroke-dasharray": "4 4" });
    const foot = down - box.top < textHeight + 1 ? down + textHeight : down - 4;
    const width = widthOf(level.name) + 8;
    const isTaken = (left) => hasPointIn(curves, scales,
      { left, right: left + width, top: foot - textHeight, bottom: foot + 3 });
    const isLeft = isTaken(box.right - width) && !isTaken(box.left);
    surface.text([isLeft ? box.left + 4 : box.right - 4, foot], isLeft ? "start" : "end",
      level.name);
  }
};

const paintMoments = (surface, box, moments, x) => {
  for (const moment of moments) {
    const across = x.pixel(moment);
    drawLine(surface, [across, box.top], [across, box.bottom],
      { stroke: "currentColor", "stroke-opacity": 0.5, "stroke-dasharray": "2 3" });
  }
};

const hasPoints = ({ x, scatter }) => x.length > 0 || scatter?.x.length > 0;

/** The order in which curves are drawn: a dashed one lies on the others, which show between. */
const fromBelow = (curves) => {
  const reversed = [...curves].reverse();
  return [...reversed.filter(({ dash }) => !dash), ...reversed.filter(({ dash }) => dash)];
};

/**
 * Draws curves on a surface, the first of them on top of those after it and dashed ones on top of
 * all, and returns {box, x, y}: where, and its scales. `view` has the ranges `x` and `y`; where
 * wanted `logX`, `logY`, `levels`, `moments` of x with a line each, a `moment` that is marked,
 * `says` for the marks of x, and the `names` of the axes.
 */
export const paintCurves = (surface, size, curves, view) => {
  const left = view.names
    ? leftOf(scaleOf(view.y, [size.height, 0], view.logY), size.height) : undefined;
  const box = boxOf(size, { names: Boolean(view.names), top: view.top, left });
  const x = scaleOf(view.x, [box.left, box.right], view.logX);
  const y = scaleOf(view.y, [box.bottom, box.top], view.logY);
  paintGrid(surface, box, y);
  const says = view.says ?? x.says;
  for (const mark of x.marks(Math.max(4, (box.right - box.left) / 75))) {
    surface.text([x.pixel(mark), box.bottom + 15], "middle", says(mark));
  }
  if (view.names) paintNames(surface, box, view.names);
  const edge = 4; // pixels: half a dot at the edge
  const clip = {
    left: box.left - edge, right: box.right + edge, top: box.top - edge, bottom: box.bottom + edge,
  };
  surface.clipped(clip, (inside) => {
    paintLevels(inside, box, view.levels ?? [], curves, { x, y });
    paintMoments(inside, box, view.moments ?? [], x);
    for (const curve of fromBelow(curves)) {
      if (!curve.hidden && hasPoints(curve)) paintCurve(inside, curve, { x, y }, view.x);
    }
    if (Number.isFinite(view.moment)) {
      const across = x.pixel(view.moment);
      drawLine(inside, [across, box.top], [across, box.bottom],
        { stroke: "currentColor", "stroke-width": 2 });
    }
  });
  return { box, x, y };
};

/** The curves of a figure as a drawing of that size; `range` is the part of x that is seen. */
export const drawnCurves = (figure, size, { hidden = new Set(), top, range } = {}) => {
  const svg = drawing(size, figure.title);
  const spans = spansOf(figure);
  const curves = curvesOf(figure).map((curve) => ({ ...curve, hidden: hidden.has(curve.name) }));
  paintCurves(new SvgSurface(svg), size, curves, {
    x: range ?? spans.x, y: spans.y, logX: figure.x.scale === "log", logY: figure.y.scale === "log",
    levels: figure.levels, moments: figure.moments, names: figure, top,
  });
  return svg;
};

/** The value that a curve has nearest to x, within `reach`; null where it has none there. */
export const valueNear = (curve, x, reach) => {
  for (const { x: times, y: values } of [curve, curve.scatter ?? { x: [], y: [] }]) {
    if (times.length === 0) continue;
    const at = nearest(times, x);
    if (values[at] !== null && Math.abs(times[at] - x) <= reach) return values[at];
  }
  return null;
};
