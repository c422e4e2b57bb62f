// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Charts by uPlot, with one cursor for all. Takes and gives the same as strips.js.

/** uPlot's minified build is a classic script; as a module it would keep what it defines. */
const loaded = () => new Promise((resolve, reject) => {
  const script = document.createElement("script");
  script.src = new URL("./uPlot.iife.min.js", import.meta.url).href;
  script.addEventListener("load", () => resolve(globalThis.uPlot));
  script.addEventListener("error", () => reject(new Error("uPlot is missing")));
  document.head.append(script);
});

const UPlot = await loaded();
const together = UPlot.sync("page");

/** Three series of uPlot for each curve: the line, and the ends of its band. */
const seriesOf = (curves, colours) => [{}].concat(...curves.map((curve) => {
  const colour = colours[curve.colour];
  const edge = { show: Boolean(curve.band) && !curve.hidden, points: { show: false }, width: 0 };
  return [
    {
      stroke: colour, width: curve.dash ? 1.25 : 1.75, dash: curve.dash ? [5, 4] : undefined,
      points: { show: false }, show: !curve.hidden,
    },
    edge, { ...edge },
  ];
}));

const bandsOf = (curves, colours) => curves.flatMap((curve, i) =>
  (curve.band ? [{ series: [3 * i + 3, 3 * i + 2], fill: `${colours[curve.colour]}38` }] : []));

export const makeChart = (element) => {
  let chart = null;
  let signature = "";
  let shown = null; // index of the point under the cursor

  const axis = (colours, more) => ({
    stroke: colours.muted, font: "11px system-ui, sans-serif", ticks: { show: false },
    grid: { stroke: colours.line, width: 1 }, ...more,
  });

  const build = (curves, colours) => {
    chart?.destroy();
    chart = new UPlot({
      width: element.clientWidth,
      height: element.clientHeight,
      padding: [8, 18, 0, 0],
      legend: { show: false },
      cursor: { sync: { key: together.key }, drag: { x: false, y: false }, y: false },
      scales: { x: { time: false, auto: false }, y: { auto: false } },
      axes: [
        axis(colours, {
          size: 30, gap: 9, grid: { show: false },
          values: (_, marks) => marks.map((mark) => (mark === 0 ? "now" : `${mark} s`)),
        }),
        axis(colours, { size: 46, gap: 4, space: 28 }),
      ],
      series: seriesOf(curves, colours),
      bands: bandsOf(curves, colours),
      hooks: { setCursor: [(one) => { shown = one.cursor.idx; }] },
    }, [[]], element);
    chart.root.setAttribute("aria-hidden", "true");
  };

  const update = ({ times, series, curves }, from, most, colours) => {
    const now = JSON.stringify([curves, colours]);
    if (now !== signature) build(curves, colours);
    signature = now;
    const data = [times];
    series.forEach((one, i) => {
      data.push(curves[i].show === "most" ? one.most : one.value, one.least, one.most);
    });
    chart.batch(() => {
      chart.setData(data, false);
      chart.setScale("x", { min: from, max: 0 });
      chart.setScale("y", { min: 0, max: most });
    });
  };
  const resize = () => chart?.setSize({ width: element.clientWidth, height: element.clientHeight });
  /** The point under the cursor, as an index into the times that were shown last; null: none. */
  return { update, resize, pointed: () => shown, destroy: () => chart?.destroy() };
};
