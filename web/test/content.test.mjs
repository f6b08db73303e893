// What the page says and draws of runs of different kinds: sentences, tiles, tables and marks by what there is.

import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { cmif, singularValues } from '../src/cmif.js';
import { tables, traces } from './browser.mjs';
import { lead, shownIn } from './shown.mjs';
import { alongPath, forced, identified, measured, oneRun, pack, partAlone, robust, toolMeasured, toolOnly, turning, twoRuns } from './synthetic.mjs';

const shown = shownIn({ webgl: false });

// Of cards and strip alike.
const tiles = (page) => page.locator('.tiles > div').evaluateAll((list) => Object.fromEntries(list.map((d) => [d.querySelector('dt').textContent, [...d.querySelectorAll('dd')].map((x) => x.textContent).join(' | ')])));

describe('the answer', () => {
  test('sentences stand once, five of them openly, and give the error alone', () => shown(oneRun(), async (page) => {
    const data = oneRun();
    const expected = [data.headline[1], ...data.runs[0].sentences];
    assert.deepEqual(await page.locator('#remarks .sentences li').allTextContents(), expected);
    assert.deepEqual(await page.locator('.sentences li:visible').allTextContents(), expected.slice(0, 5));
    assert.ok('Estimated error of the limits' in await tiles(page));
  }));

  test('no tile says the error again where a sentence does', async () => {
    const data = oneRun();
    data.runs[0].sentences.push('Estimated error of the charts for this model: 0.01 %.');
    await shown(data, async (page) => assert.ok(!('Estimated error of the limits' in await tiles(page))));
  });

  test('along a path the tiles are the path\'s', () => shown(alongPath(), async (page) => {
    const list = await tiles(page);
    assert.match(list['Deepest everywhere, with robot'], /^2\.03 mm \| at 10615 rpm; alone 0\.203 mm$/);
    assert.match(list['Weakest of the path, with robot'], /^0\.512 mm \| position 3, \(0, 100, 100\) mm, at 11231 rpm$/);
    assert.deepEqual(Object.keys(list).filter((name) => /^(Limit at|Lowest limit|Best pocket)/.test(name)), []);
  }));

  test('a tool alone has its tiles, and no sentence twice', () => shown(toolOnly(), async (page) => {
    const list = await tiles(page);
    assert.match(list['Limit at 1900 rpm, tool'], /^10 mm/);
    assert.match(list['Lowest limit, tool'], /mm/);
    assert.equal(await page.locator('.sentences').count(), 0);
  }));

  test('of two runs: both first lines, what differs, each run\'s own sentences', () => shown(twoRuns(), async (page) => {
    assert.deepEqual(await page.locator('.answer').allTextContents(), ['first: 2 mm.', 'second: 3 mm.']);
    assert.deepEqual(await tables(page, 'What differs'), [[['Key', 'first', 'second'], ['part.length', '0.39', '0.4'], ['robot.model', 'one_mode', '–']]]);
    const sentences = await page.locator('.sentences li').allTextContents();
    assert.deepEqual(await page.locator('#remarks h3').allTextContents(), ['first', 'second']);
    assert.deepEqual(sentences, ['an error.', ...twoRuns().runs[0].sentences, ...twoRuns().runs[1].sentences]);
  }));
});

