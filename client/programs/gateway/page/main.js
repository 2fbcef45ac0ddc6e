// The page of collision-gateway: what is where, and which keys do what.
import { LiveSource } from "./source/live.js";
import { World } from "./model/world.js";
import { Opening } from "./view/opening.js";
import { drawLegend } from "./view/legend.js";
import { PAGES, Pages } from "./view/pages.js";
import { Scene3D } from "./view/scene3d.js";
import { Timeline } from "./view/timeline.js";
import { seconds, worldTime } from "./view/format.js";

const $ = (id) => document.getElementById(id);
const TABLES_MS = 500;   // Tables are read, not watched.
const TABLES_REST = 20;  // Of the time that they take, so that the view moves.
const LIVE_S = 600;      // So far back what is live can be looked at.
const REST_MAX_MS = 100; // After a frame, so that messages get their turn.

const world = new World();
const state = { paused: null, link: "", told: "", framed: false, hovered: null };
const scene = new Scene3D(world, $("scene"), (agent) => choose({ agent }));
const timeline = new Timeline(world, $("timeline"), $("tip"), (one) => choose({ event: one }),
  (one, t) => {
    state.hovered = one ? t : null;
    scene.wanted = true;
  });
const pages = new Pages(world, $("page"), document.querySelector("nav"), choose);

/** The time that is shown: that of the pointer over a bar, of the slider, or now. */
const shownTime = () => state.hovered ?? state.paused ?? world.time();

function choose({ agent, event }) {
  if (agent !== undefined) scene.chosen = agent;
  if (event) {
    timeline.chosen = event;
    pages.showEvent(event);
    scene.flyTo(event.event, state.paused ?? world.time());
    location.hash = `event=${encodeURIComponent(event.link)}`;
  } else if (agent) {
    pages.showAgent(agent);
    location.hash = `agent=${encodeURIComponent(agent.key)}`;
  }
  scene.wanted = true;
}

/** A link to an event or an agent counts as soon as it is there. */
function followLink() {
  const link = new URLSearchParams(location.hash.slice(1));
  const agent = link.get("agent") && world.agentByKey(link.get("agent"));
  const event = link.get("event") && world.eventByLink(link.get("event"));
  if (link.get("page") && PAGES.some(({ id }) => id === link.get("page"))) {
    pages.show(link.get("page"));
  }
  if (!agent && !event) return !link.get("agent") && !link.get("event");
  choose(event ? { event } : { agent });
  return true;
}
let linked = false;
addEventListener("hashchange", () => (linked = followLink()));

/** At `t`; null: it goes on, what is live from now, a recording from where it was. */
function pause(t) {
  const { player } = world;
  if (player) {
    const from = state.paused ?? player.time();
    if (t === null) player.play(from >= player.end ? player.begin : from);
    else t = Math.max(player.begin, Math.min(player.end, t));
  }
  state.paused = t;
  $("pause").setAttribute("aria-pressed", t !== null);
  $("pause").textContent = t === null ? "Pause" : "Go on";
  if (t === null && !player) $("scrub").value = 0;
  scene.wanted = true;
}

/** The newest time that there is to show. */
const newest = () => world.player?.end ?? world.time();

function tellVerdict() {
  const text = state.told || state.link || (world.connection && !world.connection.service_alive
    ? "no service of this world is heard" : world.connection?.unreadable ??
      world.status?.verdict?.[0] ?? "waiting for the service …");
  if ($("verdict").textContent !== text) $("verdict").textContent = text;
  $("verdict").classList.toggle("trouble", !state.told &&
    !text.startsWith("WELL") && !text.startsWith("waiting"));
}

function toggle(id, value) {
  $(id).setAttribute("aria-pressed", value);
  scene.wanted = true;
  return value;
}

