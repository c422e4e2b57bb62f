// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Whole networks at once: presets, a sentence as tc-netem takes it, back to the start, and the
// present conditions as TOML.

import { post } from "./api.js";
import { byId, make, say } from "./dom.js";

const copy = async (text) => {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false; // no permission: the text is shown, to be copied by hand
  }
};

export class Conditions {
  #chosen = null;
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
    byId("presets").addEventListener("keydown", (event) => this.#move(event));
  }

  async #ask(request, name) {
    try {
      const reply = await post("/api/emulator", request);
      const warnings = (reply.warnings ?? []).map((one) => ` ${one}`).join("");
      this.tell(`${name}: generation ${reply.generation}.${warnings}`, false);
      this.#chosen = request.preset ?? null;
      this.#mark();
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

  #mark() {
    for (const button of byId("presets").querySelectorAll("button")) {
      button.setAttribute("aria-pressed", String(button.dataset.preset === this.#chosen));
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
              onclick: () => this.#ask({ command: "apply", preset: name }, name),
            },
            name,
          ),
        ),
      );
    }
    const attached = this.model.state?.emulator?.attached ?? false;
    for (const control of byId("network").querySelectorAll("button, #netem-sentence")) {
      control.disabled = !attached;
    }
    const error = this.model.state?.emulator?.error;
    say(byId("network-error"), error ?? (attached ? "" : "No emulator is attached."));
  }
}
