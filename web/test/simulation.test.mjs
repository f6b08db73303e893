// What the page tells and draws of a simulation.

import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { tables, traces } from './browser.mjs';
import { lead, shownIn } from './shown.mjs';
import { oneRun, simulated } from './synthetic.mjs';

const shown = shownIn({ webgl: false });

describe('a simulation', () => {
  const simulatedPage = (see) => shown(simulated(), see);
  const marked = (page) => page.evaluate(() => Array.from(document.getElementById('plot-lobes').data.find((t) => t.meta === 'simulated').marker.symbol));

  test('its table tells every point, and that march and lobes agree', () => simulatedPage(async (page) => {
    const [[head, stable, flip]] = await tables(page, 'Simulated points');
    assert.equal(stable[head.indexOf('Motion')], 'repeats itself with the cut');
    assert.equal(flip[head.indexOf('Motion')], 'repeats itself after 2 periods of the cut');
    assert.equal(flip[head.indexOf('Peak to peak')], '20, 40 µm');
    assert.match(await lead(page, 'simulation'), /that of the lobes to 2e−9, the periodic motion that in closed form to 3e−7\.$/);
  }));

  test('traces are those of the point that is chosen', () => simulatedPage(async (page) => {
    const amplitude = async () => Math.max(...(await traces(page, 'simulation-trace')).find((t) => t.meta === 'x_m').y);
    const before = await amplitude();
    await page.locator('#simulation label.control', { hasText: 'Point' }).locator('select').selectOption('1');
    assert.ok(Math.abs(await amplitude() - 2 * before) < 1e-3 * before, 'in µm, of the second point');
    assert.ok(Math.abs(before - 10) < 0.05, 'µm');
  }));

  test('lines of teeth and of chatter have marks of their own', () => simulatedPage(async (page) => {
    await page.locator('#simulation label.control', { hasText: 'Point' }).locator('select').selectOption('1');
    const list = await traces(page, 'simulation-spectrum');
    assert.deepEqual(list.find((t) => t.meta === 'lines tooth_passing').x, [100]);
    assert.deepEqual(list.find((t) => t.meta === 'lines other').x, [50]);
  }));

  test('a section has points once a tooth and once a turn', () => simulatedPage(async (page) => {
    const list = await traces(page, 'simulation-section');
    assert.equal(list.find((t) => t.meta === 'once a tooth').x.length, 4);
    assert.equal(list.find((t) => t.meta === 'once a turn').x.length, 2);
  }));

  test('a mark on the chart leads to its simulation, and back', () => simulatedPage(async (page) => {
    assert.deepEqual(await marked(page), ['diamond', 'diamond-open']);
    await page.evaluate(() => { const box = document.getElementById('plot-lobes'); box.emit('plotly_click', { points: [{ data: box.data.find((t) => t.meta === 'simulated'), pointNumber: 1 }] }); });
    assert.equal(await page.locator('#simulation label.control', { hasText: 'Point' }).locator('select').inputValue(), '1');
    assert.deepEqual(await marked(page), ['diamond-open', 'diamond']);
    await page.waitForFunction(() => Math.abs(document.getElementById('simulation').getBoundingClientRect().top) < innerHeight);
    await page.locator('#simulation button', { hasText: 'On the chart' }).click();
    await page.waitForFunction(() => { const { top, bottom } = document.getElementById('lobes').getBoundingClientRect(); return top < innerHeight && bottom > 0; });
  }));

  test('the map has a row a depth, with the limit on it and a gap where the vibration outgrew the cutter', () => simulatedPage(async (page) => {
    const [map, , limit] = await page.evaluate(() => document.getElementById('plot-simulation-map').data.map((t) => ({ meta: t.meta, values: t.customdata?.map((r) => Array.from(r)) })));
    const expected = [[1, 3, 5], [2, 4, null]];
    map.values.forEach((row, d) => row.forEach((v, s) => assert.ok(v === expected[d][s] || Math.abs(v - expected[d][s]) < 1e-4, `${v}`)));
    assert.equal(limit.meta, 'limit');
  }));

  test('a run without one has no such section', () => shown(oneRun(), async (page) => assert.equal(await page.locator('#simulation').count(), 0)));
});
