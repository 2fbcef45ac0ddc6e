// Goal:   the page opens recordings by drag and drop and shows each instant as it was; a page of
//         one file shows an event anywhere; what cannot be shown is told, and hides nothing.
// Method: recorded scenes in Debian's chromium; the messages of the recording, decoded by
//         protobufjs, and collisiond's own replay say what is true.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { basename } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { launch, openPage } from "./browser.mjs";
import { convert, recordsOf, recordScene, run } from "./recorded.mjs";
import { TestWorld, until } from "./world.mjs";

const TOPIC = "collision/v1/";
const REAL_TIME = "clock { kind: REAL_TIME skew_max_s: 0.01 }\n";

let browser, world, gateway, ships, orbits;
before(async () => {
  world = new TestWorld(161, REAL_TIME);
  await world.startService();
  gateway = await world.startGateway();
  ships = await recordScene(world, "spaceships", 4, 162);
  ships = { recording: ships, ...(await convert(world, ships)) };
  orbits = await recordScene(world, "iridium-cosmos", 660, 163);
  orbits = { recording: orbits, ...(await convert(world, orbits)) };
  browser = await launch();
});
afterEach(() => Promise.all(browser.contexts().map((context) => context.close())));
after(async () => {
  await browser?.close();
  await world.end();
});

const verdictOf = (page) => page.locator("#verdict").textContent();

async function livePage() {
  const page = await openPage(browser, gateway.address);
  await until("it is well", async () => (await verdictOf(page)).startsWith("WELL"));
  return page;
}

/** As a hand does: from the desktop over the page, and let go. */
async function drag(page, path) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files: [path], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await session.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data });
  }
}

/** As a script does. */
async function drop(page, path) {
  const transfer = await page.evaluateHandle(({ base64, name }) => {
    const transfer = new DataTransfer();
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    transfer.items.add(new File([bytes], name));
    return transfer;
  }, { base64: readFileSync(path).toString("base64"), name: basename(path) });
  await page.dispatchEvent("#scene", "dragover", { dataTransfer: transfer });
  await page.dispatchEvent("#scene", "drop", { dataTransfer: transfer });
}

const isOpened = (page, patience) => page.waitForFunction(() => collision.world.player !== null,
                                                          undefined, { timeout: patience });

/** Shows the instant `t` by the slider. */
const scrubTo = (page, t) => page.evaluate(async (t) => {
  const scrub = document.getElementById("scrub");
  scrub.value = t - collision.world.player.end;
  scrub.dispatchEvent(new Event("input"));
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  await new Promise((resolve) => setTimeout(resolve, 150));
  return collision.scene.drawnAt;
}, t);

/** What the simulators told of each agent: by "simulator/name" its states by time. */
function toldStates(mcap) {
  const told = new Map(), names = new Map();
  for (const one of mcap.decoded(`${TOPIC}agent_description`)) {
    const key = `${one.simulator_name}/${one.agent_name}`;
    names.set(`${one.simulator_id}.${one.slot ?? 0}`, key);
    told.set(key, { radius: one.radius_m, states: [] });
  }
  for (const { simulator_id: simulator, states } of mcap.decoded(`${TOPIC}agent_states`)) {
    for (const state of states) {
      const xyz = (v) => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];
      told.get(names.get(`${simulator}.${state.slot ?? 0}`))?.states.push({
        t: 1e-9 * Number(state.stamp_ns), p: xyz(state.position_m), v: xyz(state.velocity_m_s),
        a: xyz(state.acceleration_m_s2) });
    }
  }
  return told;
}

const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

/** All agents as the page shows them at the time that is shown, and by which states. */
const shownAgents = (page) => page.evaluate(() => {
  const t = collision.shownTime();
  return [...collision.world.agentsAt(t)].filter(({ history }) => history.at(t)).map((agent) => {
    const { p, v, a, t: stamp } = agent.history.at(t), d = t - stamp;
    const place = p.map((x, k) => x + v[k] * d + a[k] * d * d / 2);
    return { key: agent.key, t, stamp, told: p, p: place };
  });
});

