// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Charts by uPlot, with one cursor for all of a group. Takes and gives the same as strips.js.

import { paintRules } from "./rules.js";
import UPlot from "./uPlot.module.min.js";

/** Of a curve without a line there are only dots. */
const lineOf = (curve, colour) => ({
  stroke: colour, fill: undefined, spanGaps: Boolean(curve.spans), show: !curve.hidden,
  width: curve.width ?? (curve.dash ? 1.25 : 1.75), dash: curve.dash ? [5, 4] : undefined,
  points: { show: Boolean(curve.dots), size: 5, width: 0, fill: colour },
  ...(curve.width === 0 ? { paths: () => null } : {}),
});

/** Three series of uPlot for each curve: the line, and the ends of its band. */
const seriesOf = (curves, colours) => [{}].concat(...curves.map((curve) => {
  const edge = { show: Boolean(curve.band) && !curve.hidden, points: { show: false }, width: 0 };
  return [lineOf(curve, colours[curve.colour]), edge, { ...edge }];
}));

const bandsOf = (curves, colours) => curves.flatMap((curve, i) =>
  (curve.band ? [{ series: [3 * i + 3, 3 * i + 2], fill: `${colours[curve.colour]}38` }] : []));

const scaleOf = (isLog) => ({ time: false, auto: false, distr: isLog ? 3 : 1 });

const axis = (colours, more) => ({
  stroke: colours.muted, font: "11px system-ui, sans-serif", ticks: { show: false },
  grid: { stroke: colours.line, width: 1 }, ...more,
});
const plain = (mark) => String(Number(mark.toPrecision(6)));
const textsOf = (marks, says) => marks.map((mark) => (mark === null ? null : says(mark)));

/** `group`: the charts whose cursors go together; `onPoint` is called when the cursor moves. */
export const makeChart = (element, { group = "page", onPoint = () => {} } = {}) => {
  let chart = null;
  let signature = "";
  let shown = null; // index of the point under the cursor
  let view = null;
  let colours = null;

  const rules = ({ ctx, bbox, valToPos }) => paintRules(ctx, {
    left: bbox.left, right: bbox.left + bbox.width, top: bbox.top, bottom: bbox.top + bbox.height,
    x: (value) => valToPos(value, "x", true), y: (value) => valToPos(value, "y", true),
  }, view, colours, devicePixelRatio);

  const build = (curves) => {
    chart?.destroy();
    chart = new UPlot({
      width: element.clientWidth,
      height: element.clientHeight,
      padding: [8, 18, 0, 0],
      legend: { show: false },
      cursor: {
        sync: { key: UPlot.sync(group).key }, drag: { x: false, y: false }, y: false,
      },
      scales: { x: scaleOf(view.logX), y: scaleOf(view.logY) },
      axes: [
        axis(colours, {
          size: 30, gap: 9, grid: { show: false },
          values: (_, marks) => textsOf(marks, view.says ?? plain),
        }),
        axis(colours, {
          size: 46, gap: 4, space: 28, values: (_, marks) => textsOf(marks, plain),
        }),
      ],
      series: seriesOf(curves, colours),
      bands: bandsOf(curves, colours),
      hooks: {
        setCursor: [(one) => {
          if (shown === one.cursor.idx) return;
          shown = one.cursor.idx;
          onPoint();
        }],
        draw: [rules],
      },
    }, [[]], element);
    chart.root.setAttribute("aria-hidden", "true");
  };

  const update = ({ times, series, curves }, nextView, nextColours) => {
    [view, colours] = [nextView, nextColours];
    const now = JSON.stringify([curves, colours, view.logX, view.logY]);
    if (now !== signature) build(curves);
    signature = now;
    const data = [times];
    series.forEach((one, i) => {
      data.push(curves[i].show === "most" ? one.most : one.value, one.least, one.most);
    });
    chart.batch(() => {
      chart.setData(data, false);
      chart.setScale("x", { min: view.x[0], max: view.x[1] });
      chart.setScale("y", { min: view.y[0], max: view.y[1] });
    });
  };
  const resize = () => chart?.setSize({ width: element.clientWidth, height: element.clientHeight });
  /** Where the curves are, in pixels of the window. */
  const area = () => chart.over.getBoundingClientRect();
  /** The value of x at this pixel of the window, of the nearest end outside the curves. */
  const valueAt = (pixel) => {
    const { left, width } = area();
    return chart.posToVal(Math.min(Math.max(pixel - left, 0), width), "x");
  };
  return {
    kind: "uPlot", update, resize, area, valueAt,
    /** The point under the cursor, as an index into the times shown last; null: none. */
    pointed: () => shown,
    destroy: () => chart?.destroy(),
  };
};
