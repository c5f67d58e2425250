// Tests of the page in headless Chromium. Takes the motet command, and a folder for pictures if they are wanted.

import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { PATIENCE, cable, check, chip, launch, open, play, run, serve } from "./browser.mjs";

const [motet, pictures] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "motet-view-"));
const SCENE = ["--robot", "hsr", "--scene", "kitchen"];
const browser = await launch();

async function picture(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const tab = (page, name) => page.getByRole("tab", { name, exact: true }).click();

/** A run from a request to the handover, whose question is answered on the page. */
async function request_with_question() {
  const { child, url, exit } = serve(motet, ["do", "bring me the mug", ...SCENE, "--speed", "8", "--view"]);
  const { page, faults, close } = await open(browser, await url);
  await page.locator(".question .asked").waitFor({ timeout: PATIENCE });
  await picture(page, "question");
  await page.locator(".question .options button", { hasText: "red mug" }).click();
  await page.locator(".question").waitFor({ state: "detached", timeout: PATIENCE });
  await page.locator(".row.running").first().waitFor({ timeout: PATIENCE });
  await page.waitForTimeout(1200);
  await picture(page, "running");
  await chip(page, "done");
  check((await exit) === 0, "the run is done");
  await tab(page, "Talk");
  const talk = await page.locator(".talk").innerText();
  check(/You\s+red mug \(mug_1\)/.test(talk), `the answer is in the talk: ${talk}`);
  check(faults.length === 0, faults.join("; "));
  await close();
  child.kill();
}

/** A question of a policy is answered in free text. */
async function free_text() {
  const { child, url, exit } = serve(motet, ["run", "examples/choose_cup.motet", ...SCENE, "--speed", "20", "--view"]);
  const { page, faults, close } = await open(browser, await url);
  await page.locator(".question .asked", { hasText: "Which of these" }).waitFor({ timeout: PATIENCE });
  await page.getByLabel("Your answer").fill("the red mug");
  await page.getByRole("button", { name: "Answer" }).click();
  await chip(page, "done");
  check((await exit) === 0, "the run is done");
  await tab(page, "Known");
  check((await page.locator(".details").innerText()).includes("cup = mug_1"), "the choice is bound");
  check(faults.length === 0, faults.join("; "));
  await close();
  child.kill();
}

/** A new request from the page takes over, and says what became of the goals. */
async function swap() {
  const record = join(folder, "talk");
  const { child, url } = serve(motet, ["do", "bring me the coke", ...SCENE, "--speed", "4", "--view", "--record", record]);
  const { page, faults, close } = await open(browser, await url);
  await page.locator(".row.running", { hasText: "go(" }).first().waitFor({ timeout: PATIENCE });
  await page.getByLabel("New request").fill("bring me the apple instead");
  await page.getByRole("button", { name: "Send" }).click();
  await tab(page, "Changes");
  await page.locator(".swap .fates li").first().waitFor({ timeout: PATIENCE });
  check((await page.locator(".swap .diff .added").count()) > 0, "the difference has new lines");
  await page.waitForTimeout(800);
  await picture(page, "swap");
  await page.getByRole("button", { name: "Pause" }).click();
  await chip(page, "paused");
  await page.getByRole("button", { name: "Go on" }).click();
  await chip(page, "running");
  await page.getByRole("button", { name: "Stop" }).click();
  await chip(page, "stopped");
  check(faults.length === 0, faults.join("; "));
  await close();
  child.kill();
}

/** The camera's picture is there while the run goes on, and the wheel comes closer to what is under the pointer. */
async function camera() {
  const { child, url } = serve(motet, ["run", "examples/fetch_mug.motet", ...SCENE, "--speed", "1", "--view"]);
  const { page, faults, close } = await open(browser, await url);
  await page.locator(".row.running").first().waitFor({ timeout: PATIENCE });
  await page.locator(".stage canvas, canvas").first().hover({ position: { x: 60, y: 200 } });
  await page.mouse.wheel(0, -900);
  await page.waitForTimeout(300);
  await picture(page, "closer");
  await tab(page, "Camera");
  await page.waitForFunction(() => document.querySelector("img.camera")?.naturalWidth > 100, null, { timeout: PATIENCE });
  const first = await page.locator("img.camera").getAttribute("src");
  await page.waitForFunction((first) => document.querySelector("img.camera")?.src.endsWith(first) === false, first, { timeout: PATIENCE });
  await picture(page, "camera");
  check(faults.length === 0, faults.join("; "));
  await close();
  child.kill();
}

/** A page whose connection is cut in the middle misses nothing, and no entry comes twice. */
async function reconnect() {
  const { child, url, exit } = serve(motet, ["run", "examples/fetch_mug.motet", ...SCENE, "--speed", "6", "--view"]);
  const address = new URL(await url);
  const line = await cable(Number(address.port));
  const { page, close } = await open(browser, `http://127.0.0.1:${line.port}/${address.hash}`);
  await page.locator(".row.running").first().waitFor({ timeout: PATIENCE });
  line.cut();
  await page.locator("span.link", { hasText: "connection lost" }).waitFor({ timeout: PATIENCE });
  await chip(page, "done");
  await exit;
  const ids = (await page.evaluate(() => window.ids)).filter((id) => id.startsWith("1-"));
  const numbers = ids.map((id) => Number(id.slice(2)));
  check(numbers.length > 20, `the page has the entries: ${numbers.length}`);
  check(numbers.every((number, i) => number === i), `in order and once: ${ids.join(" ")}`);
  line.close();
  await close();
  child.kill();
}

/** Scrubbing shows the state of a moment, in a page that is one file. */
async function scrub() {
  const [record, file] = [join(folder, "run"), join(folder, "run.html")];
  await run(motet, ["run", "examples/fetch_mug.motet", ...SCENE, "--speed", "max", "--record", record]);
  await run(motet, ["view", record, "-o", file]);
  const { page, faults, close } = await open(browser, `file://${file}`);
  await chip(page, "done");
  const first = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? 0);
  console.log(`  first picture after ${first.toFixed(0)} ms`);
  const running = page.locator(".row.running");
  check((await running.count()) === 0, "nothing runs at the end");
  const slider = page.getByLabel("Moment that is shown");
  const set = (part) =>
    slider.evaluate((input, part) => {
      input.value = part * Number(input.max);
      input.dispatchEvent(new Event("input", { bubbles: true }));
    }, part);
  await set(0.4);
  await running.first().waitFor({ timeout: PATIENCE });
  await page.waitForTimeout(600);
  await picture(page, "scrubbed");
  const done = await page.locator(".row.done").count();
  await set(0.8);
  await page.waitForTimeout(300);
  check((await page.locator(".row.done").count()) > done, "later more steps are done");
  await page.getByRole("button", { name: "Go to the end" }).click();
  check((await running.count()) === 0, "and now nothing runs");
  await page.locator(".tree").focus();
  await page.keyboard.press("End");
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowDown");
  check((await page.locator(".row.chosen").count()) === 1, "the keyboard chooses a step");
  await tab(page, "Text");
  check((await page.locator(".codeline.chosen").innerText()).includes("detect"), "a step leads to its line");
  for (const [name, options] of [
    ["light", {}],
    ["dark", { colorScheme: "dark" }],
    ["phone", { viewport: { width: 390, height: 800 }, hasTouch: true, deviceScaleFactor: 2 }],
  ]) {
    const other = await open(browser, `file://${file}`, options);
    await chip(other.page, "done");
    await other.page.waitForTimeout(1500);
    const wide = await other.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    check(wide <= 0, `${name}: the page is not wider than the window, by ${wide}`);
    await picture(other.page, name);
    await tab(other.page, "Graph");
    if (name === "phone") {
      await picture(other.page, "phone-graph");
      await tab(other.page, "Scene");
    } else {
      await tab(other.page, "Known");
    }
    await other.page.waitForTimeout(1200);
    await picture(other.page, `${name}-2`);
    check(other.faults.length === 0, other.faults.join("; "));
    await other.close();
  }
  check(faults.length === 0, faults.join("; "));
  await close();
}

