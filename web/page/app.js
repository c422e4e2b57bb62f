// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Puts the page together: the feed fills the model, and each part shows its share of it.

import { get } from "./api.js";
import { ChartPanel } from "./chartpanel.js";
import { Conditions } from "./conditions.js";
import { announce, byId, fillSelect, say } from "./dom.js";
import { Events } from "./events.js";
import { openFeed } from "./feed.js";
import { offerFullScreen, offerGuide } from "./guide.js";
import { Hand } from "./hand.js";
import { Lamps } from "./lamps.js";
import { Link } from "./link.js";
import { Model } from "./model.js";
import { Network } from "./network.js";
import { Orbit } from "./orbit.js";
import { Pace } from "./pace.js";
import { painterFor } from "./painters.js";
import { Rhythm } from "./rhythm.js";
import { Stage } from "./stage.js";
import { isOver, statusOf } from "./status.js";
import { Stories } from "./stories.js";
import { Timeline } from "./timeline.js";
import { Trap } from "./trap.js";
import { withMicro } from "./units.js";
import { farthestOf, meanOf, sentenceOf, verdictOf } from "./verdict.js";
import { Wishes } from "./wishes.js";
import { Worlds } from "./worlds.js";

const describeMs = 100; // so that number and picture agree

const model = new Model();
const orbit = new Orbit();
const worlds = new Worlds(byId("worlds"), model, orbit);
const lamps = new Lamps(byId("wire"), model);
const pace = new Pace(model);
const timeline = new Timeline(model, (seconds) => pace.seek(seconds));
const events = new Events(model);
let charts = null;
let feed = null;
const hand = new Hand({ model, orbit, send: (message) => feed?.send(message) });

const tell = (text, isError) => {
  say(byId("effect"), withMicro(text));
  byId("effect").classList.toggle("error", isError);
  if (isError) announce(text);
};
const lasts = () => (byId("lasts").checked ? `${Number(byId("lasts-s").value) || 30}s` : null);

/** The letters of the peers that a path joins: "1-2" is that of peers 1 and 2. */
const ends = (path) => {
  const found = /^(\d+)-(\d+)$/.exec(path);
  const letter = (id) => model.peers.find((peer) => peer.id === Number(id))?.letter ?? id;
  return found
    ? [letter(found[1]), letter(found[2])]
    : [model.peers[0]?.letter ?? "A", model.peers[1]?.letter ?? "B"];
};

new Network({
  container: byId("sliders"),
  linked: byId("linked"),
  order: byId("order"),
  model,
  wishes: new Wishes(tell, lasts),
  ends,
  tell,
});
const conditions = new Conditions(model, tell);
const stage = new Stage(model, () => conditions.preset);
new Stories(model, (story) => stage.tell(story), () => conditions.preset);
new Link(model, () => conditions.preset);
offerGuide();
offerFullScreen();
new Trap(model);

const showPath = () => {
  const paths = model.paths.length > 0 ? model.paths : [""];
  fillSelect(
    byId("path"),
    paths.map((path) => [path, ends(path).join(" – ")]),
  );
  byId("path-choice").hidden = paths.length < 2;
  const path = paths.includes(byId("path").value) ? byId("path").value : paths[0];
  lamps.show(path, ends(path));
  charts?.show(path, ends(path));
};
byId("path").addEventListener("change", showPath);

const rangeButtons = [...document.querySelectorAll("[data-seconds]")];
rangeButtons.forEach((button) =>
  button.addEventListener("click", async () => {
    charts.seconds = Number(button.dataset.seconds);
    rangeButtons.forEach((one) => one.setAttribute("aria-pressed", String(one === button)));
    if (charts.seconds > 120)
      model.addCoarseHistory(await get("/api/history").catch(() => ({ columns: [] })));
  }),
);

/** The unit of the large number, and between whom it is. */
const pairName = (farthest) => {
  const letter = (id) => model.peers.find((peer) => peer.id === id)?.letter ?? String(id);
  return farthest ? `mm between ${letter(farthest.a)} and ${letter(farthest.b)}` : "mm apart";
};

