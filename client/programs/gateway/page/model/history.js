// What was told of one agent, for a while back.

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
      return;
    }
    // Time began anew, as it does in lock-step.
    if (last && state.t < last.t - 1e-6) this.states.length = 0;
    this.states.push(state);
    if (this.states.length > this.limit) this.thin();
  }

  thin() {
    const half = this.states.length >> 1;
    this.states = this.states.filter((_, i) => i >= half || i % 2 === 0);
  }

  get newest() {
    return this.states.at(-1);
  }

  /** The newest state that is not after `t`; of a time before all of them the first. */
  at(t) {
    const states = this.states;
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

/** Where a state leads if it goes on as it said, `t` after all that was told. */
export function positionAt(state, t, out = [0, 0, 0]) {
  const d = t - state.t, h = d * d / 2;
  for (let k = 0; k < 3; ++k) out[k] = state.p[k] + state.v[k] * d + state.a[k] * h;
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
 * The radius of the ball that contains all of an agent for certain at `t`, given what it declared:
 * its own radius, the errors of its state, and all that its acceleration may do since. Drawn, not
 * proven: the service computes with the declared speed, too, and rounds outward.
 */
export function certainRadius(state, declaration, t) {
  const d = Math.max(0, t - state.t);
  const radius = (declaration.radius_m ?? 0) + (declaration.margin_m ?? 0);
  const grown = radius + state.positionError + state.velocityError * d +
      (declaration.acceleration_max_m_s2 ?? 0) * d * d / 2 +
      (declaration.jerk_max_m_s3 ?? 0) * d * d * d / 6;
  return grown;
}
