// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Puts a report together: figures and player by the painters of the live page.

import { make } from "../dom.js";
import { chartMaker, painterFor } from "../painters.js";
import { setUpFigures } from "./figures.js";
import { Player } from "./player.js";

const dataIn = (id) => JSON.parse(document.getElementById(id)?.textContent ?? "null");

/** What is written in the licences of the libraries that the page carries. */
const showLicences = (files) => {
  const texts = Object.entries(files).filter(([name]) => name.endsWith("-LICENSE.txt"));
  if (texts.length === 0) return;
  document.querySelector("main").append(make("footer", {},
    make("details", {}, make("summary", {}, "Licences of what draws this page"),
      ...texts.map(([name, words]) =>
        make("pre", {}, `${name.replace("-LICENSE.txt", "")}\n\n${words}`)))));
};

/** `files` are those that the page carries, by name. */
export const start = async (files) => {
  if (files["uPlot.min.css"]) {
    const sheet = make("style");
    sheet.textContent = files["uPlot.min.css"];
    document.head.append(sheet);
  }
  showLicences(files);
  const makeChart = await chartMaker();
  const figures = setUpFigures(dataIn("figures") ?? {}, makeChart);
  const replays = dataIn("replays");
  const root = document.querySelector(".player");
  const player = root && replays ? new Player(root, replays, { painterFor, makeChart }) : null;
  document.body.dataset.view = player ? await player.start() : "none";
  globalThis.hapnet = { figures, player }; // for the tests, and for the curious at the console
};