/** Timing of what is watched: whether its own lateness would spoil what is seen. */
const timing = () => {
  const names = [...model.fine.columns.keys()].filter((name) => name.includes("late_us:"));
  const most = Math.max(...names.map((name) => model.fine.summary(name, 10)?.most ?? 0), 0);
  if (names.length === 0) return ["", "–"];
  return most < 1000 ? ["met", "on time"] : ["missed", `${(most / 1000).toFixed(1)} ms late`];
};

const describe = () => {
  const farthest = farthestOf(model);
  worlds.describe(farthest);
  hand.describe();
  lamps.describe();
  charts?.describe();
  const first = model.frame?.peers?.find(Boolean);
  const at = first?.session?.at_s;
  if (first || !isOver(model.state)) // else it stays at the end
    say(byId("clock"), Number.isFinite(at) ? `t = ${at.toFixed(1)} s` : "t = –");
  const [kind, words] = timing();
  byId("timing").className = `pill ${kind}`;
  say(byId("timing"), words);
  const verdict = verdictOf(model);
  byId("verdict").className = `badge tier-${verdict.tier}`;
  say(byId("verdict"), verdict.says);
  const back = model.lookingAt === null ? "" : `Looking back. `;
  say(byId("sentence"), back + sentenceOf(model, farthest));
  say(byId("apart"), farthest ? farthest.apart.toFixed(1) : "–");
  say(byId("pair"), pairName(farthest));
  say(byId("apart-mean"), meanOf(model, farthest));
};

const showState = (state) => {
  document.body.dataset.peers = String(model.peers.length);
  const isAlone = model.peers.length === 0 && Boolean(state.emulator?.attached);
  document.body.dataset.alone = String(isAlone);
  document.body.dataset.matrix = String(model.paths.length > 1);
  const isRecord = Boolean(state.pace?.read_only);
  const time = isRecord ? "from records" : "virtual time";
  say(byId("mode"), state.mode === "virtual" ? time : "live UDP");
  byId("read-only").hidden = !isRecord;
  byId("network-controls").hidden = isRecord;
  byId("wire").hidden = isRecord;
  const { says } = statusOf(state);
  byId("help").hidden = says === "";
  say(byId("help-text"), says);
  showPath();
};
model.addEventListener("state", ({ detail }) => showState(detail));

const connection = ({ open, says }) => {
  document.body.classList.toggle("offline", !open);
  byId("connection").hidden = open;
  say(byId("connection"), says);
};

// Any change repaints the whole page, so all parts change in the same turns.
let described = 0;
document.addEventListener("visibilitychange", () => rhythm.rest());
let rhythm = new Rhythm();
const turn = (now) => {
  requestAnimationFrame(turn); // stands still while the tab is hidden
  if (!rhythm.turn(now)) return;
  worlds.paint();
  lamps.draw(now);
  charts?.draw(now);
  timeline.draw(now);
  if (now - described < describeMs) return;
  described = now;
  describe();
};

/** Resolves once the browser has shown the page: what draws in space is loaded after that. */
const painted = () => new Promise((resolve) => {
  if (!PerformanceObserver.supportedEntryTypes?.includes("paint")) resolve();
  else new PerformanceObserver(resolve).observe({ type: "paint", buffered: true });
});

const start = async () => {
  feed = openFeed({
    hello: (message) => {
      events.clear();
      model.hello(message);
      say(byId("version"), message.version ?? "");
    },
    history: (message) => model.addHistory(message),
    frame: (message) => model.addFrame(message),
    state: (message) => model.setState(message.state),
    event: (message) => model.addEvent(message),
    reset: () => model.clear(),
    hand: (message) => hand.told(message),
    connection,
  });
  await painted();
  charts = new ChartPanel(byId("charts"), byId("chart-table"), model);
  if (model.state) showPath();
  requestAnimationFrame(turn);
  const three = byId("three").getAttribute("href") !== ""; // else the build lacks three.js
  byId("credit").hidden = !three;
  const painter = await painterFor(byId("worlds"), three);
  rhythm = new Rhythm({ level: painter.level });
  rhythm.addEventListener("change", () => painter.setLevel(rhythm.level));
  worlds.painter = painter;
  document.body.dataset.view = painter.kind;
};
start();
// For the tests, and for the curious at the console.
globalThis.hapnet = { model, orbit, worlds, hand, get rhythm() { return rhythm; } };
