// The page of a fleet in headless Chromium: page.mjs ADDRESS PICTURES ROBOT ORDER ANSWER. The robot asks a question, which is
// answered on the page; then its run is stopped.

import { join } from "node:path";
import { PATIENCE, check, launch, open } from "../../../tests/view/browser.mjs";

const [address, pictures, robot, order, answer] = process.argv.slice(2);
const browser = await launch();

async function look() {
  const { page, faults, close } = await open(browser, address);
  const row = page.locator("#robots tr", { hasText: order });
  await row.locator(".asks input").waitFor({ timeout: PATIENCE });
  await page.screenshot({ path: join(pictures, "question.png"), fullPage: true });
  // What somebody writes stays when the page looks again.
  await row.locator("input").pressSequentially(answer.slice(0, 2));
  await page.waitForTimeout(2500);
  await row.locator("input").pressSequentially(answer.slice(2));
  check((await row.locator("input").inputValue()) === answer, "the answer is not lost");
  await row.locator("input").press("Enter");
  await page.locator("#robots code", { hasText: "go(" }).first().waitFor({ timeout: PATIENCE });
  // The journal of a run that goes on, and of one that is done, in a tab of its own.
  for (const line of [row, page.locator("#results tr", { hasText: "done" }).first()]) {
    const [tab] = await Promise.all([page.context().waitForEvent("page"), line.getByRole("button", { name: "Journal" }).click()]);
    tab.on("pageerror", (error) => faults.push(`journal: ${error.message}`));
    await tab.locator(".chip").first().waitFor({ timeout: PATIENCE });
    check(!tab.url().includes(new URL(address).hash.slice(1)), "the token is not in the address of a journal");
    check((await tab.evaluate(() => window.opener)) === null, "the journal does not reach the page");
    await tab.screenshot({ path: join(pictures, "journal.png") });
    await tab.close();
  }
  await row.getByRole("button", { name: "Stop" }).click();
  const ended = page.locator("#results tr", { hasText: order }).filter({ hasText: "interrupted" });
  await ended.waitFor({ timeout: PATIENCE });
  check((await ended.locator("td").nth(1).innerText()) === robot, "the result is of the robot");
  await page.screenshot({ path: join(pictures, "results.png"), fullPage: true });
  await page.setViewportSize({ width: 420, height: 800 });
  await page.screenshot({ path: join(pictures, "narrow.png") });
  check(faults.length === 0, faults.join("; "));
  await close();
  // Without its token the page shows nothing.
  const other = await open(browser, address.split("#")[0]);
  await other.page.locator("#note", { hasText: "No answer: open the page by the address" }).waitFor({ timeout: PATIENCE });
  check((await other.page.locator("#results tr").count()) === 0, "no result without the token");
  await other.close();
}

let code = 0;
try {
  await look();
  console.log("page: well");
} catch (error) {
  console.error(`page: ${error.message}`);
  code = 1;
}
await browser.close();
process.exit(code);