/** What is shown is what was told; of states closer than a tenth the last one counts. */
function areAsTold(shown, told, roundedTo) {
  assert.equal(shown.length, told.size);
  for (const one of shown) {
    const { states } = told.get(one.key), { t, stamp } = one;
    const state = states.find((state) => Math.abs(state.t - stamp) < 1e-9);
    assert.ok(state, `${one.key} has told a state of ${stamp}`);
    assert.ok(distance(state.p, one.told) <= roundedTo, `${one.key} at ${t}`);
    const newest = states.filter((state) => state.t <= t - 0.15).at(-1) ?? states[0];
    assert.ok(newest.t <= stamp && stamp <= t + 1e-9, `${one.key}: ${stamp} at ${t}`);
  }
}

/** The contacts as a replay tells them last: by the names of the two, and which one it is. */
async function toldContacts(recording) {
  const { out } = await run(world, "collisiond", "--log-level", "error", "--replay", recording);
  const contacts = new Map();
  for (const line of String(out).trim().split("\n")) {
    const event = JSON.parse(line);
    if (Number(event.contacts_sequence) > 0) {
      const { lower_label: lower, higher_label: higher, contact } = event;
      contacts.set(`${lower.agent_name} ${higher.agent_name} ${contact}`, event);
    }
  }
  return contacts;
}

test("a file is dragged onto the page, and each instant is shown as it was", async () => {
  const page = await livePage();
  await drag(page, ships.path);
  await isOpened(page);
  await until("its length is told", async () =>
    /^spaceships\.mcap: [34]\.\d\d s of its world$/.test(await verdictOf(page)));
  await page.getByRole("button", { name: "Go on" }).waitFor();  // it stands at its begin
  const told = toldStates(ships);
  assert.equal(told.size, 21);
  for (const t of [0.5, 3, 1.25, 2]) {
    const drawn = await scrubTo(page, t);
    assert.ok(Math.abs(drawn - t) < 0.006, `${t} is drawn at ${drawn}`);
    const shown = await shownAgents(page);
    areAsTold(shown, told, 0);
  }
  assert.match(await page.locator("#clock").textContent(), /^2\.0\d s$/);
  assert.deepEqual(page.faults, []);
});

test("a recording of the service is dropped, and its contacts are those of its replay", async () => {
  const page = await livePage();
  await drop(page, ships.recording);
  await isOpened(page);
  await until("its name is told", async () => (await verdictOf(page)).startsWith("spaceships.rec: "));
  const contacts = await toldContacts(ships.recording);
  assert.ok(contacts.size >= 1, "there are contacts");
  const shown = await page.evaluate(() => [...collision.world.events.values()]
    .map(({ event }) => event).filter(({ contacts_sequence: number }) => Number(number) > 0));
  assert.equal(shown.length, contacts.size);
  for (const event of shown) {
    const one = contacts.get(`${event.lower.name} ${event.higher.name} ${event.contact}`);
    assert.equal(event.status, one.status.replace("EVENT_", "").toLowerCase());
    for (const part of ["begin", "end"]) {
      assert.equal(event[part].earliest_ns, one[part].earliest_ns, `${event.contacts_sequence}`);
      // What is open has none.
      const latest = one[part].latest_ns;
      assert.equal(event[part].latest_ns ?? "9223372036854775807", latest);
    }
  }
  assert.deepEqual(page.faults, []);
});

test("a recording runs, stands, and ends; what is live is a click away", async () => {
  const page = await livePage();
  await drag(page, ships.path);
  await isOpened(page);
  const shown = () => page.evaluate(() => collision.shownTime());
  await page.getByRole("button", { name: "Go on" }).click();
  const from = await shown();
  await until("it runs", async () => (await shown()) > from + 0.2);
  await page.getByRole("button", { name: "Pause" }).click();
  const stands = await shown();
  await page.waitForTimeout(300);
  assert.equal(await shown(), stands);
  await page.locator("body").click({ position: { x: 5, y: 5 } });
  await page.keyboard.press("End");
  const end = await page.evaluate(() => collision.world.player.end);
  assert.equal(await shown(), end);
  await page.keyboard.press("ArrowLeft");
  assert.ok(Math.abs((await shown()) - (end - 0.1)) < 1e-9);
  await page.keyboard.press(" ");
  await until("it stops at its end", () =>
    page.evaluate(() => document.getElementById("pause").textContent === "Go on"));
  assert.equal(await shown(), end);
  await page.getByRole("button", { name: "Back to what is live" }).click();
  await until("it is live again", async () => (await verdictOf(page)).startsWith("WELL"));
  assert.equal(await page.evaluate(() => collision.world.player), null);
  assert.deepEqual(page.faults, []);
});

