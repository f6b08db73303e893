// The page of a robot over its postures. THINWALL_REPORTS lists finished pages, of which those are looked at here; without any, invented ones.

import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { drawn, launch, open, saved, tables, traces } from './browser.mjs';
import { compose, documentOf, kindOf } from './compose.mjs';
import { table as tableOf } from './csv.mjs';
import { learned, pack } from './synthetic.mjs';

const folder = mkdtempSync(path.join(os.tmpdir(), 'thinwall-postures-'));
const made = (name, data) => { const file = path.join(folder, `${name}.html`); writeFileSync(file, compose(data)); return file; };
const given = (process.env.THINWALL_REPORTS ?? '').split(':').filter(Boolean).map((f) => path.resolve(f)).filter((f) => kindOf(f) === 'postures');
const pages = given.length ? given : [made('whole', learned()), made('no-cut', learned({ cut: false, doubts: [] })), made('map-only', learned({ parts: ['map'] })), made('modes-only', learned({ parts: [] }))];

let browser;
before(async () => { browser = await launch(); });
after(async () => { await browser.close(); rmSync(folder, { recursive: true }); });

const rows = async (page, caption) => (await tables(page, caption))[0];
const heat = (page) => page.evaluate(() => { const t = document.getElementById('plot-workspace').data.find((d) => d.type === 'heatmap'); return { x: Array.from(t.x), y: Array.from(t.y), z: t.z.map((row) => Array.from(row)) }; });
const choose = (page, section, label, value) => page.locator(`#${section} label.control`, { hasText: label }).locator('select').selectOption(value);

