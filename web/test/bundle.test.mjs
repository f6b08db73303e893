// The bundle itself: what hostile names can do, and that dist is what the sources make.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { drawn, launch, open, saved, traces } from './browser.mjs';
import { compose } from './compose.mjs';
import { indexed } from './indexed.mjs';
import { hostile, oneRun, toolOnly, twoRuns } from './synthetic.mjs';

const web = path.join(path.dirname(fileURLToPath(import.meta.url)), '..');
const folder = mkdtempSync(path.join(os.tmpdir(), 'thinwall-bundle-'));
const made = (name, data) => { const file = path.join(folder, `${name}.html`); writeFileSync(file, compose(data)); return file; };

let browser;
before(async () => { browser = await launch(); });
after(async () => { await browser.close(); rmSync(folder, { recursive: true }); });

test('dist is what the sources make', () => {
  execFileSync(process.execPath, [path.join(web, 'build.mjs'), path.join(folder, 'dist')], { stdio: 'inherit' });
  for (const name of readdirSync(path.join(folder, 'dist'))) {
    assert.ok(readFileSync(path.join(folder, 'dist', name)).equals(readFileSync(path.join(web, 'dist', name))), `dist/${name} is not up to date: npm run build`);
  }
});

test('the script can stand in a page and names its licences', () => {
  const script = readFileSync(path.join(web, 'dist/page.js'), 'utf8');
  assert.doesNotMatch(script, /<\/script|<!--/i);
  for (const holder of ['Plotly Technologies Inc.', 'three.js authors', 'Arjun Barrett']) assert.ok(script.includes(holder) && readFileSync(path.join(web, 'dist/LICENSES.txt'), 'utf8').includes(holder), holder);
});

describe('a document with names that are scripts', () => {
  let page;
  before(async () => { page = await open(browser, made('hostile', hostile())); await drawn(page); });
  after(() => page.context().close());

  test('runs nothing and breaks nothing', async () => {
    for (const [id, at] of [['lobes', 0.5], ['receptance', 0.5], ['path', 0.5], ['mac-0', 0.5]]) {
      await page.locator(`#plot-${id}`).scrollIntoViewIfNeeded();
      const box = await page.locator(`#plot-${id} .nsewdrag`).first().boundingBox();
      await page.mouse.move(box.x + box.width * at, box.y + box.height * at);
      await page.waitForTimeout(150);
    }
    for (const option of await page.locator('#receptances select').nth(2).locator('option').all()) await page.locator('#receptances select').nth(2).selectOption(await option.getAttribute('value'));
    for (const box of await page.$$('input[type=checkbox]')) await box.click();
    const svg = await saved(page, page.getByRole('button', { name: 'Receptances: save as SVG' }));
    assert.doesNotMatch(svg.text, /<script|<img|javascript:[^&]*"/);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.deepEqual(page.trouble, []);
    assert.deepEqual(await page.evaluate(() => window.violations), []);
  });

  test('adds no element and no link', async () => {
    assert.equal(await page.locator('script').count(), 2);
    assert.equal(await page.locator('main img').count(), 0);
    assert.equal(await page.locator('a[href^="javascript"]').count(), 0);
    assert.equal(await page.evaluate(() => [...document.querySelectorAll('svg a')].filter((a) => a.hasAttribute('href') || a.hasAttribute('xlink:href')).length), 0);
  });

  test('shows the names as they are', async () => {
    assert.ok((await page.textContent('.answer')).startsWith('</script><script>'));
    assert.match(await page.title(), /^<\/script>/);
  });
});

test('two runs lie over each other, each with its label and its dash', async () => {
  const page = await open(browser, made('two', twoRuns()));
  await drawn(page);
  const shown = await traces(page, 'lobes');
  const limits = [0, 1].map((i) => shown.find((t) => t.meta === `limit ${i} supported`));
  assert.deepEqual(limits.map((t) => t.name), ['first: with robot', 'second: with robot']);
  assert.notEqual(limits[0].line.dash, limits[1].line.dash);
  assert.equal(await page.locator('#checks table').count(), 2);
  await page.context().close();
});

test('a document of another schema, or a damaged one, says so', async () => {
  for (const damage of [(d) => { d.schema = 2; }, (d) => { d.runs[0].lobes[0].rpm.deflate = d.runs[0].lobes[0].rpm.deflate.slice(0, 40); }]) {
    const data = oneRun();
    damage(data);
    const page = await open(browser, made('damaged', data));
    assert.match(await page.textContent('[role=alert]'), /cannot be shown/);
    await page.context().close();
  }
});

test('a document with next to nothing in it is a page all the same', async () => {
  const page = await open(browser, made('bare', { schema: 1, program: 'thinwall', headline: ['Nothing was asked.'], runs: [{ label: 'bare', summary: { case: 'bare' }, manifest: {}, case: '' }] }));
  assert.equal(await page.textContent('.answer'), 'Nothing was asked.');
  assert.deepEqual(page.trouble, []);
  await page.context().close();
});

test('the documentation\'s pictures are PNG files of at most 150 kB', () => {
  const out = path.join(folder, 'pictures');
  execFileSync(process.execPath, [path.join(web, 'test/screenshots.mjs'), made('pictures', toolOnly()), out]);
  assert.deepEqual(readdirSync(out).sort(), ['lobes.png', 'page.png']);
  for (const name of readdirSync(out)) {
    const bytes = readFileSync(path.join(out, name));
    assert.equal(bytes.toString('latin1', 1, 4), 'PNG');
    assert.ok(bytes.length > 5000 && bytes.length <= 150_000, `${name}: ${bytes.length} bytes`);
  }
});

test('a picture in 256 colours is the picture', async () => {
  const page = await browser.newPage({ viewport: { width: 61, height: 40 } });
  await page.setContent('<body style="margin:0;background:linear-gradient(90deg,#440154,#fde725)"><p style="color:white">text</p></body>');
  const png = await page.screenshot();
  const decoded = (bytes) => page.evaluate(async (base64) => {
    const picture = Object.assign(new Image(), { src: `data:image/png;base64,${base64}` });
    await picture.decode();
    const pen = Object.assign(document.createElement('canvas'), { width: picture.width, height: picture.height }).getContext('2d');
    pen.drawImage(picture, 0, 0);
    return [picture.width, picture.height, Array.from(pen.getImageData(0, 0, picture.width, picture.height).data)];
  }, bytes.toString('base64'));
  const [width, height, before] = await decoded(png);
  const [w, h, after_] = await decoded(await indexed(page, png));
  assert.deepEqual([w, h], [width, height]);
  assert.ok(before.reduce((worst, v, i) => Math.max(worst, Math.abs(v - after_[i])), 0) <= 16, 'a channel is off by no more than two bins of 8');
  await page.close();
});