/** A motion that is proven infeasible says why in numbers, and what blocks it is red. */
async function blocked() {
  const scene = JSON.parse(readFileSync("robots/scenes/kitchen.json", "utf8"));
  const shelf = scene.entities.find((one) => one.id === "shelf");
  const walls = [[2.2, -0.8, 2.7, 0.1], [2.2, 1.8, 2.7, 0.1], [0.9, 0.5, 0.1, 2.7], [3.5, 0.5, 0.1, 2.7]];
  walls.forEach(([x, y, along, across], i) =>
    scene.entities.push({ ...shelf, id: `wall_${i}`, names: [`wall ${i}`], pose: { xyz: [x, y, 0.35], rpy: [0, 0, 0] }, shape: { box: [along, across, 0.7] } }),
  );
  const [room, policy, answers, record, file] = ["walls.json", "chosen.motet", "answers.json", "walled", "walled.html"].map((name) => join(folder, name));
  writeFileSync(room, JSON.stringify(scene));
  writeFileSync(answers, JSON.stringify(["red mug"]));
  writeFileSync(policy, 'policy chosen for hsr {\n    let cups = detect_all("drinkware")\n    let cup = choose("Which of these?", cups)\n    try {\n        go(cup)\n    } catch any {\n        fail "I cannot pass wall_2"\n    }\n}\n');
  await run(motet, ["run", policy, "--robot", "hsr", "--scene", room, "--answers", answers, "--speed", "max", "--record", record], [3]);
  await run(motet, ["view", record, "-o", file]);
  const { page, faults, close } = await open(browser, `file://${file}`);
  await chip(page, "failed");
  const why = await page.locator(".blockedby").innerText();
  check(why.includes("wall_2"), `the reason names a wall: ${why}`);
  check((await page.locator(".tag.blocked").allInnerTexts()).join() === "wall 2", "its name is red");
  const notes = await page.locator(".row .note").allInnerTexts();
  check(notes.some((note) => note.includes("no path leads there")), `the step says why: ${notes.join("; ")}`);
  await page.waitForTimeout(1200);
  await picture(page, "blocked");
  check(faults.length === 0, faults.join("; "));
  await close();
}