describe('the first screen', () => {
  const asked = () => {
    const data = oneRun();
    const { summary } = data.runs[0];
    const chart = summary.lobes.find((l) => l.name === 'supported');
    chart.at_case_speed = { spindle_speed_rpm: 1900, limiting_depth_m: 0.003, contact: { preload_n: 50, lost_above_m: 0.001 },
      sensitivities: [{ parameter: 'damping_ratio', mode_frequency_hz: 250.1, sensitivity: 0.8 }, { parameter: 'K_r', mode_frequency_hz: null, sensitivity: -0.5 }, { parameter: 'K_a', mode_frequency_hz: null, sensitivity: 0.001 }] };
    chart.robust = { confidence: 2, minimum_depth_m: 0.0016, at_spindle_speed_rpm: 1000 };
    Object.assign(summary.operating_points[1], { forced_vibration: { mean_power_w: 120, peak_force_n: 300, surface_location_error_m: -12e-6 }, contact: { preload_n: 50, least_force_n: -3, largest_force_n: 110, lost: true } });
    return data;
  };

  test('says the cut in one sentence, and has three cards, of which the chart follows', () => shown(asked(), async (page) => {
    assert.equal(await page.textContent('.cutting'), 'Cut at P: down milling, 5 mm radially, by a flat end mill of 20 mm with 4 teeth; Kt 600 N/mm².');
    assert.equal(await page.locator('.tiles:not(.strip) > div').count(), 3);
    assert.equal(await page.locator('header .sentences').count(), 0);
    assert.equal(await page.evaluate(() => document.querySelector('header').nextElementSibling.id), 'lobes');
    const top = await page.evaluate(() => document.getElementById('plot-lobes').getBoundingClientRect().top);
    assert.ok(top < 800, `the chart begins at ${top} px`);
  }));

  test('the strip has margin, contact force, power, surface error and robust depth', () => shown(asked(), async (page) => {
    const list = await tiles(page);
    assert.equal(list['Margin at 1500 rpm and 1 mm'], '1 mm | stable');
    assert.equal(list['Contact force'], '−3 to 110 N | the cut pulls the contact open');
    assert.equal(list['Mean power'], '120 W | peak force 300 N');
    assert.equal(list['Surface location error'], '−12 µm | undercut');
    assert.equal(list['Robust depth'], '1.6 mm | at every speed, 2 standard deviations');
  }));

  test('what the limit hinges on is a folded table of what matters', () => shown(asked(), async (page) => {
    assert.equal(await page.locator('.hinges table:visible').count(), 0);
    await page.click('.hinges summary');
    const [table] = await tables(page, 'Change of the limit at 1900 rpm by 1 % more of a parameter');
    assert.deepEqual(table.slice(1), [['damping of the mode at 250.1 Hz', 'with robot', '+0.8 %'], ['Kr', 'with robot', '−0.5 %']].map((r) => [r[0].replace('Kr', 'K_r'), ...r.slice(1)]));
  }));

  test('headline and chart are on the first page of a print', () => shown(asked(), async (page) => {
    await page.emulateMedia({ media: 'print' });
    await page.waitForFunction(() => document.getElementById('plot-lobes').layout.width === 660);
    const bottom = await page.evaluate(() => document.getElementById('plot-lobes').getBoundingClientRect().bottom);
    assert.ok(bottom < (297 - 28) / 25.4 * 96, `the chart ends at ${bottom} px`);
  }, { viewport: { width: 688, height: 1017 } }));

  test('what was cut: table and sketch in the first third', () => shown(oneRun(), async (page) => {
    const [table] = await tables(page, 'What was cut');
    const cells = Object.fromEntries(table);
    assert.equal(cells.Cutter, 'flat end mill of 20 mm, edges 20 mm long');
    assert.equal(cells.Helix, '30°');
    assert.equal(cells.Engagement, 'down milling, radial depth 5 mm (25 % of the diameter); teeth cut from 120° to 180°'); // acos(1 − 2·5/20) = 60° before 180°
    assert.equal(cells['Cutting coefficients'], 'linear: Kt 600 N/mm², Kr 200 N/mm², Kte 17.9 N/mm');
    assert.equal(cells['Their origin'], '7075, P');
    assert.equal(cells.Material, 'E 70 GPa, ν 0.33, density 2810 kg/m³');
    assert.equal(cells.Fixture, 'held at y_min');
    assert.match(await page.getAttribute('.sketch svg', 'aria-label'), /120° to 180°/);
    const { top, height } = await page.evaluate(() => ({ top: document.getElementById('cut').offsetTop, height: document.body.scrollHeight }));
    assert.ok(top < height / 3, `${top} of ${height}`);
  }));

  test('the sector of the sketch ends where the wall of the part is', async () => {
    const box = (page, name) => page.evaluate((of) => { const b = document.querySelector(`.sketch .${of}`).getBBox(); return { left: b.x, right: b.x + b.width, top: b.y, bottom: b.y + b.height }; }, name);
    for (const mode of ['down', 'up']) {
      const data = oneRun();
      data.runs[0].case_values['cutting.mode'] = mode;
      await shown(data, async (page) => {
        const [sector, part, cutter] = [await box(page, 'engaged'), await box(page, 'stock'), await box(page, 'cutter')];
        assert.ok(Math.abs(sector.right - Math.sin(Math.PI / 3) * cutter.right) < 0.05 && sector.left > -0.05, JSON.stringify(sector));
        const [edge, reach] = mode === 'down' ? [part.top, sector.bottom] : [-part.bottom, -sector.top];
        assert.ok(Math.abs(edge - cutter.bottom / 2) < 0.05, 'a quarter of the diameter stands ahead');
        assert.ok(Math.abs(reach - cutter.bottom) < 0.05);
      });
    }
  });
});

