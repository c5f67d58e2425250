// Tests of the playground and of the workbench of `motet view` in headless Chromium. Takes the motet command, the folder of the
// playground, and a folder for pictures if they are wanted.

import { createServer } from "node:http";
import { mkdtempSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { PATIENCE, check, chip, launch, open, play, run, serve } from "../view/browser.mjs";

const [motet, folder, pictures] = process.argv.slice(2);
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".txt": "text/plain" };
const files = createServer((request, reply) => {
  const name = new URL(request.url, "http://x").pathname.slice(1) || "index.html";
  if (!/^[\w.]+$/.test(name)) return reply.writeHead(404).end();
  try {
    const bytes = readFileSync(join(folder, name));
    reply.writeHead(200, { "content-type": TYPES[extname(name)] ?? "text/plain" }).end(bytes);
  } catch {
    reply.writeHead(404).end();
  }
});
await new Promise((resolve) => files.listen(0, "127.0.0.1", resolve));
const address = `http://127.0.0.1:${files.address().port}/`;
const browser = await launch();

const picture = async (page, name) => pictures && page.screenshot({ path: join(pictures, `${name}.png`) });
const area = (page) => page.getByLabel("Text of the policy");
const button = (page, name) => page.getByRole("button", { name, exact: true });
/** Shows the end of a run that plays. A short run may have played to its end by then: the button is disabled there. */
const to_the_end = (page) => {
  const shown = () => {
    const end = document.querySelector('button[title="Go to the end"]');
    end?.click();
    return end?.disabled;
  };
  return page.waitForFunction(shown, null, { timeout: PATIENCE });
};
const clean = (page) => page.locator(".clean").waitFor({ timeout: PATIENCE });
const finding = (page, code) => page.locator(".findings .finding", { hasText: code }).first().waitFor({ timeout: PATIENCE });

/** Asks the module in a worker of its own. */
async function asker(page) {
  await page.evaluate(() => {
    const worker = new Worker("worker.js");
    let number = 0;
    const waiting = new Map();
    worker.onmessage = ({ data }) => waiting.get(data.id)(data);
    window.askModule = (question) =>
      new Promise((resolve) => {
        number += 1;
        waiting.set(number, resolve);
        worker.postMessage({ id: number, question: JSON.stringify(question) });
      });
  });
  return async (question) => {
    const { answer } = await page.evaluate((question) => window.askModule(question), question);
    check(!answer.error, `${question.ask}: ${answer.error}`);
    return answer;
  };
}

/** Policies of the examples and of the pages of the diagnostics, as files. */
function policies() {
  const all = [];
  const add = (name, text, robot, scene) => all.push({ name, text, robot, scene });
  for (const name of readdirSync("examples").filter((name) => /\.(motet|json)$/.test(name))) {
    const text = readFileSync(join("examples", name), "utf8");
    const about = readFileSync(join("examples", name.replace(/\.json$/, ".motet")), "utf8");
    const [, robot, scene] = /Robot ([a-z0-9_]+), scene ([a-z0-9_]+)\./.exec(about);
    add(name, text, robot, scene);
  }
  for (const name of readdirSync("compiler/codes")) {
    const page = readFileSync(join("compiler/codes", name), "utf8");
    let count = 0;
    for (const [, kind, text] of page.matchAll(/^```(motet|json)[^\n]*\n([\s\S]*?)^```/gm)) {
      add(`${name.replace(".md", "")}-${(count += 1)}.${kind}`, text, "hsr", "kitchen");
    }
  }
  return all;
}

/** The module finds the same as the command, byte for byte; says how long a check takes. */
async function same_findings() {
  const { page, close } = await open(browser, address);
  await clean(page);
  const ask = await asker(page);
  const here = mkdtempSync(join(tmpdir(), "motet-playground-"));
  const rooms = new Map();
  for (const one of policies()) {
    const room = `${one.robot} ${one.scene}`;
    rooms.set(room, [...(rooms.get(room) ?? []), one]);
  }
  let [compared, times] = [0, []];
  for (const [room, all] of rooms) {
    const [robot, scene] = room.split(" ");
    await ask({ ask: "open", robot, scene });
    for (const { name, text } of all) {
      const path = join(here, name);
      writeFileSync(path, text);
      const told = await run(motet, ["check", path, "--robot", robot, "--scene", scene, "--format", "json"], [0, 1, 2]);
      const expected = told.split("\n").filter((line) => line.startsWith('{"code"')).map((line) => `${line}\n`).join("");
      const question = { ask: "check", text, name: path };
      const { lines } = await ask(question);
      check(lines === expected, `${name} for ${room}: the command says\n${expected}\nthe module\n${lines}`);
      compared += 1;
      if (name.endsWith(".motet") && !name.startsWith("M")) {
        times.push(
          await page.evaluate(async (question) => {
            const begun = performance.now();
            await window.askModule(question);
            return performance.now() - begun;
          }, question),
        );
      }
    }
  }
  times = times.sort((a, b) => a - b);
  console.log(`  ${compared} policies; a check of an example takes ${times[times.length >> 1].toFixed(1)} ms at the median, ${times.at(-1).toFixed(1)} ms at most`);
  check(compared > 150, `${compared} policies`);
  await close();
}

