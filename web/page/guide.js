// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The help panel and full screen, for every viewer.

import { byId } from "./dom.js";

const typedIn = "input, select, textarea";

/** Opens by its button and by the key "?"; the browser closes it by Escape. */
export const offerGuide = () => {
  const guide = byId("guide");
  byId("open-guide").addEventListener("click", () => guide.showModal());
  byId("close-guide").addEventListener("click", () => guide.close());
  guide.addEventListener("click", ({ target }) => {
    if (target === guide) guide.close(); // beside the panel
  });
  document.addEventListener("keydown", (event) => {
    if (event.key !== "?" || event.target.matches(typedIn) || guide.open) return;
    event.preventDefault();
    guide.showModal();
  });
};

export const offerFullScreen = () => {
  const button = byId("full-screen");
  button.hidden = !document.fullscreenEnabled;
  button.addEventListener("click", () => (document.fullscreenElement
    ? document.exitFullscreen() : document.documentElement.requestFullscreen()));
  document.addEventListener("fullscreenchange", () =>
    button.setAttribute("aria-pressed", String(document.fullscreenElement !== null)));
};
