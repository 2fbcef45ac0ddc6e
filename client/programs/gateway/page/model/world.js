// The world as far as it was told: agents with their past, events, the service.
import { History, positionAt } from "./history.js";

const STATES_MAX = 400000;  // Of all agents together.
const STATES_LEAST = 16;    // Of one.
const EVENTS_MAX = 20000;
const DEPARTED_MAX = 2000;
const PACE_MS = 2000;
const CARRIED_MS = 500;     // So long at most time is carried on by itself.
const SOON_S = 2;           // A contact that may begin within it is near.

/** The service does not hold such an agent any more. */
const GONE = ["not-held", "evicted", "removed-silent"];

const isOpen = (event) => event.status === "possible" || event.status === "confirmed";

/** Levels of alert, as the legend has them; a higher one counts. */
export const LEVELS = ["calm", "possible", "soon", "contact"];

/** A name that stays the same from one run of the page to the next. */
export const agentKey = (reference) => `${reference.simulator ?? "?"}/${reference.name ?? "?"}`;
export const eventLink = (event) =>
  [agentKey(event.lower), agentKey(event.higher), event.contact, event.level ?? ""].join("+");

export class World extends EventTarget {
  constructor() {
    super();
    this.departedMax = DEPARTED_MAX;
    this.reset();
  }

  /** A new connection: all comes anew. */
  reset() {
    this.dispatchEvent(new Event("anew"));
    this.agents = new Map();  // by number
    this.byId = new Map();    // the newest agent, by "SIMULATOR.slot"
    this.departed = new Set();
    this.waiting = new Map(); // states of agents that are not described yet, by number
    this.events = new Map();  // by key
    this.standing = new Set(); // of these, what may be, is, or was a contact
    this.shapes = new Set();  // hashes that can be had
    this.bytes = new Map();   // of shapes that need not be fetched, by hash
    this.player = null;       // of a recording: it says what time it is
    this.status = null;
    this.skew = 0;
    this.earliest = null;
    this.connection = null;
    this.now = null;          // { t [s], heard [ms], rate }
    this.times = [];          // of the last PACE_MS, likewise
    this.version = 0;
  }

  take(item) {
    switch (item.item) {
      case "agent": return this.takeAgent(item.number, item.agent);
      case "event": return this.takeEvent(item);
      case "status":
        this.takeService(item.status);
        this.skew = item.skew_max_s;
        return this.takeNow(item.status.now_s);
      case "now": return this.takeNow(item.now_s);
      case "earliest": this.earliest = item.earliest; return;
      case "connection": this.connection = item; return;
      case "shape": this.shapes.add(item.hash); return;
    }
  }

  takeAgent(number, info) {
    const known = this.agents.get(number);
    if (!info || GONE.includes(info.presence)) {
      if (known) this.depart(known);
      return;
    }
    const isSame = known && known.info.generation === info.generation &&
        known.info.run === info.run;
    if (known && !isSame) this.depart(known);
    const agent = isSame ? known : { number, history: new History(this.limit()), level: 0 };
    agent.info = info;
    agent.key = agentKey(info);
    agent.declaration = info.declaration ?? {};
    const waiting = this.waiting.get(number);
    if (waiting) agent.history.add(waiting);
    this.waiting.delete(number);
    this.agents.set(number, agent);
    this.byId.set(idOf(info), agent);
  }

  /** It stays to be looked at in the past. */
  depart(agent) {
    this.agents.delete(agent.number);
    agent.left = this.now?.t ?? -Infinity;
    agent.level = 0;
    this.departed.add(agent);
    if (this.departed.size > this.departedMax) this.forget(this.departed.values().next().value);
  }

  forget(agent) {
    this.departed.delete(agent);
    if (this.byId.get(idOf(agent.info)) === agent) this.byId.delete(idOf(agent.info));
  }

  /** All that are there at `t`, those that have left since as well. */
  *agentsAt(t) {
    yield* this.agents.values();
    for (const agent of this.departed) if (t < agent.left) yield agent;
  }

  limit() {
    return Math.max(STATES_LEAST, Math.floor(STATES_MAX / (this.agents.size + 1)));
  }

  takeState(number, state) {
    const agent = this.agents.get(number);
    if (!state) return;
    if (!agent) return void this.waiting.set(number, state);
    agent.history.limit = this.limit();
    agent.history.add(state);
  }

  /** States of before this page was opened, by the numbers of their agents. */
  takePast(past) {
    for (const [number, states] of past) {
      const agent = this.agents.get(number);
      if (!agent) continue;
      agent.history.limit = this.limit();
      agent.history.addPast(states.filter((state) => state.generation === agent.info.generation));
    }
    this.arrived();
  }

  /**
   * What a service told in a former epoch is of another time. Of a service that has ended, and that
   * no standby succeeds, nobody knows whether its open events go on.
   */
  takeService(status) {
    const former = this.status;
    this.status = status;
    if (!former) return;
    const isSame = former.service_id === status.service_id;
    const isSuccessor = former.standbys.some((one) => one.service_id === status.service_id);
    for (const one of [...this.standing]) {
      const { event } = one;
      const isOfEpoch = event.service_id !== status.service_id || event.epoch >= status.epoch;
      if (!isOfEpoch) this.forgetEvent(one);
      else if (!isSame && !isSuccessor && event.service_id !== status.service_id &&
               isOpen(event)) this.standing.delete(one);
    }
  }

  forgetEvent(one) {
    this.events.delete(one.key);
    this.standing.delete(one);
  }

  takeShape(hash, bytes) {
    this.shapes.add(hash);
    this.bytes.set(hash, bytes);
  }

