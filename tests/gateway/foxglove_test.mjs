// Goal:   programs that speak Foxglove's WebSocket protocol get the world as it is, by the schemas
//         that they are sent; these are those that Foxglove publishes.
// Method: the real programs, Foxglove's own client, and independent readers of protobuf and ROS 2
//         messages; collisionctl says what is true.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { test } from "node:test";
import { TestWorld, until } from "./world.mjs";

const require = createRequire(import.meta.url);
const { parse: parseRosMessage } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const { foxgloveMessageSchemas, generateProto } = require("@foxglove/schemas/internal");
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const protobuf = require("protobufjs");
const { FileDescriptorSet } = require("protobufjs/ext/descriptor");
const WebSocket = require("ws");

const NEW = "foxglove.sdk.v1", OLD = "foxglove.websocket.v1";
const TOPICS = ["/scene", "/tf", "/events", "/status", "/log", "/numbers/world",
                "/numbers/nearest"];
const REAL_TIME = "clock { kind: REAL_TIME skew_max_s: 0.01 }\n";

const socketAddress = (gateway) => gateway.address.replace("http", "ws");

const rootOf = (channel) =>
  protobuf.Root.fromDescriptor(FileDescriptorSet.decode(Buffer.from(channel.schema, "base64")));

/** What reads the messages of a channel, from what the channel says of itself alone. */
function readerOf(channel) {
  if (channel.encoding === "cdr") {
    assert.equal(channel.schemaEncoding, "ros2msg");
    const reader = new MessageReader(parseRosMessage(channel.schema, { ros2: true }));
    return (bytes) => reader.readMessage(bytes);
  }
  assert.equal(channel.encoding, "protobuf");
  assert.equal(channel.schemaEncoding, "protobuf");
  const type = rootOf(channel).lookupType(channel.schemaName);
  const how = { longs: String, enums: String, defaults: true, arrays: true };
  return (bytes) => type.toObject(type.decode(bytes), how);
}

/** A program that subscribes to topics, and what it has got. */
class Viewer {
  constructor(gateway, protocol, topics) {
    this.topics = topics;
    this.channels = new Map();   // by topic
    this.messages = new Map(topics.map((topic) => [topic, []]));
    this.entities = new Map();   // by id, as a 3D panel has them
    this.transforms = new Map(); // by frame
    this.faults = [];
    this.time = -1n;
    this.ids = new Map();        // topics, by subscription
    this.socket = new WebSocket(socketAddress(gateway), [protocol]);
    this.client = new FoxgloveClient({ ws: this.socket });
    this.client.on("error", (error) => this.faults.push(error.message));
    this.client.on("status", (status) => this.faults.push(status.message));
    this.client.on("serverInfo", (info) => (this.info = info));
    this.client.on("time", ({ timestamp }) => this.takeTime(timestamp));
    this.client.on("advertise", (channels) => this.takeChannels(channels));
    this.client.on("message", (message) => this.takeMessage(message));
    this.client.on("close", () => (this.closed = true));
  }

  takeChannels(channels) {
    for (const channel of channels) {
      this.channels.set(channel.topic, channel);
      if (!this.topics.includes(channel.topic)) continue;
      this.ids.set(this.client.subscribe(channel.id), { topic: channel.topic,
                                                        read: readerOf(channel) });
    }
  }

  takeTime(timestamp) {
    if (timestamp < this.time) this.faults.push("time runs backwards");
    this.time = timestamp;
  }

