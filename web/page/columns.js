// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Figures over time: named columns, each with mean (or newest), least and most, of the newest rows.

const grown = (old, size) => {
  const next = new Float64Array(size).fill(NaN);
  next.set(old);
  return next;
};

const summaryOf = ({ value, least, most }, begin, end) => {
  let [sum, count, low, high] = [0, 0, Infinity, -Infinity];
  for (let i = begin; i < end; i += 1) {
    if (!Number.isFinite(value[i])) continue;
    sum += value[i];
    count += 1;
    low = Math.min(low, least[i]);
    high = Math.max(high, most[i]);
  }
  return count > 0 ? { mean: sum / count, least: low, most: high } : null;
};

export class Columns {
  /** Keeps rows of the last `seconds`, at most `most` of them. */
  constructor(seconds, most) {
    this.seconds = seconds;
    this.most = most;
    this.clear();
  }

  clear() {
    this.first = 0;
    this.end = 0;
    this.times = new Float64Array(2 * this.most);
    this.columns = new Map();
  }

  get length() {
    return this.end - this.first;
  }
  get newest() {
    return this.length > 0 ? this.times[this.end - 1] : NaN;
  }
  get oldest() {
    return this.length > 0 ? this.times[this.first] : NaN;
  }

  /**
   * A row of {name: number | [value, least, most]}. One of the newest time adds to that row, as
   * peers and emulator may tell of a moment apart; an earlier one is left out.
   */
  push(time, row) {
    if (this.length > 0 && time < this.newest) return;
    if (this.length === 0 || time > this.newest) this.#begin(time);
    for (const [name, cell] of Object.entries(row)) {
      const column = this.columns.get(name) ?? this.#add(name);
      const [value, least, most] = Array.isArray(cell) ? cell : [cell, cell, cell];
      column.value[this.end - 1] = value ?? NaN;
      column.least[this.end - 1] = least ?? NaN;
      column.most[this.end - 1] = most ?? NaN;
    }
    const start = time - this.seconds;
    while (this.times[this.first] < start || this.length > this.most) this.first += 1;
  }

  /** A row in which nothing is known yet. */
  #begin(time) {
    if (this.end === this.times.length) this.#compact();
    this.times[this.end] = time;
    for (const { value, least, most } of this.columns.values())
      value[this.end] = least[this.end] = most[this.end] = NaN;
    this.end += 1;
  }

  #add(name) {
    const make = () => grown([], this.times.length);
    const column = { value: make(), least: make(), most: make() };
    this.columns.set(name, column);
    return column;
  }

  #compact() {
    const move = (array) => array.copyWithin(0, this.first, this.end);
    move(this.times);
    for (const column of this.columns.values()) Object.values(column).forEach(move);
    this.end -= this.first;
    this.first = 0;
  }

  /** Index of the first row at or after the time. */
  indexAt(time) {
    let [low, high] = [this.first, this.end];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The part from time to time: {times, of(name) -> {value, least, most}}, without copies. */
  window(from, to) {
    const [begin, end] = [this.indexAt(from), Math.min(this.indexAt(to) + 1, this.end)];
    const nothing = new Float64Array(Math.max(0, end - begin)).fill(NaN);
    const of = (name) => {
      const column = this.columns.get(name);
      if (!column) return { value: nothing, least: nothing, most: nothing };
      const cut = (array) => array.subarray(begin, end);
      return { value: cut(column.value), least: cut(column.least), most: cut(column.most) };
    };
    return { times: this.times.subarray(begin, end), of };
  }

  /**
   * At most about `count` points for a chart: {times, series: [{value, least, most}]}, lists with
   * null for gaps. Stretches keep to fixed times, so that a running chart does not shimmer.
   */
  sampled(names, from, to, count) {
    const part = this.window(from, to);
    const columns = names.map(part.of);
    const step = Math.max((to - from) / count, 1e-6);
    const times = [];
    const series = names.map(() => ({ value: [], least: [], most: [] }));
    const { length } = part.times;
    for (let begin = 0; begin < length;) {
      const stretch = Math.floor(part.times[begin] / step);
      let end = begin + 1;
      while (end < length && Math.floor(part.times[end] / step) === stretch) end += 1;
      times.push(part.times[end - 1]);
      columns.forEach((column, i) => {
        const cell = summaryOf(column, begin, end);
        series[i].value.push(cell?.mean ?? null);
        series[i].least.push(cell?.least ?? null);
        series[i].most.push(cell?.most ?? null);
      });
      begin = end;
    }
    return { times, series };
  }

  /** Mean, least and most of a column over the last seconds before `to`; null without any. */
  summary(name, seconds, to = this.newest) {
    const part = this.window(to - seconds, to);
    return summaryOf(part.of(name), 0, part.times.length);
  }
}
