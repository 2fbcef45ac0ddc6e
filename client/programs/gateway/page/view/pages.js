// The tables beside the view, one page at a time.
import { levelAt, LEVELS, statusAt } from "../model/world.js";
import {
  bracket, element, fullName, list, mark, quantity, seconds, table, worldTime,
} from "./format.js";
import { beginOf } from "./timeline.js";
import { drawHistory } from "./event_history.js";
import { servicePage, silencePage } from "./service_pages.js";

const ROWS_MAX = 100;

export const PAGES = [
  { id: "pairs", title: "Pairs" },
  { id: "agents", title: "Agents" },
  { id: "simulators", title: "Simulators" },
  { id: "service", title: "Service" },
  { id: "silence", title: "Why is it silent?" },
];

export class Pages {
  constructor(world, place, tabs, onChoose) {
    Object.assign(this, { world, place, onChoose, words: [] });
    this.detail = null;
    this.byGap = false;
    this.tabs = PAGES.map(({ id, title }) => {
      const tab = element("button", { role: "tab", id: `tab-${id}`, onclick: () => this.show(id) },
                          title);
      tabs.append(tab);
      return tab;
    });
    this.show("pairs");
  }

  show(id) {
    this.detail = null;
    this.id = id;
    PAGES.forEach((page, i) => this.tabs[i].setAttribute("aria-selected", page.id === id));
    this.place.setAttribute("aria-labelledby", `tab-${id}`);
    this.draw(this.world.time());
  }

  /** What was chosen is not there any more. */
  forget() {
    if (this.detail) this.show(this.id);
  }

  showEvent(one) {
    this.detail = { key: one.key };
    this.draw(this.world.time());
  }

  showAgent(agent) {
    this.detail = { agent };
    this.draw(this.world.time());
  }

  filter(text) {
    this.words = text.toLowerCase().split(/\s+/).filter(Boolean);
    this.draw(this.world.time());
  }

  matches(...texts) {
    if (this.words.length === 0) return true;
    const all = texts.map((text) => text()).join(" ").toLowerCase();
    return this.words.every((word) => all.includes(word));
  }

  draw(t) {
    const focused = document.activeElement?.dataset?.key;
    const scrolled = this.place.scrollTop;
    this.place.replaceChildren(...this.content(t));
    this.place.scrollTop = scrolled;
    if (focused) {
      const row = this.place.querySelector(`[data-key="${CSS.escape(focused)}"]`);
      row?.focus({ preventScroll: true });
    }
  }

  content(t) {
    if (this.detail?.key) return this.eventPage(this.world.events.get(this.detail.key), t);
    if (this.detail) return this.agentPage(this.detail.agent, t);
    switch (this.id) {
      case "pairs": return this.pairs(t);
      case "agents": return this.agents(t);
      case "simulators": return this.simulators();
      case "service": return servicePage(this.world);
      default: return silencePage(this.world);
    }
  }

  row(key, isChosen, act, ...cells) {
    return element("tr", {
      tabindex: 0, "data-key": key, class: isChosen ? "chosen" : undefined, onclick: act,
      onkeydown: (pressed) => pressed.key === "Enter" && act(),
    }, ...cells);
  }

  pairs(t) {
    const shown = [...this.world.standing].filter(({ event }) =>
      this.matches(() => fullName(event.lower), () => fullName(event.higher), () => event.status,
                   () => tagsOf(event.lower), () => tagsOf(event.higher)));
    const order = ({ event }) => {
      if (this.byGap) return gapOf(event)?.lower ?? Infinity;
      const level = levelAt(event, t);
      const begin = beginOf(event, t);
      // What stands; what is expected, then what may be, the nearest first; what was, the newest
      // first; what is expected to pass.
      if (level === 3) return begin - 1e12;
      if (level === 0) return 1e11 - begin;
      const expected = event.expected?.outcome === "touch" ? event.expected.begin.earliest_s : null;
      return expected !== null ? expected - t : begin - t +
        (event.expected?.outcome === "pass" ? 1e12 : 1e9);
    };
    const keys = new Map(shown.map((one) => [one, order(one)]));
    shown.sort((a, b) => keys.get(a) - keys.get(b));
    if (shown.length === 0) {
      return [element("p", { class: "empty" }, "No contact is possible or was told.")];
    }
    const sort = element("button", {
      "data-key": "by-gap", "aria-pressed": String(this.byGap), title: "Those that come nearest first",
      onclick: () => {
        this.byGap = !this.byGap;
        this.draw(this.world.time());
      } }, "Gap");
    return [table(["", "Pair", "Status", "Begins", sort],
      shown.slice(0, ROWS_MAX).map((one) => {
        const { event } = one;
        const level = levelAt(event, t);
        return this.row(one.key, false, () => this.onChoose({ event: one }),
          element("td", {}, mark(level === 0 ? "over" : LEVELS[level])),
          element("td", {}, `${event.lower.name} – ${event.higher.name}`),
          element("td", {}, statusText(one, t) + (event.level ? ` (${event.level})` : "")),
          element("td", {}, beginText(event, t)),
          element("td", { class: "number" }, gapText(event)));
      })), more(shown.length)].filter(Boolean);
  }

