// What was told of one agent, for a while back.

const BEFORE_S = 0.5;

/** States by their time; of a long past every second one is forgotten. */
export class History {
  constructor(limit) {
    this.limit = limit;
    this.states = [];
  }

  add(state) {
    const last = this.states.at(-1);
    if (last && last.t === state.t) {
      this.states[this.states.length - 1] = state;  // a clearance came, or a jump
      if (this.states.length > 1) this.states.at(-2).next = state;
      return;
    }
    // Time began anew, as it does in lock-step.
    if (last && state.t < last.t - 1e-6) this.states.length = 0;
    else if (last) last.next = state;
    this.states.push(state);
    if (this.states.length > this.limit) this.thin();
  }

  /** States of before all that are there, in their order. */
  addPast(states) {
    const first = this.states[0]?.t ?? Infinity;
    const past = states.filter(({ t }, i) => t < first && (i === 0 || t > states[i - 1].t));
    this.states = [...past, ...this.states];
    this.link();
    if (this.states.length > this.limit) this.thin();
  }

  thin() {
    const half = this.states.length >> 1;
    this.states = this.states.filter((_, i) => i >= half || i % 2 === 0);
    this.link();
  }

  /** Each knows the next. */
  link() {
    this.states.forEach((state, i) => (state.next = this.states[i + 1]));
  }

  get newest() {
    return this.states.at(-1);
  }

  /**
   * The newest state that is not after `t`. The first one counts a little before its time, too:
   * before that nothing is known.
   */
  at(t) {
    const states = this.states;
    if (states.length === 0 || t < states[0].t - BEFORE_S) return undefined;
    let low = 0, high = states.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (states[middle].t <= t) low = middle + 1;
      else high = middle;
    }
    return states[Math.max(0, low - 1)];
  }

  /** Those within [from, to]. */
  between(from, to) {
    return this.states.filter((state) => state.t >= from && state.t <= to);
  }
}

/** Where an agent is: on the cubic curve to the next state, if that is known; else carried on. */
export function positionAt(state, t, out = [0, 0, 0]) {
  const { next } = state;
  return next && t > state.t && t < next.t && !next.jumped ? cubicBetween(state, next, t, out)
    : carriedOn(state, t, out);
}

/** Where a state leads if the agent keeps what it said. */
export function carriedOn(state, t, out = [0, 0, 0]) {
  const d = t - state.t, h = d * d / 2;
  for (let k = 0; k < 3; ++k) out[k] = state.p[k] + state.v[k] * d + state.a[k] * h;
  return out;
}

/** Hermite's cubic through the positions and velocities of two states. */
function cubicBetween(a, b, t, out) {
  const span = b.t - a.t, s = (t - a.t) / span, r = 1 - s;
  const atA = r * r * (1 + 2 * s), atB = s * s * (1 + 2 * r);
  for (let k = 0; k < 3; ++k) {
    out[k] = atA * a.p[k] + atB * b.p[k] + span * s * r * (r * a.v[k] - s * b.v[k]);
  }
  return out;
}

/** The orientation (w x y z), turned on by the angular velocity that was told. */
export function orientationAt(state, t) {
  const [wx, wy, wz] = state.w, d = t - state.t;
  const rate = Math.hypot(wx, wy, wz);
  if (rate * Math.abs(d) < 1e-9) return state.q;
  const s = Math.sin(rate * d / 2) / rate, c = Math.cos(rate * d / 2);
  const [w, x, y, z] = state.q;
  const a = wx * s, b = wy * s, e = wz * s;  // (c, a, b, e) times q
  return [c * w - a * x - b * y - e * z, c * x + a * w + b * z - e * y,
          c * y - a * z + b * w + e * x, c * z + a * y - b * x + e * w];
}

/**
 * The radius of the ball that contains all of an agent at `t`, given what it declared: its own
 * radius, the errors of its state, all that its acceleration may do, the steps of its integrator,
 * and a clock that is off by up to `skew` [s]. The bound of the service in doubles, to nearest: it
 * may differ in the last digits. Source: collision_core/motion/space_time_bound.h.
 */
export function certainRadius(state, declaration, t, skew = 0) {
  const length = Math.abs(t - state.t) + skew, h = declaration.time_step_s ?? 0;
  const own = (declaration.radius_m ?? 0) + (declaration.margin_m ?? 0);
  const acceleration = declaration.acceleration_max_m_s2 ?? 0;
  const jerk = declaration.jerk_max_m_s3 ?? 0;
  return own + state.positionError + Math.hypot(...state.v) * skew +
    state.velocityError * length + acceleration * length * (length + h) / 2 +
    jerk * length * (length * length + 3 * h * length + 3 * h * h) / 6 +
    Math.hypot(...state.a) * (skew + h / 2) * length;
}
