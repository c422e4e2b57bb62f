// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the session is doing, whether it counts, and what can be done next, in words.

import { sentenceFrom, withMicro } from "./units.js";

const acts = { starting: "starts", stopping: "stops", failed: "has failed", running: "plays" };

/** Whether a run in real time counts, by the verdict of the server; "" where it has none. */
const verdictOf = (last) => {
  if (!last) return "";
  if (last.valid) {
    return "It is valid as a measurement: of 100 ticks and datagrams, 99 were at most 1 ms late.";
  }
  return `It is not valid as a measurement: ${withMicro(last.invalid_because.join("; "))}.`;
};

const inVirtualTime = (state, name) => {
  const { pace, stage } = state;
  if (pace.state === "playing") return { brief: `${name} plays`, says: "" };
  if (pace.state === "paused") return { brief: `${name} is paused`, says: "" };
  const next = pace.read_only
    ? "Play it again, or go to any moment of it in the timeline."
    : "Play it again from its seed, go to any moment of it in the timeline, or save it as an "
      + `experiment${stage?.available ? "; Restart plays with other settings" : ""}.`;
  const counts = pace.read_only ? "" : " It is valid: in virtual time nothing is late.";
  const brief = `${name} has ended`;
  return { brief, says: `${sentenceFrom(brief)}${counts} ${next}` };
};

/**
 * {brief, says}: what the session is doing, in a few words, and what has come of it and can be done
 * next, in sentences; these are "" while it plays.
 */
export const statusOf = (state) => {
  const { stage, pace } = state;
  const name = stage?.run > 0 ? `run ${stage.run}` : "the session";
  if (pace) return inVirtualTime(state, pace.read_only ? "the record" : name);
  if (!stage?.available) return { brief: "", says: sentenceFrom(state.help ?? "") };
  if (stage.state !== "stopped") return { brief: `${name} ${acts[stage.state]}`, says: "" };
  if (stage.run === 0) return { brief: "nothing plays", says: "Nothing plays yet. Press Start." };
  const verdict = verdictOf(stage.last);
  const files = verdict === "" ? "" : "; its files are listed at the end of the page";
  const brief = `${name} has ended`;
  const sentences = [sentenceFrom(brief), verdict, `Start plays again${files}.`];
  return { brief, says: sentences.filter((one) => one !== "").join(" ") };
};

/** True if a run of the stage is over, and the next has not begun. */
export const isOver = (state) => {
  const { stage, pace } = state ?? {}; // null before the first state
  return Boolean(stage?.available) && stage.state === "stopped" && stage.run > 0 && !pace;
};

/** Why a figure has nothing to show, in a sentence. */
export const whyEmpty = (state, figure) => {
  const { stage, pace, emulator } = state ?? {};
  if (pace?.read_only && figure.needsEmulator)
    return "What the emulator did is not in the records.";
  if (figure.needsEmulator && !emulator?.attached && stage?.state === "running")
    return "No emulator is attached.";
  if (stage?.available && stage.state !== "running" && !pace) return "Nothing plays. Press Start.";
  if (pace && pace.state !== "playing")
    return "Time stands still, and this page has seen nothing of this figure. Press Play.";
  return "No value has come yet.";
};