test("a contact is found in the table and shown at its time", async () => {
  const page = await livePage();
  await drag(page, orbits.path);
  await isOpened(page);
  await page.getByRole("row", { name: /cosmos-2251 – iridium-33|iridium-33 – cosmos-2251/ })
    .first().click();
  await page.getByRole("heading", { name: /iridium-33/ }).waitFor();
  // Where the literature has them: two balls of 500 m touch at 599.734303 s.
  await scrubTo(page, 599.73);
  const [a, b] = await shownAgents(page);
  assert.ok(Math.abs(distance(a.p, b.p) - 1000) < 60, `${distance(a.p, b.p)} m apart`);
  assert.deepEqual(page.faults, []);
});

test("a file that cannot be shown is told of, and what is live goes on", async () => {
  const page = await livePage();
  const file = (name, bytes) => {
    writeFileSync(`${world.folder}/${name}`, bytes);
    return `${world.folder}/${name}`;
  };
  const { bytes } = orbits;
  const chunks = recordsOf(bytes).filter(({ opcode }) => opcode === 6);
  const broken = bytes.slice();
  broken.fill(0x55, chunks[1].begin + 60, chunks[1].end);
  const files = [
    ["notes.txt", "this is no recording\n", /cannot be shown: .*collisiond cannot replay it/s],
    ["empty.rec", "", /cannot be shown: /],
    // What comes before is shown before the damage is met.
    ["broken.mcap", broken, /cannot be shown: /],
  ];
  for (const [name, content, sentence] of files) {
    page.expectsErrors = true;  // the browser notes what the gateway refuses
    await drag(page, file(name, content));
    await until(`${name} is told of`, async () => sentence.test(await verdictOf(page)));
    const sentenceNow = await verdictOf(page);
    assert.ok(sentenceNow.startsWith(`${name} cannot be shown: `), sentenceNow);
    assert.ok(sentenceNow.length < 300 && !/undefined|\[object/.test(sentenceNow), sentenceNow);
    const before = await page.evaluate(() => collision.source.messages);
    await until("more comes", async () =>
      (await page.evaluate(() => collision.source.messages)) > before + 2);
    await until("the state of the service is told again", async () =>
      (await verdictOf(page)).startsWith("WELL"));
    page.expectsErrors = false;
  }
  // And what can be shown is shown then.
  await drag(page, ships.path);
  await isOpened(page);
  assert.deepEqual(page.faults, []);
});

test("of a file that a crash has left, what is whole is shown", async () => {
  const page = await livePage();
  const cut = `${world.folder}/cut.mcap`;
  const last = recordsOf(ships.bytes).filter(({ opcode }) => opcode === 6).at(-1);
  writeFileSync(cut, ships.bytes.subarray(0, last.begin + 100));
  await drag(page, cut);
  await isOpened(page);
  const { begin, end } = await page.evaluate(() => collision.world.player);
  assert.ok(end > begin + 1, `from ${begin} to ${end} s`);
  assert.deepEqual(page.faults, []);
});

test("opening and scrubbing makes no long tasks", async () => {
  const page = await livePage();
  let seen;
  await until("no task of 200 ms", async () => {
    await page.evaluate(() => {
      const spin = window.spin ??= () => {
        const from = performance.now();
        for (let i = 0, x = 1; i < 2e6; ++i) x = (x * 16807) % 2147483647;
        return performance.now() - from;
      };
      for (let i = 0; i < 10; ++i) spin();  // until it is compiled
      window.best = Math.min(window.best ?? Infinity, ...Array.from({ length: 10 }, spin));
      window.slowest = window.best;
      window.tasks = [];
      window.observer = new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) window.tasks.push(entry.duration);
      });
      window.observer.observe({ type: "longtask" });
    });
    await drag(page, ships.path);
    await isOpened(page);
    for (let t = 0.5; t < 3.5; t += 0.5) {
      await scrubTo(page, t);
      await page.evaluate(() => (window.slowest = Math.max(window.slowest, window.spin())));
    }
    seen = await page.evaluate(() => {
      window.observer.disconnect();
      return { longest: Math.max(0, ...window.tasks), slower: window.slowest / window.best };
    });
    return seen.longest < 200 * seen.slower;
  });
  assert.deepEqual(page.faults, []);
});

