// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Axes: from values to pixels and back, with round values to mark.

/** 1, 2 or 5 times a power of ten: about so many of these from low to high. */
const stepOf = (low, high, count) => {
  const span = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(span));
  return [1, 2, 5, 10].map((factor) => factor * power).find((one) => one >= span * 0.999);
};

/** About `count` round values from low to high. */
export const roundMarks = (low, high, count) => {
  const step = stepOf(low, high, count);
  const marks = [];
  for (let mark = Math.ceil(low / step) * step; mark <= high + 1e-9 * step; mark += step) {
    marks.push(Number(mark.toPrecision(10)));
  }
  return marks;
};

/** Powers of ten within the range; over less than two decades also 2 and 5 times each. */
const logMarks = (low, high, count) => {
  const [begin, end] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
  const every = Math.max(1, Math.ceil((end - begin) / count));
  const factors = Math.log10(high / low) < 2 ? [1, 2, 5] : [1];
  const marks = [];
  for (let exponent = begin; exponent <= end; exponent += every) {
    marks.push(...factors.map((factor) => Number((factor * 10 ** exponent).toPrecision(3))));
  }
  const within = marks.filter((mark) => mark >= 0.999 * low && mark <= 1.001 * high);
  return within.length > 1 ? within : roundMarks(low, high, count);
};

/** From a round value at or below low to one at or above high: no value lies beyond the marks. */
export const roundSpan = ([low, high]) => {
  const step = stepOf(low, high, 5);
  return [Math.floor, Math.ceil].map((round, i) =>
    Number((round([low / step + 1e-9, high / step - 1e-9][i]) * step).toPrecision(10)));
};

/** A mark as text: "0.25", beyond thousands "1e4" on a logarithmic axis. */
const textOf = (mark, isLog) => (isLog && (mark > 1e3 || mark < 1e-3)
  ? mark.toExponential().replace("e+", "e") : String(Number(mark.toPrecision(6))));

/** {pixel(value), value(pixel), marks(count), says(mark)}: from [low, high] to [from, to]. */
export const scaleOf = ([low, high], [from, to], isLog = false) => {
  const [map, back] = isLog ? [Math.log10, (at) => 10 ** at] : [(at) => at, (at) => at];
  const [begin, end] = [map(low), map(high)];
  return {
    pixel: (value) => from + ((map(value) - begin) / (end - begin)) * (to - from),
    value: (at) => back(begin + ((at - from) / (to - from)) * (end - begin)),
    marks: (count) => (isLog ? logMarks : roundMarks)(low, high, count),
    says: (mark) => textOf(mark, isLog),
  };
};

/**
 * The least and the most of the finite numbers; whole decades if `isLog`; never a single value:
 * that stands at the end of an axis from zero.
 */
export const spanOf = (numbers, isLog) => {
  let [least, most] = [Infinity, -Infinity];
  for (const value of numbers) {
    if (!Number.isFinite(value) || (isLog && value <= 0)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  if (!(least <= most)) return isLog ? [0.1, 10] : [-1, 1];
  if (isLog) {
    const low = Math.floor(Math.log10(least));
    return [10 ** low, 10 ** Math.max(Math.ceil(Math.log10(most)), low + 1)];
  }
  if (least < most) return [least, most];
  return least === 0 ? [0, 1] : [Math.min(least, 0), Math.max(most, 0)];
};

/** The index of the value that is nearest to x in an ascending list. */
export const nearest = (values, x) => {
  let [low, high] = [0, values.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < x) low = middle + 1;
    else high = middle;
  }
  return low > 0 && x - values[low - 1] < values[low] - x ? low - 1 : low;
};
