// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The curves of a figure, from the report's data, in the form in which charts take them.

/** "var(--left)" -> "left": charts take the names of the palette. */
const nameOf = (colour) => /^var\(--(.+)\)$/.exec(colour)?.[1] ?? "ink";

/**
 * What the curves look like. One without a name belongs to the named one before it: `name`, by
 * which it is hidden, is that one's; `label` is empty.
 */
export const stylesOf = (data) => {
  let name = "";
  return data.curves.map((curve, i) => {
    if (curve.name !== "" || i === 0) name = curve.name;
    return {
      name, label: curve.name, colour: nameOf(curve.colour), dots: curve.dots, spans: true,
      width: curve.width === 0 ? 0 : Math.max(1.25, curve.width),
      dash: curve.dashes !== "none", band: false, show: "mean",
    };
  });
};

/**
 * {times, series: [{value, least, most}]}: all curves over one ascending list of x. A curve with
 * several points at one x has a row for each; null stands where it has none.
 */
export const rowsOf = (data) => {
  const cells = new Map(); // x -> for each curve its values there
  const canShow = ([x, y]) => (!data.log_x || x > 0) && (!data.log_y || y > 0);
  data.curves.forEach((curve, i) => {
    for (const [x, y] of curve.points.filter(canShow)) {
      if (!cells.has(x)) cells.set(x, data.curves.map(() => []));
      cells.get(x)[i].push(y);
    }
  });
  const times = [];
  const values = data.curves.map(() => []);
  for (const x of [...cells.keys()].sort((a, b) => a - b)) {
    const here = cells.get(x);
    const count = Math.max(...here.map((list) => list.length));
    for (let row = 0; row < count; row += 1) {
      times.push(x);
      here.forEach((list, i) => values[i].push(list[row] ?? null));
    }
  }
  return { times, series: values.map((value) => ({ value, least: value, most: value })) };
};

/** The least and the most of numbers, and of what an axis is to span besides; never alike. */
export const spanOf = (numbers, isLog) => {
  const known = numbers.filter((value) => Number.isFinite(value) && (!isLog || value > 0));
  const least = known.reduce((a, b) => Math.min(a, b), Infinity);
  const most = known.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(least <= most)) return isLog ? [0.1, 10] : [-1, 1];
  if (isLog) {
    const low = Math.floor(Math.log10(least));
    return [10 ** low, 10 ** Math.max(Math.ceil(Math.log10(most)), low + 1)];
  }
  return least < most ? [least, most] : [least - 1, most + 1];
};

/** What both axes of a figure span: {x, y}. On a linear y axis with a little room. */
export const spansOf = (data) => {
  const points = data.curves.flatMap((curve) => curve.points);
  const x = spanOf(points.map((point) => point[0]).concat(data.range_x), data.log_x);
  const levels = data.levels.map((level) => level.y);
  const [low, high] = spanOf(points.map((point) => point[1]).concat(data.range_y, levels),
    data.log_y);
  const room = data.log_y ? 0 : 0.04 * (high - low);
  return { x, y: [low === 0 ? 0 : low - room, high + room] };
};

/** The value that a curve has nearest to the row, within 1 % of what is seen; null: none. */
export const valueNear = (rows, curve, row, [from, to]) => {
  const { times, series } = rows;
  const { value } = series[curve];
  const reach = 0.01 * (to - from);
  const isNear = (i) => Math.abs(times[i] - times[row]) <= reach;
  for (let step = 0; step < times.length; step += 1) {
    const [before, after] = [row - step, row + step];
    const sees = [before, after].map((i) => i >= 0 && i < times.length && isNear(i));
    if (sees[0] && value[before] !== null) return value[before];
    if (sees[1] && value[after] !== null) return value[after];
    if (!sees[0] && !sees[1]) return null;
  }
  return null;
};
