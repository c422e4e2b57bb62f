// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The double of an emulator: conditions of each path by key, a generation, and figures per frame.

const number = (text, fallback = 0) => {
  const found = /-?[0-9.]+/.exec(text ?? "");
  return found ? Number(found[0]) : fallback;
};

export const presets = [
  { name: "ideal", about: "no delay, no loss", settings: {} },
  { name: "lan", about: "0.15 ms", settings: { delay: "0.15ms" } },
  {
    name: "wifi-busy",
    about: "1 ms, log-normal jitter, 1 % loss",
    settings: {
      delay: "1ms",
      jitter: '{ law = "log-normal", mean = "21ms", sd = "61ms" }',
      loss: "1%",
    },
  },
  {
    name: "lte",
    about: "18 / 14 ms",
    settings: {
      delay: "18ms",
      jitter: '{ law = "gamma", mean = "9ms", sd = "6ms" }',
      loss: "0.1%",
    },
  },
  { name: "geo-satellite", about: "290 ms", settings: { delay: "290ms", loss: "0.5%" } },
  {
    name: "paper-delay-160",
    about: "160 ms, as in Table 1 of the paper",
    settings: { delay: "160ms" },
  },
  {
    name: "paper-jitter-15",
    about: "uniform from -15 to +15 ms",
    settings: {
      delay: "15ms",
      jitter: "15ms",
      order: "free",
    },
  },
  { name: "paper-loss-93", about: "93 % random loss", settings: { loss: "93%" } },
];

const isNothing = (value) => /^(0|0ms|0%|0bit\/s|keep)$/.test(value) || /share = "0%"/.test(value);

export class Network {
  generation = 1;
  live = [];

  constructor(paths) {
    this.paths = paths;
    this.conditions = {};
    this.received = { up: 0, down: 0 };
    this.queues = new Map();
  }

  #keys(key) {
    const parts = key.split(".");
    const name = parts.pop();
    const way = ["up", "down", "both"].includes(parts.at(-1)) ? parts.pop() : "both";
    const path = parts.join(".");
    const paths = path === "" || path === "all" ? this.paths : [path];
    if (!paths.every((one) => this.paths.includes(one))) throw new Error(`unknown path '${path}'`);
    const known = ["delay", "jitter", "loss", "duplicate", "reorder", "rate", "order", "corrupt"];
    if (!known.includes(name)) throw new Error(`unknown key '${name}'`);
    return paths.flatMap((one) =>
      (way === "both" ? ["up", "down"] : [way]).map(
        (each) => `${one === "" ? "" : `${one}.`}${each}.${name}`,
      ),
    );
  }

  set(settings, seconds) {
    const before = { ...this.conditions };
    for (const [key, value] of Object.entries(settings)) {
      for (const one of this.#keys(key)) {
        if (isNothing(value)) delete this.conditions[one];
        else this.conditions[one] = value;
      }
    }
    if (seconds) this.live.push({ settings, before, until: Date.now() + 1000 * seconds });
    return this.#reply(before);
  }

  apply(settings) {
    const before = { ...this.conditions };
    this.conditions = {};
    this.live = [];
    this.set(
      Object.fromEntries(Object.entries(settings).map(([key, value]) => [`both.${key}`, value])),
    );
    this.generation -= JSON.stringify(before) === JSON.stringify(this.conditions) ? 0 : 1;
    return this.#reply(before);
  }

  #reply(before) {
    const changed = JSON.stringify(before) !== JSON.stringify(this.conditions);
    if (changed) this.generation += 1;
    return {
      ok: true,
      generation: this.generation,
      changed,
      elapsed_s: 1,
      effective_at_ns: 1,
      effective_at: { ...this.received },
    };
  }

  /** Ends what was asked for a while; true when something ended. */
  expire() {
    const over = this.live.filter((one) => one.until <= Date.now());
    if (over.length === 0) return false;
    this.live = this.live.filter((one) => one.until > Date.now());
    this.conditions = over[0].before;
    this.generation += 1;
    return true;
  }

  delayMs(path, way) {
    return number(this.conditions[`${path === "" ? "" : `${path}.`}${way}.delay`]);
  }

  #direction(path, way, datagrams) {
    const prefix = `${path === "" ? "" : `${path}.`}${way}.`;
    const delay = this.delayMs(path, way);
    const jitter = this.conditions[`${prefix}jitter`];
    const loss = number(this.conditions[`${prefix}loss`]) / 100;
    const spread = /half_width|^\d/.test(jitter ?? "") ? number(jitter) : jitter ? 9 : 0;
    const lost = Array.from({ length: datagrams }, () => Math.random() < loss).filter(
      Boolean,
    ).length;
    if (path === this.paths[0]) this.received[way] += datagrams;
    const delivered = datagrams - lost;
    const least = Math.max(0, delay - spread * Math.random());
    const most = delay + spread * Math.random() + 0.05;
    return {
      received: datagrams,
      delivered,
      duplicated: 0,
      dropped: lost > 0 ? { random_loss: lost } : {},
      in_flight: Math.round(delay * 1),
      delay_ms: delivered > 0 ? { min: least, mean: (least + most) / 2, max: most } : null,
      late_us: delivered > 0 ? { mean: 9, max: 20 + 40 * Math.random() } : null,
    };
  }

  frame(number_, datagrams) {
    return {
      ok: true,
      frame: number_,
      at_ns: Date.now() * 1e6,
      elapsed_s: 1,
      generation: this.generation,
      paths: this.paths.map((name) => ({
        name,
        up: this.#direction(name, "up", datagrams),
        down: this.#direction(name, "down", datagrams),
      })),
    };
  }
}