for (const file of pages) {
  describe(path.relative(process.cwd(), file), () => {
    const { postures: found } = documentOf(file);
    const beside = path.join(path.dirname(file), 'postures.json');
    const figures = existsSync(beside) ? JSON.parse(readFileSync(beside, 'utf8')) : found.figures;
    let page;
    before(async () => { page = await open(browser, file); await drawn(page); });
    after(() => page.context().close());

    test('is small, opens without error, asks for nothing else, breaks no policy', async () => {
      assert.ok(statSync(file).size <= 8e6, `${statSync(file).size} bytes`);
      assert.deepEqual(page.trouble, []);
      assert.deepEqual(page.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
      assert.deepEqual(await page.evaluate(() => window.violations), []);
      assert.ok(!/undefined|NaN|null/.test(await page.locator('main').innerText()));
    });

    test('has the sections of what was asked, and no other', async () => {
      const ids = await page.locator('section').evaluateAll((list) => list.map((s) => s.id));
      const wanted = { map: figures.map, next: figures.next, 'held-out': found.modes, curve: figures.curve, envelope: figures.envelope, sharing: figures.shared?.length, modes: !found.modes };
      for (const [id, there] of Object.entries(wanted)) assert.equal(ids.includes(id), Boolean(there), id);
      assert.equal((await rows(page, 'Modes')).length, 1 + figures.modes.length);
    });

    test('doubts and remarks stand as they are', async () => {
      const text = await page.locator('#remarks').textContent();
      for (const line of [...figures.doubts, ...figures.notes]) assert.ok(text.includes(line), line);
    });

    test('the map has the extremes that the figures tell, and is saved whole', { skip: !figures.map?.least_depth_m }, async () => {
      assert.match(await page.locator('.answer').textContent(), new RegExp(`${figures.postures} tapped postures`));
      const table = tableOf((await saved(page, page.locator('#map .exports button', { hasText: 'CSV' }))).text);
      assert.equal(table.length, figures.map.places);
      const depths = table.map((row) => Number(row['Stable depth (mm)']));
      assert.ok(Math.abs(Math.min(...depths) / (figures.map.least_depth_m * 1e3) - 1) < 1e-9);
      assert.ok(Math.abs(Math.max(...depths) / (figures.map.largest_depth_m * 1e3) - 1) < 1e-9);
    });

    test('each quantity of the map is drawn', { skip: !figures.map }, async () => {
      const select = page.locator('#map label.control', { hasText: 'Show' }).locator('select');
      for (const value of await select.locator('option').evaluateAll((list) => list.map((o) => o.value))) {
        await select.selectOption(value);
        const drawnOnes = (await traces(page, 'workspace')).find((t) => t.meta === 'map');
        assert.ok(drawnOnes.x.length >= 2, value);
      }
      await select.selectOption({ index: 0 });
    });

    test('predictions beyond their intervals are told apart', { skip: !found.modes }, async () => {
      for (const value of figures.depths ? ['depth', 'frequency', 'damping'] : ['frequency', 'damping']) {
        await choose(page, 'held-out', 'Of', value);
        const list = await traces(page, 'held-out');
        const count = (meta) => list.find((t) => t.meta === meta)?.x.length ?? 0;
        const all = value === 'depth' ? found.depths.posture.shape[0] : found.modes.posture.shape[0];
        assert.equal(count('inside') + count('outside'), all);
        if (value === 'depth') assert.ok(Math.abs(count('inside') / all - figures.depths.covered) < 1e-9);
      }
    });

    test('the learning curves are those of the figures', { skip: !figures.curve }, async () => {
      const list = await traces(page, 'curve');
      for (const [meta, points] of [['plain', figures.curve.plain], ['arm', figures.curve.with_arm]]) {
        const trace = list.find((t) => t.meta === meta);
        assert.deepEqual(trace?.x, points?.map((p) => p.postures));
        points?.forEach((p, i) => assert.ok(Math.abs(trace.y[i] / (100 * (p.depth_error ?? p.frequency_error)) - 1) < 1e-9));
      }
    });

    test('fits a phone', async () => {
      const phone = await open(browser, file, { viewport: { width: 390, height: 800 } });
      await drawn(phone);
      assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      assert.deepEqual(phone.trouble, []);
      await phone.context().close();
    });
  });
}

describe('the map of invented postures', { skip: given.length > 0 }, () => {
  test('each cell has the value of its place, and one that was not reached has none', async () => {
    const data = learned();
    const page = await open(browser, made('cells', data));
    await drawn(page);
    const { x, y, z } = await heat(page);
    assert.deepEqual([x, y], [[0, 1, 2], [0, 10]]);
    y.forEach((k, j) => x.forEach((v, i) => { const depth = data.expected.get([v, k].join()); assert.ok(depth === undefined ? z[j][i] === null : Math.abs(z[j][i] - depth) < 1e-9, `${v} ${k}`); }));
    const [tapped, asked, next] = ['tapped', 'asked for', 'to tap next'].map((meta) => traces(page, 'workspace').then((list) => list.find((t) => t.meta === meta)));
    assert.equal((await tapped).x.length, 6);
    assert.deepEqual([(await asked).x[0], (await asked).y[0], (await next).x[0], (await next).y[0]], [0.9, 4, 1, 10]);
    assert.equal((await rows(page, 'Best candidates'))[1][3], '60 %');
    await page.context().close();
  });

  test('of three columns a slice is shown, which follows the choice of axes and of the third value', async () => {
    const data = learned({ parts: ['map'] });
    const places = [[0, 0, 5], [1, 0, 5], [0, 1, 5], [0, 0, 7], [1, 1, 7]];
    const n = places.length;
    data.postures.figures.over = ['x', 'y', 'turn'];
    data.postures.asked = [0, 0, 5.2];
    data.postures.places = pack('f64', [n, 3], places.flat());
    data.postures.map = { places: pack('f64', [n, 3], places.flat()), first_hz: pack('f64', [n, 3], places.flatMap(([x, y, t]) => [x + 10 * y + 100 * t, 1, 1e4])) };
    const page = await open(browser, made('three', data));
    await drawn(page);
    assert.deepEqual((await heat(page)).z, [[500, 501], [510, null]]);
    await choose(page, 'map', 'at turn', '1');
    assert.deepEqual((await heat(page)).z, [[700, null], [null, 711]]);
    await choose(page, 'map', 'Across', '2');
    assert.deepEqual((await heat(page)), { x: [5, 7], y: [0, 1], z: [[500, 700], [510, null]] });
    await choose(page, 'map', 'Upwards', '2');
    assert.deepEqual((await heat(page)), { x: [0, 1], y: [5, 7], z: [[500, 510], [700, null]] });
    await page.context().close();
  });

  test('of one column it is a line with its interval', async () => {
    const data = learned({ parts: ['map'] });
    data.postures.figures.over = ['u'];
    data.postures.asked = [0.5];
    data.postures.places = pack('f64', [2, 1], [0, 2]);
    data.postures.map = { places: pack('f64', [3, 1], [0, 1, 2]), first_hz: pack('f64', [3, 3], [10, 9, 11, 12, 11, 13, 14, 13, 15]) };
    const page = await open(browser, made('line', data));
    await drawn(page);
    const list = await traces(page, 'workspace');
    assert.deepEqual(list.find((t) => t.meta === 'map').y, [10, 12, 14]);
    assert.deepEqual(list.find((t) => t.meta === 'band').y, [9, 11, 13, 15, 13, 11, null]);
    await page.context().close();
  });
});
