// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// How results came about, and whether they count: what their manifests say.

import { banner, bold, folded, general, name, notValid, paragraph, table, words } from "./words.js";

const isValid = ({ manifest }) => manifest.valid === true;

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
const detailsOf = ({ folder, manifest }) => {
  const entries = Object.entries(manifest).map(([key, value]) =>
    [titleOf(key), isNested(value) ? JSON.stringify(value, null, 2) : wordsOf(value)]);
  const isLong = ([, text]) => text.includes("\n");
  return folded([`${folder}: `, { code: wordsOf(manifest.command) }], [
    table(folder, ["", "value"],
      entries.filter((entry) => !isLong(entry)).map(([title, text]) => [title, words(text)])),
    ...entries.filter(isLong).flatMap(([title, text]) => [paragraph(`${title}:`), { pre: text }]),
  ]);
};

export const runs = (section, data) => [
  table("What was run", ["folder", "title", "wall time, s", "simulated, s",
    "times faster\nthan real time", "sessions", "seeds", "valid"],
  data.runs.map((run) => {
    const says = (key) => wordsOf(run.manifest[key]);
    return [run.folder, words(says("title")), says("wall_time_s"), says("simulated_s"),
      says("speed_ratio"), name(says("sessions")), name(says("seeds")),
      isValid(run) ? name("valid") : { text: "not valid", style: "name missed" }];
  })),
  ...data.runs.map(detailsOf),
];

const reasonsOf = (run) => {
  if (isValid(run)) return [];
  const { invalid_because: reasons, kind } = run.manifest;
  const said = Array.isArray(reasons) && reasons.length > 0
    ? reasons.map((reason) => (typeof reason === "string" ? reason : JSON.stringify(reason)))
    : [kind === "real-time" ? "not every session over real UDP kept its timing"
      : "does not say why"];
  return said.map((reason) => `${run.folder}: ${reason}`);
};

/** The banner that says whether results are valid, and why not; recorded sessions say it alone. */
export const validity = ({ runs: all, subject }) => {
  const reasons = all.flatMap(reasonsOf);
  if (reasons.length > 0)
    return [notValid(reasons)];
  if (all.length > 0)
    return [banner("met", [bold("Valid."), " All runs completed and passed their own validity "
      + "checks."])];
  if (subject === "session") return [];
  return [banner("", "There is no manifest.json: it is not known how these numbers came about and "
    + "whether they are valid.")];
};
