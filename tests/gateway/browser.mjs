// Debian's chromium, without a screen.
import { chromium } from "playwright-core";

export const launch = () => chromium.launch({
  executablePath: process.env.COLLISION_CHROMIUM,
  headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic"],
});

/** A page that notes what no page may do: errors, and requests to other hosts. */
export async function openPage(browser, address, size = { width: 1280, height: 720 }) {
  const context = await browser.newContext({ viewport: size });
  const page = await context.newPage();
  page.faults = [];
  const host = new URL(address).host;
  page.on("console", (line) => {
    if (line.type() === "error" && !page.expectsErrors) page.faults.push(line.text());
  });
  page.on("pageerror", (error) => page.faults.push(error.stack));
  await context.route("**/*", (route) => {
    if (new URL(route.request().url()).host === host) return route.continue();
    page.faults.push(`asks ${route.request().url()}`);
    return route.abort();
  });
  await page.goto(address);
  await page.waitForFunction(() => window.collision !== undefined);
  return page;
}