  takeMessage({ subscriptionId, timestamp, data }) {
    const { topic, read } = this.ids.get(subscriptionId);
    if (timestamp > this.time) this.faults.push(`${topic} of a time that was not told`);
    const message = read(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    this.messages.get(topic).push(message);
    if (topic === "/tf") {
      for (const one of message.transforms) this.transforms.set(one.child_frame_id, one);
    }
    if (topic === "/scene") this.takeScene(message);
  }

  takeScene({ deletions, entities }) {
    for (const { type, id } of deletions) {
      type === "ALL" ? this.entities.clear() : this.entities.delete(id);
    }
    for (const entity of entities) this.entities.set(entity.id, entity);
  }

  of(topic) {
    return this.messages.get(topic);
  }

  unsubscribe(topic) {
    const [id] = [...this.ids].find(([, one]) => one.topic === topic);
    this.client.unsubscribe(id);
  }
}

const bracketOf = (bracket) => [bracket.earliest_ns, bracket.latest_ns];

/** What protobufjs has of a bracket; what stands for "never" is null in JSON. */
const toldBracket = (bracket) => bracketOf(bracket).map((ns) =>
  ["9223372036854775807", "-9223372036854775808"].includes(ns) ? null : ns);

for (const [domain, protocol] of [[150, NEW], [151, OLD]]) {
  test(`by ${protocol} a viewer gets the world as it is`, async () => {
    const world = new TestWorld(domain, "clock { simulators_awaited: 2 }\n");
    try {
      await world.startService();
      const gateway = await world.startGateway();
      const viewer = new Viewer(gateway, protocol, TOPICS);
      await until("channels", () => viewer.channels.size > 0);
      assert.equal(viewer.socket.protocol, protocol);
      assert.deepEqual([...viewer.channels.keys()], TOPICS);
      assert.deepEqual(viewer.info.capabilities, ["time"]);
      assert.equal(viewer.info.metadata.world, world.name);
      world.startTwoThatMeet();

      // The contact, as it comes and goes.
      const mark = await until("the contact is marked", () => viewer.entities.get("contact/0"));
      const at = mark.spheres[0].pose.position;
      assert.ok(Math.abs(at.x) < 0.6 && Math.abs(at.y) < 0.6, JSON.stringify(at));
      assert.equal(mark.arrows.length, 1);
      assert.match(mark.texts[0].text, /left × right/);
      const ended = await until("it ends", () =>
        viewer.of("/events").find(({ status }) => status === "EVENT_ENDED"));
      assert.ok(viewer.of("/events").some(({ status }) => status === "EVENT_CONFIRMED"));
      const [told] = (await world.ask("events", "--json")).filter((one) =>
        one.status === "ended");
      assert.deepEqual(toldBracket(ended.begin), bracketOf(told.begin));
      assert.deepEqual(toldBracket(ended.end), bracketOf(told.end));
      assert.ok(BigInt(ended.begin.earliest_ns) <= 4500000000n);
      assert.ok(BigInt(ended.begin.latest_ns) >= 4500000000n);
      assert.ok(viewer.of("/log").some(({ message, level }) => level === "INFO" &&
        /left \(left-sim\) and right \(right-sim\)/.test(message)));
      await until("the mark is gone", () => !viewer.entities.has("contact/0"));

      // At the end both stand still: every agent has a body, where collisionctl says.
      await until("they are where they are told to be", async () => {
        const [{ agents }] = await world.ask("agents", "--json");
        assert.equal(agents.length, 2);
        return agents.every(({ name, simulator, state }) => {
          const frame = `${simulator}/${name}`;
          const { x, y, z } = viewer.transforms.get(frame).translation;
          assert.ok([...viewer.entities.values()].some((one) => one.frame_id === frame));
          return Math.hypot(x - state.position_m[0], y - state.position_m[1],
                            z - state.position_m[2]) < 0.01;
        });
      });
      assert.equal(viewer.entities.size, 2);
      for (const { spheres } of viewer.entities.values()) assert.equal(spheres[0].size.x, 1);

      // Plain numbers.
      const numbers = viewer.of("/numbers/world").at(-1);
      assert.equal(numbers.agents, 2);
      assert.equal(numbers.contacts, 1n);
      assert.ok(numbers.memory_bytes > 1000000n && numbers.cpu_s > 0);
      const near = viewer.of("/numbers/nearest").filter(({ lower }) => lower !== "");
      assert.ok(near.length > 0);
      for (const one of near) {
        assert.deepEqual([one.lower, one.higher].sort(), ["left", "right"]);
        const now = one.stamp.sec + 1e-9 * one.stamp.nanosec;
        // NaN: it may never begin.
        assert.ok(!(now + one.begin_earliest_s > 4.500001), JSON.stringify(one));
        assert.ok(!(now + one.begin_latest_s < 4.499999), JSON.stringify(one));
        assert.ok(!(one.gap_lower_m > one.gap_upper_m));
      }
      const status = viewer.of("/status").at(-1);
      assert.equal(status.world, world.name);
      assert.equal(status.agents, 2);
      assert.deepEqual(viewer.faults, []);

      // One that comes later gets what stands.
      const late = new Viewer(gateway, protocol, ["/scene", "/events", "/tf"]);
      await until("it has all", () => late.entities.size === 2 && late.transforms.size === 2 &&
        late.of("/events").length > 0);
      assert.equal(late.of("/events").at(-1).status, "EVENT_ENDED");
      assert.deepEqual(late.faults, []);
    } finally {
      await world.end();
    }
  });
}

test("what is not offered is answered, and the connection goes on", async () => {
  const world = new TestWorld(152, REAL_TIME);
  try {
    await world.startService();
    const gateway = await world.startGateway();
    const viewer = new Viewer(gateway, NEW, ["/status"]);
    await until("a status", () => viewer.of("/status").length > 0);
    viewer.client.getParameters([], "one");
    viewer.client.advertise({ topic: "/mine", encoding: "json", schemaName: "" });
    viewer.client.sendMessage(1, new Uint8Array(3));
    viewer.socket.send("this is no JSON");
    viewer.client.subscribe(99);
    await until("five answers", () => viewer.faults.length === 5);
    assert.match(viewer.faults[0], /does not support the operation "getParameters"/);
    const before = viewer.of("/status").length;
    await until("another status", () => viewer.of("/status").length > before);
    viewer.unsubscribe("/status");
    await new Promise((resolve) => setTimeout(resolve, 300));
    const then = viewer.of("/status").length;
    const { time } = viewer;
    await until("time goes on", () => viewer.time > time + 1500000000n);
    assert.equal(viewer.of("/status").length, then);
    assert.equal(viewer.faults.length, 5);
    assert.ok(!viewer.closed);
  } finally {
    await world.end();
  }
});

test("the newer protocol is preferred, others are refused", async () => {
  const world = new TestWorld(153, REAL_TIME);
  try {
    await world.startService();
    const gateway = await world.startGateway("0", "--origin", "https://app.foxglove.dev");
    const chosenOf = (protocols, headers = {}) => new Promise((resolve) => {
      const socket = new WebSocket(socketAddress(gateway), protocols, { headers });
      socket.on("open", () => (resolve(socket.protocol), socket.close()));
      socket.on("error", (error) => resolve(error.message));
    });
    assert.equal(await chosenOf([NEW]), NEW);
    assert.equal(await chosenOf([OLD]), OLD);
    assert.equal(await chosenOf([OLD, NEW]), NEW);
    for (const protocols of [[], ["foxglove.sdk.v2"], ["mqtt"]]) {
      assert.match(await chosenOf(protocols), /400/);
    }
    assert.equal(await chosenOf([NEW], { origin: "https://app.foxglove.dev" }), NEW);
    assert.match(await chosenOf([NEW], { origin: "https://evil.example" }), /403/);
  } finally {
    await world.end();
  }
});

test("more than a thousand agents are balls in the world", async () => {
  const world = new TestWorld(154, "agents_max: 2000\n" + REAL_TIME);
  try {
    await world.startService();
    const gateway = await world.startGateway("0", "--rate", "2");
    const viewer = new Viewer(gateway, NEW, ["/scene", "/tf"]);
    world.start("drone-swarm", "--drones", "1200", "--simulator", "swarm", "--real-time",
                "--rate", "10", "--box", "20000,20000,2000", "--seconds", "120");
    const balls = () => [...viewer.entities.values()].filter(({ id }) => id.startsWith("chunk/"))
      .reduce((sum, { spheres }) => sum + spheres.length, 0);
    await until("all are shown", () => balls() === 1200);
    assert.ok([...viewer.entities.keys()].every((id) => /^(chunk|contact)\//.test(id)));
    const late = new Viewer(gateway, OLD, ["/scene"]);
    await until("so to one that comes later", () => late.entities.has("chunk/2"));
    assert.deepEqual([...viewer.faults, ...late.faults], []);
  } finally {
    await world.end();
  }
});

test("schemas are those that Foxglove publishes", async () => {
  const world = new TestWorld(155, REAL_TIME);
  try {
    await world.startService();
    const gateway = await world.startGateway();
    const viewer = new Viewer(gateway, NEW, []);
    await until("channels", () => viewer.channels.size > 0);
    let compared = 0;
    for (const topic of ["/scene", "/tf", "/log"]) {
      const ours = rootOf(viewer.channels.get(topic)).lookup("foxglove");
      for (const type of ours.nestedArray) {
        const text = generateProto(foxgloveMessageSchemas[type.name],
                                   enumsOf(foxgloveMessageSchemas[type.name]));
        const published = protobuf.parse(text, { keepCase: true }).root
          .lookupType(`foxglove.${type.name}`);
        compareTypes(type, published);
        ++compared;
      }
    }
    assert.ok(compared > 20, `${compared} types`);
  } finally {
    await world.end();
  }
});

const enumsOf = (schema) => schema.fields.map(({ type }) => type.enum).filter(Boolean);

/** Each field of ours is the published one: we may lack some, as models. */
function compareTypes(ours, published) {
  const lastWord = (name) => name.split(".").at(-1);
  for (const field of ours.fieldsArray) {
    const other = published.fields[field.name];
    const where = `${ours.name}.${field.name}`;
    assert.ok(other, `${where} is published`);
    assert.deepEqual([field.id, field.repeated, lastWord(field.type)],
                     [other.id, other.repeated, lastWord(other.type)], where);
  }
  for (const one of ours.nestedArray) {
    const other = published.nested[one.name];
    assert.deepEqual({ ...one.values }, { ...other.values }, `${ours.name}.${one.name}`);
  }
}
