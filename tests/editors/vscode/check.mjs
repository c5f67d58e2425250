// Opens a policy in VS Code and looks at what the extension shows.

import { createRequire } from 'node:module';
import { join } from 'node:path';

const [address, pictures] = process.argv.slice(2);
const { chromium } = createRequire(join(process.env.PLAYWRIGHT, 'package.json'))('playwright-core');
const begun = Date.now();
const seconds = () => ((Date.now() - begun) / 1000).toFixed(1);
const done = what => console.log(`${seconds()} s: ${what}`);

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu'],
});
const page = await browser.newPage({ viewport: { width: 1400, height: 900 } });
page.setDefaultTimeout(60000);
try {
  for (;;) {
    const isThere = await page.goto(address).then(() => true, () => false);
    if (isThere) break;
    await new Promise(resolve => setTimeout(resolve, 300));
  }
  await page.waitForSelector('.monaco-workbench');
  done('the workbench is there');
  await page.getByText('fetch.motet', { exact: true }).first().dblclick();
  await page.waitForSelector('.monaco-editor .view-lines');
  await page.waitForSelector('.squiggly-error');
  done('an error is underlined');
  await page.keyboard.press('Control+Shift+M');
  const panel = page.locator('.markers-panel');
  await panel.getByText('there is no primitive or policy `sya`').first().waitFor();
  await panel.getByText('M0201').first().waitFor();
  const problems = await panel.innerText();
  done(`Problems: ${problems.replaceAll('\n', ' | ')}`);
  if (!problems.includes('M0501') || !problems.includes('[Ln 5, Col 26]')) throw new Error('M0501 is not at 5:26');
  await page.locator('.codelens-decoration').first().waitFor();
  const lens = await page.locator('.codelens-decoration').first().innerText();
  if (!lens.includes('Run in simulation')) throw new Error(`the lens is ${lens}`);
  done(`the lens: ${lens}`);
  const word = page.locator('.view-line span', { hasText: /^handover$/ }).first();
  await word.hover();
  await page.locator('.monaco-hover').getByText('Known here').first().waitFor();
  done('the hover says what is known');
  await page.screenshot({ path: join(pictures, 'problems.png') });
  await page.mouse.move(5, 5);
  await page.locator('.view-line', { hasText: 'sya' }).first().click();
  await page.keyboard.press('End');
  for (let index = 0; index < 8; index++) await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Control+.');
  await page.getByText('Write `say`').first().waitFor();
  await page.screenshot({ path: join(pictures, 'fix.png') });
  await page.keyboard.press('Enter');
  await panel.getByText('there is no primitive or policy `sya`').first().waitFor({ state: 'detached' });
  done('the quick fix takes the error away');
  await page.screenshot({ path: join(pictures, 'fixed.png') });
} catch (error) {
  await page.screenshot({ path: join(pictures, 'failed.png') });
  console.error(String(error));
  process.exitCode = 1;
} finally {
  await browser.close();
}
