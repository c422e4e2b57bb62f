// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A slider with a number beside it. It shows the server's value. While it waits for an answer to
// the viewer's request, it is hollow.

import { make, say } from "./dom.js";
import { spokenSetting } from "./settings.js";
import { spoken } from "./units.js";

let count = 0;

export class Slider {
  #asked = null; // the viewer's value, until the server answers
  #shown = 0;

  /**
   * `label` names it for all, `ask(number)` is called with each new wish, and `refuse(text)` with
   * the reason why a number that was typed is none.
   */
  constructor(setting, label, ask, refuse) {
    this.setting = setting;
    const id = `slider-${(count += 1)}`;
    const note = `${id}-note`;
    this.range = make("input", {
      type: "range",
      id,
      min: 0,
      max: setting.most,
      step: setting.step,
      value: 0,
      "aria-label": label,
      "aria-describedby": note,
      "data-setting": setting.key,
    });
    this.number = make("input", {
      type: "number",
      min: 0,
      max: setting.limit,
      step: "any",
      "aria-label": `${label}, ${setting.unit}`,
      inputmode: "decimal",
    });
    this.note = make("span", { class: "note", id: note });
    this.root = make(
      "div",
      { class: "slider", "data-setting": setting.key },
      this.range,
      make(
        "span",
        { class: "entry" },
        this.number,
        make("span", { class: "unit", "aria-hidden": "true" }, setting.unit),
      ),
      this.note,
    );
    const fromRange = () => {
      const place = Number(this.range.value);
      this.#ask(setting.fromSlider ? setting.fromSlider(place) : place, ask);
    };
    this.range.addEventListener("input", fromRange);
    this.number.addEventListener("change", () => {
      const typed = this.number.value;
      const wish = typed === "" && !setting.none ? NaN : Number(typed);
      if (wish >= 0 && wish <= setting.limit) {
        this.#ask(wish, ask);
        return;
      }
      const most = `${spoken(setting.limit)} ${setting.unit}`;
      const what = Number.isNaN(wish) ? "is not a number" : `cannot be ${typed} ${setting.unit}`;
      refuse(`The ${label} ${what}: enter 0 to ${most}. It stays as it was.`);
      this.#put(this.#shown, true);
    });
  }

  #ask(number, ask) {
    this.#asked = number;
    this.#put(number);
    this.root.classList.add("waiting");
    ask(number);
  }

  #put(number, isCorrection = false) {
    const { setting } = this;
    this.#shown = number;
    const place = setting.toSlider ? setting.toSlider(number) : number;
    if (!setting.toSlider) this.range.max = String(Math.max(setting.most, Math.ceil(number)));
    this.range.value = String(place);
    this.range.setAttribute("aria-valuetext", spokenSetting(setting, number));
    const share = place / Number(this.range.max);
    this.range.style.setProperty("--share", `${(100 * share).toFixed(2)}%`);
    const isTyped = document.activeElement === this.number && this.#asked === null;
    if (!isTyped || isCorrection) {
      this.number.value = setting.none && number === 0 ? "" : String(Number(number.toPrecision(6)));
      this.number.placeholder = setting.none ?? "";
    }
  }

  /** The server's answer is in: what it says counts again. */
  answered() {
    this.#asked = null;
    this.root.classList.remove("waiting");
  }

  /** What holds now. Leaves a wish alone that is not answered yet. */
  show(text) {
    if (this.#asked !== null) return;
    const { number, note } = this.setting.read(text);
    this.#put(number);
    say(this.note, note);
  }

  get value() {
    return this.#shown;
  }
}