const actions = {
  frame: () => scene.frame(shownTime()),
  follow: () => (scene.follows = toggle("follow", !scene.follows)),
  labels: () => (scene.shows.labels = toggle("labels", !scene.shows.labels)),
  trails: () => (scene.shows.trails = toggle("trails", !scene.shows.trails)),
  pause: () => pause(state.paused === null ? world.time() : null),
  live: () => pause(world.player ? world.player.end : null),
};
for (const [id, act] of Object.entries(actions)) $(id).addEventListener("click", act);
const KEYS = { f: "frame", g: "follow", l: "labels", t: "trails", " ": "pause", End: "live" };
addEventListener("keydown", (key) => {
  if (key.target.matches("input, button, [role=tab]") || key.ctrlKey || key.metaKey) return;
  if (key.key === "/") {
    key.preventDefault();
    return $("search").focus();
  }
  if (key.key === "ArrowLeft" || key.key === "ArrowRight") {
    const step = (key.shiftKey ? 1 : 0.1) * (key.key === "ArrowLeft" ? -1 : 1);
    return pause((state.paused ?? world.time()) + step);
  }
  if (!(key.key in KEYS)) return;
  key.preventDefault();
  actions[KEYS[key.key]]();
});
$("scrub").addEventListener("input", () => {
  const back = Number($("scrub").value), now = newest();
  if (now !== null) pause(back === 0 && !world.player ? null : now + back);
});
$("ahead").addEventListener("input", () => {
  scene.aheadS = Number($("ahead").value);
  $("ahead-text").textContent = seconds(scene.aheadS, 1);
  scene.wanted = true;
});
$("search").addEventListener("input", () => pages.filter($("search").value));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  scene.takeColors();
  drawLegend($("legend"));
});

world.addEventListener("anew", () => {
  pause(null);
  timeline.chosen = scene.chosen = null;
  pages.forget();
  state.framed = linked = false;
});
world.addEventListener("change", () => {
  scene.wanted = true;
  if (!state.framed && [...world.agents.values()].some((agent) => agent.history.newest)) {
    state.framed = true;
    scene.frame(world.time());
  }
  if (!linked) linked = followLink();
});

let tablesDue = 0;
function draw(began) {
  const t = shownTime();
  if (world.player && state.paused === null && !world.player.isRunning) pause(world.player.end);
  const moves = state.paused === null && state.hovered === null &&
    (world.player || world.now?.rate > 0);
  if (scene.wanted || moves) {
    if (state.paused !== null || state.hovered !== null || world.player) world.findLevels(t);
    scene.draw(t);
    timeline.draw(state.paused ?? world.time());
  }
  const now = newest();
  if (world.player) $("scrub").value = t - now;
  $("clock").textContent = worldTime(t, world.status?.epoch_utc);
  $("scrub-text").textContent = world.player ? seconds(t - world.player.begin)
    : state.paused === null ? "live" : seconds(state.paused - now);
  tellVerdict();
  if (began >= tablesDue) {
    const from = performance.now();
    pages.draw(state.paused ?? world.time());
    tablesDue = began + TABLES_MS + TABLES_REST * (performance.now() - from);
  }
  const took = performance.now() - began;
  setTimeout(() => requestAnimationFrame(draw), Math.min(REST_MAX_MS, took));
}

/** What the controls of time are for: the last `length` seconds of what is shown. */
function nameControls(length, scrub, open, live) {
  $("scrub").min = -length;
  $("scrub").setAttribute("aria-label", scrub);
  $("open").textContent = open;
  $("live").textContent = live;
}

drawLegend($("legend"));
let source = null;
const opening = new Opening(world, $("open"), $("file"), {
  tell: (text) => (state.told = text),
  begin: () => source?.close(),
  failed: () => {
    if (world.player) return;  // a former recording is still there
    nameControls(LIVE_S, "Seconds before now", "Open file", "Live");
    source?.goOn();
  },
  opened: (key) => {
    const { player } = world;
    nameControls(player.end - player.begin, "Seconds before the end", "Back to what is live", "End");
    $("open").hidden = own !== null;
    const event = world.events.get(key);
    pause(event?.event.begin.earliest_s ?? player.begin);
    if (event) choose({ event });
    if (location.hash) linked = followLink();
  },
});
const own = $("recorded");
if (own) opening.openOwn(own);
else source = new LiveSource(world, (text) => (state.link = text));
requestAnimationFrame(draw);

// For tests and the curious: what is drawn, in numbers.
window.collision = { world, scene, timeline, source, opening, shownTime, choose, pause };
