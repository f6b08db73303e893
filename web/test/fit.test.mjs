// The page of a fit. THINWALL_REPORTS lists finished pages, of which those of fits are looked at here; without any an invented one is.

import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { commandOf, toggled } from '../src/chosen.js';
import { displacements } from '../src/motion.js';
import { drawn, launch, open, pixels, saved, slide, tables, traces } from './browser.mjs';
import { compose, documentOf, kindOf } from './compose.mjs';
import { fitted } from './synthetic.mjs';

const folder = mkdtempSync(path.join(os.tmpdir(), 'thinwall-fit-'));
const made = (name, data) => { const file = path.join(folder, `${name}.html`); writeFileSync(file, compose(data)); return file; };
const given = (process.env.THINWALL_REPORTS ?? '').split(':').filter(Boolean).map((f) => path.resolve(f)).filter((f) => kindOf(f) === 'fit');
const pages = given.length ? given : [made('fit', fitted()), made('plain', fitted({ coherence: false, shapes: false, warnings: [] }))];

let browser;
before(async () => { browser = await launch(); });
after(async () => { await browser.close(); rmSync(folder, { recursive: true }); });

const rows = async (page, caption) => (await tables(page, caption))[0];

for (const file of pages) {
  describe(path.relative(process.cwd(), file), () => {
    const { fit } = documentOf(file);
    const beside = path.join(path.dirname(file), 'fit.json');
    const figures = existsSync(beside) ? JSON.parse(readFileSync(beside, 'utf8')) : fit.figures;
    const { modes } = figures;
    let page;
    before(async () => { page = await open(browser, file); await drawn(page); });
    after(() => page.context().close());
    const command = () => page.locator('.command').textContent();
    /** Clicks on a pole of the diagram as drawn, the last of those that satisfy. */
    const click = async (wanted) => {
      await page.locator('#plot-stabilisation').scrollIntoViewIfNeeded();
      const at = await page.evaluate((hz) => {
        const box = document.getElementById('plot-stabilisation');
        const trace = box.data.find((t) => t.meta?.startsWith('poles') && Array.from(t.x).some((x) => Math.abs(x / hz - 1) < 1e-9));
        const i = Array.from(trace.x).findLastIndex((x) => Math.abs(x / hz - 1) < 1e-9);
        const { left, top } = box.getBoundingClientRect();
        const { xaxis, yaxis } = box._fullLayout;
        return { x: left + xaxis._offset + xaxis.d2p(trace.x[i]), y: top + yaxis._offset + yaxis.d2p(trace.y[i]) };
      }, wanted);
      await page.mouse.click(at.x, at.y);
      await page.waitForTimeout(350); // Plotly waits for a second click
    };

    test('is small, opens without error, asks for nothing else, breaks no policy', async () => {
      assert.ok(statSync(file).size <= 8e6, `${statSync(file).size} bytes`);
      assert.deepEqual(page.trouble, []);
      assert.deepEqual(page.requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
      assert.deepEqual(await page.evaluate(() => window.violations), []);
    });

    test('the table has the modes of fit.json with their intervals', async () => {
      const [, ...list] = await rows(page, 'Modes');
      assert.equal(list.length, modes.length);
      list.forEach((cells, i) => {
        assert.ok(Math.abs(Number(cells[1]) / modes[i].frequency_hz - 1) < 1e-5, cells[1]);
        const [low, high] = modes[i].frequency_95_hz;
        assert.deepEqual(cells[2].split(' … ').map(Number).map((v) => Math.abs(v / modes[i].frequency_hz - 1) < 1), [true, true]);
        assert.ok(Math.abs(Number(cells[2].split(' … ')[0]) / low - 1) < 1e-5 && Math.abs(Number(cells[2].split(' … ')[1]) / high - 1) < 1e-5);
      });
    });

    test('doubts and remarks stand as they are', async () => {
      const text = await page.locator('#remarks').textContent();
      for (const doubt of figures.warnings) assert.ok(text.includes(doubt), doubt);
      if (!figures.warnings.length) assert.match(text, /Nothing speaks against the fit/);
    });

    test('measured and fitted lie upon each other in every view', async () => {
      const show = page.locator('#receptances label.control', { hasText: 'Show' }).locator('select');
      for (const view of ['log', 'phase', 'nyquist', 'cmif']) {
        await show.selectOption(view);
        const list = await traces(page, 'receptance');
        const [measured, ours] = [/^0 measured( cmif 0)?$/, /^0 measured synthesised( cmif 0)?$/].map((meta) => list.find((t) => meta.test(t.meta)));
        assert.ok(measured && ours, `${view}: ${list.map((t) => t.meta)}`);
        assert.equal(measured.x.length, ours.x.length);
        if (view === 'log') assert.equal(list.some((t) => t.meta?.endsWith('coherence')), Boolean(fit.frf.coherence));
      }
      await show.selectOption('log');
    });

    test('the diagram tells apart what is stable in frequency, damping and vector, over the indicator', async () => {
      const list = await traces(page, 'stabilisation');
      assert.equal(list[0].meta, 'cmif');
      const poles = list.filter((t) => t.meta.startsWith('poles'));
      assert.ok(poles.length >= 2, list.map((t) => t.meta).join());
      assert.equal(poles.reduce((n, t) => n + t.x.length, 0), fit.diagram.hz.shape[0]);
      const stable = poles.find((t) => t.meta === 'poles 7');
      for (const { hz } of fit.stable) assert.ok(stable.x.some((x) => Math.abs(x / hz - 1) < 0.01), `${hz} Hz`);
    });

    test('clicks on poles make the command that names them', async () => {
      assert.equal(await command(), commandOf(fit.command, modes.map((m) => m.frequency_hz)));
      await page.getByRole('button', { name: 'Choose no pole' }).click();
      assert.equal(await command(), commandOf(fit.command, []));
      const [first] = (await traces(page, 'stabilisation')).filter((t) => t.meta === 'poles 7');
      const hz = first.x.at(-1);
      await click(hz);
      assert.equal(await command(), commandOf(fit.command, [hz]));
      await click(hz);
      assert.equal(await command(), commandOf(fit.command, []));
      await page.getByRole('button', { name: 'Choose the poles of this fit' }).click();
      assert.equal(await command(), commandOf(fit.command, modes.map((m) => m.frequency_hz)));
    });

    test('the diagram is saved as a table', async () => {
      const { text } = await saved(page, page.locator('#stabilisation .exports button', { hasText: 'CSV' }));
      assert.equal(text.trim().split('\n').length, fit.diagram.hz.shape[0] + 1);
    });

    test('the shape is drawn, turns and grows', { skip: !fit.shapes }, async () => {
      await page.locator('#shapes').scrollIntoViewIfNeeded();
      const before_ = await pixels(page);
      assert.ok(before_.colours > 3);
      await slide(page, 'Amplitude', 0.6);
      const larger = await pixels(page);
      assert.notEqual(larger.hash, before_.hash);
      await page.locator('canvas.shape').focus();
      await page.keyboard.press('ArrowLeft');
      assert.notEqual((await pixels(page)).hash, larger.hash);
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

describe('a fit of many forces', () => {
  test('tells how many the table of misfits leaves out', { skip: given.length > 0 }, async () => {
    const data = fitted();
    const forces = Array.from({ length: 14 }, (_, i) => `${i + 1}.x`);
    Object.assign(data.fit.figures, { forces, misfit: data.fit.figures.misfit.map(([m]) => forces.map(() => m)) });
    const page = await open(browser, made('wide', data));
    assert.equal((await rows(page, 'Misfit (response by force)'))[0].length, 1 + 12);
    assert.match(await page.locator('#misfit').textContent(), /2 more forces are in fit\.json/);
    await page.context().close();
  });
});

describe('the choice of poles', () => {
  test('a click adds a pole, another takes it back', () => {
    assert.deepEqual(toggled([60, 180], 100), [60, 100, 180]);
    assert.deepEqual(toggled([60, 100, 180], 100.05), [60, 180]);
  });

  test('the command is one that a shell reads', () => {
    assert.equal(commandOf(['thinwall', 'fit', "it's.uff", '--from', '20 Hz'], [60.25, 180.4999999]), "thinwall fit 'it'\\''s.uff' --from '20 Hz' --poles '60.25 Hz, 180.5 Hz'");
  });

  test('a shape turns through its phases with an amplitude of 1', () => {
    const shape = [[0, 2, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0]];
    assert.deepEqual(displacements(shape, 0).map(([x]) => Math.round(x * 1e9) / 1e9), [0, 0.5]);
    assert.ok(Math.abs(displacements(shape, -Math.PI / 2)[0][0] - 1) < 1e-12);
  });
});
