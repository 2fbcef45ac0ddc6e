// A recorded world: a file that was dropped, or what a page of one file holds.
import { readItems } from "./items.js";

const TOPIC = "/page";
const UPLOAD_MAX = 256 * 2 ** 20;
const PART_BYTES = 2 ** 20;
const BREATH_MS = 40;  // Of work; then the page may draw.
const DEPARTED_MAX = 200000;

/** The time of a recording: it runs, stops, and is set. */
class Player {
  constructor(begin, end) {
    Object.assign(this, { begin, end, from: begin, since: null, rate: 1 });
  }

  time() {
    if (this.since === null) return this.from;
    const passed = (this.rate * (performance.now() - this.since)) / 1000;
    return Math.min(this.end, this.from + passed);
  }

  play(from) {
    this.from = Math.max(this.begin, Math.min(this.end, from));
    this.since = performance.now();
  }

  get isRunning() {
    return this.since !== null && this.time() < this.end;
  }
}

/**
 * Fills the model with all of a recording, and gives it a player. `messages`: an async iterable of
 * ArrayBuffers, in their order. `onBegin()`: there is something to show; up to then the model is as
 * it was. `onPart(t)`: the world's time so far.
 */
export async function load(model, messages, onBegin, onPart) {
  let begin = null, due = null;
  for await (const message of messages) {
    if (due === null) {
      onBegin();
      model.reset();
      model.departedMax = DEPARTED_MAX;
      due = performance.now() + BREATH_MS;
    }
    readItems(message, model);
    if (model.now && model.agents.size > 0) begin ??= model.now.t;
    if (performance.now() < due) continue;
    onPart(model.now?.t);
    await new Promise((done) => setTimeout(done));
    due = performance.now() + BREATH_MS;
  }
  if (begin === null) throw new Error("no agent is in it");
  model.player = new Player(begin, model.now.t);
  model.arrived();
}

/** The messages for the page in an MCAP file, as collisionctl convert and record write it. */
export async function* messagesOf(file) {
  const [{ McapIndexedReader, McapStreamReader }, { decompress }] =
    await Promise.all([import("@mcap/core"), import("fzstd")]);
  const zstd = (bytes, size) => decompress(bytes, new Uint8Array(Number(size)));
  const decompressHandlers = { zstd };
  const readable = {
    size: async () => BigInt(file.size),
    read: async (offset, length) => {
      const part = file.slice(Number(offset), Number(offset + length));
      return new Uint8Array(await part.arrayBuffer());
    },
  };
  let reader;
  try {
    reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  } catch {
    // Without an end: what wrote it was killed, or writes it yet.
    yield* wholeChunks(file, new McapStreamReader({ decompressHandlers, validateCrcs: true }));
    return;
  }
  if (![...reader.channelsById.values()].some(({ topic }) => topic === TOPIC)) {
    throw new Error(`it has no channel ${TOPIC}: collisionctl convert and record write one`);
  }
  for await (const { data } of reader.readMessages({ topics: [TOPIC] })) {
    yield data.slice().buffer;
  }
}

async function* wholeChunks(file, reader) {
  const channels = new Set();
  for (let at = 0; at < file.size; at += PART_BYTES) {
    reader.append(new Uint8Array(await file.slice(at, at + PART_BYTES).arrayBuffer()));
    for (let record; (record = reader.nextRecord()) !== undefined;) {
      if (record.type === "Channel" && record.topic === TOPIC) channels.add(record.id);
      if (record.type === "Message" && channels.has(record.channelId)) {
        yield record.data.slice().buffer;
      }
    }
  }
}

/** What the gateway makes of a recording of the service: { blob: an MCAP file, note }. */
export async function converted(file) {
  if (file.size > UPLOAD_MAX) {
    throw new Error("it has more than 256 MB: collisionctl convert makes an .mcap file of it");
  }
  const answer = await fetch("convert", { method: "POST", body: file });
  if (!answer.ok) throw new Error((await answer.text()).trim());
  return { blob: await answer.blob(), note: answer.headers.get("X-Collision-Note") ?? "" };
}

/** Messages from one gzipped text of base64: u32 length before each. */
export async function* messagesIn(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(plain).arrayBuffer();
  const view = new DataView(buffer);
  for (let at = 0; at + 4 <= buffer.byteLength;) {
    const length = view.getUint32(at, true);
    yield buffer.slice(at + 4, at + 4 + length);
    at += 4 + length;
  }
}
