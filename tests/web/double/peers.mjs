// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The double of peers: the first carries the cube along P1's path, the others' copies are where it
// was one delay ago. A second, turning body shows what a session with several bodies sends.

const path = (t) =>
  22 +
  Math.min(
    52.7,
    24.0 * Math.sin(2 * Math.PI * 0.484 * t + 3.09) +
      29.0 * Math.sin(2 * Math.PI * 0.501 * t + 3.24) +
      46.7 * Math.sin(2 * Math.PI * 0.383 * t + 4.43) +
      23.2 * Math.sin(2 * Math.PI * 0.254 * t + 5.32),
  );

const cubeX = (t) => path(Math.max(0, t)) / 1000;
const speedOf = (t) => (cubeX(t + 0.001) - cubeX(t - 0.001)) / 0.002;

export const letters = "ABCDEFGH";

export const paperScene = {
  ok: true,
  name: "paper",
  hash: "p",
  bodies: [
    {
      body: 0,
      name: "cube",
      shape: "box",
      half: [0.02, 0.02, 0.02],
      position: [0, 0, 0],
      orientation: [1, 0, 0, 0],
      movable: true,
      shared: true,
      turns: false,
      colour: "blue",
    },
    {
      body: 1,
      name: "static cube",
      shape: "box",
      half: [0.02, 0.02, 0.02],
      position: [0.1147, 0, 0.03],
      orientation: [1, 0, 0, 0],
      movable: false,
      shared: false,
      turns: false,
      colour: "pink",
    },
  ],
  hips: { radius: 0.005, count: 2 },
  planes: [{ name: "platform", normal: [0, 1, 0], offset: -0.02 }],
};

export const turningScene = {
  ...paperScene,
  name: "bench",
  hash: "b",
  bodies: [
    { ...paperScene.bodies[0], turns: true },
    {
      body: 1,
      name: "hammer",
      shape: "box",
      half: [0.012, 0.012, 0.02],
      position: [-0.04, 0, -0.05],
      orientation: [1, 0, 0, 0],
      movable: true,
      shared: true,
      turns: true,
      colour: "blue",
      parts: [
        {
          shape: "box",
          half: [0.04, 0.006, 0.006],
          position: [0.052, 0, 0],
          orientation: [1, 0, 0, 0],
        },
      ],
    },
    {
      body: 2,
      name: "ball",
      shape: "sphere",
      half: [0.015, 0.015, 0.015],
      position: [0.09, -0.005, 0.03],
      orientation: [1, 0, 0, 0],
      movable: true,
      shared: true,
      turns: false,
      colour: "blue",
    },
    {
      body: 3,
      name: "roller",
      shape: "capsule",
      half: [0.04, 0.008, 0.008],
      position: [-0.02, -0.012, 0.06],
      orientation: [1, 0, 0, 0],
      movable: false,
      shared: false,
      turns: false,
      colour: "pink",
    },
  ],
  fields: [
    { name: "wind", position: [0, 0.05, -0.04], half: [0.05, 0.03, 0.03], force: [0.8, 0, 0] },
  ],
};

const turnAbout = (angle) => [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0];

/** The newest frame of the peer at `place`, t seconds into the session; delays are in ms. */
export const peerFrame = ({ place, t, delayMs, frame, turning, phase, lost }) => {
  const seen = t - (place === 0 ? 0 : delayMs / 1000);
  const x = cubeX(seen);
  const v = speedOf(seen);
  const force = place === 0 ? 0.35 * v * 10 : 0.2 * Math.sin(3 * t);
  const side = place % 2 === 0 ? -1 : 1;
  const bodies = [
    {
      body: 0,
      position: [x, 0, 0],
      velocity: [v, 0, 0],
      orientation: turnAbout(0.6 * Math.sin(seen)),
    },
    {
      body: 1,
      position: [-0.04, 0, -0.05],
      velocity: [0, 0, 0],
      orientation: turnAbout(0.5 * seen),
    },
    {
      body: 2,
      position: [0.09, -0.005, 0.03 + 0.01 * Math.sin(seen)],
      velocity: [0, 0, 0],
      orientation: [1, 0, 0, 0],
    },
  ];
  return {
    ok: true,
    frame,
    at_ns: Math.round(t * 1e9),
    peer: place + 1,
    tick: Math.round(t * 1000),
    phase,
    session: { number: 7, at_s: t, phase },
    hip: [x + side * 0.0245, 0.002 * Math.sin(t), 0.012 * (place - 0.5)],
    hip_v: [v, 0, 0],
    cube: [x, 0, 0],
    cube_v: [v, 0, 0],
    ...(turning ? { bodies } : {}),
    hand_force: [force, 0, 0],
    body_force: [force, 0, 0],
    remote_force: [0, 0, 0],
    touching: true,
    remote_touching: false,
    remote_fresh: true,
    cube_x: { min: x - 0.0001, max: x + 0.0001 },
    force_n: { max: Math.abs(force) },
    late_us: { max: 40 + 25 * Math.random() },
    ticks: 16,
    missed: 0,
    heard: [
      {
        from: place === 0 ? 2 : 1,
        n: 16,
        lost,
        late: 0,
        delay_ms: { min: delayMs, mean: delayMs + 0.05, max: delayMs + 0.1 },
        age_ms: delayMs,
        offset_ms: 0,
        uncertainty_ms: 0,
      },
    ],
    governor: "active",
    fault: null,
  };
};

export const pairOf = (a, b, one, other) => ({
  a,
  b,
  at_ns: one.at_ns,
  apart_mm: 1000 * Math.abs(one.cube[0] - other.cube[0]),
  distance_mm: 1000 * Math.abs(one.cube[0] - other.cube[0]),
  uncertainty_ms: 0,
  cube_a: one.cube,
  cube_b: other.cube,
  force_apart_n: Math.abs(Math.abs(one.hand_force[0]) - Math.abs(other.hand_force[0])),
});