/** A page from a disk, with all that it asks for. */
async function openFile(path) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  const page = await context.newPage();
  page.faults = [];
  page.on("console", (line) => line.type() === "error" && page.faults.push(line.text()));
  page.on("pageerror", (error) => page.faults.push(error.stack));
  page.on("request", (request) => {
    const url = request.url();
    if (url !== `file://${path}` && !/^(blob|data):/.test(url)) page.faults.push(`asks ${url}`);
  });
  await page.goto(`file://${path}`);
  await page.waitForFunction(() => window.collision?.world.player);
  return page;
}

const exported = async (recording, name, ...words) => {
  const path = `${world.folder}/${name}.html`;
  const told = await run(world, "collisionctl", "export", recording, "--html", path, ...words);
  return { path, ...told };
};

test("a page of one file shows the event, its bracket, and the agents around it", async () => {
  const contacts = [...(await toldContacts(ships.recording)).values()];
  const [first] = contacts;  // in the order in which they were told first
  const { path, status, err, out } = await exported(ships.recording, "first & <only>");
  assert.equal(status, 0, err);
  assert.equal(Number(String(out).match(/: (\d+) bytes\n$/)[1]), statSync(path).size);
  const page = await openFile(encodeURI(path).replace("#", "%23"));
  const seen = await page.evaluate(() => ({
    event: collision.timeline.chosen.event, t: collision.shownTime(),
    drawn: collision.scene.renderer.info.render.points, own: document.title,
  }));
  for (const part of ["begin", "end"]) {
    assert.equal(seen.event[part].earliest_ns, first[part].earliest_ns);
    assert.equal(seen.event[part].latest_ns ?? "9223372036854775807", first[part].latest_ns);
  }
  assert.ok(Math.abs(seen.t - 1e-9 * Number(first.begin.earliest_ns)) < 1e-6, `${seen.t}`);
  await page.getByRole("heading", { name: seen.event.lower.name }).waitFor();
  await until("all are drawn", async () => (await page.evaluate(() =>
    collision.scene.renderer.info.render.points)) === 21);
  await until("its length is told", async () =>
    /^spaceships\.rec: \d+\.\d\d s of its world$/.test(await verdictOf(page)));
  assert.ok(!(await page.getByRole("button", { name: "Open file" }).isVisible()));
  const told = toldStates(ships);
  areAsTold(await shownAgents(page), told, 0.01);
  assert.deepEqual(page.faults, []);
});

