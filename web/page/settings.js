// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The settings with a slider: how they read a condition, and what they request.

import {
  jitterOf,
  delayOf,
  lossOf,
  parseLaw,
  parseRate,
  parseShare,
  parseTime,
  spoken,
  writeRate,
  writeShare,
  writeTime,
} from "./units.js";

// bit/s; a session needs 1.4e6
const rates = [1e5, 2e5, 5e5, 1e6, 1.2e6, 1.5e6, 2e6, 5e6, 1e7, 1e8];

/** A law in a few words: "gamma 9 ± 6 ms". */
const wordsOfLaw = (text, unit) => {
  const law = parseLaw(text);
  if (!law) return text;
  const numbers = [law.value ?? law.mean ?? law.share, law.half_width ?? law.sd].filter(Boolean);
  return numbers.length > 0 ? `${law.law ?? ""} ${numbers.join(" ± ")}`.trim() : (law.law ?? unit);
};

/** {number, note}: where the slider stands, and a note where it cannot show all of it. */
const plain = (parse, other) => (text) => {
  if (text === undefined) return { number: 0, note: "" };
  const number = parse(text);
  return number !== null
    ? { number, note: "" }
    : { number: other(text) ?? 0, note: wordsOfLaw(text) };
};

export const settings = [
  {
    key: "delay",
    label: "delay",
    unit: "ms",
    most: 400,
    step: 1,
    limit: 10000,
    read: plain(parseTime, (text) => delayOf(text).mean),
    write: writeTime,
  },
  {
    key: "jitter",
    label: "jitter ±",
    unit: "ms",
    most: 60,
    step: 0.5,
    limit: 1000,
    read: plain(parseTime, (text) => jitterOf(text).spread),
    write: writeTime,
  },
  {
    key: "loss",
    label: "loss",
    unit: "%",
    most: 100,
    step: 0.5,
    limit: 100,
    read: plain(parseShare, lossOf),
    write: writeShare,
  },
  {
    key: "duplicate",
    label: "duplicate",
    unit: "%",
    most: 50,
    step: 0.5,
    limit: 100,
    read: plain(parseShare, (text) => parseShare(parseLaw(text)?.share)),
    write: writeShare,
  },
  {
    key: "reorder",
    label: "reorder",
    unit: "%",
    most: 50,
    step: 0.5,
    limit: 100,
    read: (text) => {
      const number = text === undefined ? 0 : (parseShare(parseLaw(text)?.share ?? text) ?? 0);
      return { number, note: number > 0 ? `by ${parseLaw(text)?.displacement ?? "some"}` : "" };
    },
    write: (percent) => `{ share = "${writeShare(percent)}", displacement = 3 }`,
  },
  {
    key: "rate",
    label: "rate",
    unit: "Mbit/s",
    most: rates.length,
    step: 1,
    limit: 1e6,
    none: "any",
    // The slider counts through round rates; 0 is none.
    read: (text) => {
      const bits = parseRate(parseLaw(text)?.limit ?? text ?? "0") ?? 0;
      return { number: bits / 1e6, note: "" };
    },
    write: (megabits) => (megabits === 0 ? "0bit/s" : writeRate(megabits * 1e6)),
    toSlider: (megabits) =>
      megabits === 0 ? rates.length : rates.findLastIndex((rate) => rate <= megabits * 1e6 * 1.001),
    fromSlider: (place) => (place >= rates.length ? 0 : rates[Math.max(0, place)] / 1e6),
  },
];

export const orders = ["keep", "free", "sorted"];

export const spokenSetting = (setting, number) =>
  setting.none && number === 0 ? setting.none : `${spoken(number, 2)} ${setting.unit}`;
