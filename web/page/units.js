// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The values of a profile as texts with units, and the numbers that sliders show of them.

const times = { ns: 1e-6, us: 1e-3, ms: 1, s: 1000, min: 60000, h: 3600000 };
const rates = { "bit/s": 1, "kbit/s": 1e3, "Mbit/s": 1e6, "Gbit/s": 1e9, "Tbit/s": 1e12 };

const withUnit = (text, units) => {
  const found = /^\s*(-?[0-9.]+(?:e-?[0-9]+)?)\s*([a-zA-Z/%]*)\s*$/.exec(text ?? "");
  if (!found) return null;
  if (Number(found[1]) === 0) return 0;
  return Object.hasOwn(units, found[2]) ? Number(found[1]) * units[found[2]] : null;
};

export const parseTime = (text) => withUnit(text, times);
export const parseShare = (text) => withUnit(text, { "%": 1 });
export const parseRate = (text) => withUnit(text, rates);

/** The keys of a law that is written as a table, { law = "gamma", mean = "9ms" }; else null. */
export const parseLaw = (text) => {
  if (!/^\s*\{.*\}\s*$/.test(text ?? "")) return null;
  const law = {};
  for (const [, key, quoted, bare] of text.matchAll(/([a-z_]+)\s*=\s*(?:"([^"]*)"|([^,}\s]+))/g)) {
    law[key] = quoted ?? bare;
  }
  return law;
};

/** The constant part of a delay or jitter in ms and how far it varies; null where unknown. */
export const delayOf = (text) => {
  if (text === undefined) return { mean: 0, spread: 0 };
  const law = parseLaw(text);
  if (!law) return { mean: parseTime(text), spread: 0 };
  const mean = parseTime(law.value ?? law.mean ?? "0ms");
  const spread = parseTime(
    law.half_width ?? law.sd ?? (law.law === "exponential" ? law.mean : "0"),
  );
  return { mean, spread };
};

/** The jitter: as a bare time, it is the half width of a uniform law around 0. */
export const jitterOf = (text) => {
  const plain = parseTime(text);
  return plain === null ? delayOf(text) : { mean: 0, spread: plain };
};

/** The share lost in per cent: the sum of the laws that name one. */
export const lossOf = (text) => {
  if (text === undefined) return 0;
  const plain = parseShare(text);
  if (plain !== null) return plain;
  const burst = /^\s*"?(\d+)\/(\d+)"?\s*$/.exec(text);
  if (burst) return (100 * Number(burst[1])) / Number(burst[2]);
  const law = parseLaw(text);
  if (!law) return null;
  if (law.lost && law.of) return (100 * Number(law.lost)) / Number(law.of);
  if (law.every && /^\d+$/.test(law.every)) return 100 / Number(law.every);
  return parseShare(law.share);
};

const trimmed = (number) => String(Number(number.toPrecision(6)));
export const writeTime = (ms) => (ms === 0 ? "0ms" : `${trimmed(ms)}ms`);
export const writeShare = (percent) => `${trimmed(percent)}%`;
export const writeRate = (bits) => {
  const [unit, size] = Object.entries(rates)
    .reverse()
    .find(([, one]) => bits >= one) ?? ["bit/s", 1];
  return `${trimmed(bits / size)}${unit}`;
};

/** A number for people: few digits, thousands apart. */
export const spoken = (number, digits = 1) =>
  number === null || number === undefined || Number.isNaN(number)
    ? "–"
    : number.toLocaleString("en-GB", { maximumFractionDigits: digits }).replaceAll(",", "\u202f");

/** A message of the server with µs in place of us. */
export const withMicro = (words) => words.replace(/(\d ?)us\b/g, "$1µs");

/** A message of the server as a sentence. */
export const sentenceFrom = (words) =>
  words === "" ? "" : words[0].toUpperCase() + words.slice(1) + (/[.!?]$/.test(words) ? "" : ".");
