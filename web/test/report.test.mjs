// Finished reports in a browser. THINWALL_REPORTS lists report.html files (separated by ':'); without it the tests make their own.
// Where a summary.json lies beside a report, the plots are held against that, else against the report's own copy.

import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { table } from './csv.mjs';
import { drawn, launch, open, pixels, saved, slide, traces } from './browser.mjs';
import { compose, documentOf, kindOf } from './compose.mjs';
import { oneRun, twoRuns } from './synthetic.mjs';

const folder = mkdtempSync(path.join(os.tmpdir(), 'thinwall-page-'));
const made = (name, data) => { const file = path.join(folder, `${name}.html`); writeFileSync(file, compose(data)); return file; };
const given = (process.env.THINWALL_REPORTS ?? '').split(':').filter(Boolean).map((f) => path.resolve(f)).filter((f) => kindOf(f) === 'runs');
const reports = given.length ? given : [made('one', oneRun()), made('two', twoRuns())];
// A time depends on the machine and on what else it does: it is told always, and held to a bound only where one is given.
const bound = Number(process.env.THINWALL_READY_MS ?? Infinity);
const rounded = 2e-5; // of the document's arrays of f32: their mantissas have 15 bits
const largest = Number(process.env.THINWALL_REPORT_BYTES ?? 5e6);

let browser;
before(async () => { browser = await launch(); });
after(async () => { await browser.close(); rmSync(folder, { recursive: true }); });

const close = (a, b, tolerance = 1e-6) => assert.ok(Math.abs(a - b) <= tolerance * Math.abs(b), `${a} is not ${b}`);

/** Numbers of an array of the document, decoded here by another way than the page's. */
function numbers({ type, deflate, shuffled }) {
  const width = { f32: 4, f64: 8, i16: 2, u32: 4 }[type];
  let bytes = inflateSync(Buffer.from(deflate, 'base64'));
  const n = bytes.length / width;
  if (shuffled) bytes = Buffer.from(Array.from({ length: bytes.length }, (_, i) => bytes[(i % width) * n + Math.floor(i / width)]));
  const read = { f32: 'readFloatLE', f64: 'readDoubleLE', i16: 'readInt16LE', u32: 'readUInt32LE' }[type];
  return Array.from({ length: n }, (_, i) => bytes[read](i * width));
}