describe('sentences and sections by what there is', () => {
  test('with everything', () => shown(oneRun(), async (page) => {
    assert.match(await lead(page, 'receptances'), /differ by at most 2e−12.*lower panel/);
    assert.match(await lead(page, 'modes'), /What the robot does/);
    assert.match(await lead(page, 'lobes'), /The cut is at P\..*broad.*Stars.*Crosses.*○.Hopf, ◇.flip, □.fold/);
    assert.match(await page.textContent('#receptances'), /Left out of this page.*Q\.y, Q\.z.*300 of 1500 lines/);
    assert.equal(await page.textContent('#quality h2'), 'Reduction, mesh and coupling');
  }));

  test('a part alone speaks of no robot and of no second way', () => shown(partAlone(), async (page) => {
    const text = await page.locator('main section:not(#provenance)').allTextContents();
    assert.doesNotMatch(text.join(' '), /robot|two ways|Left out of this page|Operating point|Fitted/i);
    assert.doesNotMatch(await page.textContent('#modes'), /changed its place/);
    assert.equal(await page.textContent('#quality h2'), 'Reduction and mesh');
  }));

  test('a tool alone has no empty section', () => shown(toolOnly(), async (page) => {
    assert.deepEqual(await page.locator('main section').evaluateAll((list) => list.map((s) => s.id)), ['lobes', 'provenance']);
  }));

  test('a measured tool shows its receptances with their coherence', () => shown(toolMeasured(), async (page) => {
    assert.match(await lead(page, 'receptances'), /better damped tool\. Where the coherence \(lower panel\)/);
    const list = await traces(page, 'receptance');
    const coherence = list.find((t) => t.meta === '0 tool coherence');
    assert.ok(list.some((t) => t.meta === '0 tool') && coherence);
    coherence.y.forEach((y, k) => assert.ok(Math.abs(y - (1 - 0.004 * k)) < 1e-6));
    await page.locator('#receptances select').first().selectOption('y');
    await page.locator('#receptances select').nth(1).selectOption('y');
    assert.ok(!(await traces(page, 'receptance')).some((t) => t.meta === '0 tool coherence'), 'y/y has none');
  }));

  test('a measured part and a measured robot show their coherence, each in its own colour', async () => {
    const data = measured();
    const [{ frf: [part, robot] }] = data.runs;
    const n = part.hz.shape[0];
    part.coherence = pack('f32', [2, 2, n], Array.from({ length: 4 * n }, (_, i) => (i < n ? 1 - i / n : NaN)));
    robot.coherence = pack('f32', [1, 1, n], Array(n).fill(0.9));
    await shown(data, async (page) => {
      assert.match(await lead(page, 'receptances'), /Where the coherence \(lower panel\) falls below 1/);
      const list = await traces(page, 'receptance');
      const of = (name) => list.find((t) => t.meta === `0 ${name} coherence`);
      of('part').y.forEach((y, k) => assert.ok(Math.abs(y - (1 - k / n)) < 1e-6));
      assert.ok(of('robot').y.every((y) => Math.abs(y - 0.9) < 1e-6));
      for (const name of ['part', 'robot']) assert.equal(of(name).line.color, list.find((t) => t.meta === `0 ${name}`).line.color);
      assert.ok(!list.some((t) => t.meta === '0 coupled_receptance coherence'));
    });
  });

  test('a measured tool shows what its fitted poles make of it, and how well they agree', async () => {
    const data = toolMeasured();
    const { tool_frf: tip } = data.runs[0];
    const H = Array.from({ length: 400 }, (_, i) => (i < 100 ? (i % 2 ? -2e-6 : 1e-6) : NaN));
    Object.assign(tip, { synthesised: pack('f32', [2, 2, 50, 2], H), agreement: pack('f64', [2, 2, 2], [0.99871, 0.0456, NaN, NaN, NaN, NaN, NaN, NaN]) });
    await shown(data, async (page) => {
      const of = async () => (await traces(page, 'receptance')).find((t) => t.meta === '0 tool synthesised');
      const fitted = await of();
      assert.equal(fitted.name, 'tool, fitted: FRAC 0.9987, 4.6 % off');
      assert.ok(fitted.y.every((y) => Math.abs(y - Math.hypot(1, 2)) < 1e-5));
      await page.locator('#receptances select').nth(2).selectOption('imaginary');
      assert.ok((await of()).y.every((y) => Math.abs(y + 2) < 1e-5));
      await page.locator('#receptances select').first().selectOption('y');
      assert.equal(await of(), undefined, 'y/x was not measured');
    });
  });

  test('measured receptances: the main modes, and no empty section', () => shown(measured(), async (page) => {
    assert.deepEqual(await page.locator('main section').evaluateAll((list) => list.map((s) => s.id)), ['remarks', 'receptances', 'modes', 'provenance']);
    assert.deepEqual((await tables(page, 'Part with robot: main modes of the receptance'))[0][1], ['1', '36.328', '1.64']);
    assert.doesNotMatch(await lead(page, 'receptances'), /lower panel/);
  }));
});

