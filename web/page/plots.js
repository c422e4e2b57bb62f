// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the charts show: for each its title, unit, least span and curves. A curve names a column of
// the figures; `band` draws from its least to its most, `dash` is what was asked for.

import { colourOfPeer } from "./paint/palette.js";

const pairsMax = 6; // curves in one chart that an eye can tell apart

const letters = (model) => new Map(model.peers.map((peer) => [peer.id, peer.letter]));

const pairCurves = (model) => {
  const letter = letters(model);
  const pairs = model.frame?.pairs ?? [];
  return pairs.slice(0, pairsMax).map(({ a, b }, place) => ({
    name: `apart_mm:${a}-${b}`,
    label: `${letter.get(a) ?? a}–${letter.get(b) ?? b}`,
    colour: pairs.length === 1 ? "accent" : colourOfPeer(place),
    show: "mean",
    band: true,
  }));
};

/** Other algorithms, which play beside the chosen one under the same network. */
const otherCurves = (model) =>
  (model.frame?.emulator?.others ?? []).map(({ algorithm }, i) => ({
    name: `other_mm:${algorithm}`,
    label: algorithm,
    colour: ["sep", "other"][i],
    show: "mean",
  }));

const wayCurves =
  (figure, ends, more = {}) =>
  (path) =>
    [
      ["up", "left"],
      ["down", "right"],
    ].map(([way, colour], i) => ({
      name: `${way}.${figure}:${path}`,
      label: i === 0 ? `${ends[0]} → ${ends[1]}` : `${ends[1]} → ${ends[0]}`,
      colour,
      show: "mean",
      ...more,
    }));

const asked = (figure, ends) => (path) =>
  wayCurves(
    figure,
    ends,
  )(path).map((curve) => ({
    ...curve,
    label: `${curve.label} asked`,
    dash: true,
    colour: "ink",
  }));

const peerCurves = (model, figure) =>
  model.peers.map((peer, place) => ({
    name: `${figure}:${peer.id}`,
    label: peer.letter,
    colour: colourOfPeer(place),
    show: "most",
  }));

/** What the peers heard, where nothing is known of the emulator. */
const heardCurves = (model) =>
  model.peers.map((peer, place) => ({
    name: `heard_delay_ms:${peer.id}`,
    label: `to ${peer.letter}`,
    colour: colourOfPeer(place),
    show: "mean",
    band: true,
  }));

/** The charts for that path of the emulator, whose ends have these two letters. */
export const plotsOf = (model, path, ends) => [
  {
    key: "apart",
    title: "Copies apart, |x₁ − x₂|",
    unit: "mm",
    span: 2,
    curves: [...pairCurves(model), ...otherCurves(model)],
  },
  {
    key: "delay",
    title: "Delay: asked and measured",
    unit: "ms",
    span: 5,
    curves: model.state?.pace?.read_only
      ? heardCurves(model)
      : [
          ...wayCurves("delay_ms", ends, { band: true })(path),
          ...asked("asked_ms", ends)(path),
        ],
  },
  {
    key: "loss",
    title: "Loss, over 1 s",
    unit: "%",
    span: 2,
    curves: [...wayCurves("loss", ends)(path), ...asked("asked_loss", ends)(path)],
  },
  {
    key: "spread",
    title: "Jitter: longest − shortest delay in 1 s",
    unit: "ms",
    span: 1,
    curves: wayCurves("spread_ms", ends)(path),
  },
  {
    key: "force",
    title: "Force on each hand",
    unit: "N",
    span: 0.5,
    curves: peerCurves(model, "force_n"),
  },
  {
    key: "late",
    title: "Late: ticks of the peers, datagrams of the emulator",
    unit: "µs",
    span: 100,
    curves: [
      ...peerCurves(model, "peer_late_us").map((curve) => ({
        ...curve,
        label: `peer ${curve.label}`,
      })),
      ...wayCurves("late_us", ends, { show: "most" })(path).map((curve, i) => ({
        ...curve,
        label: `emulator ${["up", "down"][i]}`,
        colour: ["sep", "other"][i],
      })),
    ],
  },
];