  agents(t) {
    const shown = [...this.world.agents.values()].filter((agent) =>
      this.matches(() => fullName(agent.info), () => tagsOf(agent.info),
                   () => agent.info.presence));
    shown.sort((a, b) => b.level - a.level || (a.key < b.key ? -1 : 1));
    if (shown.length === 0) return [element("p", { class: "empty" }, "No agent is here.")];
    return [table(["", "Agent", "Clear for", "State", "Breaches"],
      shown.slice(0, ROWS_MAX).map((agent) => {
        const state = agent.history.at(t);
        return this.row(agent.key, this.detail?.agent === agent,
          () => this.onChoose({ agent }),
          element("td", {}, mark(LEVELS[agent.level])),
          element("td", {}, fullName(agent.info)),
          element("td", { class: "number" }, clearText(state, t)),
          element("td", { class: "number" }, state ? ageText(t - state.t) : "none"),
          element("td", { class: "number" }, agent.info.breach?.count ?? 0));
      })), more(shown.length)].filter(Boolean);
  }

  simulators() {
    const status = this.world.status;
    const shown = (status?.simulators ?? []).filter((one) => this.matches(() => one.name));
    if (shown.length === 0) return [element("p", { class: "empty" }, "No simulator is here.")];
    return [table(["Simulator", "Clock", "Offset", "Agents", "Refused"], shown.map((one) =>
      element("tr", {},
        element("td", {}, one.name, one.alive ? "" : " (silent)"),
        element("td", { class: "number" }, seconds(one.clock_s)),
        element("td", {}, one.clock_offset?.earliest_s == null ? "–" :
          `${quantity(one.clock_offset.earliest_s, "s")} … ` +
          quantity(one.clock_offset.latest_s, "s")),
        element("td", { class: "number" }, one.agents),
        element("td", {}, one.refused_now > 0
          ? `${one.refused_now}: ${one.refused_why}` : "none"))))];
  }

  eventPage(one, t) {
    if (!one) return [element("p", { class: "empty" }, "That event is not kept any more.")];
    const { event } = one;
    const gap = event.proximity?.separation_m;
    return [
      this.back(),
      element("h2", {}, mark(LEVELS[levelAt(event, t)]), `${fullName(event.lower)} – ` +
        fullName(event.higher)),
      element("p", { class: "sentence" }, event.explanation ?? ""),
      list([
        ["Status", statusText(one, t) + (event.because ? `, since one has ${event.because}` : "")],
        ["Begins", bracket(event.begin)],
        ["Which is", Date.parse(this.world.status?.epoch_utc ?? "") > 0 &&
          event.begin.earliest_s != null &&
          worldTime(event.begin.earliest_s, this.world.status.epoch_utc).split(" · ")[1]],
        ["Ends", bracket(event.end)],
        ["Expected", expectedText(event)],
        ["Gap", gap && `${quantity(gap.lower, "m")} … ${quantity(gap.upper, "m")} at ` +
          seconds(event.proximity.at_s, 3)],
        ["Point", event.proximity?.point_m && `(${event.proximity.point_m.map((x) =>
          x.toFixed(2)).join(", ")}) m, within ${quantity(event.proximity.point_error_m, "m")}`],
        ["Closing at", event.proximity?.relative_velocity && quantity(
          Math.hypot(...event.proximity.relative_velocity.velocity_m_s), "m/s")],
        ["Cost", `${event.work_units} work units, trees to level ${event.tree_level}`],
        ["Limited by", event.limited_by === "none" ? "nothing" : event.limited_by],
        ["Revisions", one.revisions.length],
      ]),
      element("h2", {}, "How well its begin was known"),
      drawHistory(one),
      element("p", {}, ...[event.lower, event.higher].map((side) => {
        const agent = this.world.agentOf(side);
        return agent && element("button", { onclick: () => this.onChoose({ agent }) },
                                fullName(side));
      })),
    ];
  }

