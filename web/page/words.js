// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A sentence on each task and algorithm, for people who meet them first on this page.

export const tasks = {
  P1: "A holds the cube and carries it to and fro, always in the same way; B watches. It is the "
    + "paper's Table 1.",
  T1: "A pushes the cube to the right, B pushes it back to the left, by turns.",
  T2: "One side holds the cube and the other presses against it; then they swap.",
  T3: "Both squeeze the cube between them and carry it to and fro.",
  T4: "Both squeeze the cube, lift it and put it on a shelf.",
  T5: "Both press the cube against a wall.",
  T6: "Both squeeze the cube and hold it still.",
  T7: "Two to eight hands squeeze one cube and carry it.",
  T8: "Two to eight hands turn one cube to and fro.",
  T9: "A puts a cube on another, then B puts a third on both.",
  T10: "A hands B a screwdriver, and B puts it down.",
};

export const algorithms = {
  base: "Each side follows the newest message of the other, without any correction for its delay.",
  "dead-reckoning": "Each side extrapolates the other's cube from its last speed up to now.",
  sep: "Each side predicts the other hand's force and position up to now.",
  "remote-proxy": "Each side simulates the other's hand, and moves it to where it means to be.",
};
