// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The origin of results and whether they count, from their manifests.

import { banner, folded, general, name, notValid, paragraph, table, words } from "./words.js";

const isValid = ({ manifest }) => manifest.valid === true;

/** The last part of a folder's path: where the page lies says the rest. */
const nameOf = ({ folder }) => folder.split("/").filter((part) => part !== "").at(-1) ?? ".";

/** "1 to 40" of whole numbers that follow one another; nothing for what is none. */
const rangeOf = (list) => {
  const follows = list.length >= 3
    && list.every((value, i) => Number.isInteger(value) && value === list[0] + i);
  return follows ? `${list[0]} to ${list.at(-1)}` : "";
};

/** What a person reads of a value: texts without quotes, lists with commas. */
const wordsOf = (value) => {
  if (value === null || value === undefined) return "–";
  if (typeof value === "number") return Number.isInteger(value) ? String(value) : general(value, 4);
  if (Array.isArray(value)) return rangeOf(value) || value.map(wordsOf).join(", ");
  if (typeof value !== "object") return String(value);
  return Object.entries(value).map(([key, one]) => `${key} ${wordsOf(one)}`).join(", ");
};

const isObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);
/** Objects in objects, such as the demo's configuration, are shown as JSON. */
const isNested = (value) => isObject(value) && Object.values(value).some(isObject);

/** "speed_ratio" as "speed ratio", "wall_time_s" as "wall time, s". */
const titleOf = (key) => key.replace(/_s$/, ", s").replaceAll("_", " ");

/** All that a manifest says; what has lines of its own, as the configuration, below the rest. */
const detailsOf = (run) => {
  const { manifest } = run;
  const entries = Object.entries(manifest).map(([key, value]) =>
    [titleOf(key), isNested(value) ? JSON.stringify(value, null, 2) : wordsOf(value)]);
  const isLong = ([, text]) => text.includes("\n");
  return folded([`${nameOf(run)}: `, { code: wordsOf(manifest.command) }], [
    table(nameOf(run), ["key", "value"],
      entries.filter((entry) => !isLong(entry)).map(([title, text]) => [title, words(text)])),
    ...entries.filter(isLong).flatMap(([title, text]) => [paragraph(`${title}:`), { pre: text }]),
  ]);
};

export const runs = (section, data) => [
  table("What was run", ["folder", "title", "wall time, s", "simulated, s",
    "times faster\nthan real time", "sessions", "seeds", "valid"],
  data.runs.map((run) => {
    const says = (key) => wordsOf(run.manifest[key]);
    return [nameOf(run), words(says("title")), says("wall_time_s"), says("simulated_s"),
      says("speed_ratio"), name(says("sessions")), name(says("seeds")),
      isValid(run) ? name("valid") : { text: "not valid", style: "name missed" }];
  })),
  ...(data.runs.length > 1 ? [{ list: data.played }] : []),
  ...data.runs.map(detailsOf),
];

const reasonsOf = (run) => {
  if (isValid(run)) return [];
  const { invalid_because: reasons, kind } = run.manifest;
  const said = Array.isArray(reasons) && reasons.length > 0
    ? reasons.map((reason) => (typeof reason === "string" ? reason : JSON.stringify(reason)))
    : [kind === "real-time" ? "not every session over real UDP kept its timing"
      : "the manifest does not say why"];
  return said.map((reason) => ({ reason, name: nameOf(run) }));
};

/** Each reason once, with the runs that have it where there are several. */
const joined = (reasons, isOne) => [...new Set(reasons.map(({ reason }) => reason))]
  .map((reason) => {
    const names = reasons.filter((one) => one.reason === reason).map(({ name: of }) => of);
    return isOne ? reason : `${[...new Set(names)].join(", ")}: ${reason}`;
  });

/** "3 of 40 seeds and 6 of 30 s": by what a run falls short of the built-in one; "" by nothing. */
const shortfallOf = ({ amounts }) => {
  if (!amounts?.meant) return "";
  const { played, meant } = amounts;
  return [["seeds", "seeds"], ["duration_s", "s"]].filter(([key]) => played[key] < meant[key])
    .map(([key, unit]) => `${general(played[key], 4)} of ${general(meant[key], 4)} ${unit}`)
    .join(" and ");
};

/**
 * Of the runs of a kind the first that falls short of what its results are stated for: {words,
 * endsEarly}; null: all were played in full.
 */
export const firstLookOf = ({ runs: all }, kind) => {
  const run = all.find((one) => one.manifest.kind === kind && shortfallOf(one) !== "");
  if (!run) return null;
  const { played, meant } = run.amounts;
  const [lasts, whole] = [played, meant].map(({ duration_s: length }) => general(length, 4));
  const endsEarly = played.duration_s < meant.duration_s
    ? `the sessions last ${lasts} of ${whole} s` : "";
  return { words: `Played with ${shortfallOf(run)}: a first look, not a verdict.`, endsEarly };
};

/**
 * By what runs fall short of the built-in experiments that they are: a sentence for the head of the
 * page; "" where they do not. Claims say it themselves.
 */
export const shortfallWords = ({ runs: all }) => {
  const short = all.filter((run) => run.manifest.kind !== "claims" && run.amounts?.built_in
    && shortfallOf(run) !== "");
  if (short.length === 0) return "";
  const isJudged = short.some((run) => run.manifest.kind === "limits");
  const said = all.length === 1 ? [shortfallOf(short[0])]
    : short.map((run) => `${nameOf(run)} ${shortfallOf(run)}`);
  return `Played with ${said.join("; ")}: a first look${isJudged ? ", not a verdict" : ""}.`;
};

/** Says why results do not count; that they do stands where it is told what was played. */
export const validity = ({ runs: all, subject }) => {
  const reasons = all.flatMap(reasonsOf);
  if (reasons.length > 0) return [notValid(joined(reasons, all.length === 1))];
  if (all.length > 0 || subject === "session") return [];
  return [banner("", "There is no manifest.json: it is not known how these numbers came about and "
    + "whether they are valid.")];
};
