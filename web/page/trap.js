// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The trap: a condition over the live figures that saves the last seconds when it comes true.

import { post } from "./api.js";
import { announce, byId, make, say } from "./dom.js";

const states = {
  disarmed: "not armed", armed: "armed", fired: "fired: collecting what follows",
  resting: "resting before it is armed again",
};

export class Trap {
  constructor(model) {
    this.model = model;
    byId("trap").addEventListener("submit", (event) => {
      event.preventDefault();
      const armed = this.trap?.state !== "disarmed";
      const when = byId("trap-when").value.trim();
      this.#ask("/api/trap", armed ? { do: "disarm" } : { do: "arm", when, last: "10s" });
    });
    byId("keep").addEventListener("click", () => this.#ask("/api/keep", { last: "10s" }));
    model.addEventListener("state", () => this.#show());
  }

  get trap() { return this.model.state?.trap; }

  async #ask(path, request) {
    try {
      const reply = await post(path, request);
      this.#say(reply.files ? `Saved ${reply.files.join(", ")}.` : reply.trap?.says ?? "");
    } catch (error) {
      this.#say(error.message);
    }
  }

  #say(text) {
    say(byId("trap-says"), text);
    announce(text);
  }

  #show() {
    const { trap } = this;
    const keep = this.model.state?.keep;
    byId("keep").hidden = !keep?.available;
    const does = keep?.available ? "save the last 10 s when" : "note when";
    say(document.querySelector("label[for=trap-when]"), does);
    byId("arm").disabled = !trap?.available;
    byId("trap-when").disabled = !trap?.available;
    say(byId("arm"), trap && trap.state !== "disarmed" ? "Disarm" : "Arm");
    byId("trap").dataset.state = trap?.state ?? "disarmed";
    const times = trap?.fired > 0 ? `, fired ${trap.fired} times` : "";
    say(byId("trap-state"), trap?.available ? `${states[trap.state] ?? trap.state}${times}`
      : keep?.says ?? trap?.says ?? "");
    const keys = (trap?.keys ?? []).join();
    const list = byId("trap-keys");
    if (list.dataset.keys === keys) return;
    list.dataset.keys = keys;
    list.replaceChildren(...(trap?.keys ?? []).map((key) => make("option", { value: `${key}>` })));
  }
}