  async shapeBytes(hash) {
    const known = this.bytes.get(hash);
    if (known) return known;
    const answer = await fetch(`shapes/${hash}`);
    return answer.ok ? answer.arrayBuffer() : null;
  }

  takeEvent({ key, event, revisions, superseded }) {
    if (!event) {
      const gone = this.events.get(key);
      if (gone) this.forgetEvent(gone);
      return;
    }
    const known = this.events.get(key);
    const one = Object.assign(known ?? {}, { key, event, revisions, link: eventLink(event) });
    // A forecast that came to nothing is of no interest any more, and there are many.
    one.isIdle = superseded || event.status === "dismissed" || event.status === "withdrawn";
    this.events.set(key, one);
    one.isIdle ? this.standing.delete(one) : this.standing.add(one);
    if (this.events.size > EVENTS_MAX) {
      this.forgetEvent(this.events.values().next().value);
    }
  }

  takeNow(t) {
    if (t === null) return;
    if (this.now && t < this.now.t - 1) this.beginAnew(t);
    if (this.now && t <= this.now.t) return;
    const heard = performance.now();
    this.times.push({ t, heard });
    while (this.times.length > 2 && heard - this.times[1].heard > PACE_MS) this.times.shift();
    this.now = { t, heard, rate: this.pace() };
  }

  /** Seconds of the world in one of the wall: of the last two seconds, if they were seen. */
  pace() {
    if (this.status?.clock === "real-time") return 1;
    const [first, last] = [this.times[0], this.times.at(-1)];
    const seen = last.heard - first.heard;
    return seen < PACE_MS / 4 ? 0 : (1000 * (last.t - first.t)) / seen;
  }

  /** Time has begun anew, as it does in lock-step: what was told of later times is of before. */
  beginAnew(t) {
    this.now = null;
    this.times = [];
    for (const agent of [...this.departed]) this.forget(agent);
    for (const one of [...this.events.values()]) {
      if (one.event.now_s > t + 1) this.forgetEvent(one);
    }
    this.dispatchEvent(new Event("anew"));
  }

  /** All of a message has been taken. */
  arrived() {
    ++this.version;
    this.findLevels();
    this.dispatchEvent(new Event("change"));
  }

  /** The world's time, carried on at its pace for as long as it may take to be told anew. */
  time() {
    if (this.player) return this.player.time();
    if (!this.now) return null;
    const elapsed = Math.min(CARRIED_MS, performance.now() - this.now.heard);
    return this.now.t + (this.now.rate * elapsed) / 1000;
  }

  agentOf(reference) {
    return this.byId.get(idOf(reference));
  }

  /**
   * How far apart the two of an event are at `t`, by the states that were told: { centres, balls },
   * the latter between the balls of their radii [m]; null: one of them is not known then, or has no
   * centre.
   */
  apart(event, t) {
    const places = [event.lower, event.higher].map((side) => {
      const agent = this.agentOf(side), state = agent?.history.at(t);
      return state && !agent.declaration.half_space
        ? { p: positionAt(state, t), radius: agent.declaration.radius_m ?? 0 } : null;
    });
    if (places.includes(null)) return null;
    const centres = Math.hypot(...places[0].p.map((x, k) => x - places[1].p[k]));
    return { centres, balls: centres - places[0].radius - places[1].radius };
  }

  agentByKey(key) {
    for (const agent of this.agents.values()) if (agent.key === key) return agent;
    return undefined;
  }

  eventByLink(link) {
    for (const one of this.events.values()) if (one.link === link) return one;
    return undefined;
  }

  /** How near to a contact each agent is at `t`, by the events that are open then. */
  findLevels(t = this.now?.t) {
    for (const agent of this.agentsAt(-Infinity)) agent.level = 0;
    if (t == null) return;
    for (const { event } of this.standing) {
      const level = levelAt(event, t);
      if (level === 0) continue;
      for (const side of [event.lower, event.higher]) {
        const agent = this.agentOf(side);
        if (agent) agent.level = Math.max(agent.level, level);
      }
    }
  }

  /** The box of all agents at `t`, as { center, radius }. */
  extent(t) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const p = [0, 0, 0];
    let radius = 1;
    for (const agent of this.agentsAt(t)) {
      const state = agent.history.at(t);
      if (!state || agent.declaration.half_space) continue;
      positionAt(state, t, p);
      const own = agent.declaration.radius_m ?? 0;
      radius = Math.max(radius, own);
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k], p[k] - own);
        high[k] = Math.max(high[k], p[k] + own);
      }
    }
    if (low[0] === Infinity) return { center: [0, 0, 0], radius: 10 };
    const center = low.map((x, k) => (x + high[k]) / 2);
    return { center, radius: Math.max(radius, Math.hypot(...high.map((x, k) => x - low[k])) / 2) };
  }
}

/** What was told of an event at `t`; undefined: nothing yet. */
export function statusAt(one, t) {
  return one.revisions.findLast((revision) => revision.now_s <= t)?.status;
}

const idOf = (reference) => `${reference.simulator_id}.${reference.slot}`;

/** The level of an event at `t`: index into LEVELS. */
export function levelAt(event, t) {
  const begin = event.begin, end = event.end;
  const isOver = end?.latest_s != null && end.latest_s < t;
  if (event.status === "confirmed" || event.status === "ended" || event.status === "undecided") {
    if (isOver) return 0;
    if (begin.latest_s != null && begin.latest_s <= t) return event.level ? 2 : 3;
    return begin.earliest_s - t < SOON_S ? 2 : 1;
  }
  if (event.status !== "possible") return 0;
  return begin.earliest_s - t < SOON_S && event.expected?.outcome === "touch" ? 2 : 1;
}
