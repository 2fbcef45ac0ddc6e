// Recordings for tests: scenes, what their transcripts hold, and MCAP files as they are in bytes.
// The transcript and the records of a file are read here by hand, so that nothing of ours judges
// itself.
import { execFile } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import protobuf from "protobufjs";
import descriptor from "protobufjs/ext/descriptor/index.js";

const BIN = process.env.COLLISION_BIN_DIR;

/** Runs a program to its end: { status, out, err }; `out` in bytes. */
export const run = (world, program, ...words) => new Promise((resolve) => {
  execFile(join(BIN, program), words, {
    env: world.environment, encoding: "buffer", maxBuffer: 1 << 28,
  }, (error, out, err) => resolve({ status: error ? error.code : 0, out, err: String(err) }));
});

/** A recording of a scene in lock-step; its path. */
export async function recordScene(world, scene, seconds, domain, ...words) {
  const file = join(world.folder, `${scene}.rec`);
  const { status, out, err } = await run(world, "scene-runner", scene, "--unjudged", "--seconds",
    String(seconds), "--domain", String(domain), "--record", file, ...words);
  if (status !== 0) throw new Error(`${scene}: ${status}: ${out}${err}`);
  return file;
}

/** The fields of a message: { number, value }; of variable length a number or bytes. */
export function* fieldsOf(bytes) {
  let at = 0;
  const varint = () => {
    let value = 0n;
    for (let shift = 0n;; shift += 7n) {
      const byte = bytes[at++];
      value |= BigInt(byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  while (at < bytes.length) {
    const key = Number(varint()), number = key >> 3;
    switch (key & 7) {
      case 0: yield { number, value: varint() }; break;
      case 1: yield { number, value: bytes.subarray(at, at += 8) }; break;
      case 2: {
        const length = Number(varint());
        if (at + length > bytes.length) throw new Error("cut off");
        yield { number, value: bytes.subarray(at, at += length) };
        break;
      }
      case 5: yield { number, value: bytes.subarray(at, at += 4) }; break;
      default: throw new Error(`wire type ${key & 7}`);
    }
  }
}

const valueOf = (bytes, number) =>
  [...fieldsOf(bytes)].find((field) => field.number === number)?.value;

// By the numbers of idl/messages.proto.
const INPUTS = {
  2: "agent_description", 3: "shape", 4: "agent_states", 5: "simulator_clock", 6: "agent_removal",
  7: "liveliness", 8: "shape_removal", 9: "shape_ready", 10: "service_heard",
  11: "operator_command", 12: "event_of_another_service", 15: "simulator_hello", 16: "watch",
};
const OUTPUTS = {
  1: "clearance", 2: "earliest_intersection", 3: "event", 4: "rejection", 5: "service_status",
  6: "simulator_report", 7: "service_hello", 8: "agent_breach", 9: "screening_event",
};

function messageOf(holder, topics) {
  const field = [...fieldsOf(holder)].find(({ number }) => number in topics);
  return field && { topic: topics[field.number], bytes: field.value };
}

/**
 * The steps of a transcript: { wall, messages: [{ topic, bytes }] }, in their order. Of events the
 * topic is "event".
 */
export function stepsOf(transcript) {
  const steps = [];
  let at = 0, continues = false;
  while (at < transcript.length) {
    let length = 0;
    for (let shift = 0;; shift += 7) {
      const byte = transcript[at++];
      length += (byte & 127) * 2 ** shift;
      if (byte < 128) break;
    }
    const entry = transcript.subarray(at, at += length);
    const batch = valueOf(entry, 2), told = valueOf(entry, 5);
    if (batch) {
      if (!continues) steps.push({ wall: valueOf(batch, 1) ?? 0n, messages: [] });
      continues = valueOf(batch, 5) === 1n;
      for (const { number, value } of fieldsOf(batch)) {
        const message = number === 3 && messageOf(value, INPUTS);
        if (message) steps.at(-1).messages.push(message);
      }
    } else if (told) {
      steps.at(-1).messages.push(messageOf(valueOf(told, 2), OUTPUTS));
    }
  }
  return steps;
}

const zstd = (bytes, size) => decompress(bytes, new Uint8Array(Number(size)));

/** All in the order of the file, each chunk with its checksum; { done } says whether it is whole. */
export function readStream(bytes) {
  const reader = new McapStreamReader({ decompressHandlers: { zstd }, validateCrcs: true });
  reader.append(bytes);
  const file = { schemas: new Map(), channels: new Map(), messages: [], metadata: [] };
  for (let record; (record = reader.nextRecord());) {
    if (record.type === "Schema") file.schemas.set(record.id, record);
    if (record.type === "Channel") file.channels.set(record.id, record);
    if (record.type === "Metadata") file.metadata.push(record);
    if (record.type === "Statistics") file.statistics = record;
    if (record.type !== "Message") continue;
    file.messages.push({ ...record, topic: file.channels.get(record.channelId).topic });
  }
  return { ...file, done: reader.done() };
}

/** By its index, whose checksum is compared. */
export const openIndexed = (bytes) => McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  },
  decompressHandlers: { zstd },
});

export async function messagesBy(reader, how) {
  const messages = [];
  for await (const message of reader.readMessages(how)) {
    messages.push({ ...message, topic: reader.channelsById.get(message.channelId).topic });
  }
  return messages;
}

/** The records at the top of a file: { opcode, begin, end, content }. */
export function recordsOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const records = [];
  for (let at = 8; at < bytes.length - 8;) {
    const begin = at, length = Number(view.getBigUint64(at + 1, true));
    at += 9 + length;
    records.push({ opcode: bytes[begin], begin, end: at, content: bytes.subarray(begin + 9, at) });
  }
  return records;
}

/** That of zlib. */
export function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return ~crc >>> 0;
}

/** Decoders of a file's messages, by topic, from the schemas that it holds. */
export function decodersOf({ schemas, channels }) {
  const types = new Map();
  for (const { id, name, encoding, data } of schemas.values()) {
    if (encoding !== "protobuf") continue;  // Plain numbers: foxglove_test.mjs reads those.
    const set = descriptor.FileDescriptorSet.decode(data);
    types.set(id, protobuf.Root.fromDescriptor(set).resolveAll().lookupType(name));
  }
  const decoders = new Map();
  for (const { topic, schemaId, messageEncoding } of channels.values()) {
    if (messageEncoding === "protobuf") decoders.set(topic, types.get(schemaId));
  }
  return decoders;
}

/** A converted recording: { path, bytes, file, decoders, decoded(topic) }. */
export async function convert(world, recording, ...words) {
  const path = recording.replace(/(\.\w+)?$/, ".mcap");
  const { status, err } = await run(world, "collisionctl", "convert", recording, path, ...words);
  if (status !== 0) throw new Error(err);
  const bytes = new Uint8Array(readFileSync(path)), file = readStream(bytes);
  const decoders = decodersOf(file);
  const decoded = (topic) => file.messages.filter((message) => message.topic === topic)
    .map(({ data }) => decoders.get(topic).decode(data));
  return { path, bytes, file, decoders, decoded };
}
