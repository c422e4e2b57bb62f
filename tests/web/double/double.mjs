// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The double's state, answers and frames.
import { Network, presets } from "./network.mjs";
import { letters, pairOf, paperScene, peerFrame, turningScene } from "./peers.mjs";

const frameMs = 1000 / 60;
const refuse = (status, text) => Object.assign(new Error(text), { status });

const pathsOf = (peers) => {
  if (peers === 2) return [""];
  const ids = Array.from({ length: peers }, (_, i) => i + 1);
  return ids.flatMap((a) => ids.filter((b) => b > a).map((b) => `${a}-${b}`));
};

export class Double {
  clients = new Set();
  events = [];
  rows = [];
  number = 0;
  at = 0;

  constructor(options) {
    this.options = { peers: 2, running: true, ...options };
    this.running = this.options.running;
    this.run = this.running ? 1 : 0;
    this.choice = {
      mode: "live",
      task: "P1",
      algorithm: "base",
      preset: "paper-delay-160",
      peers: this.options.peers,
      seconds: 30,
      seed: 1,
    };
    this.loop = true;
    this.trap = {
      state: "disarmed",
      when: null,
      last: "10s",
      fired: 0,
      says: "",
      available: true,
      keys: ["apart_mm", "distance_mm", "a.force_n.max", "up.dropped_share", "up.delay_ms.max"],
    };
    this.pace = options.virtual
      ? { state: "paused", factor: 1, at_s: 0, length_s: 30, steps: [] }
      : null;
    this.#begin();
    this.timer = setInterval(() => this.#tick(), frameMs);
    this.begun = performance.now();
  }

  stop() {
    clearInterval(this.timer);
  }

  #begin() {
    this.network = new Network(pathsOf(this.choice.peers));
    this.network.apply(
      this.options.settings ?? presets.find((one) => one.name === this.choice.preset).settings,
    );
    this.sessionBegin = this.at;
  }

  get state() {
    const ids = Array.from({ length: this.choice.peers }, (_, i) => i);
    const { conditions, generation, paths } = this.network;
    return {
      mode: this.pace ? "virtual" : "live",
      at_s: this.at,
      emulator: {
        attached: this.running,
        socket: "emulator.sock",
        generation,
        conditions,
        paths,
        timeline: {},
        live: this.network.live.map((one) => ({
          settings: one.settings,
          remaining_s: (one.until - Date.now()) / 1000,
        })),
        error: null,
      },
      peers: ids.map((i) => ({
        id: i + 1,
        letter: letters[i],
        attached: this.running,
        socket: `peer-${i + 1}.sock`,
        task: this.choice.task,
        algorithm: this.choice.algorithm,
        scene: 0,
        device: "simulated Omni",
        state: this.running ? "running" : "waiting",
        says: "",
        seed: 1,
        duration_s: 30,
        boot_id: "x",
        clock: "same",
        error: null,
      })),
      scenes: [this.options.turning ? turningScene : paperScene],
      presets: presets.map(({ name, about }) => ({ name, about })),
      stage: {
        available: this.options.stage !== false,
        state: this.running ? "running" : "stopped",
        says: "",
        run: this.run,
        loop: this.loop,
        choice: this.choice,
        choices: {
          modes: ["live"],
          tasks: ["P1", "T1", "T3", "T7"],
          algorithms: ["base", "dead-reckoning", "sep"],
          presets: presets.map((one) => one.name),
          peers: [2, 8],
          seconds: [5, 600],
        },
      },
      pace: this.pace,
      trap: this.trap,
      keep: { available: true, says: "" },
      events: this.events.slice(-100),
      help:
        this.running || this.options.stage !== false
          ? null
          : "Nothing is attached. Run: hapnet-web --stage",
    };
  }

  join(connection) {
    const client = { connection, acked: this.number };
    const say = (object) => connection.send(JSON.stringify(object));
    say({ type: "hello", schema: 1, version: "0.1.0-double", frame_ms: 16.7, state: this.state });
    say(this.history(1));
    this.clients.add(client);
    return client;
  }

  leave(client) {
    this.clients.delete(client);
  }

