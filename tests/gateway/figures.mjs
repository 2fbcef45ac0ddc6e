// Figures of the gateway for the report: node figures.mjs [--quick] --json FILE.
// ./run view-figures calls it.
//   - processor time of the gateway for so many agents and viewers, at ten updates a second
//   - the longest task of the page that shows ten thousand agents and a hundred meshes
//   - how large a page of one file is, for two minutes of a hundred agents that stream
import { execFile } from "node:child_process";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { promisify } from "node:util";
import { WebSocket } from "ws";
import { launch, openPage } from "./browser.mjs";
import { source, TestWorld, until } from "./world.mjs";

const TICKS = 100;       // Of a second, in /proc/PID/stat.
const SETTLE_MS = 8000;  // Until nobody joins any more.
const RATE = 10;

const words = process.argv.slice(2);
const isQuick = words.includes("--quick");
const output = words[words.indexOf("--json") + 1];
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const BIN = process.env.COLLISION_BIN_DIR;

/** Of all threads, user and system [s]. */
function processorTime(pid) {
  const fields = readFileSync(`/proc/${pid}/stat`, "utf8").replace(/^.*\) /s, "").split(" ");
  return (Number(fields[11]) + Number(fields[12])) / TICKS;
}

/** A viewer that takes what comes. */
function view(address) {
  const url = `${address.replace("http", "ws")}ws`;
  const socket = new WebSocket(url, "collision.page.v1", { perMessageDeflate: false });
  const viewer = { socket, messages: 0, bytes: 0 };
  socket.on("message", (data) => {
    ++viewer.messages;
    viewer.bytes += data.length;
    socket.send("ack");
  });
  return viewer;
}

async function withSwarm(agents, look) {
  const world = new TestWorld(166, "agents_max: 20000\npairs_max: 1000000\n" +
    "clock { kind: REAL_TIME }\n");
  try {
    await world.startService();
    const gateway = await world.startGateway();
    const size = 600 * Math.cbrt(agents);
    world.start("drone-swarm", "--drones", String(agents), "--simulator", "swarm", "--real-time",
                "--rate", String(RATE), "--box", `${5 * size},${5 * size},${size / 2}`,
                "--places", String(agents), "--seconds", "600");
    return await look(world, gateway);
  } finally {
    await world.end();
  }
}

async function gatewayCost(agents, count, seconds) {
  return withSwarm(agents, async (world, gateway) => {
    const viewers = Array.from({ length: count }, () => view(gateway.address));
    await until("all agents are held", async () =>
      (await world.ask("status", "--json"))[0].agents === agents);
    await pause(SETTLE_MS);
    const before = { cpu: processorTime(gateway.pid), at: performance.now(),
                     messages: viewers.map(({ messages }) => messages) };
    await pause(1000 * seconds);
    const passed = (performance.now() - before.at) / 1000;
    const cores = (processorTime(gateway.pid) - before.cpu) / passed;
    const updates = viewers.map(({ messages }, i) => (messages - before.messages[i]) / passed);
    for (const { socket } of viewers) socket.terminate();
    return { part: "cost", agents, viewers: count, cores,
             updates_a_second_least: Math.min(...updates) };
  });
}

async function longestTask() {
  const browser = await launch();
  try {
    return await withSwarm(10000, async (world, gateway) => {
      world.start("drone-ships", "--drones", "100", "--simulator", "ships", "--real-time",
                  "--rate", String(RATE), "--mesh", source("config/scenes/drone-ship.obj"),
                  "--mesh-unit", "1", "--mesh-up", "z", "--box", "600,600,200", "--seconds", "600");
      const page = await openPage(browser, gateway.address);
      await page.waitForFunction(() => collision.scene.bodies.shown.size === 100, undefined,
                                 { timeout: 120000 });
      await pause(3000);
      return page.evaluate(async () => {
        const tasks = [];
        const observer = new PerformanceObserver((list) =>
          tasks.push(...list.getEntries().map(({ duration }) => duration)));
        observer.observe({ type: "longtask" });
        await new Promise((done) => setTimeout(done, 10000));
        observer.disconnect();
        return Math.max(0, ...tasks);
      });
    });
  } finally {
    await browser.close();
  }
}

/** Bytes of a page that holds all of a scene, and of the MCAP file. */
async function recordedSizes(seconds) {
  const world = new TestWorld(0);
  const run = promisify(execFile);
  try {
    const path = (name) => join(world.folder, name);
    await run(join(BIN, "scene-runner"), ["swarm-100", "--seconds", String(seconds), "--stream",
      "--unjudged", "--record", path("run.rec"), "--scenes", source("config/scenes")],
      { maxBuffer: 1 << 26 });
    await run(join(BIN, "collisionctl"), ["export", path("run.rec"), "--html", path("run.html"),
      "--before", String(seconds), "--after", String(seconds)]);
    await run(join(BIN, "collisionctl"), ["convert", path("run.rec"), path("run.mcap")]);
    return { part: "recorded", agents: 100, seconds, page_bytes: statSync(path("run.html")).size,
             mcap_bytes: statSync(path("run.mcap")).size };
  } finally {
    await world.end();
  }
}

const measurements = [];
const cases = isQuick ? [[1000, 100, 5], [10000, 1, 5]]
  : [[1000, 1, 15], [1000, 100, 15], [10000, 1, 15], [10000, 100, 15]];
for (const [agents, count, seconds] of cases) {
  measurements.push(await gatewayCost(agents, count, seconds));
  console.log(JSON.stringify(measurements.at(-1)));
}
const sizes = await recordedSizes(isQuick ? 20 : 120);
measurements.push(sizes);
console.log(JSON.stringify(sizes));
const longest = await longestTask();
const costs = measurements.filter(({ part }) => part === "cost");
const figures = {
  cores_most: Math.max(...costs.map(({ cores }) => cores)),
  updates_a_second_least: Math.min(...costs.map((one) => one.updates_a_second_least)),
  page_bytes: sizes.page_bytes,
  longest_task_ms: longest,
};
console.log(JSON.stringify(figures));
if (output) writeFileSync(output, JSON.stringify({ figures, measurements }, null, 1));
