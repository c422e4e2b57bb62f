// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The trap: a condition over the live figures that saves the last seconds when it comes true.

import { post } from "./api.js";
import { announce, byId, make, say } from "./dom.js";
import { sentenceFrom } from "./units.js";

/** What the trap does now, in sentences. */
const sentencesOf = ({ state, when, fired }) => {
  const times = fired === 1 ? "once" : `${fired} times`;
  const had = fired > 0 ? ` It has come true ${times}.` : "";
  const does = {
    disarmed: "The trap is not armed.",
    armed: `The trap waits for ${when}.`,
    fired: `${when} came true. The trap collects 2 s of what follows.`,
    resting: "The trap rests. It is armed again within 30 s.",
  };
  return `${does[state] ?? ""}${had}`;
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
      this.#say(reply.files ? `Saved ${reply.files.join(", ")}.` : "");
    } catch (error) {
      this.#say(sentenceFrom(error.message));
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
    const why = keep?.available ? "" : sentenceFrom(keep?.says ?? "");
    say(byId("trap-state"), trap ? `${sentencesOf(trap)} ${why}` : "");
    const keys = (trap?.keys ?? []).join();
    const list = byId("trap-keys");
    if (list.dataset.keys === keys) return;
    list.dataset.keys = keys;
    list.replaceChildren(...(trap?.keys ?? []).map((key) => make("option", { value: `${key}>` })));
  }
}
