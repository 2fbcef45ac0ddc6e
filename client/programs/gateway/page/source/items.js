// The items of the gateway's protocol (gateway/scene/item.h, state_table.h) from their bytes.

const KIND_JSON = 0, KIND_STATES = 1;
const HAS_STATE = 1, NOT_CLEAR = 2, SATURATED = 4, DISCONTINUITY = 8;
const HEADER_BYTES = 64, STATE_BYTES = 64, SHORT_MAX = 32000;

const text = new TextDecoder();

/** Calls `onJson(object)` and `onState(number, state | null)` for all that is in a message. */
export function readItems(buffer, onJson, onState) {
  const view = new DataView(buffer);
  for (let at = 0; at + 8 <= buffer.byteLength;) {
    const kind = view.getUint32(at, true), length = view.getUint32(at + 4, true);
    at += 8;
    if (at + length > buffer.byteLength) throw new Error("an item is cut off");
    if (kind === KIND_JSON) {
      onJson(JSON.parse(text.decode(new Uint8Array(buffer, at, length))));
    } else if (kind === KIND_STATES) {
      readStates(view, at, onState);
    }
    at += length;
  }
}

/**
 * One chunk. A state: t [s], position p [m], velocity v, acceleration a, angular velocity w, all in
 * the world frame; orientation q (w x y z); errors of position and velocity; until when it is
 * clear.
 */
function readStates(view, at, onState) {
  const first = view.getUint32(at, true), count = view.getUint32(at + 4, true);
  const f64 = (offset) => view.getFloat64(at + offset, true);
  const base = f64(8), origin = [f64(16), f64(24), f64(32)];
  const step = f64(40), accelerationUnit = f64(48), rotationUnit = f64(56);
  for (let i = 0; i < count; ++i) {
    const s = at + HEADER_BYTES + i * STATE_BYTES;
    const flags = view.getUint32(s, true);
    if (!(flags & HAS_STATE)) {
      onState(first + i, null);
      continue;
    }
    const i16 = (offset, unit) => view.getInt16(s + offset, true) * unit;
    const f32 = (offset) => view.getFloat32(s + offset, true);
    onState(first + i, {
      t: base + 1e-6 * view.getInt32(s + 4, true),
      p: [0, 1, 2].map((k) => origin[k] + step * view.getInt32(s + 8 + 4 * k, true)),
      v: [f32(20), f32(24), f32(28)],
      a: [i16(32, accelerationUnit), i16(34, accelerationUnit), i16(36, accelerationUnit)],
      w: [i16(38, rotationUnit), i16(40, rotationUnit), i16(42, rotationUnit)],
      q: [44, 46, 48, 50].map((offset) => i16(offset, 1 / SHORT_MAX)),
      positionError: f32(52),
      velocityError: f32(56),
      clearUntil: base + f32(60),
      notClear: (flags & NOT_CLEAR) !== 0,
      saturated: (flags & SATURATED) !== 0,
      jumped: (flags & DISCONTINUITY) !== 0,
    });
  }
}