test("an event is found by its number, by names, and else the contacts are told", async () => {
  const contacts = await toldContacts(ships.recording);
  const last = [...contacts.values()].at(-1).contacts_sequence;
  const byNumber = await exported(ships.recording, "number", "--around", last);
  assert.equal(byNumber.status, 0, byNumber.err);
  const page = await openFile(byNumber.path);
  const event = await page.evaluate(() => collision.timeline.chosen.event);
  assert.equal(String(event.contacts_sequence), last);

  const names = [event.higher.name, event.lower.name].join(",");
  const byNames = await exported(ships.recording, "names", "--around", names);
  assert.equal(byNames.status, 0, byNames.err);
  const other = await openFile(byNames.path);
  const found = await other.evaluate(() => collision.timeline.chosen.event);
  assert.deepEqual([found.lower.name, found.higher.name], [event.lower.name, event.higher.name]);

  const unknown = await exported(ships.recording, "unknown", "--around", "9999");
  assert.equal(unknown.status, 2, unknown.err);
  assert.match(unknown.err, /no such event in the recording; contacts in it, by their numbers:\n {2}1 /);
  assert.ok(unknown.err.includes(`${event.lower.name}`), unknown.err);
  const senseless = await exported(ships.recording, "senseless", "--around", "ada");
  assert.equal(senseless.status, 2, senseless.err);
  assert.match(senseless.err, /--around "ada"; allowed: /);
  const notes = `${world.folder}/notes.rec`;
  writeFileSync(notes, "this is no recording\n");
  const none = await exported(notes, "none");
  assert.equal(none.status, 66, none.err);
  assert.match(none.err, /notes\.rec: byte 0: /);
  assert.deepEqual([...page.faults, ...other.faults], []);
});

test("an event of a later run is shown, not the same time of an earlier one", async () => {
  const twice = new TestWorld(164, "clock { simulators_awaited: 2 }\n");
  try {
    const recording = `${twice.folder}/twice.rec`;
    const service = await twice.startService("--record", recording);
    const numbers = [];
    for (const shift of [0, 1]) {
      const players = twice.startTwoThatMeet(shift, ["--speed", "20", "--linger"]);
      const contact = await until("the contact is over", async () =>
        (await twice.ask("events", "--json")).find((one) => one.status === "ended" &&
          one.begin.earliest_s > 4 + shift));
      numbers.push(String(contact.contacts_sequence));
      for (const player of players) player.kill("SIGTERM");
      await until("the players end", () => players.every(({ ended }) => ended !== undefined));
    }
    service.kill("SIGTERM");
    await until("the service ends", () => service.ended !== undefined);
    for (const [around, begin] of [[numbers[0], 4.5], [numbers[1], 5.5], ["left,right", 4.5]]) {
      const one = await exported(recording, `run-${around}`, "--around", around);
      assert.equal(one.status, 0, one.err);
      const page = await openFile(one.path);
      const seen = await page.evaluate(() => ({
        event: collision.timeline.chosen?.event, t: collision.shownTime(),
        agents: [...collision.world.agentsAt(collision.shownTime())].map(({ history }) =>
          history.at(collision.shownTime())),
      }));
      assert.ok(seen.event.begin.earliest_s <= begin && seen.event.begin.latest_s >= begin, around);
      assert.equal(seen.agents.length, 2);
      const [a, b] = seen.agents.map(({ p, v, t }) => p[0] + v[0] * (seen.t - t));
      assert.ok(Math.abs(Math.abs(a - b) - 1) < 0.01, `${Math.abs(a - b)} m apart`);
      assert.deepEqual(page.faults, []);
    }
  } finally {
    await twice.end();
  }
});

test("a page of two minutes and 100 agents is less than 5 MB", async () => {
  // Twelve seconds of it, since what an agent takes in a second is the same: 5 MB less the page
  // itself, over 12000 seconds of agents.
  const recording = await recordScene(world, "swarm-100", 12, 165, "--stream");
  const one = await exported(recording, "swarm", "--before", "30", "--after", "30");
  assert.equal(one.status, 0, one.err);
  const small = await exported(recording, "instant", "--before", "0", "--after", "0");
  assert.equal(small.status, 0, small.err);
  const page = await openFile(one.path);
  const seen = await page.evaluate(() => {
    const { player, agents } = collision.world;
    return { seconds: player.end - player.begin, agents: agents.size + collision.world.departed.size,
             states: [...agents.values()].map(({ history }) => history.states.length) };
  });
  assert.ok(seen.agents >= 100 && seen.seconds > 11, JSON.stringify(seen));
  const bytes = statSync(one.path).size - statSync(small.path).size;
  const seconds = seen.seconds * 100;
  const whole = statSync(small.path).size + (bytes / seconds) * 12000;
  assert.ok(whole < 5e6, `${whole} bytes: ${bytes / seconds} a second of an agent`);
  assert.deepEqual(page.faults, []);
});
