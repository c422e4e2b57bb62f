// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// What can be played, in sentences: the stories of the server to start from, and the task and the
// algorithm that are chosen.

import { byId, make, say } from "./dom.js";
import { algorithms, tasks } from "./words.js";

const compared = ["task", "algorithm", "scene", "preset", "peers", "device"];

/** The story that the stage has begun with, as far as it decides what there is to see. */
const storyOf = ({ choice, choices }) => choices.stories.find((story) =>
  compared.every((key) => story.choice[key] === choice[key]));

export class Stories {
  #signature = "";

  /** `tell(name)` starts that story; `preset()` is the preset that holds, null after a change. */
  constructor(model, tell, preset) {
    Object.assign(this, { model, tell, preset });
    for (const id of ["task", "algorithm"]) {
      byId(id).addEventListener("change", () => this.#show());
    }
    byId("guide-tasks").replaceChildren(...this.#list(tasks));
    byId("guide-algorithms").replaceChildren(...this.#list(algorithms));
    for (const name of ["state", "event"]) model.addEventListener(name, () => this.#show());
  }

  #list(sentences) {
    return Object.entries(sentences).flatMap(([name, words]) =>
      [make("dt", {}, name), make("dd", {}, words)]);
  }

  #arrange(stories) {
    const signature = stories.map(({ name }) => name).join();
    if (signature === this.#signature) return;
    this.#signature = signature;
    byId("stories").replaceChildren(...stories.map(({ name, title, look }) =>
      make("button", {
        type: "button", class: "chip", title: look, "data-story": name, "aria-pressed": false,
        onclick: () => this.tell(name),
      }, title)));
  }

  #show() {
    const { stage, emulator } = this.model.state ?? {};
    const isOffered = Boolean(stage?.available);
    byId("stories").hidden = !isOffered;
    this.#arrange(isOffered ? stage.choices.stories ?? [] : []);
    const story = isOffered ? storyOf(stage) : undefined;
    const isPlaying = stage?.state === "running" && emulator?.attached;
    const isChanged = isPlaying && story && this.preset() !== story.choice.preset;
    for (const button of byId("stories").children) {
      const isTold = button.dataset.story === story?.name && !isChanged;
      button.setAttribute("aria-pressed", String(isTold));
    }
    const changed = `The network is no longer that of the story “${story?.title}”: start the story `
      + "again to see what it tells of.";
    say(byId("story-look"), !story || !isPlaying ? "" : isChanged ? changed : story.look);
    const [first] = this.model.peers;
    const chosen = (id) => (isOffered ? byId(id).value : first?.[id]);
    for (const [id, sentences] of Object.entries({ task: tasks, algorithm: algorithms })) {
      const name = chosen(id);
      say(byId(`${id}-says`), sentences[name] ? `${name}: ${sentences[name]}` : "");
    }
  }
}
