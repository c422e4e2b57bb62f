// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Puts a page together from the data that it carries: words, tables, figures and the player. Of
// results it carries tables, of which words and blocks are made first.

import { make } from "../dom.js";
import { Document } from "./document.js";

/** What is written in the licences of the libraries that the page carries. */
const showLicences = (main, files) => {
  const texts = Object.entries(files).filter(([name]) => name.endsWith("-LICENSE.txt"));
  if (texts.length === 0) return;
  main.append(make("footer", {},
    make("details", {}, make("summary", {}, "Licences of what draws this page"),
      ...texts.map(([name, words]) =>
        make("pre", {}, `${name.replace("-LICENSE.txt", "")}\n\n${words}`)))));
};

const startPlayer = async (replays) => {
  const root = document.querySelector(".player");
  if (!root || !replays) return null;
  const { Player } = await import("./player.js");
  return new Player(root, replays);
};

/** `files` are those that the page carries, by name. */
export const start = async (files) => {
  const carried = JSON.parse(document.getElementById("hapnet-data").textContent);
  const data = carried.tables ? (await import("./sections.js")).layOut(carried) : carried;
  const main = document.querySelector("main");
  const page = new Document(data);
  page.fill(main);
  showLicences(main, files);
  document.getElementById(location.hash.slice(1))?.scrollIntoView();
  const player = await startPlayer(data.replays);
  document.body.dataset.view = player ? await player.start() : "none";
  globalThis.hapnet = { data, figures: page.figures, player }; // for tests, and for the curious
};
