// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Whole networks: presets, a sentence of tc-netem, the conditions at the start, and the present
// ones as TOML. A preset holds at once, and a session that starts begins with it.

import { post } from "./api.js";
import { byId, make, say } from "./dom.js";

const copy = async (text) => {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false; // no permission: the viewer copies the shown text
  }
};

export class Conditions {
  #chosen = undefined; // a preset; null: other conditions; undefined: as at the session's start
  #signature = "";

  constructor(model, tell) {
    Object.assign(this, { model, tell });
    byId("reset").addEventListener("click", () => this.#ask({ command: "reset" }, "reset"));
    byId("netem").addEventListener("submit", (event) => {
      event.preventDefault();
      const sentence = byId("netem-sentence")
        .value.trim()
        .replace(/^.*\bnetem\s+/, "");
      if (sentence !== "") this.#ask({ command: "apply", netem: sentence }, sentence);
    });
    byId("copy-toml").addEventListener("click", () => this.#copy());
    model.addEventListener("state", () => this.#show());
    model.addEventListener("event", ({ detail }) => this.#follow(detail));
    byId("presets").addEventListener("keydown", (event) => this.#move(event));
  }

  async #ask(request, name) {
    try {
      const reply = await post("/api/emulator", request);
      const warnings = (reply.warnings ?? []).map((one) => ` ${one}`).join("");
      this.tell(`${name}: generation ${reply.generation}.${warnings}`, false);
    } catch (error) {
      this.tell(error.message, true);
    }
  }

  async #copy() {
    const area = byId("toml");
    try {
      const { profile } = await post("/api/emulator", { command: "show" });
      area.value = profile ?? "";
      const copied = await copy(area.value);
      area.hidden = false;
      if (!copied) area.select();
      this.tell(
        copied ? "The profile is on the clipboard." : "Here is the profile: copy it.",
        false,
      );
    } catch (error) {
      this.tell(error.message, true);
    }
  }

  /** The preset that holds; null where its conditions have been changed. */
  get preset() {
    const { stage } = this.model.state ?? {};
    return this.#chosen === undefined ? stage?.choice?.preset ?? null : this.#chosen;
  }

  /** The preset after that event, by whichever page asked for it. */
  #follow({ kind, text, set }) {
    if (kind === "emulator" && text.endsWith("is attached")) this.#chosen = undefined;
    if (kind !== "conditions") return;
    const applied = /^apply (\S+): /.exec(text)?.[1];
    const isPreset = this.model.state?.presets.some(({ name }) => name === applied);
    if (/^reset: /.test(text)) this.#chosen = undefined;
    else if (isPreset) this.#chosen = applied;
    else if (applied || set) this.#chosen = null;
    this.#mark();
  }

  #choose(name) {
    const { emulator, pace } = this.model.state;
    if (emulator?.attached && pace?.state !== "ended")
      return this.#ask({ command: "apply", preset: name }, name);
    this.#chosen = name;
    this.#mark();
    return this.tell(`The next session begins with ${name}.`, false);
  }

  #mark() {
    for (const button of byId("presets").querySelectorAll("button")) {
      button.setAttribute("aria-pressed", String(button.dataset.preset === this.preset));
    }
  }

  /** Left and right go from preset to preset, as in a toolbar. */
  #move(event) {
    const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!way) return;
    const buttons = [...byId("presets").querySelectorAll("button")];
    const next = buttons[buttons.indexOf(document.activeElement) + way];
    if (!next) return;
    event.preventDefault();
    next.focus();
  }

  #show() {
    const presets = this.model.state?.presets ?? [];
    const signature = presets.map((preset) => preset.name).join();
    if (signature !== this.#signature) {
      this.#signature = signature;
      byId("presets").replaceChildren(
        ...presets.map(({ name, about }) =>
          make(
            "button",
            {
              type: "button",
              class: "chip",
              title: about,
              "aria-pressed": false,
              "data-preset": name,
              onclick: () => this.#choose(name),
            },
            name,
          ),
        ),
      );
    }
    const { stage } = this.model.state ?? {};
    this.#mark();
    const attached = this.model.state?.emulator?.attached ?? false;
    for (const control of byId("network").querySelectorAll("button, #netem-sentence")) {
      control.disabled = !(attached || (control.dataset.preset && stage?.available));
    }
    const error = this.model.state?.emulator?.error;
    const isOver = stage?.available && stage.state !== "running";
    const says = attached ? error ?? "" : error ?? "No emulator is attached.";
    say(byId("network-error"), isOver ? "" : says);
    say(byId("network-next"), isOver
      ? "Nothing plays: a preset that you choose now is what the next session begins with." : "");
  }
}
