// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Starts and stops the demo: task, algorithm, scene and peers out of closed sets, in the network
// that is chosen among the presets.

import { post } from "./api.js";
import { announce, byId, fillSelect, say } from "./dom.js";
import { statusOf } from "./status.js";
import { sentenceFrom, withMicro } from "./units.js";

const busy = ["starting", "stopping"];

export class Stage {
  /** `preset()` is the network to start with; null: that of the last session. */
  constructor(model, preset) {
    Object.assign(this, { model, preset });
    byId("start").addEventListener("click", () => this.#start());
    byId("stop").addEventListener("click", () => this.#ask({ do: "stop" }));
    byId("loop").addEventListener("change", (event) => {
      if (this.stage?.state === "running") this.#ask({ do: "loop", loop: event.target.checked });
    });
    for (const id of ["time", "task", "algorithm", "scene", "peers", "device"]) {
      byId(id).addEventListener("change", () => {
        byId("stage").classList.add("changed");
        this.#offerLoop();
      });
    }
    model.addEventListener("state", () => this.#show());
  }

  get stage() { return this.model.state?.stage; }

  async #ask(request) {
    say(byId("stage-says"), "");
    this.isAsking = true;
    try {
      await post("/api/stage", request);
    } catch (error) {
      say(byId("stage-says"), sentenceFrom(error.message));
      announce(error.message);
    }
    this.isAsking = false;
  }

  get #begin() { return this.stage.state === "running" ? "restart" : "start"; }

  /** Plays that story, in place of what plays. */
  tell(story) {
    byId("stage").classList.remove("changed");
    return this.#ask({ do: this.#begin, story });
  }

  #start() {
    byId("stage").classList.remove("changed");
    return this.#ask({
      do: this.#begin,
      mode: byId("time").value,
      task: byId("task").value,
      algorithm: byId("algorithm").value,
      scene: byId("scene").value,
      preset: this.preset() ?? this.stage.choice.preset,
      device: byId("device").value,
      peers: Number(byId("peers").value),
      loop: byId("loop").checked,
    });
  }

  /** A session in virtual time is played again from its own controls, and repeats itself. */
  #offerLoop() {
    byId("loop").closest("label").hidden = byId("time").value === "virtual";
  }

  #show() {
    const { stage } = this;
    byId("stage").hidden = !stage?.available;
    if (!stage?.available) return;
    const { choice, choices } = stage;
    const same = (list) => (list ?? []).map((one) => [one, one]);
    const [least, most] = choices.peers ?? [2, 2];
    const counts = Array.from({ length: most - least + 1 }, (_, i) => String(least + i));
    const kept = byId("stage").classList.contains("changed");
    const chosen = (value) => (kept ? undefined : String(value));
    fillSelect(byId("time"), same(choices.modes), chosen(choice.mode));
    fillSelect(byId("task"), same(choices.tasks), chosen(choice.task));
    fillSelect(byId("algorithm"), same(choices.algorithms), chosen(choice.algorithm));
    const scenes = (choices.scenes ?? []).map((one) => [one, one === "task" ? "the task's" : one]);
    fillSelect(byId("scene"), scenes, chosen(choice.scene));
    const hands = { simulated: "simulated", page: "yours" };
    fillSelect(byId("device"), (choices.devices ?? []).map((one) => [one, hands[one] ?? one]),
      chosen(choice.device));
    fillSelect(byId("peers"), same(counts), chosen(choice.peers));
    if (!this.isAsking) byId("loop").checked = stage.loop;
    this.#offerLoop();
    const running = stage.state === "running";
    byId("start").disabled = busy.includes(stage.state);
    byId("stop").disabled = stage.state === "stopped" || stage.state === "stopping";
    say(byId("start"), running ? "Restart" : "Start");
    byId("stage").dataset.state = stage.state;
    say(byId("stage-state"), statusOf(this.model.state).brief);
    if (stage.state === "failed")
      say(byId("stage-says"), sentenceFrom(withMicro(stage.says ?? "")));
  }
}
