// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Where everything is in one live frame: a Map of sides for the painters, in mm and N.

import { colourOfAlgorithm } from "./paint/palette.js";
import { noTurn, subtract } from "./paint/vector.js";
import { millimetres } from "./scene.js";

const poseOf = (body) => ({
  at: millimetres(body.position),
  turn: body.orientation ?? noTurn,
});

const bodiesOf = (peer, shared) => {
  const bodies = new Map();
  if (peer.cube && shared !== null)
    bodies.set(shared, { at: millimetres(peer.cube), turn: noTurn });
  for (const body of peer.bodies ?? []) bodies.set(body.body, poseOf(body));
  return bodies;
};

/** At equal times, how far the first shared body of each other peer is from this one's. */
const offsetsOf = (id, pairs) => {
  const offsets = new Map();
  for (const pair of pairs) {
    if (!pair.cube_a || !pair.cube_b) continue;
    const way = millimetres(subtract(pair.cube_b, pair.cube_a));
    if (pair.a === id) offsets.set(pair.b, way);
    if (pair.b === id)
      offsets.set(
        pair.a,
        way.map((value) => -value),
      );
  }
  return offsets;
};

/** Where the first shared body of that side is with each other algorithm, and its colour. */
const besideOf = (place, others) => others.map(({ algorithm, cube_a: a, cube_b: b }) => ({
  algorithm, tint: colourOfAlgorithm(algorithm), at: millimetres(place === 0 ? a : b),
}));

/** The pairs whose positions are known: their first shared body's x at one time, mm. */
const pairsOf = (pairs) =>
  pairs
    .filter((pair) => pair.cube_a && pair.cube_b)
    .map(({ a, b, cube_a: one, cube_b: other, uncertainty_ms: doubt }) => ({
      a, b, x: [1000 * one[0], 1000 * other[0]], uncertainty_ms: doubt,
    }));

/** `peers` are those of the state, `shared` the number of the first shared body. */
export const momentOf = (frame, peers, shared) => {
  const sides = new Map();
  (frame.peers ?? []).forEach((peer, place) => {
    const id = peers[place]?.id ?? peer?.peer;
    if (!peer || id === undefined) return;
    sides.set(id, {
      id,
      place,
      hip: peer.hip ? millimetres(peer.hip) : null,
      force: peer.hand_force ?? null,
      speed: peer.cube_v ? Math.hypot(...peer.cube_v) : 0,
      bodies: bodiesOf(peer, shared),
      offsets: offsetsOf(id, frame.pairs ?? []),
      beside: besideOf(place, frame.emulator?.others ?? []),
    });
  });
  return { at: frame.at_s, sides, pairs: pairsOf(frame.pairs ?? []) };
};
