// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A link with the page's settings in its fragment, without the token: its reader needs the address
// that hapnet-web printed.

import { post, wanted } from "./api.js";
import { announce, byId, say } from "./dom.js";
import { prefixOf } from "./rows.js";
import { settings } from "./settings.js";
import { sentenceFrom } from "./units.js";

const members = ["mode", "task", "algorithm", "scene", "preset", "device"];
const isOfStage = (key) => members.includes(key) || key === "peers";

/** What the fragment says: {choice, conditions}, each only with what is there. */
const settingsIn = (fragment) => {
  const choice = {};
  const conditions = {};
  for (const [key, value] of fragment) {
    if (members.includes(key)) choice[key] = value;
    else if (key === "peers") choice.peers = Number(value);
    else if (key.includes(".")) conditions[key] = value;
  }
  return { choice, conditions };
};

export class Link {
  #run = null; // the last one before the link's own

  /** `preset()` is the preset that holds, or null where its conditions have been changed. */
  constructor(model, preset) {
    Object.assign(this, { model, preset, wanted: settingsIn(wanted) });
    byId("copy-link").addEventListener("click", () => this.#copy());
    byId("follow-link").addEventListener("click", () => this.#follow());
    byId("ignore-link").addEventListener("click", () => this.#end());
    model.addEventListener("state", () => this.#show());
  }

  get text() {
    const { stage } = this.model.state ?? {};
    const fragment = new URLSearchParams();
    if (stage?.available) {
      for (const [key, value] of Object.entries(stage.choice)) {
        if (isOfStage(key) && key !== "preset") fragment.set(key, String(value));
      }
    }
    const preset = this.preset();
    fragment.set("preset", preset ?? "ideal");
    if (preset === null) {
      for (const [key, value] of Object.entries(this.model.conditions)) fragment.set(key, value);
    }
    return `${location.origin}${location.pathname}#${fragment}`;
  }

  /** The button shows the link and copies it, or hides it again. */
  async #copy() {
    const isShown = byId("link-shown").hidden;
    byId("link-shown").hidden = !isShown;
    byId("copy-link").setAttribute("aria-expanded", String(isShown));
    if (!isShown) return;
    const { text } = this;
    const shown = byId("link-text");
    shown.value = text;
    let says = "The link is on the clipboard. It has the settings, and not the key to this server.";
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      shown.select();
      says = "Copy this link. It has the settings, and not the key to this server.";
    }
    say(byId("link-says"), says);
    announce(says);
  }

  #show() {
    const { stage, emulator } = this.model.state;
    if (this.wanted === null) return;
    const { choice, conditions } = this.wanted;
    const words = [...Object.entries(choice), ...Object.entries(conditions)];
    if (words.length === 0) return this.#end();
    const isReady = stage?.available || emulator?.attached;
    byId("link-notice").hidden = !isReady || this.#run !== null;
    say(byId("link-brings"), words.map((pair) => pair.join(" ")).join(", "));
    if (this.#run === null) return undefined;
    if (stage?.run === this.#run || stage?.state !== "running" || !emulator?.attached)
      return undefined;
    return this.#setConditions();
  }

  /** With a stage, starts a session; else sets the conditions of the emulator that is there. */
  async #follow() {
    const { stage } = this.model.state;
    if (!stage?.available) return this.#setConditions();
    try {
      const does = stage.state === "running" ? "restart" : "start";
      await post("/api/stage", { do: does, ...this.wanted.choice });
      this.#run = stage.run;
      byId("link-notice").hidden = true;
    } catch (error) {
      this.#fail(error);
    }
    return undefined;
  }

  /** What the link does not name is none. */
  async #setConditions() {
    const { choice, conditions } = this.wanted;
    this.#end();
    const wish = {};
    const isPreset = Object.keys(conditions).length === 0;
    for (const path of this.model.paths) {
      for (const way of ["up", "down"]) {
        for (const { key, write } of isPreset ? [] : settings)
          wish[`${prefixOf(path, way)}${key}`] = write(0);
      }
    }
    try {
      if (!isPreset)
        await post("/api/emulator", { command: "set", settings: { ...wish, ...conditions } });
      else if (choice.preset && !this.model.state.stage?.available)
        await post("/api/emulator", { command: "apply", preset: choice.preset });
    } catch (error) {
      this.#fail(error);
    }
  }

  #fail(error) {
    byId("link-shown").hidden = false;
    byId("link-text").value = "";
    say(byId("link-says"), sentenceFrom(error.message));
    announce(sentenceFrom(error.message));
  }

  #end() {
    this.wanted = null;
    byId("link-notice").hidden = true;
  }
}
