// Programs of a test, in a world of its own; all end with it.
import { execFile, spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";

const BIN = process.env.COLLISION_BIN_DIR, SOURCE = process.env.COLLISION_SOURCE_DIR;
const PATIENCE_MS = 60000;

export const source = (path) => join(SOURCE, path);

/** Waits until `done()` is true, or something else than undefined and false. */
export async function until(what, done, patience = PATIENCE_MS) {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await done();
    if (answer !== undefined && answer !== false && answer !== null) return answer;
    if (Date.now() > end) throw new Error(`not within ${patience} ms: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

export class TestWorld {
  constructor(domain, config = "") {
    this.name = `page-${process.pid}`;
    this.domain = domain;
    this.folder = mkdtempSync(join(tmpdir(), "collision-"));
    this.config = join(this.folder, "collisiond.textproto");
    writeFileSync(this.config, `world: "${this.name}"\ndomain: ${domain}\n${config}`);
    this.environment = {
      ...process.env,
      CYCLONEDDS_URI: `file://${source("config/cyclonedds-loopback.xml")}`,
      COLLISION_WORLD: this.name,
      COLLISION_DOMAIN: String(domain),
    };
    this.processes = [];
  }

  start(program, ...words) {
    const child = spawn(join(BIN, program), words, {
      env: this.environment, stdio: ["ignore", "pipe", "pipe"] });
    child.said = "";
    for (const stream of [child.stdout, child.stderr]) {
      stream.on("data", (text) => (child.said += text));
    }
    child.on("exit", (code, signal) => (child.ended = code ?? signal));
    this.processes.push(child);
    return child;
  }

  async startService(...words) {
    const service = this.start("collisiond", "--config", this.config, ...words);
    await until("the service serves", () => service.said.includes("serves world"));
    return service;
  }

  /** The gateway on a port of its own; its address. */
  async startGateway(port = "0", ...words) {
    const gateway = this.start("gateway", "--port", port, ...words);
    gateway.address = await until("the gateway listens", () => {
      if (gateway.ended !== undefined) throw new Error(gateway.said);
      return gateway.said.match(/http:\S+/)?.[0];
    });
    return gateway;
  }

  /**
   * Two that meet head-on `shift` after 4.5 s, each a simulator of its own, at twice the pace of the
   * clock unless `pace` says otherwise; their players.
   */
  startTwoThatMeet(shift = 0, pace = ["--speed", "2", "--linger"]) {
    return [["left", -5 - shift, 1], ["right", 5 + shift, -1]].map(([name, x, v]) => {
      const rows = Array.from({ length: 13 }, (_, t) => `${t},${name},${x + v * t},0,0,${v},0,0`);
      const file = join(this.folder, `${name}.csv`);
      writeFileSync(file, `time_s,agent_id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n${rows.join("\n")}\n`);
      return this.start("trajectory-player", file, "--simulator", `${name}-sim`, "--radius", "0.5",
                        ...pace);
    });
  }

  /** What collisionctl prints, as documents. */
  async ask(...words) {
    const { stdout } = await promisify(execFile)(join(BIN, "collisionctl"), words, {
      env: this.environment, maxBuffer: 1 << 26 });
    return stdout.trim().split("\n").filter(Boolean).map((line) => JSON.parse(line));
  }

  async end() {
    for (const child of this.processes.reverse()) {
      if (child.ended !== undefined) continue;
      child.kill("SIGCONT");
      child.kill("SIGTERM");
      const late = setTimeout(() => child.kill("SIGKILL"), 5000);
      if (child.ended === undefined) await once(child, "exit");
      clearTimeout(late);
    }
    rmSync(this.folder, { recursive: true, force: true });
  }
}
