// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What the charts show: for each its title, unit, the label of its axis, where the values are from,
// least span and curves. A curve names a column of the figures; `band` draws from its least to its
// most, `dash` marks requested values, `beside` is a comparison that does not set the scale. A
// plot that is `robust` may cut peaks off, one that `needsEmulator` is empty without one.

import { colourOfAlgorithm, colourOfPeer } from "./paint/palette.js";

const pairsMax = 6; // curves in one chart that an eye can tell apart

const letters = (model) => new Map(model.peers.map((peer) => [peer.id, peer.letter]));

const pairCurves = (model) => {
  const letter = letters(model);
  const pairs = model.frame?.pairs ?? [];
  const hasOthers = (model.frame?.emulator?.others ?? []).length > 0;
  const algorithm = hasOthers ? `, ${model.peers[0]?.algorithm}` : "";
  return pairs.slice(0, pairsMax).map(({ a, b }, place) => ({
    name: `apart_mm:${a}-${b}`,
    label: `${letter.get(a) ?? a}–${letter.get(b) ?? b}${algorithm}`,
    colour: pairs.length === 1 ? "accent" : colourOfPeer(place),
    show: "mean",
    band: true,
  }));
};

/** Other algorithms, which play beside the chosen one under the same network. */
const otherCurves = (model) =>
  (model.frame?.emulator?.others ?? []).map(({ algorithm }) => ({
    name: `other_mm:${algorithm}`,
    label: algorithm,
    colour: colourOfAlgorithm(algorithm),
    show: "mean",
    beside: true,
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
    title: "Copies apart, along x",
    unit: "mm",
    label: "distance",
    source: "positions in the peers' frames, at equal times",
    span: 2,
    robust: true,
    curves: [...pairCurves(model), ...otherCurves(model)],
  },
  {
    key: "delay",
    title: "Delay: asked and measured",
    unit: "ms",
    label: "delay",
    source: model.state?.pace?.read_only
      ? "stamps in the peers' messages" : "datagrams that the emulator passed on",
    span: 5,
    needsEmulator: !model.state?.pace?.read_only,
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
    label: "loss",
    source: "datagrams that the emulator counted",
    needsEmulator: true,
    span: 2,
    curves: [...wayCurves("loss", ends)(path), ...asked("asked_loss", ends)(path)],
  },
  {
    key: "spread",
    title: "Jitter: longest − shortest delay in 1 s",
    unit: "ms",
    label: "spread of delay",
    source: "datagrams that the emulator counted",
    needsEmulator: true,
    span: 1,
    curves: [...wayCurves("spread_ms", ends)(path), ...asked("asked_spread_ms", ends)(path)],
  },
  {
    key: "force",
    title: "Force on each hand",
    unit: "N",
    label: "force",
    source: "what each hand's device was told",
    span: 0.5,
    curves: peerCurves(model, "force_n"),
  },
  {
    key: "late",
    title: "Late: ticks of the peers, datagrams of the emulator",
    unit: "µs",
    label: "lateness",
    source: "clocks of the peers' loops and of the emulator",
    span: 100,
    curves: [
      ...peerCurves(model, "peer_late_us").map((curve) => ({
        ...curve,
        label: `tick of ${curve.label}`,
      })),
      ...wayCurves("late_us", ends, { show: "most" })(path).map((curve, i) => ({
        ...curve,
        label: `emulator ${curve.label}`,
        colour: ["sep", "other"][i],
      })),
    ],
  },
];
