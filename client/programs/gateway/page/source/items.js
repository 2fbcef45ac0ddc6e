// The items of the gateway's protocol (scene/item.h, state_table.h) from their bytes.

const KIND_JSON = 0, KIND_STATES = 1, KIND_CHANGED = 2, KIND_SHAPE = 3;
const HASH_BYTES = 32;
const HAS_STATE = 1, NOT_CLEAR = 2, SATURATED = 4, DISCONTINUITY = 8;
const HEADER_BYTES = 8, STATE_BYTES = 96, ORIENTATION_ONE = 32000;

const text = new TextDecoder();

/**
 * Hands all that is in a message to `model`: take(object), takeState(number, state | null),
 * takeShape(hash, bytes).
 */
export function readItems(buffer, model) {
  const view = new DataView(buffer);
  for (let at = 0; at + 8 <= buffer.byteLength;) {
    const kind = view.getUint32(at, true), length = view.getUint32(at + 4, true);
    at += 8;
    if (at + length > buffer.byteLength) throw new Error("an item is cut off");
    if (kind === KIND_JSON) {
      model.take(JSON.parse(text.decode(new Uint8Array(buffer, at, length))));
    } else if (kind === KIND_STATES) {
      readStates(view, at, model);
    } else if (kind === KIND_CHANGED) {
      readChanged(view, at, length, model);
    } else if (kind === KIND_SHAPE) {
      const hash = [...new Uint8Array(buffer, at, HASH_BYTES)];
      model.takeShape(hash.map((byte) => byte.toString(16).padStart(2, "0")).join(""),
                      buffer.slice(at + HASH_BYTES, at + length));
    }
    at += length;
  }
}

/** The items of a message, each as a message. */
export function* splitItems(buffer) {
  const view = new DataView(buffer);
  for (let at = 0; at + 8 <= buffer.byteLength;) {
    const end = at + 8 + view.getUint32(at + 4, true);
    yield buffer.slice(at, end);
    at = end;
  }
}

function readStates(view, at, model) {
  const first = view.getUint32(at, true), count = view.getUint32(at + 4, true);
  for (let i = 0; i < count; ++i) {
    model.takeState(first + i, readState(view, at + HEADER_BYTES + i * STATE_BYTES));
  }
}

/** Rows whose first bytes come first, then all second ones, and so on. */
function readChanged(view, at, length, model) {
  const row = HEADER_BYTES + STATE_BYTES, count = Math.floor(length / row);
  const rows = new DataView(new ArrayBuffer(count * row));
  for (let k = 0; k < row; ++k) {
    for (let i = 0; i < count; ++i) rows.setUint8(i * row + k, view.getUint8(at + k * count + i));
  }
  for (let s = 0; s < count * row; s += row) {
    model.takeState(rows.getUint32(s, true), readState(rows, s + HEADER_BYTES));
  }
}

/**
 * A state: t [s], position p [m], velocity v, acceleration a, angular velocity w, all in
 * the world frame; orientation q (w x y z); errors of position and velocity; until when it is
 * clear.
 */
function readState(view, s) {
  const flags = view.getUint32(s, true);
  if (!(flags & HAS_STATE)) return null;
  const f32 = (offset) => view.getFloat32(s + offset, true);
  const f64 = (offset) => view.getFloat64(s + offset, true);
  const i16 = (offset) => view.getInt16(s + offset, true) / ORIENTATION_ONE;
  const t = f64(8);
  return {
    t,
    p: [f64(16), f64(24), f64(32)],
    v: [f32(40), f32(44), f32(48)],
    a: [f32(52), f32(56), f32(60)],
    w: [f32(64), f32(68), f32(72)],
    q: [i16(84), i16(86), i16(88), i16(90)],
    generation: view.getUint32(s + 92, true),
    positionError: f32(76),
    velocityError: f32(80),
    clearUntil: t + f32(4),
    notClear: (flags & NOT_CLEAR) !== 0,
    saturated: (flags & SATURATED) !== 0,
    jumped: (flags & DISCONTINUITY) !== 0,
  };
}