describe('the charts', () => {
  test('chatter frequencies: logarithmic where they spread, marks few and large, the line through all', () => shown(oneRun(), async (page) => {
    const { type, trace } = await page.evaluate(() => { const { data, layout } = document.getElementById('plot-lobes'); const t = data.find((d) => d.meta === 'chatter 0 supported'); return { type: layout.yaxis2.type, trace: { y: Array.from(t.y), size: t.marker.size, symbol: t.marker.symbol, mode: t.mode } }; });
    assert.equal(type, 'log');
    assert.equal(trace.mode, 'lines+markers');
    const marked = trace.size.filter((s) => s > 0);
    assert.ok(marked.length <= 60 && marked.length >= 20 && Math.min(...marked) >= 7, `${marked.length} of ${marked[0]} px`);
    assert.ok(new Set(trace.symbol.filter((_, k) => trace.size[k])).size >= 2);
    assert.ok(trace.y.filter((y) => y !== null).length > marked.length);
  }));

  test('only pockets have stars', () => shown(oneRun(), async (page) => {
    const best = (await traces(page, 'lobes')).find((t) => t.meta === 'pockets 0 supported');
    assert.deepEqual(best.x, [2400, 1200]);
  }));

  test('robust limits and other methods are drawn where they are, and said', async () => {
    await shown(oneRun(), async (page) => assert.doesNotMatch(await lead(page, 'lobes'), /robust|other methods/));
    await shown(robust(), async (page) => {
      assert.match(await lead(page, 'lobes'), /Dotted: the robust limit, which holds for 2 standard deviations .* Thin lines: the limits of other methods, where they converged\./);
      const list = await traces(page, 'lobes');
      const [limit, dotted, other] = ['limit', 'robust', 'zeroth order'].map((kind) => list.find((t) => t.meta === `${kind} 0 supported`));
      assert.equal(dotted.line.dash, 'dot');
      dotted.y.forEach((y, k) => (limit.y[k] === null ? assert.equal(y, null) : assert.ok(Math.abs(y - 0.8 * limit.y[k]) < 1e-5 * y)));
      assert.deepEqual(other.x, [1000, 2000, 3000]);
      assert.deepEqual(other.y.map((y) => y && Number(y.toPrecision(5))), [2, null, 3]);
    });
  });

  test('the range by what was identified is shaded, and said', async () => {
    await shown(oneRun(), async (page) => assert.doesNotMatch(await lead(page, 'lobes'), /Shaded/));
    await shown(identified(), async (page) => {
      assert.match(await lead(page, 'lobes'), /Shaded: 95 % of the limits lie there/);
      const list = await traces(page, 'lobes');
      const [limit, range] = ['limit', 'identified'].map((kind) => list.find((t) => t.meta === `${kind} 0 supported`));
      assert.equal(range.fill, 'toself');
      assert.equal(range.x[0], limit.x[1]); // the first is not known
      assert.ok(Math.abs(range.y[0] - 0.9 * limit.y[1]) < 1e-5 * range.y[0]);
    });
  });

  test('few positions of a path are lines, many a map over the path and not beyond', async () => {
    const look = (page) => page.evaluate(() => { const { data, layout } = document.getElementById('plot-path'); return { kinds: data.map((t) => t.meta), range: layout.yaxis.range, colours: data.filter((t) => t.meta?.startsWith('position')).map((t) => t.line.color) }; });
    await shown(oneRun(), async (page) => {
      const { kinds, colours: drawnIn } = await look(page);
      assert.ok(!kinds.includes('map') && kinds.filter((k) => k?.startsWith('position')).length === 5);
      assert.equal(new Set(drawnIn).size, 5);
    });
    const data = oneRun();
    for (const path of data.runs[0].paths) Object.assign(path, { positions: pack('f64', [9, 3], Array.from({ length: 27 }, (_, i) => (i % 3 === 1 ? 0.01 * Math.floor(i / 3) : 0))), depth_m: pack('f32', [9, 20], Array.from({ length: 180 }, (_, i) => 1e-3 * (1 + (i % 7)))) });
    await shown(data, async (page) => {
      const { kinds, range } = await look(page);
      assert.ok(kinds.includes('map') && !kinds.some((k) => k?.startsWith('position')));
      assert.ok(Math.abs(range[0]) < 1e-9 && Math.abs(range[1] - 80) < 1e-6, range.join());
    });
  });

  test('a waterfall stacks the depth of each position above its place, the nearest in front', async () => {
    await shown(oneRun(), async (page) => {
      await page.locator('#path select').nth(1).selectOption('waterfall');
      const lines = await page.evaluate(() => document.getElementById('plot-path').data.filter((t) => t.meta?.startsWith('stacked') || t.meta?.startsWith('base')).map((t) => ({ meta: t.meta, y: Array.from(t.y), depth: t.customdata && Array.from(t.customdata) })));
      assert.deepEqual(lines.map((l) => l.meta), [4, 3, 2, 1, 0].flatMap((i) => [`base ${i}`, `stacked ${i}`]));
      const all = lines.flatMap((l) => l.depth ?? []);
      const [low, high] = [Math.min(...all), Math.max(...all)];
      for (const { meta, y, depth } of lines) {
        const place = 50 * Number(meta.split(' ')[1]); // mm
        if (!depth) assert.ok(y.every((v) => Math.abs(v - place) < 1e-6), meta);
        else for (const [j, d] of depth.entries()) assert.ok(Math.abs(y[j] - place - (125 * Math.log(d / low)) / Math.log(high / low)) < 1e-6, meta); // 2.5 spacings high
      }
    });
  });

  test('mode indicator: the singular values of the whole matrix', async () => {
    const close = (a, b) => assert.ok(Math.abs(a - b) < 1e-9 * Math.abs(b) + 1e-15, `${a} is not ${b}`);
    // U diag(5, 2) Vᴴ with rotations and phases has the singular values 5 and 2; a matrix of rank one has one.
    const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
    const turned = [[[5 * c * 0.6 + 2 * s * 0.8, 0], [0, 5 * c * 0.8 - 2 * s * 0.6]], [[0, 5 * s * 0.6 - 2 * c * 0.8], [-(5 * s * 0.8 + 2 * c * 0.6), 0]]];
    const [first, second] = singularValues(turned);
    close(first, 5);
    close(second, 2);
    const [one, none] = singularValues([[[1, 1], [2, 2]], [[2, 2], [4, 4]]]);
    close(one, 5 * Math.SQRT2);
    assert.ok(none < 1e-12);
    const turning = { hz: pack('f64', [1], [10]), responses: ['R.x', 'R.rz'], forces: ['R.x', 'R.rz'], H: pack('f32', [2, 2, 1, 2], [3, 4, 0, 0, 0, 0, 1e6, 0]) };
    assert.deepEqual(cmif(turning).values.map((v) => v[0]), [5], 'rad and m are not mixed');
    await shown(oneRun(), async (page) => {
      await page.locator('#receptances label.control', { hasText: 'Show' }).locator('select').selectOption('cmif');
      const list = await traces(page, 'receptance');
      const [largest, next] = [0, 1].map((k) => list.find((t) => t.meta === `0 part cmif ${k}`));
      assert.ok(largest.y.every((y, i) => y >= next.y[i]));
      assert.ok(list.some((t) => t.meta === '0 robot cmif 0') && !list.some((t) => t.meta === '0 robot cmif 1'), 'one degree of freedom has one singular value');
    });
  });

  test('receptances open on the point of the cut, along its softest direction', async () => {
    const data = oneRun();
    const [r] = data.runs;
    delete r.summary.coupling.reductions;
    r.cutting.at = 'Q';
    await shown(data, async (page) => assert.equal(await page.locator('#receptances select').first().inputValue(), 'Q.x'));
  });

  test('two runs are told apart in every trace', () => shown(twoRuns(), async (page) => {
    const look = (id) => page.evaluate((name) => document.getElementById(name).data.map((t) => ({ meta: t.meta, name: t.name, dash: t.line?.dash, symbol: t.marker?.symbol, size: t.marker?.size })), id);
    const lobes = await look('plot-lobes');
    const frf = await look('plot-receptance');
    const pair = (list, kind) => [0, 1].map((i) => list.find((t) => t.meta === kind(i)));
    for (const kind of [(i) => `${i} coupled_spatial`, (i) => `${i} coupled_receptance`, (i) => `${i} part`, (i) => `${i} difference`]) {
      const [a, b] = pair(frf, kind);
      assert.notEqual(a.dash, b.dash, kind(0));
      assert.notEqual(a.name, b.name);
    }
    const [a, b] = pair(lobes, (i) => `chatter ${i} supported`);
    const marks = (t) => new Set(t.symbol.filter((_, k) => t.size[k] > 0));
    assert.ok(marks(a).size && [...marks(a)].every((symbol) => !marks(b).has(symbol)), 'no mark of one run is one of the other');
    assert.notDeepEqual(...pair(lobes, (i) => `pockets ${i} supported`).map((t) => t.symbol));
    const least = await look('plot-path');
    for (const name of ['part', 'supported']) assert.notEqual(...pair(least, (i) => `least ${i} ${name}`).map((t) => t.dash));
  }));

  test('operating points: circle and cross on the chart, margins in the table', () => shown(oneRun(), async (page) => {
    const list = await page.evaluate(() => document.getElementById('plot-lobes').data.filter((t) => t.meta?.startsWith('points')).map((t) => ({ meta: t.meta, x: Array.from(t.x), y: Array.from(t.y), symbol: t.marker.symbol, color: t.marker.color })));
    assert.deepEqual(list.map((t) => [t.meta, t.x[0], t.y[0], t.symbol]), [['points 0 part chatter', 1500, 1, 'x'], ['points 0 supported stable', 1500, 1, 'circle-open']]);
    assert.notEqual(list[0].color, list[1].color);
    const [table] = await tables(page, 'Operating points');
    assert.deepEqual(table[1].slice(0, 6), ['1500', '1', 'part alone', '✗ chatter', '−0.8 mm (−80 %)', '1410 to 1620']);
    assert.deepEqual(table[2].slice(2, 6), ['with robot', '✓ stable', '1 mm (100 %)', 'lowest to highest']);
  }));

  test('surface, force and contact over the speed: folded, gaps and shading where the cut chatters', async () => {
    const data = forced();
    const { rpm, surface, force, contact } = data.expected;
    delete data.expected;
    await shown(data, async (page) => {
      const list = await traces(page, 'forced');
      const of = (meta) => list.find((t) => t.meta === meta);
      assert.deepEqual(of('surface_location_error_m').x, rpm);
      const near = (meta, values, factor) => of(meta).y.forEach((y, k) => assert.ok(values[k] === null ? y === null : Math.abs(y - values[k] * factor) <= 1e-5 * Math.abs(values[k] * factor), `${meta} ${k}: ${y}`));
      near('surface_location_error_m', surface, 1e6);
      near('peak_force_n', force, 1);
      near('least_contact_force_n', contact, 1);
      const { shapes, annotations } = await page.evaluate(() => { const { layout } = document.getElementById('plot-forced'); return { shapes: layout.shapes.map((s) => [s.type, s.x0, s.x1, s.y0]), annotations: layout.annotations.map((a) => [a.text, a.y]) }; });
      assert.deepEqual(shapes, [['rect', 1250, 1750, 0], ['rect', 1950, 2000, 0], ['line', 0, 1, 0], ['line', 0, 1, 60]]);
      assert.deepEqual(annotations, [['preload', 60]]);
      await page.locator('#forced select').selectOption('1');
      const alone = await traces(page, 'forced');
      assert.ok(!alone.some((t) => t.meta === 'least_contact_force_n'), 'the part alone has no contact');
    });
    await shown(data, async (page) => {
      assert.equal(await page.locator('#plot-forced').isVisible(), false);
      await page.click('#forced summary');
      await page.waitForFunction(() => document.getElementById('plot-forced').data);
    }, { unfold: false });
    await shown(oneRun(), async (plainPage) => assert.equal(await plainPage.locator('#forced').count(), 0));
  });

  test('forces over a turn: the period repeated, polar from the top and clockwise, or components', () => shown(turning(), async (page) => {
    const [resultant] = await traces(page, 'turn');
    const expected = [[0, 5], [5, 0], [0, 0], [0, 0], [0, -5], [-5, 0], [0, 0], [0, 0]]; // 5 N at 0°, 90°, 180°, 270°
    assert.equal(resultant.x.length, expected.length);
    expected.forEach(([x, y], k) => assert.ok(Math.hypot(resultant.x[k] - x, resultant.y[k] - y) < 1e-5, `${k}: ${resultant.x[k]}, ${resultant.y[k]}`));
    const { height, width } = await page.evaluate(() => { const { xaxis, yaxis } = document.getElementById('plot-turn')._fullLayout; return { width: xaxis._length / (xaxis.range[1] - xaxis.range[0]), height: yaxis._length / (yaxis.range[1] - yaxis.range[0]) }; });
    assert.ok(Math.abs(height / width - 1) < 1e-6, 'circles are round');
    await page.locator('#forced label.control', { hasText: 'Show' }).locator('select').selectOption('angle');
    const list = await traces(page, 'turn');
    assert.deepEqual(list.map((t) => t.meta), ['feed', 'normal', 'axis']);
    assert.deepEqual(list[0].x.map(Math.round), [0, 90, 90, 180, 180, 270, 270, 360]);
    assert.deepEqual(list[1].y.map(Math.round).map((v) => v + 0), [-4, -4, 0, 0, -4, -4, 0, 0]);
  }));

  test('tooth-passing speeds are the document\'s, and not offered without them', async () => {
    await shown(toolOnly(), async (page) => {
      await page.getByLabel('tooth-passing speeds').check();
      const texts = await page.evaluate(() => document.getElementById('plot-lobes').layout.annotations.map((a) => a.text));
      assert.ok(texts.includes('100 Hz') && texts.includes('180 Hz'), texts.join());
    });
    const data = oneRun();
    data.runs[0].lobes.forEach((lobe) => { delete lobe.tooth_passing_hz; });
    await shown(data, async (page) => assert.equal(await page.getByLabel('tooth-passing speeds').count(), 0));
  });

  test('labels of the axes lie apart on a phone and in print', async () => {
    const apart = (page) => page.evaluate(() => ['#plot-receptance .y2tick text', '#plot-receptance .ytick text', '#plot-lobes .y2tick text', '#plot-lobes .ytick text'].filter((name) => {
      const boxes = [...document.querySelectorAll(name)].map((t) => t.getBoundingClientRect()).sort((a, b) => a.top - b.top);
      return boxes.length < 2 || boxes.some((box, i) => i && box.top < boxes[i - 1].bottom - 4); // a box is higher than its digits
    }));
    for (const decades of [1.5, 3, 8]) {
      const data = oneRun();
      data.runs[0].route_difference = pack('f32', [300], Array.from({ length: 300 }, (_, i) => 10 ** (-11.3 - decades * Math.abs(Math.sin(i)))));
      await shown(data, async (page) => {
        assert.deepEqual(await apart(page), [], `${decades} decades on a phone`);
        await page.emulateMedia({ media: 'print' });
        await page.waitForFunction(() => [...document.querySelectorAll('.plot')].every((p) => p.layout?.width === (p.closest('.columns') ? 316 : 660)));
        assert.deepEqual(await apart(page), [], `${decades} decades in print`);
      }, { viewport: { width: 360, height: 740 } });
    }
  });
});

describe('the tables', () => {
  test('fits, robot\'s modes, units of checks', () => shown(oneRun(), async (page) => {
    assert.deepEqual((await tables(page, 'Fitted parameters (SI units)'))[0][1], ['length of P', 'part.length', '0.3921', '0.4', '0.38 to 0.41']);
    assert.deepEqual((await tables(page, 'What they were fitted to'))[0][1], ['length of P', 'part frequency', '212.9 Hz', '212 Hz']);
    assert.deepEqual((await tables(page, 'Robot alone'))[0][1], ['1', '29.500', '2.10']);
    const checks = Object.fromEntries((await tables(page, 'Checks'))[0].map((r) => [r[0], r.slice(1, 3)]));
    assert.deepEqual(checks.fit, ['212.9 Hz', '212 ± 2 Hz']);
    assert.deepEqual(checks['own unit'], ['3 kN', '3 kN']);
    assert.deepEqual(checks['least depth'], ['2.1 mm', 'at least 2 mm']);
  }));
});
