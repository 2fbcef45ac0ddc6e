// Goal:   an MCAP file holds what its recording holds, message for message, in a form that others
//         read; recording to it live is the same; what cannot be done is told in a sentence.
// Method: scenes are recorded, replayed as a transcript and converted; @mcap/core reads the files,
//         protobufjs decodes with the schemas in them, and checksums are computed anew.
import assert from "node:assert/strict";
import { copyFileSync, existsSync, mkdirSync, readFileSync, truncateSync, writeFileSync }
  from "node:fs";
import { after, before, test } from "node:test";
import {
  convert, crc32, decodersOf, messagesBy, openIndexed, readStream, recordScene, recordsOf, run,
  stepsOf,
} from "./recorded.mjs";
import { TestWorld, until } from "./world.mjs";

const OPCODE = { chunk: 6, messageIndex: 7, dataEnd: 15 };
const TOPIC = "collision/v1/";
const SCENES = [["spaceships", 4, 156], ["swarm-100", 3, 157], ["iridium-cosmos", 660, 158]];

const recordings = new Map();
let world;
before(async () => {
  world = new TestWorld(156);
  for (const [scene, seconds, domain] of SCENES) {
    const path = await recordScene(world, scene, seconds, domain);
    recordings.set(scene, { path, mcap: await convert(world, path) });
  }
});
after(() => world.end());

/** What an MCAP file must hold of a transcript: topic, bytes, times, in their order. */
function expectedOf(steps, decoders) {
  const tellsTime = ["clearance", "service_status"];
  let now = 0n;
  return steps.flatMap(({ wall, messages }) => {
    const told = messages.map(({ topic, bytes }) => {
      const decoder = topic === "event"
        ? decoders.get(`${TOPIC}contact`) ?? decoders.get(`${TOPIC}forecast`)
        : decoders.get(TOPIC + topic);
      assert.ok(decoder, `a schema of ${topic}`);
      const message = decoder.decode(bytes);
      if (tellsTime.includes(topic)) {
        const told = BigInt(String(message.now_ns));
        if (told > -(2n ** 62n)) now = told;
      }
      const name = topic === "event"
        ? String(message.contacts_sequence) > "0" ? "contact" : "forecast" : topic;
      return { topic: TOPIC + name, bytes, decoder, message };
    });
    const logTime = now < 0n ? 0n : now;
    return told.map((one) => ({ ...one, logTime, publishTime: wall }));
  });
}

/** Each replay measures anew how long it takes to build trees. */
function withoutMeasured(message) {
  const measured = message.counters?.find(({ name }) => name === "tree_build_us");
  if (measured) measured.value = 0;
  return message;
}

for (const [scene] of SCENES) {
  test(`${scene}: each message of the transcript is in the file, byte for byte`, async () => {
    const { path, mcap } = recordings.get(scene);
    const transcript = await run(world, "collisiond", "--log-level", "error", "--transcript",
                                 "--replay", path);
    assert.equal(transcript.status, 0, transcript.err);
    const expected = expectedOf(stepsOf(transcript.out), mcap.decoders);
    const found = mcap.file.messages.filter(({ topic }) => topic.startsWith(TOPIC));
    assert.ok(found.length > 500, `${found.length} messages`);
    assert.equal(found.length, expected.length);
    const next = new Map();
    found.forEach((message, i) => {
      const one = expected[i], what = `${scene}, message ${i}`;
      assert.equal(message.topic, one.topic, what);
      if (message.topic === `${TOPIC}service_status`) {
        assert.deepEqual(withoutMeasured(one.decoder.decode(message.data)),
                         withoutMeasured(one.decoder.decode(one.bytes)), what);
      } else {
        assert.ok(Buffer.from(message.data).equals(one.bytes), what);
      }
      assert.equal(message.logTime, one.logTime, what);
      assert.equal(message.publishTime, one.publishTime, what);
      assert.equal(message.sequence, next.get(message.topic) ?? 0, what);
      next.set(message.topic, message.sequence + 1);
      // A field that the schema did not know would be lost.
      assert.equal(one.decoder.encode(one.message).finish().length, one.bytes.length, what);
    });
    for (const topic of ["agent_description", "agent_states", "service_status", "clearance",
                         scene === "swarm-100" ? "forecast" : "contact"]) {
      assert.ok(next.has(TOPIC + topic), `${topic} in ${[...next.keys()]}`);
    }
  });
}

