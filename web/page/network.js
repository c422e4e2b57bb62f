// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sliders for one path, or a matrix of them for the links of several peers: both directions
// together, or each alone where they differ.

import { fillSelect, make, say } from "./dom.js";
import { conditionsOf, prefixOf } from "./rows.js";
import { orders, settings } from "./settings.js";
import { Slider } from "./slider.js";

/** Rows of sliders: the key in front of a setting, what it holds for, and how people call it. */
const targetsOf = (paths, linked, ends) => {
  const ways = (path, [a, b]) => {
    const [up, down] = [prefixOf(path, "up"), prefixOf(path, "down")];
    if (linked) return [{ keys: [up, down], path, way: "up", label: `${a} ⇄ ${b}` }];
    return [
      { keys: [up], path, way: "up", label: `${a} → ${b}` },
      { keys: [down], path, way: "down", label: `${b} → ${a}` },
    ];
  };
  const targets = paths.flatMap((path) => ways(path, ends(path)));
  if (paths.length < 2) return targets;
  const all = paths.flatMap((path) => [prefixOf(path, "up"), prefixOf(path, "down")]);
  return [{ keys: all, path: paths[0], way: "up", label: "all links" }, ...targets];
};

export class Network {
  #rows = [];
  #signature = "";

  #wantsLinked = true; // the viewer's choice
  #isAligning = false; // requested, not answered

  /**
   * `ends(path)` gives the letters of the two peers that a path joins, `tell(text, isError)` shows
   * what is refused.
   */
  constructor({ container, linked, order, model, wishes, ends, tell }) {
    Object.assign(this, { container, linked, order, model, wishes, ends, tell });
    linked.addEventListener("change", () => {
      this.#wantsLinked = linked.checked;
      if (linked.checked) this.#align();
      this.refresh();
    });
    fillSelect(
      order,
      orders.map((one) => [one, one]),
    );
    order.addEventListener("change", () => {
      const wish = {};
      for (const { keys } of this.#targets())
        for (const key of keys) wish[`${key}order`] = order.value;
      wishes.ask(wish);
    });
    model.addEventListener("state", () => this.refresh());
  }

  get #paths() { return this.model.paths.length > 0 ? this.model.paths : [""]; }

  /** What holds of a path in both directions: [up, down]. */
  #held(path) {
    return ["up", "down"].map((way) => conditionsOf(this.model.conditions, path, way));
  }

  /** The keys in which the directions of a path differ. */
  #differing(path) {
    const [up, down] = this.#held(path);
    return Object.keys({ ...up, ...down }).filter((key) => up[key] !== down[key]);
  }

  /** Gives each direction back what holds on the way there. */
  #align() {
    const wish = {};
    for (const path of this.#paths) {
      const [up] = this.#held(path);
      for (const key of this.#differing(path)) {
        const none = settings.find((setting) => setting.key === key)?.write(0);
        const text = up[key] ?? (key === "order" ? "keep" : none);
        if (text !== undefined) wish[`${prefixOf(path, "down")}${key}`] = text;
      }
    }
    if (Object.keys(wish).length === 0) return;
    this.#isAligning = true;
    this.wishes.ask(wish, () => { this.#isAligning = false; }); // the state that follows shows it
  }

  #targets() {
    const paths = this.#paths;
    return targetsOf(paths, this.linked.checked, this.ends);
  }

  #slider(target, setting) {
    const slider = new Slider(setting, `${setting.label}, ${target.label}`, (number) => {
      const text = setting.write(number);
      const wish = Object.fromEntries(target.keys.map((key) => [`${key}${setting.key}`, text]));
      this.wishes.ask(wish, () => {
        slider.answered();
        this.#show();
      });
    }, (text) => this.tell(text, true));
    return slider;
  }

  /** One path: a block for each setting. Several: a table with a row for each target. */
  #build(targets) {
    this.#rows = targets.map((target) => ({
      target,
      sliders: settings.map((setting) => this.#slider(target, setting)),
    }));
    if (this.model.paths.length > 1) {
      const head = make(
        "tr",
        {},
        make("td"),
        ...settings.map((setting) =>
          make("th", { scope: "col" }, `${setting.label}, ${setting.unit}`),
        ),
      );
      const rows = this.#rows.map(({ target, sliders }) =>
        make(
          "tr",
          {},
          make("th", { scope: "row" }, target.label),
          ...sliders.map((slider) => make("td", {}, slider.root)),
        ),
      );
      this.container.replaceChildren(
        make(
          "table",
          { class: "matrix" },
          make("caption", { class: "quiet" }, "A row for each link, a column for each setting"),
          make("thead", {}, head),
          make("tbody", {}, ...rows),
        ),
      );
      return;
    }
    this.container.replaceChildren(
      ...settings.map((setting, column) =>
        make(
          "fieldset",
          {},
          make("legend", {}, setting.label),
          ...this.#rows.map(({ target, sliders }) =>
            make(
              "div",
              { class: "way" },
              this.#rows.length > 1
                ? make("span", { class: "quiet-label", "aria-hidden": "true" }, target.label)
                : null,
              sliders[column].root,
            ),
          ),
        ),
      ),
    );
  }

  refresh() {
    const differ = this.#paths.some((path) => this.#differing(path).length > 0);
    this.linked.checked = this.#wantsLinked && (this.#isAligning || !differ);
    this.linked.parentElement.title = differ
      ? "The directions differ. Tick this to give the way back what holds on the way there."
      : "A change holds for both directions.";
    const targets = this.#targets();
    const signature = targets.map((target) => target.keys.join() + target.label).join();
    if (signature !== this.#signature) {
      this.#signature = signature;
      this.#build(targets);
    }
    this.#show();
  }

  #show() {
    for (const { target, sliders } of this.#rows) {
      const held = conditionsOf(this.model.conditions, target.path, target.way);
      sliders.forEach((slider) => slider.show(held[slider.setting.key]));
    }
    const first = this.#rows[0]?.target;
    if (!first) return;
    const order = conditionsOf(this.model.conditions, first.path, first.way).order ?? "keep";
    if (document.activeElement !== this.order) this.order.value = order;
    const attached = this.model.state?.emulator?.attached ?? false;
    for (const input of this.container.querySelectorAll("input")) input.disabled = !attached;
    this.order.disabled = !attached;
    const live = this.model.state?.emulator?.live ?? [];
    const ending = live.filter((one) => one.remaining_s !== null);
    say(
      document.getElementById("lasting"),
      ending
        .map(
          (one) =>
            `${Object.entries(one.settings ?? {})
              .map((pair) => pair.join(" "))
              .join(", ")} ` + `for ${Math.ceil(one.remaining_s)} s more`,
        )
        .join("; "),
    );
  }
}
