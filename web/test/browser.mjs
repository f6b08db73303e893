// A headless Chromium for the tests. THINWALL_BROWSER names another executable.

import { chromium } from 'playwright-core';

const executablePath = process.env.THINWALL_BROWSER ?? '/usr/bin/chromium';
const software = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

export const launch = (webgl = true) => chromium.launch({ executablePath, args: ['--no-sandbox', ...(webgl ? software : ['--disable-gpu', '--disable-3d-apis'])] });

/** Opens a file and waits until it is ready. Folded plots are unfolded unless `unfold` is false. What went wrong on the way is in `.trouble`, what was asked for in `.requests`. */
export async function open(browser, file, { unfold = true, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 900 }, reducedMotion: 'reduce', ...options });
  const page = await context.newPage();
  page.trouble = [];
  page.requests = [];
  page.on('console', (m) => { if (['error', 'warning'].includes(m.type()) && !noise(m.text())) page.trouble.push(m.text()); });
  page.on('pageerror', (e) => page.trouble.push(String(e.stack)));
  page.on('request', (r) => page.requests.push(r.url()));
  page.on('dialog', (d) => { page.trouble.push(`a dialog: ${d.message()}`); d.dismiss(); });
  await page.addInitScript(() => {
    window.violations = [];
    document.addEventListener('securitypolicyviolation', (e) => window.violations.push(`${e.violatedDirective}: ${e.sample || e.blockedURI}`));
  });
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  if (unfold) await page.evaluate(() => document.querySelectorAll('details.folded').forEach((d) => { d.open = true; }));
  return page;
}

// What the software renderer says of itself when a test reads pixels.
const noise = (text) => /GPU stall due to ReadPixels|Automatic fallback to software WebGL/.test(text);

/** All plots of the page are drawn but those that are folded away. */
export const drawn = (page) => page.waitForFunction(() => [...document.querySelectorAll('.plot')].every((p) => p.data || p.closest('details:not([open])')));

/** Traces of a plot as plain values: [{ name, meta, x, y }]. */
export const traces = (page, id) => page.evaluate((name) => document.getElementById(name).data.map((t) => ({ name: t.name, meta: t.meta, x: Array.from(t.x), y: Array.from(t.y), line: t.line, fill: t.fill })), `plot-${id}`);

/** A hash of the picture's pixels, and how many colours it has. */
export const pixels = (page) => page.evaluate(() => {
  const canvas = document.querySelector('canvas.shape');
  const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
  const pen = copy.getContext('2d');
  pen.drawImage(canvas, 0, 0);
  const words = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
  let hash = 0;
  for (const w of words) hash = (Math.imul(hash, 31) + w) | 0;
  return { hash, colours: new Set(words).size };
});

/** Of the picture's pixels that `is([r, g, b])` says yes to: how many, whether one touches the border, and over which share of the height they reach. */
export async function colours(page, is) {
  const { width, height, text } = await page.evaluate(() => {
    const canvas = document.querySelector('canvas.shape');
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const bytes = pen.getImageData(0, 0, copy.width, copy.height).data;
    let s = '';
    for (let i = 0; i < bytes.length; i += 32768) s += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return { width: copy.width, height: copy.height, text: btoa(s) };
  });
  const bytes = Buffer.from(text, 'base64');
  const rows = [];
  let atBorder = false;
  for (let i = 0; i < width * height; i++) {
    if (!is([bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2]])) continue;
    const [x, y] = [i % width, Math.floor(i / width)];
    rows.push(y);
    atBorder ||= x === 0 || y === 0 || x === width - 1 || y === height - 1;
  }
  const range = rows.reduce(([low, high], y) => [Math.min(low, y), Math.max(high, y)], [Infinity, -Infinity]);
  return { count: rows.length, atBorder, height: rows.length ? (range[1] - range[0]) / height : 0 };
}

/** All tables of a caption, each as rows of the cells' texts. */
export const tables = (page, caption) => page.locator('table').evaluateAll((list, wanted) => list.filter((t) => t.caption.textContent === wanted).map((t) => [...t.rows].map((r) => [...r.cells].map((c) => c.textContent))), caption);

/** Moves a slider, as a user does. */
export const slide = (page, label, value) => page.evaluate(([name, v]) => {
  const input = [...document.querySelectorAll('label.control')].find((l) => l.textContent === name).querySelector('input');
  input.value = v;
  input.dispatchEvent(new Event('input', { bubbles: true }));
}, [label, String(value)]);

/** Presses a button that saves a file, and gives the file's text. Chromium drops a page's eleventh download of a second, without a word: each waits its part of one. */
export async function saved(page, button) {
  await page.waitForTimeout(150);
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return { name: download.suggestedFilename(), text: Buffer.concat(chunks).toString('utf8') };
}