test("statistics, indexes, compression and checksums are right", async () => {
  for (const [scene, { mcap: { bytes, file } }] of recordings) {
    const counts = new Map();
    for (const { channelId } of file.messages) {
      counts.set(channelId, (counts.get(channelId) ?? 0n) + 1n);
    }
    const times = file.messages.map(({ logTime }) => logTime);
    const least = times.reduce((a, b) => (a < b ? a : b));
    const most = times.reduce((a, b) => (a > b ? a : b));
    const { statistics } = file;
    assert.equal(statistics.messageCount, BigInt(file.messages.length), scene);
    assert.deepEqual(statistics.channelMessageCounts, counts);
    assert.equal(statistics.messageStartTime, least);
    assert.equal(statistics.messageEndTime, most);
    assert.equal(statistics.schemaCount, file.schemas.size);
    assert.equal(statistics.channelCount, file.channels.size);
    assert.equal(statistics.metadataCount, 1);

    const records = recordsOf(bytes);
    const chunks = records.filter(({ opcode }) => opcode === OPCODE.chunk);
    assert.ok(chunks.length >= 2, `${chunks.length} chunks`);
    assert.equal(statistics.chunkCount, chunks.length);
    const reader = await openIndexed(bytes);
    assert.deepEqual(reader.chunkIndexes.map(({ chunkStartOffset }) => Number(chunkStartOffset)),
                     chunks.map(({ begin }) => begin));
    for (const index of reader.chunkIndexes) {
      assert.equal(index.compression, "zstd");
      // A reader that asks for a topic takes the channels of a chunk from here.
      for (const offset of index.messageIndexOffsets.values()) {
        assert.equal(bytes[Number(offset)], OPCODE.messageIndex);
      }
    }
    for (const { content } of chunks) {
      assert.notEqual(new DataView(content.buffer, content.byteOffset).getUint32(24, true), 0,
                      "a chunk has a checksum, which the reader has compared");
    }
    const end = records.find(({ opcode }) => opcode === OPCODE.dataEnd);
    const told = new DataView(end.content.buffer, end.content.byteOffset).getUint32(0, true);
    assert.equal(told, crc32(bytes.subarray(0, end.begin)), "of the data section");
    assert.notEqual(reader.footer.summaryCrc, 0);
    const [metadata] = file.metadata;
    assert.equal(metadata.name, "collision");
    assert.match(metadata.metadata.get("version"), /^\d+\.\d+\.\d+/);
  }
});

test("a reader asks by time and by topic", async () => {
  const { bytes, file } = recordings.get("spaceships").mcap;
  const reader = await openIndexed(bytes);
  assert.equal((await messagesBy(reader, {})).length, file.messages.length);
  const topics = [`${TOPIC}contact`, "/page"], startTime = 1000000000n, endTime = 2500000000n;
  const expected = file.messages.filter(({ topic, logTime }) => topics.includes(topic) &&
    logTime >= startTime && logTime <= endTime);
  assert.ok(expected.length > 5 && expected.length < file.messages.length / 2);
  for (const reverse of [false, true]) {
    const found = await messagesBy(reader, { topics, startTime, endTime, reverse });
    assert.equal(found.length, expected.length);
    const nameOf = ({ topic, sequence }) => `${topic} ${sequence}`;
    assert.deepEqual(found.map(nameOf).sort(), expected.map(nameOf).sort());
    found.slice(1).forEach(({ logTime }, i) =>
      assert.ok(reverse ? logTime <= found[i].logTime : logTime >= found[i].logTime));
  }
  // What the page is told comes in the order in which it was written, also to a reader by time.
  const pages = await messagesBy(reader, { topics: ["/page"] });
  assert.deepEqual(pages.map(({ sequence }) => sequence), pages.map((_, i) => i));
});

