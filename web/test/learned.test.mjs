// What the page draws and says of the cuts that a chart learned from, and of the cut to make next.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { tables, traces } from './browser.mjs';
import { lead, shownIn } from './shown.mjs';
import { oneRun } from './synthetic.mjs';

const shown = shownIn({ webgl: false });
const share = (right, of) => ({ right, of, share: right / of, low: 0.1, high: 0.9 });

/** A run whose last chart learned from two cuts; `change` alters what it learned. */
function taught(change = () => {}) {
  const data = oneRun();
  const chart = data.runs[0].summary.lobes.at(-1);
  chart.learned = {
    parameters: [
      { parameter: 'frequency', mode_frequency_hz: 500, before: 500, after: 490, relative_deviation_before: 0.02, relative_deviation_after: 0.01, moved: -1 },
      { parameter: 'K_t', mode_frequency_hz: null, before: 6e8, after: 5.7e8, relative_deviation_before: 0.1, relative_deviation_after: 0.08, moved: -0.5 },
      { parameter: 'speed_exponent', mode_frequency_hz: null, before: 0, after: 0.18, relative_deviation_before: 0.2, relative_deviation_after: 0.12, moved: 0.9 },
    ],
    before: share(1, 2), after: share(2, 2), contradictions: [{ spindle_speed_rpm: 1500, depth_m: 0.003, observed: 'stable', chatter_probability: 0.97 }],
    next_cut: { for_rpm: 2000, spindle_speed_rpm: 1800, depth_m: 0.0015, chatter_probability: 0.4, deviation_before: 0.12, deviation_after: 0.07 },
    rows: [1000, 2000, 3000].map((rpm) => ({ spindle_speed_rpm: rpm, before_m: 0.002, median_m: 0.0022, stable_90_m: 0.0019, stable_95_m: 0.0018 })),
  };
  change(chart.learned);
  return data;
}

const said = (page) => page.locator('p.next-cut').textContent();
const marks = async (page) => (await traces(page, 'lobes')).filter((t) => t.meta?.startsWith('proposed'));
const table = async (page, caption) => (await tables(page, caption))[0];

test('the next cut is drawn where it lies and said with its risk and what it brings', () => shown(taught(), async (page) => {
  const [next, ...others] = await marks(page);
  assert.deepEqual(others, []);
  assert.deepEqual([next.name, Array.from(next.x), Array.from(next.y)], ['next cut', [1800], [1.5]]);
  assert.equal(await said(page), 'The next cut to make is 1800 rpm, 1.5 mm: it chatters with a probability of 40 %, and its outcome narrows the relative standard deviation of the limit at 2000 rpm from 12 % to 7 %.');
  assert.match(await lead(page, 'lobes'), /The full line is the chart before any cut.*The star is the cut to make next/);
}));

test('the learned chart lies beside the chart before, with a table of what moved', () => shown(taught(), async (page) => {
  const list = await traces(page, 'lobes');
  assert.ok(list.some((t) => t.meta === 'limit 0 supported'));
  assert.deepEqual(Array.from(list.find((t) => t.meta === 'learned 0 median_m').y), [2.2, 2.2, 2.2]);
  assert.deepEqual(await table(page, 'What the cuts taught'), [
    ['Parameter', 'Before', 'After', 'Moved by'], ['frequency at 500 Hz', '500 Hz ± 2 %', '490 Hz ± 1 %', '−1 deviations'], ['K_t', '600 N/mm² ± 10 %', '570 N/mm² ± 8 %', '−0.5 deviations'],
    ['exponent q of the coefficients over the speed, n^−q', '0 ± 0.2', '0.18 ± 0.12', '0.9 deviations']]);
  assert.deepEqual((await table(page, 'Cuts on the right side')).map((row) => row[1]), ['Right, 95 % interval', '1 of 2, 50 % (10 to 90 %)', '2 of 2, 100 % (10 to 90 %)']);
  assert.deepEqual((await table(page, 'Cuts that contradict the others'))[1], ['1500 rpm, 3 mm', 'seen stable', '97 %']);
}));

test('a cut for the best speed and one that removes most are told apart', () => shown(taught((learned) => {
  learned.next_cut.for_rpm = null;
  learned.productive_cut = { spindle_speed_rpm: 2500, depth_m: 0.001, chatter_probability: 0.1 };
}), async (page) => {
  assert.deepEqual((await marks(page)).map((t) => t.name), ['next cut', 'removes most']);
  assert.match(await said(page), /narrows the relative standard deviation of the best speed from 12 % to 7 %\. The cut that removes most at the case.s risk is 2500 rpm, 1 mm, which chatters with a probability of 10 %\./);
}));

test('a chart without a next cut sends to the warnings, which have the reason', () => shown(taught((learned) => { delete learned.next_cut; }), async (page) => {
  assert.deepEqual(await marks(page), []);
  assert.equal(await said(page), 'No next cut is proposed; the run’s warnings say why.');
}));

test('a chart that learned nothing speaks of no cut', () => shown(oneRun(), async (page) => {
  assert.equal(await page.locator('p.next-cut').count(), 0);
}));
