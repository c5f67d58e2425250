// Runs of the motet command and pages in headless Chromium, for the tests of the page.

import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import net from "node:net";
import { fileURLToPath } from "node:url";

const ROOT = fileURLToPath(new URL("../../", import.meta.url));
const { chromium } = createRequire(`${ROOT}view/package.json`)("playwright-core");
const FLAGS =
  "--no-sandbox --disable-gpu --disable-background-networking --disable-component-update --disable-sync --no-first-run " +
  "--use-angle=swiftshader --enable-unsafe-swiftshader";
/** Longest wait for anything, in ms. */
export const PATIENCE = 30_000;

export const launch = () => chromium.launch({ executablePath: process.env.CHROMIUM, headless: true, args: FLAGS.split(" ") });

/** Waits for a word in the head of a page. */
export const chip = (page, word) => page.locator(".chip", { hasText: word }).first().waitFor({ timeout: PATIENCE });

/** Runs tests by their names, all or those that `ONLY` names. Gives the number of those that failed. */
export async function play(tests) {
  const only = process.env.ONLY?.split(",");
  let failed = 0;
  for (const [name, test] of Object.entries(tests)) {
    if (only && !only.includes(name)) continue;
    const begun = Date.now();
    try {
      await test();
      console.log(`${name}: well (${((Date.now() - begun) / 1000).toFixed(1)} s)`);
    } catch (error) {
      failed += 1;
      console.error(`${name}: ${error.message}`);
    }
  }
  return failed;
}

export function check(is, what) {
  if (!is) throw new Error(`not so: ${what}`);
}

/** Starts a command that serves a page. Gives its process and, once it is printed, the address. */
export function serve(motet, args) {
  const child = spawn(motet, args, { cwd: ROOT, stdio: ["pipe", "pipe", "pipe"] });
  let said = "";
  const url = new Promise((resolve, reject) => {
    child.stderr.on("data", (bytes) => {
      said += bytes;
      const found = /the page is at (\S+)/.exec(said);
      if (found) resolve(found[1]);
    });
    child.on("exit", (code) => reject(new Error(`${args.join(" ")} ended with ${code}: ${said}`)));
  });
  const exit = new Promise((resolve) => child.on("exit", resolve));
  child.stdout.resume();
  return { child, url, exit, said: () => said };
}

/** Runs a command to its end. */
export function run(motet, args, codes = [0]) {
  return new Promise((resolve, reject) => {
    const child = spawn(motet, args, { cwd: ROOT, stdio: ["ignore", "pipe", "pipe"] });
    let said = "";
    for (const stream of [child.stdout, child.stderr]) stream.on("data", (bytes) => (said += bytes));
    child.on("exit", (code) => (codes.includes(code) ? resolve(said) : reject(new Error(`${args.join(" ")}: ${code}: ${said}`))));
  });
}

/** Opens a page, and keeps every error and every request that leaves it. */
export async function open(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 860 }, ...options });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("request", (request) => {
    const { protocol, hostname } = new URL(request.url());
    if (protocol.startsWith("http") && hostname !== "127.0.0.1") faults.push(`request to ${request.url()}`);
  });
  await page.addInitScript(() => {
    window.ids = [];
    const Own = window.EventSource;
    window.EventSource = class extends Own {
      constructor(...args) {
        super(...args);
        this.addEventListener("message", (event) => {
          if (JSON.parse(event.data).t !== "moved") window.ids.push(event.lastEventId);
        });
      }
    };
  });
  await page.goto(url);
  return { page, faults, close: () => context.close() };
}

/** Forwards a port to another, until it is cut. */
export function cable(port) {
  const open = new Set();
  const server = net.createServer((near) => {
    const far = net.connect(port, "127.0.0.1");
    for (const end of [near, far]) {
      open.add(end);
      end.on("error", () => {});
      end.on("close", () => (near.destroy(), far.destroy(), open.delete(end)));
    }
    near.pipe(far);
    far.pipe(near);
  });
  return new Promise((resolve) => {
    server.listen(0, "127.0.0.1", () =>
      resolve({
        port: server.address().port,
        cut: () => open.forEach((end) => end.destroy()),
        close: () => (server.close(), open.forEach((end) => end.destroy())),
      }),
    );
  });
}