const HOSTILE = [
  "<img src=x onerror=hit()>",
  "</script><script>hit()</script>",
  "\"><svg onload=hit()>",
  "javascript:hit()",
  "{{constructor.constructor('hit()')()}}",
  "<!-- items -->",
  "' onmouseover='hit()",
  "&lt;b&gt;",
  "__proto__",
  "&#8238;evil",
];

/** A hundred hostile names, texts and failures are shown as text. */
async function hostile() {
  const scene = JSON.parse(readFileSync("robots/scenes/kitchen.json", "utf8"));
  for (let i = 0; i < 100; i++) {
    const name = `${HOSTILE[i % HOSTILE.length]} ${i}`;
    const pose = { xyz: [4 + (i % 10) * 0.3, 4 + Math.floor(i / 10) * 0.3, 0.05], rpy: [0, 0, 0] };
    scene.entities.push({ id: `thing_${i}`, kind: "Object", class: "mug", names: [name], pose, shape: { box: [0.1, 0.1, 0.1] } });
  }
  const [room, policy, faults_file, record] = ["room.json", "p.motet", "faults.json", "hostile"].map((name) => join(folder, name));
  writeFileSync(room, JSON.stringify(scene));
  const says = HOSTILE.map((text) => `    say(${JSON.stringify(text.replaceAll("{", "(").replaceAll("}", ")"))})`);
  writeFileSync(policy, `policy hostile for hsr {\n${says.join("\n")}\n    go(kitchen_table)\n}\n`);
  const text = "<img src=x onerror=hit()>";
  writeFileSync(faults_file, JSON.stringify({ calls: [{ primitive: "go", then: { fails: { kind: "blocked", text } } }] }));
  await run(motet, ["run", policy, "--robot", "hsr", "--scene", room, "--speed", "max", "--faults", faults_file, "--record", record], [3]);
  const file = join(folder, "hostile.html");
  await run(motet, ["view", record, "-o", file]);
  const { page, faults, close } = await open(browser, `file://${file}`);
  await page.evaluate(() => (window.hit = () => (window.was_hit = true)));
  await chip(page, "failed");
  for (const name of ["Graph", "Text", "Changes", "Known", "Step", "Talk", "Scene"]) {
    await tab(page, name);
    await page.waitForTimeout(150);
  }
  await tab(page, "Known");
  const shown = await page.locator(".details").innerText();
  for (let i = 0; i < 100; i++) check(shown.includes(`${HOSTILE[i % HOSTILE.length]} ${i}`), `${HOSTILE[i % HOSTILE.length]} ${i} is shown as text`);
  check((await page.locator("#app img, #app script, #app [onload], #app [onmouseover]").count()) === 0, "no name became an element");
  check(!(await page.evaluate(() => window.was_hit)), "no name ran");
  await picture(page, "hostile");
  check(faults.length === 0, faults.join("; "));
  await close();
}