test("what a crash leaves is read up to the last whole chunk", () => {
  const { bytes, file } = recordings.get("iridium-cosmos").mcap;
  const chunks = recordsOf(bytes).filter(({ opcode }) => opcode === OPCODE.chunk);
  const { begin, end } = chunks.at(-1);
  for (const [length, isWhole] of [[begin, true], [begin + 20, false], [end - 1, false]]) {
    const left = readStream(bytes.subarray(0, length));
    assert.equal(left.done, false);
    assert.ok(left.messages.length > 0 && left.messages.length < file.messages.length);
    left.messages.forEach(({ topic, sequence, data }, i) => {
      assert.equal(topic, file.messages[i].topic);
      assert.equal(sequence, file.messages[i].sequence);
      assert.ok(Buffer.from(data).equals(file.messages[i].data), `${length} ${isWhole}`);
    });
  }
  assert.equal(readStream(bytes.subarray(0, end)).messages.length, file.messages.length);
});

test("a damaged chunk is noticed", () => {
  const { bytes } = recordings.get("iridium-cosmos").mcap;
  const [chunk] = recordsOf(bytes).filter(({ opcode }) => opcode === OPCODE.chunk);
  const damaged = bytes.slice();
  damaged[chunk.begin + 9 + 24] ^= 1;
  assert.throws(() => readStream(damaged), /CRC/);
});

test("two conversions of one recording are the same bytes", async () => {
  const { path, mcap } = recordings.get("swarm-100");
  const again = `${world.folder}/again.mcap`;
  assert.equal((await run(world, "collisionctl", "convert", path, again)).status, 0);
  assert.ok(readFileSync(again).equals(mcap.bytes));
});

test("file names may be odd", async () => {
  const folder = `${world.folder}/it's a "folder" $(of) files`;
  mkdirSync(folder);
  const odd = `${folder}/-it's; a \\ \`file\`\n.rec`;
  copyFileSync(recordings.get("swarm-100").path, odd);
  const { bytes } = await convert(world, odd);
  assert.ok(Buffer.from(bytes).equals(recordings.get("swarm-100").mcap.bytes));
});

test("what cannot be converted is told in a sentence", async () => {
  const good = recordings.get("spaceships").path, { folder } = world;
  const notes = `${folder}/notes.txt`, kept = `${folder}/kept.mcap`;
  writeFileSync(notes, "this is no recording\n");
  writeFileSync(kept, "of before");
  const refused = async (status, sentence, ...words) => {
    const told = await run(world, "collisionctl", "convert", ...words);
    assert.equal(told.status, status, told.err);
    assert.match(told.err, sentence);
    assert.ok(!/terminate|what\(\)/.test(told.err), told.err);
    return told;
  };
  await refused(66, /none\.rec: cannot be read: No such file or directory\n$/,
                `${folder}/none.rec`, kept);
  await refused(74, /notes\.txt: byte 0: /, notes, kept);
  assert.equal(readFileSync(kept, "utf8"), "of before", "nothing takes the place of what was there");
  await refused(74, /none\/run\.mcap: cannot be written: No such file or directory\n$/, good,
                `${folder}/none/run.mcap`);
  await refused(2, /--from "soon"; allowed: YESTERDAY, /, good, kept, "--from", "soon");
  await refused(74, /\/dev\/full: cannot be written: No space left on device\n$/, good, "/dev/full");

  // An output that is the input would destroy it.
  const own = `${folder}/own.rec`;
  copyFileSync(good, own);
  await refused(2, /own\.rec: is the recording itself/, own, own);
  assert.ok(readFileSync(own).equals(readFileSync(good)));

  // Of a damaged one, what comes before is there.
  const damaged = `${folder}/damaged.rec`, part = `${folder}/damaged.mcap`;
  copyFileSync(good, damaged);
  truncateSync(damaged, Math.floor(readFileSync(good).length * 0.6));
  await refused(74, /damaged\.rec: byte \d+: cut off\n$/, damaged, part);
  const { messages, done } = readStream(new Uint8Array(readFileSync(part)));
  const whole = recordings.get("spaceships").mcap.file.messages;
  assert.ok(done && messages.length > whole.length / 3 && messages.length < whole.length);
  const contentOf = ({ topic, data }) => topic + Buffer.from(data).toString("hex");
  const ours = ({ topic }) => topic.startsWith(TOPIC) && topic !== `${TOPIC}service_status`;
  assert.deepEqual(messages.filter(ours).map(contentOf),
                   whole.filter(ours).slice(0, messages.filter(ours).length).map(contentOf));
});

