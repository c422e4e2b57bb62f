// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Starts and stops the demo: task, algorithm, peers and network out of closed sets.

import { post } from "./api.js";
import { announce, byId, fillSelect, say } from "./dom.js";

const busy = ["starting", "stopping"];

export class Stage {
  constructor(model) {
    this.model = model;
    byId("start").addEventListener("click", () => this.#start());
    byId("stop").addEventListener("click", () => this.#ask({ do: "stop" }));
    byId("loop").addEventListener("change", (event) => {
      if (this.stage?.state === "running") this.#ask({ do: "restart", loop: event.target.checked });
    });
    for (const id of ["time", "task", "algorithm", "peers", "preset"]) {
      byId(id).addEventListener("change", () => { byId("stage").classList.add("changed"); });
    }
    model.addEventListener("state", () => this.#show());
  }

  get stage() { return this.model.state?.stage; }

  async #ask(request) {
    say(byId("stage-says"), "");
    try {
      await post("/api/stage", request);
    } catch (error) {
      say(byId("stage-says"), error.message);
      announce(error.message);
    }
  }

  #start() {
    byId("stage").classList.remove("changed");
    const running = this.stage.state === "running";
    return this.#ask({
      do: running ? "restart" : "start",
      mode: byId("time").value,
      task: byId("task").value,
      algorithm: byId("algorithm").value,
      preset: byId("preset").value,
      peers: Number(byId("peers").value),
      loop: byId("loop").checked,
    });
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
    fillSelect(byId("preset"), same(choices.presets), chosen(choice.preset));
    fillSelect(byId("peers"), same(counts), chosen(choice.peers));
    if (document.activeElement !== byId("loop")) byId("loop").checked = stage.loop;
    const running = stage.state === "running";
    byId("start").disabled = busy.includes(stage.state);
    byId("stop").disabled = stage.state === "stopped" || stage.state === "stopping";
    say(byId("start"), running ? "Restart" : "Start");
    byId("stage").dataset.state = stage.state;
    say(byId("stage-state"), stage.run > 0 ? `run ${stage.run}, ${stage.state}` : stage.state);
    if (stage.state === "failed") say(byId("stage-says"), stage.says ?? "");
  }
}
