// Makes the pictures of the README: node pictures.mjs FOLDER. ./run pictures calls it.
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { launch } from "./browser.mjs";
import { TestWorld, until } from "./world.mjs";

const SIZE = { width: 1280, height: 720 };
const SETTLE_MS = 1500;

const folder = process.argv[2];
mkdirSync(folder, { recursive: true });

/** Runs a scene, and calls `look(page)` when a contact has ended. */
async function picture(browser, name, scene, speed, scheme, look) {
  const world = new TestWorld(0);
  try {
    const runner = world.start("scene-runner", scene, "--view", "--port", "0", "--arguments",
                               `--speed ${speed}`);
    const link = await until("the link", () => runner.said.match(/http:\S+/)?.[0]);
    const context = await browser.newContext({ viewport: SIZE, colorScheme: scheme });
    const page = await context.newPage();
    await page.goto(link);
    await page.waitForFunction(() => [...collision.world.standing].some(({ event }) =>
      event.status === "ended"), undefined, { timeout: 120000 });
    await look(page);
    await page.waitForTimeout(SETTLE_MS);
    await page.screenshot({ path: join(folder, `${name}.png`) });
    console.log(join(folder, `${name}.png`));
  } finally {
    await world.end();
  }
}

/** Chooses the last contact that has ended, and stops in the middle of it. */
const chooseContact = (page) => page.evaluate(() => {
  const one = [...collision.world.standing].filter(({ event }) => event.status === "ended").at(-1);
  collision.choose({ event: one });
  collision.pause((one.event.begin.latest_s + one.event.end.earliest_s) / 2);
  collision.scene.flyTo(one.event, (one.event.begin.latest_s + one.event.end.earliest_s) / 2);
  collision.timeline.span = 8;
});

const browser = await launch();
try {
  await picture(browser, "swarm", "swarm-100", 1, "light", async (page) => {
    await page.waitForFunction(() => [...collision.world.standing].filter(({ event }) =>
      event.status === "ended").length >= 5, undefined, { timeout: 120000 });
    await page.keyboard.press("f");
  });
  await picture(browser, "spaceships", "spaceships", 1, "dark", chooseContact);
  await picture(browser, "iridium-cosmos", "iridium-cosmos", 20, "light", chooseContact);
} finally {
  await browser.close();
}