/** Records a world from now on; `end()` stops it and reads the file. */
async function recordLive(live, ...words) {
  const path = `${live.folder}/now.mcap`;
  const recorder = live.start("collisionctl", "record", path, ...words);
  await until("the recorder writes", () => existsSync(path));
  return {
    recorder, path,
    async end() {
      recorder.kill("SIGINT");
      await until("the recorder ends", () => recorder.ended !== undefined);
      assert.equal(recorder.ended, 0, recorder.said);
    },
  };
}

test("a live recording has the contacts that collisionctl shows; one more run is one more file",
  async () => {
    const live = new TestWorld(159, "clock { simulators_awaited: 2 }\n");
    try {
      const recording = `${live.folder}/service.rec`;
      const service = await live.startService("--record", recording);
      const recorder = await recordLive(live);
      const shown = [];
      for (const shift of [0, 1]) {
        const players = live.startTwoThatMeet(shift, ["--speed", "20", "--linger"]);
        shown.push(await until("the contact is over", async () =>
          (await live.ask("events", "--json")).find((one) => one.status === "ended" &&
            one.begin.earliest_s > 4 + shift)));
        for (const player of players) player.kill("SIGTERM");
        await until("the players end", () => players.every(({ ended }) => ended !== undefined));
      }
      await recorder.end();
      assert.match(recorder.recorder.said, /now\.2\.mcap: \d+ messages\n.*now\.mcap: \d+ messages\n/);
      service.kill("SIGTERM");
      await until("the service ends", () => service.ended !== undefined);
      const converted = `${live.folder}/service.mcap`;
      assert.equal((await run(live, "collisionctl", "convert", recording, converted)).status, 0);
      for (const stem of ["now", "service"]) {
        for (const [i, end] of [".mcap", ".2.mcap"].entries()) {
          contactIs(`${live.folder}/${stem}${end}`, shown[i]);
        }
      }
    } finally {
      await live.end();
    }
  });

/** The file tells one contact, with the brackets that collisionctl shows. */
function contactIs(path, shown) {
  const bytes = new Uint8Array(readFileSync(path)), file = readStream(bytes);
  assert.ok(file.done, path);
  const decoder = decodersOf(file).get(`${TOPIC}contact`);
  const contacts = file.messages.filter(({ topic }) => topic === `${TOPIC}contact`)
    .map(({ data }) => decoder.decode(data));
  const last = contacts.at(-1);
  assert.equal(String(last.contacts_sequence), String(shown.contacts_sequence), path);
  for (const part of ["begin", "end"]) {
    assert.equal(String(last[part].earliest_ns), shown[part].earliest_ns, path);
    assert.equal(String(last[part].latest_ns), shown[part].latest_ns, path);
  }
}

test("recording where nothing is heard, or nothing can be written, is told", async () => {
  const none = new TestWorld(160);
  try {
    const silent = await run(none, "collisionctl", "--timeout", "1", "record",
                             `${none.folder}/none.mcap`);
    assert.equal(silent.status, 69, silent.err);
    assert.match(silent.err, /no service was heard: /);
    const unwritten = await run(none, "collisionctl", "--timeout", "1", "record",
                                `${none.folder}/none/none.mcap`);
    assert.equal(unwritten.status, 74, unwritten.err);
    assert.match(unwritten.err, /none\.mcap: cannot be written: No such file or directory/);
  } finally {
    await none.end();
  }
});
