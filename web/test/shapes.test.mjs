// The moving shapes: what of part and robot is seen, and by which numbers it is coloured.

import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { comac, likeness } from '../src/comac.js';
import { extent, shapeOf, surface } from '../src/shapes.js';
import { colours, slide } from './browser.mjs';
import { shownIn } from './shown.mjs';
import { noArm, oneRun, pack } from './synthetic.mjs';

const shown = shownIn({ webgl: true });
const pick = (page, label, value) => page.locator('#shapes label.control', { has: page.locator('span', { hasText: new RegExp(`^${label}$`) }) }).locator('select').selectOption(value);

describe('the moving shapes', () => {
  const robot = (page) => colours(page, ([r, g, b]) => r < 10 && g > 70 && Math.abs(g / (b || 1) - 158 / 115) < 0.12);
  const orange = (page) => colours(page, ([r, g, b]) => r > 100 && b < 12 && Math.abs(g / r - 94 / 213) < 0.06);

  test('the list says of what a mode is', () => shown(oneRun(), async (page) => {
    const options = await page.locator('#shapes select').first().locator('option').allTextContents();
    assert.ok(options.includes('part 1: 200.1 Hz') && options.includes('part with robot 1: 250.1 Hz'), options.join());
  }));

  test('the arm is wholly in the picture, and out of it for the part alone', () => shown(oneRun(), async (page) => {
    const first = await robot(page);
    await pick(page, 'View', 'all');
    const seen = await robot(page);
    assert.ok(seen.count > 300 && !seen.atBorder, JSON.stringify(seen));
    const whole = seen.height;
    await pick(page, 'View', 'part');
    const near = await robot(page);
    assert.ok(near.height > 1.2 * whole || near.atBorder);
    assert.deepEqual(near, first, 'the view begins on the part');
    await pick(page, 'Mode', { label: 'part 1: 200.1 Hz' });
    assert.equal((await robot(page)).count, 0);
  }));

  test('the robot\'s motion limits the amplitude', async () => {
    const data = oneRun();
    for (const m of data.runs[0].shapes.modes) if (m.robot) m.robot = [0, 40, 0];
    await shown(data, async (page) => {
      await pick(page, 'View', 'all');
      await slide(page, 'Amplitude', 1);
      await slide(page, 'Phase', 0);
      const seen = await robot(page);
      assert.ok(seen.count > 300 && !seen.atBorder, JSON.stringify(seen));
      assert.match(await page.textContent('#shapes figcaption'), /40 times as far as the part/);
    });
  });

  test('a robot without an arm is seen where it pushes, of coupled modes only', () => shown(noArm(), async (page) => {
    assert.ok((await robot(page)).count > 150);
    assert.match(await page.textContent('#shapes .legend'), /robot/);
    await pick(page, 'Mode', { label: 'part 1: 200.1 Hz' });
    assert.equal((await robot(page)).count, 0);
    assert.doesNotMatch(await page.textContent('#shapes .legend'), /robot/);
  }));

  test('it pushes from outside along what is joined, and is in the view', () => {
    const { pushes: [point], direction } = surface(noArm().runs[0].shapes);
    assert.deepEqual(point.push.map((x) => Math.round(x) + 0), point.normal.map((x) => -Math.round(x) + 0));
    const facing = point.normal.reduce((sum, x, k) => sum + x * direction[k], 0);
    assert.ok(facing > 0, 'the contact is on the side that is seen first');
    assert.ok(direction[2] > 0);
  });

  test('arrows only where a contact joins', async () => {
    const legend = (page) => page.textContent('#shapes .legend');
    const select = (page) => pick(page, 'Mode', { label: 'part 1: 200.1 Hz' });
    let joined;
    await shown(oneRun(), async (page) => { await select(page); joined = (await orange(page)).count; assert.match(await legend(page), /arrows: directions joined/); });
    const data = oneRun();
    data.runs[0].shapes.points.forEach((p) => { delete p.joined; });
    await shown(data, async (page) => { await select(page); assert.ok((await orange(page)).count < 0.8 * joined); assert.doesNotMatch(await legend(page), /arrows/); });
  });

  test('likeness of the shapes at each place: 1 where they move alike, 0 across, whatever their size and sign', async () => {
    const one = { vectors: Float32Array.of(1, 0, 0, 0, 2, 0), scale: 1 };
    const other = { vectors: Float32Array.of(-3, 0, 0, 0, 0, 1), scale: 0.5 };
    assert.deepEqual(Array.from(likeness([[one, other]])), [1, 0]);
    const second = [{ vectors: Float32Array.of(0, 1, 0, 0, 1, 0), scale: 1 }, { vectors: Float32Array.of(0, 0, 1, 0, 1, 0), scale: 1 }];
    const [mixed] = likeness([[one, other], second]); // (1·1.5)² / ((1 + 1)(1.5² + 1))
    assert.ok(Math.abs(mixed - 2.25 / 6.5) < 1e-6);
    const { values } = { values: comac(oneRun().runs[0]) };
    assert.ok(values.length === oneRun().runs[0].shapes.vertices.shape[0] && values.every((x) => x >= 0 && x < 1.00001));
    await shown(oneRun(), async (page) => { await pick(page, 'Colour', 'comac'); assert.match(await page.textContent('#shapes .legend'), /COMAC.*0.*1/); });
  });

  test('what is to be seen holds part and robot', () => {
    const { shapes } = oneRun().runs[0];
    const { centre, points } = extent(surface(shapes), true);
    const inside = (p) => points.some((q) => q.every((x, k) => Math.abs(x + centre[k] - p[k]) < 1e-9));
    assert.ok(shapes.robot_arm.every(inside));
    assert.ok(!shapes.robot_arm.some((p) => extent(surface(shapes), false).points.some((q) => q.every((x, k) => Math.abs(x - p[k]) < 1e-9))));
    assert.equal(shapeOf({ shape: shapes.modes[0].shape, step: 1, robot: [0, 3, 4] }).reach, 5);
  });

  test('thickness: the least is kept and in the range, faces across the wall are not', () => {
    const { shapes } = oneRun().runs[0];
    const n = shapes.triangles.shape[0];
    const values = Array.from({ length: n }, (_, t) => (t === 1000 ? 0.0012 : t % 20 === 0 ? 0.02 : 0.006));
    const { thickness } = surface({ ...shapes, thickness_m: pack('f32', [n], values) });
    assert.ok(Math.abs(thickness.low - 0.0012) < 1e-8 && Math.abs(thickness.high - 0.006) < 1e-8 && Math.abs(thickness.median - 0.006) < 1e-8, JSON.stringify({ ...thickness, values: 0 }));
    assert.ok(Math.abs(thickness.values[1000] - 0.0012) < 1e-8);
  });

  test('a wall of one thickness with narrow sides reads as that, and the thinnest place has its own colour', async () => {
    const data = oneRun();
    const n = data.runs[0].shapes.triangles.shape[0];
    const thin = (some) => pack('f32', [n], Array.from({ length: n }, (_, t) => (some && t === 1001 ? 0.001 : t % 20 === 0 ? 0.0187 : 0.006)));
    const viewed = async (page) => { await pick(page, 'Colour', 'thickness'); await slide(page, 'Amplitude', 0); };
    data.runs[0].shapes.thickness_m = thin(false);
    await shown(data, async (page) => { await viewed(page); assert.match(await page.textContent('#shapes .legend'), /6 mm\s+7\.2 mm and more/); });
    data.runs[0].shapes.thickness_m = thin(true);
    await shown(data, async (page) => {
      await pick(page, 'Mode', { label: 'part 1: 200.1 Hz' });
      await viewed(page);
      assert.match(await page.textContent('#shapes .legend'), /1 mm\s+6 mm and more/);
      assert.match(await page.textContent('#shapes figcaption'), /Thinnest 1 mm; half of the surface at most 6 mm/);
      assert.ok((await colours(page, ([r, g, b]) => b > r && g < 20 && r > 25)).count > 3, 'the thinnest triangle is as dark as the scale is');
    });
  });
});