/** A policy of a thousand steps stays fluid. */
async function thousand() {
  const [policy, record, file] = ["long.motet", "long", "long.html"].map((name) => join(folder, name));
  const groups = Array.from({ length: 100 }, (_, i) => {
    const steps = Array.from({ length: 9 }, (_, k) => `        say("step ${i * 9 + k}")`);
    return `    sequence group_${i} {\n${steps.join("\n")}\n    }`;
  });
  writeFileSync(policy, `policy long for hsr {\n${groups.join("\n")}\n}\n`);
  await run(motet, ["run", policy, ...SCENE, "--speed", "max", "--record", record]);
  await run(motet, ["view", record, "-o", file]);
  const { page, faults, close } = await open(browser, `file://${file}`);
  await chip(page, "done");
  const frames = (what) =>
    page.evaluate(async (what) => {
      const tree = document.querySelector(".tree");
      const slider = document.querySelector(".scrub input");
      const begun = performance.now();
      for (let i = 0; i < 40; i++) {
        if (what === "scroll") tree.scrollTop = i * 300;
        else {
          slider.value = ((i + 1) / 41) * Number(slider.max);
          slider.dispatchEvent(new Event("input", { bubbles: true }));
        }
        await new Promise((next) => requestAnimationFrame(next));
      }
      return 40_000 / (performance.now() - begun);
    }, what);
  await tab(page, "Step");
  const [scroll, scrubbed] = [await frames("scroll"), await frames("scrub")];
  await tab(page, "Graph");
  await page.locator(".node").first().waitFor({ timeout: PATIENCE });
  await picture(page, "thousand");
  console.log(`  1,000 steps: ${scroll.toFixed(0)} frames a second while scrolling, ${scrubbed.toFixed(0)} while scrubbing`);
  // Test machines share their cores; a page that draws all steps at each frame stays below this.
  check(scroll > 5 && scrubbed > 5, "it is fluid");
  check(faults.length === 0, faults.join("; "));
  await close();
}

/** Commands without the token, from another page or to another name are refused. */
async function refused() {
  const { child, url } = serve(motet, ["run", "examples/fetch_mug.motet", ...SCENE, "--view"]);
  const address = new URL(await url);
  const token = address.hash.slice(1);
  const post = (headers) =>
    fetch(`${address.origin}/stop`, { method: "POST", headers: { "content-type": "application/json", ...headers }, body: "{}" });
  check((await post({})).status === 403, "no token");
  check((await post({ "x-motet-token": token, origin: "http://evil.example" })).status === 403, "another origin");
  check((await fetch(`${address.origin}/events`)).status === 403, "no token for the events");
  check((await fetch(`${address.origin}/`)).headers.get("content-security-policy").includes("script-src 'self';"), "a policy");
  const long = await fetch(`${address.origin}/answer`, {
    method: "POST",
    headers: { "content-type": "application/json", "x-motet-token": token },
    body: JSON.stringify({ question: "1:#1", text: "x".repeat(20_000) }),
  });
  check(long.status === 413, "a body of 20,000 letters");
  check((await post({ "x-motet-token": token, origin: address.origin })).status === 204, "the page itself");
  child.kill();
}

const failed = await play({ request_with_question, free_text, swap, camera, reconnect, scrub, blocked, hostile, thousand, refused });
await browser.close();
process.exit(failed === 0 ? 0 : 1);
