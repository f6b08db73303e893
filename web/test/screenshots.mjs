// Pictures of a report for the documentation: `node web/test/screenshots.mjs REPORT FOLDER`. PNG files of at most 150 kB:
// lobes, receptances, shape (what the report has of these) and page, the whole from top to bottom.

import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { drawn, launch, open } from './browser.mjs';
import { indexed } from './indexed.mjs';

const largest = 150_000; // bytes
const parts = { lobes: '#lobes .figure', receptances: '#receptances .figure', shape: '#shapes .figure' };

/** Takes pictures with less and less detail until one is small enough, if need be in 256 colours. */
async function small(name, folder, details, take) {
  for (const detail of details) {
    let picture = await take(detail);
    if (picture.length > largest) picture = await indexed(blank, picture);
    if (picture.length > largest) continue;
    writeFileSync(path.join(folder, `${name}.png`), picture);
    console.log(`${name}.png: ${Math.round(picture.length / 1000)} kB`);
    return;
  }
  throw new Error(`${name}.png is larger than ${largest} bytes with however little detail`);
}

/** The page at a width, in its light colours; `take` makes the picture. */
async function at(browser, report, options, take) {
  const page = await open(browser, report, { colorScheme: 'light', unfold: false, ...options });
  await drawn(page);
  await page.evaluate(() => document.querySelectorAll('.exports, nav').forEach((e) => { e.style.display = 'none'; }));
  await page.waitForTimeout(300);
  const picture = await take(page);
  await page.context().close();
  return picture;
}

const [report, folder] = process.argv.slice(2);
if (!folder) {
  console.error('usage: node web/test/screenshots.mjs REPORT.html FOLDER');
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const browser = await launch();
const blank = await browser.newPage();
const file = path.resolve(report);
for (const [name, selector] of Object.entries(parts)) {
  const present = await at(browser, file, {}, (page) => page.locator(selector).count());
  if (present) await small(name, folder, [1000, 860, 720], (width) => at(browser, file, { viewport: { width, height: 900 } }, (page) => page.locator(selector).first().screenshot()));
}
await small('page', folder, [0.75, 0.6, 0.5, 0.4, 0.3, 0.2], (scale) => at(browser, file, { viewport: { width: 1100, height: 900 }, deviceScaleFactor: scale }, (page) => page.screenshot({ fullPage: true })));
await browser.close();
