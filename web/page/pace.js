// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Virtual time: play, pause, step, pace, and saving the session as an experiment.

import { post } from "./api.js";
import { announce, byId, say } from "./dom.js";

export class Pace {
  constructor(model) {
    this.model = model;
    byId("play").addEventListener("click", () =>
      this.#ask({ do: this.pace?.state === "playing" ? "pause" : "play" }));
    byId("step").addEventListener("click", () => this.#ask({ do: "step", by_s: 0.1 }));
    byId("save").addEventListener("click", () => this.#ask({ do: "save" }));
    byId("factor").addEventListener("change", ({ target }) =>
      this.#ask({ do: "factor", factor: target.value === "max" ? "max" : Number(target.value) }));
    model.addEventListener("state", () => this.#show());
  }

  get pace() { return this.model.state?.pace; }

  async #ask(request) {
    try {
      const reply = await post("/api/pace", request);
      if (request.do === "save") {
        const said = reply.file ? `Saved ${reply.file}.` : "Saved as an experiment.";
        say(byId("pace-says"), said);
        announce(said);
      }
    } catch (error) {
      say(byId("pace-says"), error.message);
    }
  }

  seek(seconds) { return this.#ask({ do: "seek", to_s: seconds }); }

  #show() {
    const { pace } = this;
    byId("pace").hidden = !pace;
    if (!pace) return;
    byId("save").hidden = Boolean(pace.read_only);
    const acts = { playing: "Pause", paused: "Play", ended: "Play again" };
    say(byId("play"), acts[pace.state]);
    byId("step").disabled = pace.state === "ended";
    if (document.activeElement !== byId("factor")) byId("factor").value = String(pace.factor);
  }
}
