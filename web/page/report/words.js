// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// How numbers and names are written on a page of results, and blocks of document.js made of them.

/** To so many decimals, a tie to the even digit as in the program's own texts; "–" for none. */
export const shown = (value, decimals) => {
  if (value === null || value === undefined) return "–";
  const text = value.toFixed(decimals);
  if (Number(text) === 0) return (0).toFixed(decimals);
  const exact = Math.abs(value).toFixed(decimals + 30);
  if (!/^50+$/.test(exact.slice(-30)) || Number(text.at(-1)) % 2 === 0) return text;
  return (Number(text) - Math.sign(value) * 10 ** -decimals).toFixed(decimals);
};

/** With so many digits at most: "160", "4.5", "1.2e-07". */
export const general = (value, digits = 6) => {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const power = Number(value.toExponential(digits - 1).split("e")[1]);
  if (power >= -4 && power < digits) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const sign = exponent.startsWith("-") ? "-" : "+";
  return `${Number(mantissa)}e${sign}${exponent.replace(/[+-]/, "").padStart(2, "0")}`;
};

const peopleSay = {
  percent: "%", of_100: "of 100", "random-loss": "random loss", "burst-loss": "burst loss",
  interval: "interval between messages",
};
/** What programs call otherwise than people. */
export const inWords = (name) => peopleSay[name] ?? name;

/** As many digits as a limit is worth. */
const roundedLimit = (limit) => shown(limit, limit < 20 ? 1 : 0);
const above = ({ bound }) => (bound === ">" ? "> " : "");
export const limitText = (row) => `${above(row)}${roundedLimit(row.limit)}`;
/** "> 320 ms", "93 %": with every digit. */
export const exactLimit = (row, limit = row.limit) =>
  `${limit === row.limit ? above(row) : ""}${general(limit)} ${inWords(row.unit)}`;

/**
 * What reaches from low to high of a result of so many seeds; `least` are the fewest that give a
 * 95 % interval, which the page carries.
 */
export const spreadName = (seeds, least) =>
  (seeds >= least ? "95 %" : `least to most of ${seeds} seeds`);
/** "140 … 150" of a row of so many seeds; one seed has no interval. */
export const hasInterval = ({ ci_low: low, seeds }) =>
  low !== null && low !== undefined && seeds !== 1;

export const distinct = (rows, nameOf) => [...new Set(rows.map(nameOf))];
export const median = (values) => {
  const sorted = values.toSorted((a, b) => a - b);
  const middle = Math.floor(sorted.length / 2);
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
};

/** The rows of a table as objects by the keys of its columns. */
export const rowsOf = (table) => (table?.rows ?? []).map((cells) =>
  Object.fromEntries(table.columns.map(({ key }, i) => [key, cells[i]])));

// Pieces of texts, and blocks.

export const bold = (words) => ({ b: words });
export const badge = (words, style = "") => ({ badge: words, style });
/** A badge of a word, in the look that it has in report.css; nothing for none. */
export const wordBadge = (word) => (word ? badge(word, word) : "");
export const classBadge = (word) => (word ? badge(word) : "");

const tierSymbols = { good: "●", usable: "○", unusable: "×" };
export const tierBadge = (tier) => badge(`${tierSymbols[tier]} ${tier}`, `tier-${tier}`);

/** "met" and the like: how a result stands to the paper's, by the status of a limit. */
export const claimOf = (status) =>
  (/-missed$/.test(status) ? "missed" : /-met$/.test(status) ? "met" : status ?? "");
/** Green is for predictions alone: the rest could hardly have come out otherwise. */
export const statusBadge = (status, isFirstLook = false) => {
  const claim = claimOf(status);
  if (status && isFirstLook) return badge(`first look: ${claim}`, "seen");
  const isSeen = claim === "met" && status !== "predicted-met";
  return status ? badge(status, isSeen ? "seen" : claim) : "";
};

export const styled = (style) => (text) => ({ text, style });
export const name = styled("name");
export const words = styled("words");
export const ours = (text, isMissed = false) =>
  ({ text, style: isMissed ? "ours missed" : "ours" });

export const paragraph = (text) => ({ p: text });
export const heading = (text) => ({ heading: text });
export const table = (caption, heads, rows) => ({ table: { caption, heads, rows } });
export const banner = (style, text, list = []) => ({ banner: text, style, list });
export const folded = (text, blocks) => ({ folded: text, blocks });
export const panels = (size, blocks) => ({ panels: size, blocks });
export const zoomed = (blocks) => ({ zoomed: true, blocks });
export const figures = (ids) => ids.map((figure) => ({ figure }));

/** Where "usable" and "good" are used: the first such place of a page says what they mean. */
export const tierMark = { tiers: true };

/** Says that numbers do not count, and each reason. */
export const notValid = (reasons) =>
  banner("missed", [bold("Not valid."), " These numbers do not count:"], reasons);

const [digits, wholeFrom] = [4, 1000];
/** A number with a decimal point, to four digits; other texts stay. */
export const fewDigits = (text) => {
  if (!/^-?\d+\.\d+$/.test(text)) return text;
  const value = Number(text);
  if (value === 0) return "0";
  if (Math.abs(value) >= wholeFrom) return value.toFixed(0);
  const decimals = digits - 1 - Math.floor(Math.log10(Math.abs(value)));
  return shown(value, Math.min(decimals, text.split(".")[1].length));
};

/** What a terminal shows as text, with its remarks below. */
export const textTable = ({ caption, unit, heads, rows, remarks }) => {
  const hasNotes = rows.some(({ note }) => note !== "");
  const cellsOf = (row) => [
    row.name, ...row.cells.map(fewDigits), ...Array(heads.length - row.cells.length).fill(""),
    ...(hasNotes ? [words(row.note)] : []),
  ];
  const shownTable = table(caption, [unit, ...heads, ...(hasNotes ? [""] : [])], rows.map(cellsOf));
  return remarks.length === 0 ? [shownTable]
    : [panels("", [shownTable, ...remarks.map(paragraph)])];
};