  history(every) {
    const columns = this.rows[0]?.columns ?? ["at_s"];
    const rows = this.rows
      .filter((row) => row.columns === columns || row.columns.length === columns.length)
      .map((row) => row.cells);
    if (every === 1) return { type: "history", seconds: 120, columns, rows };
    const coarse = [];
    for (let i = 0; i + every <= rows.length; i += every) {
      const part = rows.slice(i, i + every);
      coarse.push(
        columns.map((_, column) =>
          column === 0
            ? part.at(-1)[0]
            : [
                Math.min(...part.map((row) => row[column])),
                Math.max(...part.map((row) => row[column])),
              ],
        ),
      );
    }
    return { ok: true, type: "history", every_frames: every, columns, rows: coarse };
  }

  #say(object) {
    const text = JSON.stringify(object);
    for (const client of this.clients) client.connection.send(text);
  }

  event(kind, text, more = {}) {
    const event = {
      type: "event",
      id: this.events.length + 1,
      at_s: this.at,
      at_unix_ms: Date.now(),
      kind,
      text,
      ...more,
    };
    this.events.push(event);
    this.#say(event);
  }

  announce() {
    this.#say({ type: "state", state: this.state });
  }

  #remember(frame) {
    const columns = ["at_s"];
    const cells = [frame.at_s];
    const put = (name, value) => {
      columns.push(name);
      cells.push(value ?? null);
    };
    frame.pairs.forEach((pair) => put(`apart_mm:${pair.a}-${pair.b}`, pair.apart_mm));
    frame.peers.forEach((peer) => {
      put(`force_n:${peer.peer}`, peer.force_n.max);
      put(`peer_late_us:${peer.peer}`, peer.late_us.max);
      put(`heard_delay_ms:${peer.peer}`, peer.heard[0].delay_ms.mean);
      put(`heard_lost:${peer.peer}`, 0);
    });
    frame.emulator.paths.forEach((path) => {
      for (const way of ["up", "down"])
        put(`${way}.delay_ms:${path.name}`, path[way].delay_ms?.mean);
      for (const way of ["up", "down"]) {
        const lost = Object.values(path[way].dropped).reduce((sum, one) => sum + one, 0);
        put(`${way}.dropped:${path.name}`, lost / path[way].received);
      }
      for (const way of ["up", "down"]) put(`${way}.late_us:${path.name}`, path[way].late_us?.max);
    });
    this.rows.push({ columns, cells });
    while (this.rows[0].cells[0] < frame.at_s - 120) this.rows.shift();
  }

  frame(datagrams) {
    const t = this.pace ? this.pace.at_s : this.at - this.sessionBegin;
    const peers = Array.from({ length: this.choice.peers }, (_, place) =>
      peerFrame({
        place,
        t,
        frame: this.number,
        turning: this.options.turning,
        phase: "running",
        lost: 0,
        delayMs: this.network.delayMs(this.network.paths[Math.max(0, place - 1)], "up"),
      }),
    );
    const pairs = peers.flatMap((one, i) =>
      peers.slice(i + 1).map((other, j) => pairOf(i + 1, i + j + 2, one, other)),
    );
    return {
      type: "frame",
      n: this.number,
      at_s: this.pace ? this.pace.at_s : this.at,
      at_ns: 1,
      left_out: 0,
      peers,
      pairs,
      emulator: this.network.frame(this.number, datagrams),
    };
  }

  #tick() {
    const now = (performance.now() - this.begun) / 1000;
    const passed = now - this.at;
    this.at = now;
    if (this.network.expire()) {
      this.event("conditions", `back to what held before: generation ${this.network.generation}`);
      this.announce();
    }
    if (!this.running) return;
    if (this.pace?.state === "playing") {
      const factor = this.pace.factor === "max" ? 1000 : this.pace.factor;
      this.pace.at_s = Math.min(this.pace.length_s, this.pace.at_s + passed * factor);
      if (this.pace.at_s === this.pace.length_s) {
        this.pace.state = "ended";
        this.announce();
      }
    } else if (this.pace && this.shownAt === this.pace.at_s) return;
    this.shownAt = this.pace?.at_s;
    this.number += 1;
    const frame = this.frame(Math.max(1, Math.round(1000 * passed)));
    this.#remember(frame);
    for (const client of this.clients) {
      if (this.number - client.acked <= 8) client.connection.send(JSON.stringify(frame));
      else client.acked = Math.max(client.acked, this.number - 8);
    }
    this.#spring(frame);
  }

  #spring(frame) {
    const found = /^apart_mm>([0-9.]+)$/.exec(this.trap.when ?? "");
    if (this.trap.state !== "armed" || !found) return;
    if (!frame.pairs.some((pair) => pair.apart_mm > Number(found[1]))) return;
    Object.assign(this.trap, { state: "resting", fired: this.trap.fired + 1 });
    this.event("trap", `trap fired: ${this.trap.when}`, { files: ["trap-1.pcapng"] });
    this.announce();
  }

  answer(path, body) {
    const answers = {
      "/api/state": () => ({ ok: true, ...this.state }),
      "/api/history": () => this.history(8),
      "/api/files": () => ({
        ok: true,
        files: [
          {
            name: "run-1/peer-1.rec",
            bytes: 123456,
            kind: "record",
            run: 1,
            modified_unix_ms: 1,
            href: "/f/0",
          },
          {
            name: "run-1/trap-1.pcapng",
            bytes: 2123456,
            kind: "capture",
            run: 1,
            modified_unix_ms: 1,
            href: "/f/1",
          },
        ],
      }),
      "/api/emulator": () => this.#emulator(body),
      "/api/stage": () => this.#stage(body),
      "/api/pace": () => this.#setPace(body),
      "/api/trap": () => {
        if (body.do === "arm" && !/^[a-z0-9_.-]+(<|<=|==|!=|>=|>)[0-9.]+$/.test(body.when)) {
          throw refuse(400, `cannot read the condition '${body.when}'`);
        }
        Object.assign(
          this.trap,
          body.do === "arm" ? { state: "armed", when: body.when } : { state: "disarmed" },
        );
        this.announce();
        return { ok: true, trap: this.trap };
      },
      "/api/keep": () => ({ ok: true, files: ["keep-1.pcapng", "keep-1-peer-1.rec"] }),
      "/api/mark": () => {
        this.event("mark", body.text);
        return { ok: true };
      },
    };
    if (!Object.hasOwn(answers, path)) throw refuse(404, `no ${path}`);
    return answers[path]();
  }

  #emulator(request) {
    if (!this.running) throw refuse(503, "no emulator is attached");
    if (request.command === "show") {
      const profile = Object.entries(this.network.conditions).map(
        ([key, value]) => `${key} = "${value}"`,
      );
      return { ok: true, generation: this.network.generation, profile: `${profile.join("\n")}\n` };
    }
    let reply;
    if (request.command === "set") {
      reply = this.network.set(request.settings, request.for ? parseFloat(request.for) : 0);
    } else if (request.command === "apply" && request.preset) {
      reply = this.network.apply(presets.find((one) => one.name === request.preset).settings);
    } else if (request.command === "apply" && /^delay (\S+)/.test(request.netem ?? "")) {
      reply = this.network.apply({ delay: /^delay (\S+)/.exec(request.netem)[1] });
      reply.warnings = ["netem would keep the order."];
    } else if (request.command === "reset") reply = this.network.apply({});
    else throw refuse(422, `cannot read the sentence '${request.netem}'`);
    const what = Object.entries(request.settings ?? {})
      .map((pair) => pair.join(" "))
      .join(", ");
    this.event(
      "conditions",
      `${what || request.preset || request.netem || "reset"}: generation ${reply.generation}`,
      { generation: reply.generation },
    );
    this.announce();
    return reply;
  }

  #stage(request) {
    if (request.do === "stop") this.running = false;
    else {
      const { do: _, loop, ...choice } = request;
      this.loop = loop ?? this.loop;
      Object.assign(this.choice, choice);
      this.running = true;
      this.run += 1;
      this.#begin();
      this.#say({ type: "reset", at_s: this.at });
      this.rows = [];
    }
    this.event("stage", this.running ? `run ${this.run} began` : "stopped");
    this.announce();
    return { ok: true, stage: this.state.stage };
  }

  #setPace(request) {
    if (!this.pace) throw refuse(409, "nothing to pace: this is live");
    const { pace } = this;
    const back = request.do === "seek" && request.to_s < pace.at_s;
    const actions = {
      play: () => {
        pace.state = "playing";
      },
      pause: () => {
        pace.state = "paused";
      },
      step: () => {
        pace.at_s += request.by_s;
      },
      seek: () => {
        pace.at_s = request.to_s;
      },
      factor: () => {
        pace.factor = request.factor;
      },
      save: () => this.event("pace", "saved", { files: ["experiment.toml"] }),
    };
    actions[request.do]();
    if (back) this.#say({ type: "reset", at_s: pace.at_s });
    this.announce();
    return { ok: true, pace };
  }
}
