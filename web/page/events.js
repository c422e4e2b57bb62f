// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The events, newest first, and the files that they left.

import { download, get } from "./api.js";
import { announce, byId, make, say } from "./dom.js";
import { withMicro } from "./units.js";

const shownMax = 60;
const spokenKinds = ["peer", "emulator", "stage", "trap", "keep"];
const kindNames = {
  conditions: "network",
  peer: "peer",
  emulator: "emulator",
  stage: "stage",
  trap: "trap",
  keep: "saved",
  mark: "mark",
  pace: "time",
};

const clock = (event) => {
  const at = new Date(event.at_unix_ms);
  return Number.isNaN(at.getTime())
    ? `${event.at_s.toFixed(1)} s`
    : `${at.toLocaleTimeString("en-GB")}.${String(at.getMilliseconds()).padStart(3, "0")}`;
};

const sizeOf = (bytes) =>
  bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

export class Events {
  constructor(model) {
    this.model = model;
    this.list = byId("event-list");
    model.addEventListener("event", ({ detail }) => this.#add(detail));
    byId("files").addEventListener("toggle", () => this.#files());
    this.born = performance.now();
  }

  clear() {
    this.list.replaceChildren();
  }

  #add(event) {
    const files = (event.files ?? []).map((name) =>
      make(
        "button",
        {
          type: "button",
          class: "link",
          onclick: () => this.#fetch(name),
        },
        name,
      ),
    );
    this.list.prepend(
      make(
        "li",
        { "data-kind": event.kind },
        make("time", {}, clock(event)),
        make("span", { class: "kind" }, kindNames[event.kind] ?? event.kind),
        make("span", { class: "what" }, withMicro(event.text ?? "")),
        ...files,
      ),
    );
    while (this.list.children.length > shownMax) this.list.lastElementChild.remove();
    if (spokenKinds.includes(event.kind) && performance.now() - this.born > 2000)
      announce(event.text);
    if (files.length > 0) this.#files();
  }

  /** By name: the list of files has the address. */
  async #fetch(name) {
    try {
      const { files } = await get("/api/files");
      const found = files.find((file) => file.name === name || file.name.endsWith(`/${name}`));
      if (!found) throw new Error(`the server no longer has ${name}`);
      await download(found.href, found.name);
    } catch (error) {
      announce(error.message);
      say(byId("files-says"), error.message);
    }
  }

  async #files() {
    if (!byId("files").open) return;
    try {
      const { files } = await get("/api/files");
      byId("file-list").replaceChildren(
        ...files.map((file) =>
          make(
            "li",
            {},
            make(
              "button",
              {
                type: "button",
                class: "link",
                onclick: () =>
                  download(file.href, file.name).catch((error) => announce(error.message)),
              },
              file.name,
            ),
            ` ${file.kind}, ${sizeOf(file.bytes)}`,
          ),
        ),
      );
      const records = files.filter((file) => file.kind === "record").slice(-2);
      say(
        byId("files-says"),
        files.length === 0
          ? "No files yet."
          : records.length === 2
            ? `hapnet-lab analyse ${records.map((file) => file.name).join(" ")}`
            : "",
      );
    } catch (error) {
      say(byId("files-says"), error.message);
    }
  }
}