/** Opens the page as for the first time: ms until it is ready, and ms of its main thread until then. */
async function loaded(file) {
  const context = await browser.newContext({ viewport: { width: 1200, height: 900 } });
  const page = await context.newPage();
  const session = await context.newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  const thread = async () => (await session.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration').value * 1e3;
  const start = await thread();
  await page.goto(`file://${file}`, { waitUntil: 'commit' });
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  const end = await thread();
  const ready = Number(await page.evaluate(() => document.documentElement.dataset.ready));
  await context.close();
  return { ready, thread: end - start };
}

/** What is drawn of a path, as a map or as lines: { x, depth: a list for each position }. */
const pathDepths = (page) => page.evaluate(() => {
  const { data } = document.getElementById('plot-path');
  const map = data.find((t) => t.type === 'heatmap');
  const lines = data.filter((t) => t.meta?.startsWith('position'));
  return { x: Array.from((map ?? lines[0]).x), depth: map ? map.customdata.map((row) => Array.from(row)) : lines.map((t) => Array.from(t.y)) };
});

for (const file of reports) {
  describe(path.relative(process.cwd(), file), () => {
    const data = documentOf(file);
    const beside = path.join(path.dirname(file), 'summary.json');
    const summary = data.runs.length === 1 && existsSync(beside) ? JSON.parse(readFileSync(beside, 'utf8')) : data.runs[0].summary;
    /** The text of a file beside the report, of a folder whether there is one. */
    const csv = (...names) => { const f = path.join(path.dirname(file), ...names) + (names.length > 1 ? '.csv' : ''); return data.runs.length === 1 && existsSync(f) && (names.length > 1 ? readFileSync(f, 'utf8') : true); };
    const has = { lobes: data.runs[0].lobes?.length, frf: data.runs[0].frf?.length, shapes: data.runs[0].shapes?.modes?.length, paths: data.runs[0].paths?.length };
    let page;
    before(async () => { page = await open(browser, file); await drawn(page); });
    after(() => page.context().close());

    test('is small enough', () => assert.ok(statSync(file).size <= largest, `${statSync(file).size} bytes`));

    test('opens without error, asks for nothing else, breaks no policy', async () => {
      assert.deepEqual(page.trouble, []);
      assert.deepEqual(page.requests.filter((u) => !u.startsWith('blob:') && !u.startsWith('data:')), [`file://${file}`]);
      assert.deepEqual(await page.evaluate(() => window.violations), []);
      const policy = await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', 'content');
      assert.match(policy, /default-src 'none'/);
      assert.doesNotMatch(policy, /unsafe|\*|http/);
    });

    test('tells how long it takes to be ready, and keeps to the bound that is asked for', async (t) => {
      const best = { ready: Infinity, thread: Infinity };
      for (let i = 0; i === 0 || (i < 6 && best.ready > bound); i++) {
        const load = await loaded(file);
        for (const key of ['ready', 'thread']) best[key] = Math.min(best[key], load[key]);
      }
      t.diagnostic(`ready after ${best.ready} ms, ${best.thread.toFixed(0)} ms of work`);
      assert.ok(best.thread > 0 && best.ready <= bound, `${best.ready} ms, ${best.thread} ms of work`);
    });

    test('says the answer first', async () => {
      assert.equal(await page.textContent('.answer'), data.headline[0]);
      assert.equal(await page.evaluate(() => document.documentElement.lang), 'en');
    });

    test('the lobes are those of the summary', { skip: !has.lobes }, async () => {
      const shown = await traces(page, 'lobes');
      for (const lobe of summary.lobes) {
        const limit = shown.find((t) => t.meta === `limit 0 ${lobe.name}`);
        const depths = limit.y.filter((y) => y !== null);
        const least = Math.min(...depths);
        close(least, lobe.minimum_depth_m * 1e3);
        assert.ok(limit.x.some((x, i) => limit.y[i] === least && Math.abs(x - lobe.at_spindle_speed_rpm) < 1e-6 * x));
        const best = shown.find((t) => t.meta === `pockets 0 ${lobe.name}`);
        const deep = (lobe.robust?.best_pockets ?? lobe.best_pockets ?? []).filter((p) => p.depth_m > 1.3 * lobe.minimum_depth_m);
        assert.equal(best?.x.length ?? 0, deep.length);
        deep.forEach((p, i) => { close(best.x[i], p.spindle_speed_rpm); close(best.y[i], p.depth_m * 1e3); });
      }
    });

    test('the lobes are those of the files beside the report', { skip: !csv('lobes') }, async () => {
      const shown = await traces(page, 'lobes');
      for (const { name } of data.runs[0].lobes) {
        const rows = table(csv('lobes', name));
        const limit = shown.find((t) => t.meta === `limit 0 ${name}`);
        const chatter = shown.find((t) => t.meta === `chatter 0 ${name}`);
        assert.equal(limit.x.length, rows.length);
        const dotted = shown.find((t) => t.meta === `robust 0 ${name}`);
        assert.equal(Boolean(dotted), 'robust_depth_m' in rows[0]);
        rows.forEach((row, i) => {
          close(limit.x[i], row.spindle_speed_rpm);
          if (dotted && row.status !== 'not_converged') close(dotted.y[i], row.robust_depth_m * 1e3, rounded);
          if (row.status === 'not_converged') assert.equal(limit.y[i], null);
          else close(limit.y[i], row.limiting_depth_m * 1e3);
          if (row.status === 'converged') assert.ok(chatter.x.some((x, k) => Math.abs(x - row.spindle_speed_rpm) < 1e-6 * x && Math.abs(chatter.y[k] - row.chatter_frequency_hz) <= rounded * row.chatter_frequency_hz), `${name}: chatter at ${row.spindle_speed_rpm} rpm`);
        });
      }
    });

    test('the lobes\' options draw', { skip: !has.lobes }, async () => {
      for (const box of await page.$$('#lobes input[type=checkbox]')) await box.click();
      const { shapes } = await page.evaluate(() => ({ shapes: document.getElementById('plot-lobes').layout.shapes.length }));
      assert.ok(shapes > 0);
      for (const box of await page.$$('#lobes input[type=checkbox]')) await box.click();
      assert.deepEqual(page.trouble, []);
    });

    test('the path map is that of the document', { skip: !has.paths }, async () => {
      const depth = numbers(data.runs[0].paths.find((p) => p.name === 'supported')?.depth_m ?? data.runs[0].paths[0].depth_m);
      const shown = (await pathDepths(page)).depth.flat();
      depth.forEach((d, i) => (Number.isFinite(d) ? close(shown[i], d * 1e3) : assert.equal(shown[i], null)));
    });

    test('the path maps are those of the files beside the report', { skip: !has.paths || !csv('lobes') }, async () => {
      const select = page.locator('#path select').first();
      const start = await select.inputValue();
      for (const [i, { name }] of data.runs[0].paths.entries()) {
        await select.selectOption(String(i));
        const map = await pathDepths(page);
        const rows = table(csv('lobes', `${name}_path`));
        assert.equal(rows.length, map.x.length * map.depth.length);
        for (const row of rows) close(map.depth[row.position - 1][map.x.findIndex((x) => Math.abs(x - row.spindle_speed_rpm) < 1e-6 * x)], row.limiting_depth_m * 1e3, rounded);
      }
      await select.selectOption(start);
    });

    test('the receptances are those of the files beside the report', { skip: !has.frf || !csv('frf') }, async () => {
      const [response, force, show] = await page.$$('#receptances select');
      await show.selectOption('linear');
      for (const frf of data.runs[0].frf.filter((f) => f.name !== 'robot' || data.runs[0].frf.length === 1)) {
        const added = csv('frf', `${frf.name}_added`); // further lines at resonances, in a file of their own
        const rows = [...table(csv('frf', frf.name)), ...(added ? table(added) : [])].sort((a, b) => a.frequency_hz - b.frequency_hz);
        for (const [to, from] of [[frf.responses.at(-1), frf.forces[0]], [frf.responses[0], frf.forces[0]]]) {
          await response.selectOption(to);
          await force.selectOption(from);
          const trace = (await traces(page, 'receptance')).find((t) => t.meta === `0 ${frf.name}`);
          const modulus = rows.map((row) => Math.hypot(row[`re ${to}/${from} m/N`], row[`im ${to}/${from} m/N`]) * 1e6); // µm/N
          const largest = Math.max(...modulus); // an entry that is left out is its mirror image to 1e-6 of this
          const line = new Map(rows.map((row, k) => [row.frequency_hz.toPrecision(9), k]));
          assert.equal(trace.x.length, frf.thinned?.to ?? rows.length);
          trace.x.forEach((hz, i) => { const wanted = modulus[line.get(hz.toPrecision(9))]; assert.ok(Math.abs(trace.y[i] - wanted) <= rounded * wanted + 2e-6 * largest, `${frf.name} ${to}/${from} at ${hz} Hz: ${trace.y[i]} is not ${wanted}`); });
        }
      }
      await show.selectOption('log');
    });

    test('the receptances are those of the document, in every display', { skip: !has.frf }, async () => {
      const [response, force, show] = await page.$$('#receptances select');
      const frf = data.runs[0].frf.find((f) => f.name !== 'robot') ?? data.runs[0].frf[0];
      const H = numbers(frf.H);
      const n = frf.hz.shape[0];
      const line = Math.floor(n / 3);
      const [r, f] = [frf.responses.length - 1, 0]; // also where the entry is left out and stands at its transpose
      await response.selectOption(frf.responses[r]);
      await force.selectOption(frf.forces[f]);
      let at = ((r * frf.forces.length + f) * n + line) * 2;
      if (Number.isNaN(H[at])) at = ((f * frf.forces.length + r) * n + line) * 2;
      const [re, im] = [H[at], H[at + 1]];
      const expected = { log: Math.hypot(re, im) * 1e6, linear: Math.hypot(re, im) * 1e6, db: 20 * Math.log10(Math.hypot(re, im)), real: re * 1e6, imaginary: im * 1e6, phase: (Math.atan2(im, re) * 180) / Math.PI };
      for (const [display, value] of Object.entries(expected)) {
        await show.selectOption(display);
        const trace = (await traces(page, 'receptance')).find((t) => t.meta === `0 ${frf.name}`);
        close(trace.y[line], value, 1e-5);
        close(trace.x[line], numbers(frf.hz)[line], 1e-9);
      }
      await show.selectOption('nyquist');
      const circle = (await traces(page, 'receptance')).find((t) => t.meta === `0 ${frf.name}`);
      close(circle.x[line], re * 1e6, 1e-5);
      close(circle.y[line], im * 1e6, 1e-5);
      await show.selectOption('log');
    });

    test('one cursor runs through the panels of a plot', { skip: !has.frf }, async () => {
      await page.locator('#receptances').scrollIntoViewIfNeeded();
      const box = await page.locator('#plot-receptance .nsewdrag').first().boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.waitForSelector('#plot-receptance .hoverlayer .legend');
      const text = await page.textContent('#plot-receptance .hoverlayer');
      assert.match(text, /part/);
      if (data.runs[0].route_difference) assert.match(text, /difference/);
    });

    test('the shape moves with the phase and changes with the mode', { skip: !has.shapes }, async () => {
      await page.locator('canvas.shape').scrollIntoViewIfNeeded();
      await slide(page, 'Phase', 0);
      const full = await pixels(page);
      assert.ok(full.colours > 50, `${full.colours} colours`);
      await slide(page, 'Phase', 180);
      const opposite = await pixels(page);
      assert.notEqual(opposite.hash, full.hash);
      await slide(page, 'Phase', 0);
      assert.equal((await pixels(page)).hash, full.hash);
      const mode = page.locator('#shapes select').first();
      const start = await mode.inputValue();
      await page.click('#shapes button[aria-label="Next mode"]');
      assert.notEqual((await pixels(page)).hash, full.hash);
      await mode.selectOption(start);
      assert.equal((await pixels(page)).hash, full.hash);
      await page.focus('canvas.shape');
      await page.keyboard.press('ArrowRight');
      assert.notEqual((await pixels(page)).hash, full.hash);
      await page.click('#shapes button[aria-label$="reset the view"]');
      assert.equal((await pixels(page)).hash, full.hash);
    });

    test('the tables hold modes and checks', async () => {
      const text = await page.textContent('main');
      for (const check of summary.checks ?? []) assert.ok(text.includes(check.name) && text.includes(check.origin), check.name);
      for (const input of data.runs[0].manifest?.inputs ?? []) assert.ok(text.includes(input.sha256));
      const cells = (caption) => page.locator('table').evaluateAll((tables, wanted) => tables.filter((t) => t.caption.textContent.startsWith(wanted)).flatMap((t) => [...t.tBodies[0].rows].map((r) => [...r.cells].map((c) => c.textContent.trim()))), caption);
      const { part, coupling, robot } = data.runs.length > 1 ? {} : summary;
      const coupled = coupling?.modes?.length ? coupling.modes : coupling?.main_modes;
      for (const [caption, modes] of [['Part alone', part?.modes], ['Part with robot', coupled], ['Robot alone', robot?.modes]]) {
        const rows = await cells(caption);
        if (data.runs.length > 1) continue;
        assert.equal(rows.length, modes?.length ?? 0, caption);
        modes?.forEach((mode, i) => { close(Number(rows[i][1]), mode.frequency_hz, 1e-4); if (Number.isFinite(mode.damping_ratio) && mode.damping_ratio > 1e-4) close(Number(rows[i][2]), mode.damping_ratio * 100, 1e-2); });
      }
    });

    test('every plot is saved as SVG and as CSV', async () => {
      for (const figure of await page.locator('figure:has(.plot)').all()) {
        const svg = await saved(page, figure.getByRole('button', { name: 'save as SVG' }));
        assert.match(svg.text, /^<svg[^]*<path[^]*<\/svg>$/, svg.name);
        const csv = await saved(page, figure.getByRole('button', { name: 'save as CSV' }));
        const [head, ...rows] = csv.text.trim().split('\n');
        assert.ok(/\((mm|rpm|Hz|m\/N|relative|rad)\)|modes kept/.test(head) && rows.length >= 3, `${csv.name}: ${head}`);
      }
      assert.deepEqual(await page.evaluate(() => window.violations), []);
    });

    test('fits a phone', async () => {
      const phone = await open(browser, file, { viewport: { width: 360, height: 740 }, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
      await drawn(phone);
      assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), 360);
      assert.deepEqual(await phone.evaluate(() => [...document.querySelectorAll('.plot')].filter((p) => p.scrollWidth > p.clientWidth + 1).map((p) => p.id)), []);
      await phone.context().close();
    });

    test('prints in light colours without its buttons', async () => {
      const paper = await open(browser, file, { colorScheme: 'dark' });
      await paper.emulateMedia({ media: 'print' });
      assert.equal(await paper.locator('button:visible').count(), 0);
      assert.equal(await paper.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
      await paper.waitForFunction(() => [...document.querySelectorAll('.plot')].every((p) => p.layout?.paper_bgcolor === '#ffffff' && p.layout.width <= 660));
      assert.ok((await paper.pdf({ format: 'A4' })).length > 20000);
      await paper.context().close();
    });

    test('has a dark side, by the system and by its button', async () => {
      const background = (p) => p.evaluate(() => getComputedStyle(document.body).backgroundColor);
      const dark = await open(browser, file, { colorScheme: 'dark' });
      assert.notEqual(await background(dark), await background(page));
      await dark.click('button[aria-label="Light or dark"]');
      assert.equal(await background(dark), await background(page));
      if (has.lobes) assert.equal(await dark.evaluate(() => document.getElementById('plot-lobes').layout.paper_bgcolor), '#ffffff');
      await dark.context().close();
    });

    test('moves by itself unless less motion is wished', { skip: !has.shapes }, async () => {
      const phase = (p) => p.evaluate(() => [...document.querySelectorAll('#shapes label.control')].find((l) => l.textContent === 'Phase').querySelector('input').value);
      assert.equal(await phase(page), '0');
      const moving = await open(browser, file, { reducedMotion: 'no-preference' });
      await moving.locator('canvas.shape').scrollIntoViewIfNeeded();
      await moving.waitForFunction(() => document.querySelector('#shapes label.control:has(+ button) input').value !== '0');
      const play = moving.locator('#shapes button[aria-label="Play or pause the motion"]');
      assert.equal((await play.textContent()).trim(), 'Pause');
      assert.equal(await play.locator('svg path').count(), 1, 'the sign is drawn, since fonts lack it');
      await play.click();
      const stopped = await phase(moving);
      await moving.waitForTimeout(200);
      assert.equal(await phase(moving), stopped);
      await moving.context().close();
    });

    test('shows a still picture without WebGL', { skip: !has.shapes }, async () => {
      const plain = await launch(false);
      const still = await open(plain, file);
      assert.equal(await still.getAttribute('.stage', 'data-view'), 'picture');
      const full = await pixels(still);
      assert.ok(full.colours > 50, `${full.colours} colours`);
      await slide(still, 'Phase', 180);
      assert.notEqual((await pixels(still)).hash, full.hash);
      assert.deepEqual(still.trouble, []);
      await plain.close();
    });
  });
}