  agentPage(agent, t) {
    const state = agent.history.at(t), { declaration } = agent;
    const tags = Object.entries(agent.info.tags ?? {}).map(([k, v]) => `${k}: ${v}`).join(", ");
    const mine = [...this.world.standing].filter(({ event }) =>
      [event.lower, event.higher].some((side) => this.world.agentOf(side) === agent));
    return [
      this.back(),
      element("h2", {}, mark(LEVELS[agent.level]), fullName(agent.info)),
      list([
        ["Presence", agent.left === undefined ? agent.info.presence : "it has left"],
        ["Clear for", clearText(state, t)],
        ["Speed", state && quantity(Math.hypot(...state.v), "m/s")],
        ["State of", state && `${ageText(t - state.t)} ago`],
        ["Radius", quantity(declaration.radius_m, "m")],
        ["Acceleration at most", quantity(declaration.acceleration_max_m_s2, "m/s²")],
        ["Speed at most", quantity(declaration.speed_max_m_s, "m/s")],
        ["Shape", declaration.shape_hash?.slice(0, 12) ?? "a ball"],
        ["Assembly", agent.info.assembly],
        ["Tags", tags],
        ["Breaches", agent.info.breach
          ? `${agent.info.breach.count}, of ${agent.info.breach.field}` : "none"],
      ]),
      element("h2", {}, "Its events"),
      mine.length === 0 ? element("p", { class: "empty" }, "None.") : table(["", "With", "Begins"],
        mine.slice(-ROWS_MAX).reverse().map((one) => this.row(one.key, false,
          () => this.onChoose({ event: one }),
          element("td", {}, mark(LEVELS[levelAt(one.event, t)])),
          element("td", {}, fullName(this.world.agentOf(one.event.lower) === agent
            ? one.event.higher : one.event.lower)),
          element("td", {}, bracket(one.event.begin))))),
    ];
  }

  back() {
    return element("button", { onclick: () => this.show(this.id) }, "← back");
  }
}

/** How far apart the two are when they are nearest, as far as was told; null: it was not. */
const gapOf = (event) => event.status === "possible"
  ? event.expected?.closest?.distance_m : event.proximity?.separation_m ?? event.closest?.distance_m;

function gapText(event) {
  const gap = gapOf(event);
  if (!gap) return "–";
  return gap.upper != null && gap.upper <= 0 ? "touch" : quantity(Math.max(0, gap.lower), "m");
}

/** What was told by `t`, and what has been told since. */
function statusText(one, t) {
  const then = statusAt(one, t), now = one.event.status;
  return then === now ? now : `${then ?? "not told"} then, ${now} since`;
}

function beginText(event, t) {
  if (event.status !== "possible") return bracket(event.begin);
  if (event.expected?.outcome === "touch") return `expected ${bracket(event.expected.begin)}`;
  const passes = event.expected?.outcome === "pass" ? ", expected to pass" : "";
  return event.begin.earliest_s > t ? `not before ${event.begin.earliest_s.toFixed(2)} s${passes}`
    : `at any time${passes}`;
}

const tagsOf = (reference) => Object.values(reference.tags ?? {}).join(" ");

const ageText = (age) => (age < 0 ? `+${quantity(-age, "s")}` : quantity(age, "s"));

/** How long it is promised that nothing unannounced begins. */
function clearText(state, t) {
  if (!state || !Number.isFinite(state.t)) return "–";
  if (state.notClear) return "may touch";
  if (state.clearUntil === -Infinity) return "no promise";
  return state.clearUntil > t + 1e8 ? "for good" : quantity(Math.max(0, state.clearUntil - t), "s");
}

function expectedText(event) {
  const expected = event.expected;
  if (!expected) return null;
  if (expected.outcome === "touch") return `to touch, ${bracket(expected.begin)}`;
  if (expected.outcome !== "pass") return "undecided";
  const near = expected.closest?.distance_m;
  return near ? `to pass, ${quantity(near.lower, "m")} … ${quantity(near.upper, "m")} apart`
    : "to pass";
}

const more = (count) => count > ROWS_MAX
  ? element("p", { class: "empty" }, `and ${count - ROWS_MAX} more: search narrows it`) : null;