/** From a wrong policy to a run that is done, by the buttons. */
async function by_hand(page, faults) {
  await clean(page);
  await picture(page, "bench-first");
  await area(page).fill('policy p for hsr {\n  go(kitchen_table)\n  let mug = detect("red mug")\n  pikc(mug)\n  done\n}\n');
  await finding(page, "M0201");
  check(await button(page, "Run").isDisabled(), "a wrong policy does not run");
  await picture(page, "bench-wrong");
  await page.locator(".findings button", { hasText: "Fix:" }).first().click();
  await page.locator("button.primary:enabled").waitFor({ timeout: PATIENCE });
  check((await area(page).inputValue()).includes("  pick(mug)"), "the fix is in the text");
  await button(page, "Decide motions").click();
  await page.locator(".motions img").waitFor({ timeout: PATIENCE });
  await picture(page, "bench-motions");
  await page.getByRole("tab", { name: "Scene", exact: true }).click();
  await page.getByLabel(/^Say what the robot/).fill("bring me the red mug");
  await button(page, "Plan").click();
  await page.waitForFunction(() => document.querySelector("textarea").value.includes("handover"), null, { timeout: PATIENCE });
  await page.locator("button.primary:enabled").waitFor({ timeout: PATIENCE });
  await button(page, "Run").click();
  await page.getByRole("button", { name: "Halt" }).waitFor({ timeout: PATIENCE });
  await page.getByRole("tab", { name: "Steps", exact: true }).click();
  await page.locator(".row.running").first().waitFor({ timeout: PATIENCE });
  await picture(page, "bench-run");
  await to_the_end(page);
  await chip(page, "done");
  check(faults.length === 0, faults.join("; "));
}

async function playground_by_hand() {
  const { page, faults, close } = await open(browser, address);
  await by_hand(page, faults);
  await close();
}

/** The same page, served by the command. */
async function workbench_by_hand() {
  const { child, url } = serve(motet, ["view"]);
  const { page, faults, close } = await open(browser, await url);
  await by_hand(page, faults);
  const { origin } = new URL(await url);
  check((await fetch(`${origin}/ask`, { method: "POST", body: '{"ask": "rooms"}' })).status === 403, "no token, no answer");
  await close();
  child.kill();
}

/** Every example runs to its end. */
async function examples() {
  const { page, faults, close } = await open(browser, address);
  await clean(page);
  const names = await page.getByLabel("Example").locator("option").allInnerTexts();
  check(names.length > 10, `${names.length} examples`);
  for (const name of names.slice(1)) {
    await page.getByLabel("Example").selectOption(name);
    await page.waitForFunction((name) => document.querySelector("textarea").value.includes("policy"), name);
    await clean(page).catch(() => check(false, `${name} has findings`));
    await button(page, "Run").click();
    await page.getByRole("button", { name: "Halt" }).waitFor({ timeout: PATIENCE }).catch(() => check(false, `${name} does not run`));
    await to_the_end(page);
    await chip(page, "done").catch(() => check(false, `${name} does not end as done`));
  }
  check(faults.length === 0, faults.join("; "));
  await close();
}

/** A link of the book opens its policy; texts of all kinds stay texts, and nothing stops the module. */
async function hostile() {
  const text = 'policy p for hsr { say("<img src=x onerror=alert(1)> ☃ 𝔘") }\n';
  const link = `${address}#policy=${Buffer.from(text).toString("base64url")}&robot=hsr&scene=lab`;
  const { page, faults, close } = await open(browser, link);
  await page.waitForFunction(() => document.querySelector("textarea")?.value.includes("☃"), null, { timeout: PATIENCE });
  check((await page.locator("label", { hasText: "Scene" }).locator("select").inputValue()) === "lab", "the scene of the link");
  await button(page, "Run").click();
  await chip(page, "done");
  check((await page.locator("img[src=x]").count()) === 0, "text stays text");
  const ask = await asker(page);
  await ask({ ask: "open", robot: "hsr", scene: "kitchen" });
  const deep = `policy p { ${"if true { ".repeat(3000)} say("x") ${"} ".repeat(3000)} }`;
  check((await ask({ ask: "check", text: deep })).lines.length > 0, "deep nesting is a finding");
  check((await ask({ ask: "check", text: "policy p { ☃".repeat(5000) })).lines.length > 0, "signs are findings");
  const refused = await page.evaluate(async () => (await window.askModule({ ask: "open", robot: "../../etc/passwd", scene: "lab" })).answer);
  check(/to choose/.test(refused.error), JSON.stringify(refused));
  const nothing = await page.evaluate(async () => (await window.askModule({ ask: "nothing" })).answer);
  check(/no question/.test(nothing.error), JSON.stringify(nothing));
  check(faults.length === 0, faults.join("; "));
  await close();
}

if (pictures) mkdirSync(pictures, { recursive: true });
const failed = await play({ playground_by_hand, workbench_by_hand, same_findings, examples, hostile });
await browser.close();
files.close();
process.exit(failed === 0 ? 0 : 1);
