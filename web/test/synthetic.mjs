// Small invented documents. `oneRun` uses every part of the contract: a plate with sine shapes; the others lack what runs of other kinds lack.

import { deflateSync } from 'node:zlib';

const types = { f32: Float32Array, f64: Float64Array, i16: Int16Array, u32: Uint32Array };

export function pack(type, shape, values, shuffled = false) {
  const array = types[type].from(values);
  let bytes = Buffer.from(array.buffer);
  if (shuffled) {
    const width = array.BYTES_PER_ELEMENT;
    bytes = Buffer.from(Array.from({ length: bytes.length }, (_, i) => bytes[(i % array.length) * width + Math.floor(i / array.length)]));
  }
  return { type, shape, deflate: deflateSync(bytes).toString('base64'), ...(shuffled ? { shuffled } : {}) };
}

const range = (n) => Array.from({ length: n }, (_, i) => i);

/** Depths over the speed with one pocket at `best` rpm, in m. */
function lobe(name, floor, best) {
  const n = 120;
  const rpm = range(n).map((i) => 1000 + (2000 * i) / (n - 1));
  const raw = rpm.map((x) => floor * (1 + 60 * Math.exp(-(((x - best) / 90) ** 2))));
  const depth = raw.map((d) => Math.min(d, 0.02));
  const status = raw.map((d, i) => (i === 5 ? 'not_converged' : d >= 0.02 ? 'stable_to_depth_limit' : 'converged'));
  const kind = rpm.map((_, i) => ['hopf', 'flip', 'fold', ''][i % 4]);
  const least = depth.reduce((best_, d, i) => (status[i] === 'converged' && d < depth[best_] ? i : best_), 0);
  return {
    depth,
    document: { name, rpm: pack('f64', [n], rpm), depth_m: pack('f64', [n], depth), error_relative: pack('f32', [n], rpm.map(() => 0.02)), chatter_hz: pack('f32', [n], rpm.map((x, i) => (i > 60 && i < 66 ? 20 * x : x / 5))), kind, status,
      truncation_m: pack('f32', [n], depth.map((d) => d * 0.03)), tooth_passing_hz: [100, 180],
      crossings: { rpm: pack('f64', [n], rpm), depth_m: pack('f64', [n], depth), chatter_hz: pack('f32', [n], rpm.map((x) => x / 5)), kind } },
    summary: { name, speeds: n, speeds_stable_to_depth_limit: status.filter((s) => s === 'stable_to_depth_limit').length, minimum_depth_m: depth[least], at_spindle_speed_rpm: rpm[least], error_estimate_relative: 0.02,
      best_pockets: [{ depth_m: 0.02, at_depth_limit: true, limited_by: 'tool_length', spindle_speed_rpm: best, removal_rate_cm3_per_min: 8 }, { depth_m: floor * 2, spindle_speed_rpm: 1200, removal_rate_cm3_per_min: null }, { depth_m: floor * 1.1, spindle_speed_rpm: 1300, removal_rate_cm3_per_min: null }],
      at_case_speed: { spindle_speed_rpm: 1900, limiting_depth_m: 0.01, at_depth_limit: false } },
  };
}

/** One resonance a name; 1/(k (1 - r² + 2 i ζ r)) in m/N. The entry below the diagonal is left out (NaN). */
function frf(name, responses, hz, f0, k) {
  const n = responses.length;
  const H = range(n * n).flatMap((e) => hz.flatMap((f) => {
    if (Math.floor(e / n) > e % n) return [NaN, NaN];
    const r = f / f0;
    const [a, b] = [1 - r * r, 0.04 * r];
    const scale = 1 / (k * (1 + (e % n)) * (a * a + b * b));
    return [a * scale, -b * scale];
  }));
  return { name, hz: pack('f64', [hz.length], hz), thinned: { from: 5 * hz.length, to: hz.length }, responses, forces: responses, H: pack('f32', [n, n, hz.length, 2], H, true), deviation: pack('f32', [n, n, hz.length], H.filter((_, i) => i % 2).map((v) => Math.abs(v) * 0.05)) };
}

/** A plate of 200 x 100 mm in y and z, meshed as a grid, with its end y = 0 held. */
function shapes(name) {
  const [ny, nz] = [60, 30];
  const vertices = range(ny * nz).flatMap((v) => [0, (v % ny) / (ny - 1), Math.floor(v / ny) / (nz - 1) / 2]);
  const triangles = range((ny - 1) * (nz - 1)).flatMap((c) => { const v = (c % (ny - 1)) + Math.floor(c / (ny - 1)) * ny; return [v, v + 1, v + ny, v + 1, v + ny + 1, v + ny]; });
  const mode = (of, number) => ({ of, number, hz: 200.1 * number + (of === 'part' ? 0 : 50), damping: 0.01, step: 1 / 30000,
    shape: pack('i16', [ny * nz, 3], vertices.map((_, i) => (i % 3 ? 0 : Math.round(30000 * Math.sin((number * Math.PI * vertices[i + 1]) / 2) * (number > 2 ? vertices[i + 2] * 2 : 1))))),
    ...(of === 'coupled' ? { robot: [1, 0, 0] } : {}) });
  return {
    vertices: pack('i16', [ny * nz, 3], vertices.map((x) => Math.round(x * 30000))), origin_m: [0, 0, 0], step_m: 0.2 / 30000, triangles: pack('u32', [triangles.length / 3, 3], triangles),
    thinned: { from: 240000, to: ny * nz }, modes: [1, 2, 3].flatMap((k) => [mode('part', k), mode('coupled', k)]),
    points: [{ name, position_m: [0, 0.2, 0.05], directions: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], joined: [[1, 0, 0]], contact: true }, { name: 'Q', position_m: [0, 0.1, 0.1], directions: [[1, 0, 0], [0, 1, 0]], contact: false }],
    fixtures: [{ name: `${name} end`, triangles: pack('u32', [nz - 1], range(nz - 1).map((j) => 2 * j * (ny - 1))) }],
    robot_arm: [[0.5, 0.2, -0.2], [0.5, 0.2, 0.2], [0.2, 0.2, 0.3], [0, 0.2, 0.05]], thickness_m: pack('f32', [triangles.length / 3], range(triangles.length / 3).map((t) => 0.002 + 1e-6 * t)),
  };
}

function run(label, point, factor) {
  const hz = range(300).map((i) => 1 + 2 * i);
  const [alone, supported] = [lobe('part', 0.0002 * factor, 1800), lobe('supported', 0.002 * factor, 2400)];
  const responses = [`${point}.x`, 'Q.x'];
  const modes = (f) => [1, 2, 3].map((k) => ({ frequency_hz: f * k, damping_ratio: 0.01 * k }));
  const path = (name, floor) => ({ name, positions: pack('f64', [5, 3], range(5).flatMap((i) => [0, 0.05 * i, 0.1])), rpm: pack('f64', [20], range(20).map((i) => 1000 + 100 * i)), depth_m: pack('f32', [5, 20], range(100).map((i) => floor * (1 + (i % 7)))) });
  return {
    label, sentences: range(7).map((i) => `Sentence ${i} of ${label}.`), frf_left_out: ['Q.y', 'Q.z'],
    summary: { case: label, title: `A plate, ${label}`, status: 'ok', mesh: { nodes: 1800, elements: 900, order: 2, dofs: 5400, min_quality: 0.4 }, part: { mass_kg: 0.3, modes: modes(200.1 * factor) },
      reduction: { method: 'craig_bampton', full_dofs: 5400, size: 30, interface_dofs: 6, kept_modes: 24, max_relative_frequency_error: 1e-4, max_relative_receptance_error: 2e-3 },
      coupling: { modes: modes(250.1 * factor), main_modes: [{ frequency_hz: 250.1 }], reductions: [{ dof: `${point}.x`, frequency_hz: 200 }], route_difference: { max_relative: 1e-12, at_frequency_hz: 300 }, kernel_condition_max: 20 },
      contacts: [{ part: point, robot: 'R' }], robot: { modes: [{ frequency_hz: 29.5, damping_ratio: 0.021 }] }, operating_points: points(factor), updating: fits(point), lobes: [alone.summary, supported.summary],
      checks: [{ name: `${point} moves`, value: 212.9, expected: 212, tolerance: 2.1, origin: `published: ${point}`, ok: true }, { name: 'fails', value: 2, expected: null, at_most: 1, origin: 'analytic', ok: false },
        { name: 'fit', quantity: 'updating[0].targets[0].reached', value: 212.9, expected: 212, tolerance: 2, origin: 'published', ok: true }, { name: 'own unit', quantity: 'x.y', unit: 'kN', value: 3, expected: 3, origin: 'analytic', ok: true }, { name: 'least depth', quantity: 'lobes[0].minimum_depth_m', value: 0.0021, at_least: 0.002, origin: 'analytic', ok: true }] },
    manifest: { program: { name: 'thinwall', version: '0.0', built_with: 'a compiler' }, inputs: [{ name: `${point}.toml`, sha256: 'ab'.repeat(32) }], started_utc: '2020-01-01T00:00:00Z', threads: 2, timings_s: { mesh: 0.1, lobes: 1.5 } },
    case_values: { 'tool.teeth': '4', 'tool.diameter': '0.02 m', 'tool.length': '0.02 m', 'tool.end': 'flat', 'tool.helices': '["0.5235987755982988 rad"]', 'cutting.at': point, 'cutting.radial_depth': '0.005 m', 'cutting.mode': 'down', 'cutting.Kt': '6e+08 Pa', 'cutting.Kr': '2e+08 Pa', 'cutting.Kte': '17900 N/m', 'cutting.law': 'linear',
      'cutting.feed_per_tooth': '1e-04 m', 'part.material.youngs_modulus': '7e+10 Pa', 'part.material.poisson_ratio': '0.33', 'part.material.density': '2810 kg/m^3', 'part.supports[0].on': 'y_min' },
    case: `[cutting]\nKt = "600 N/mm^2"  # 7075, ${point}\n[points."${point}"]\n`,
    frf: [frf('part', responses, hz, 200 * factor, 1e6), frf('robot', ['R.x'], hz, 60, 1.7e6), frf('coupled_receptance', responses, hz, 250 * factor, 3e6), frf('coupled_spatial', responses, hz, 250 * factor, 3e6)],
    route_difference: pack('f32', [300], hz.map((f) => 1e-12 * (1 + Math.sin(f)))),
    lobes: [alone.document, supported.document], cutting: { teeth: 4, depth_limit_m: 0.02, spindle_speed_rpm: 1900, at: point, spindle_range_rpm: [1100, 2800], removal_cm3_per_min_per_m_rpm: 0.19 },
    paths: [path('part', 0.0001), path('supported', 0.001)], shapes: shapes(point),
    mac: { rows: 'part alone', columns: 'part with robot', values: pack('f32', [3, 3], [0.9, 0.1, 0, 0.1, 0.2, 0.7, 0, 0.8, 0.1]), row_hz: [200, 400, 600], column_hz: [250, 450, 650] },
    auto_mac: { values: pack('f32', [3, 3], [1, 0, 0, 0, 1, 0, 0, 0, 1]), row_hz: [200, 400, 600] },
    reduction_error: { modes: [5, 10, 20], error: [0.1, 0.01, 0.001] },
  };
}

/** The same speed and depth in both charts, stable in one of them. */
const points = (factor) => ['part', 'supported'].map((chart, i) => ({ chart, spindle_speed_rpm: 1500, depth_m: 0.001 * factor, stable: i === 1, depth_margin_m: (i ? 1 : -0.8) * 1e-3 * factor, depth_margin_relative: i ? 1 : -0.8,
  depth_margin_at_limit: false, boundary_below_rpm: i ? null : 1410, boundary_above_rpm: i ? null : 1620, chatter_frequency_hz: 333, bifurcation: 'hopf' }));

const fits = (point) => [{ name: `length of ${point}`, converged: true, evaluations: 3, parameters: [{ key: 'part.length', start: 0.4, fitted: 0.3921, lower: 0.38, upper: 0.41, at_bound: false }],
  targets: [{ quantity: 'part_frequency', wanted: 212, reached: 212.9 }] }];

const document = (headline, runs) => ({ schema: 1, program: 'thinwall 0.0', headline, runs });

export const oneRun = () => document(['With the robot: stable up to 2 mm.', 'Part alone: 0.2 mm.'], [run('plate', 'P', 1)]);
export const twoRuns = () => ({ ...document(['first: 2 mm.', 'first: an error.', 'second: 3 mm.'], [run('first', 'P', 1), run('second', 'P', 1.3)]), differences: [['part.length', 0.39, 0.4], ['robot.model', 'one_mode', null]] });

/** With a robust limit at 0.8 of the other, and the limits of another method. */
export function robust() {
  const data = oneRun();
  const [, chart] = data.runs[0].lobes;
  chart.robust_depth_m = pack('f32', chart.rpm.shape, lobe('supported', 0.002, 2400).depth.map((d) => 0.8 * d));
  chart.compared = [{ name: 'zeroth_order', rpm: pack('f64', [3], [1000, 2000, 3000]), depth_m: pack('f32', [3], [0.002, 0.001, 0.003]), status: ['converged', 'not_converged', 'converged'] }];
  data.runs[0].summary.lobes[1].robust = { confidence: 2, minimum_depth_m: 0.0016, at_spindle_speed_rpm: 1000 };
  return data;
}

/** With a range of the limit by what was identified, which is not known at the first speed. */
export function identified() {
  const data = oneRun();
  const [, chart] = data.runs[0].lobes;
  const depth = lobe('supported', 0.002, 2400).depth;
  const end = (share) => pack('f32', chart.rpm.shape, depth.map((d, k) => (k ? share * d : NaN)));
  Object.assign(chart, { identification_low_m: end(0.9), identification_high_m: end(1.2) });
  return data;
}

/** With the forced motion over five speeds, three of which chatter; `expected` has the supported part's numbers. */
export function forced() {
  const data = oneRun();
  const expected = { rpm: [1000, 1500, 1600, 1900, 2000], surface: [-12e-6, null, null, 30e-6, null], force: [120, null, null, 160, null], contact: [40, null, null, -5, null] };
  const [rpm, [surface, force, contact]] = [pack('f64', [5], expected.rpm), ['surface', 'force', 'contact'].map((key) => pack('f32', [5], expected[key].map((v) => v ?? NaN)))];
  const [alone, supported] = data.runs[0].lobes;
  alone.forced = [{ depth_m: 0.001, rpm, surface_location_error_m: surface, peak_force_n: force }];
  supported.forced = [{ depth_m: 0.001, rpm, surface_location_error_m: surface, peak_force_n: force, least_contact_force_n: contact }];
  data.runs[0].summary.lobes[1].forced_over_speed = [{ depth_m: 0.001, preload_n: 60 }];
  return { ...data, expected };
}

/** With forces over the half turn of one of two teeth, 3 N along the feed and −4 N along the normal in its first half, none in the other. */
export function turning() {
  const data = oneRun();
  const f32 = (values) => pack('f32', [4], values);
  data.runs[0].lobes[1].forces = [{ spindle_speed_rpm: 1500, depth_m: 0.001, rotation_rad: f32([0, Math.PI / 2, Math.PI / 2, Math.PI]), force_feed_n: f32([3, 3, 0, 0]), force_normal_n: f32([-4, -4, 0, 0]), force_axis_n: f32([0, 0, 0, 0]) }];
  return data;
}

/** With a stable point and a flip that were simulated on the supported part, and a map of 3 speeds and 2 depths. */
export function simulated() {
  const data = oneRun();
  const f32 = (values) => pack('f32', [values.length], values);
  const f64 = (values) => pack('f64', [values.length], values);
  const turn = 0.04; // s, at 1500 rpm
  const t = range(400).map((i) => 7 + (turn * i) / 100);
  const wave = (size, k) => f32(t.map((s) => size * Math.sin((2 * Math.PI * k * s) / turn)));
  const point = (depth, motion, modulus, lines) => ({ files: `supported-${motion}`, chart: 'supported', spindle_speed_rpm: 1500, depth_m: depth, feed_per_tooth_m: 1e-4, status: 'completed', motion, period: motion === 'periodic' ? 1 : 2, simulated_s: 8,
    peak_to_peak_m: [20e-6, 40e-6, 0], mean_force_n: [1, 2, 0], peak_force_n: 120, peak_torque_n_m: 1, mean_power_w: 90, share_without_contact: modulus > 1 ? 0.24 : 0, thickest_chip_m: 1e-4,
    growth: { march_modulus: modulus, march_error_estimate_relative: 1e-8, lobes_modulus: modulus, lobes_error_estimate_relative: 1e-8, difference_relative: 2e-9 },
    forced_vibration: modulus < 1 ? { peak_to_peak_m: [20e-6, 40e-6, 0], difference_relative: 3e-7, left_of_beginning: 0 } : null,
    vibration_lines: lines, walls: [{ side: '-normal', height_m: 0, location_error_m: -6e-6, R_a_m: 6e-8, R_q_m: 7e-8, R_t_m: 2e-7 }] });
  const tables = (files, size) => ({ files, trace: { time_s: f64(t), x_m: wave(size, 4), y_m: wave(2 * size, 4), force_x_n: wave(10, 4), force_y_n: wave(20, 4), torque_n_m: wave(1, 4) },
    spectrum: { frequency_hz: f32([0, 50, 100, 150]), x_m: f32([1e-8, 1e-8, size, 1e-8]), y_m: f32([1e-8, size, 2 * size, 1e-8]), force_x_n: f32([1, 1, 5, 1]), force_y_n: f32([1, 1, 9, 1]) },
    passes: { entry_s: f64([7, 7.02, 7.04, 7.06]), tooth: f32([0, 1, 0, 1]), entry_x_m: f32([1e-6, 2e-6, 1e-6, 2e-6]), entry_y_m: f32([3e-6, 4e-6, 3e-6, 4e-6]), entry_x_m_s: f32([0, 0, 0, 0]), entry_y_m_s: f32([0, 0, 0, 0]) },
    walls: [{ side: '-normal', height_m: 0, x_m: f32([0, 1e-4, 2e-4]), error_m: f32([-6e-6, -6.2e-6, -6e-6]) }] });
  const line = (frequency, amplitude, origin) => ({ frequency_hz: frequency, amplitude_m: amplitude, direction: 'normal', origin });
  data.runs[0].summary.simulation = { paths: 'circular', settling_turns: 400, recorded_turns: 200, growth_difference: { max_relative: 2e-9, chart: 'supported', spindle_speed_rpm: 1500, depth_m: 0.001 }, forced_difference: { max_relative: 3e-7, chart: 'supported', spindle_speed_rpm: 1500, depth_m: 0.001 },
    points: [point(0.001, 'periodic', 0.9, [line(100, 40e-6, 'tooth_passing')]), point(0.003, 'period_n', 1.2, [line(100, 40e-6, 'tooth_passing'), line(50, 30e-6, 'other')])] };
  data.runs[0].simulation = { points: [tables('supported-periodic', 1e-5), tables('supported-period_n', 2e-5)],
    maps: [{ name: 'supported', rpm: f64([1000, 2000, 3000]), depth_m: f64([0.001, 0.002]), peak_to_peak_m: pack('f32', [3, 2], [1e-6, 2e-6, 3e-6, 4e-6, 5e-6, NaN]) }] };
  return data;
}

/** As of `thinwall lobes`: a chart of the tool, no part, no robot, no receptances. */
export function toolOnly() {
  const { document: chart, summary } = lobe('tool', 0.002, 1800);
  return document(['This tool: stable up to 2 mm at 1900 rpm.'], [{ label: 'tool', sentences: ['This tool: stable up to 2 mm at 1900 rpm.'], summary: { case: 'tool', title: 'Measured tool', status: 'ok', lobes: [summary], contacts: [], operating_points: [], updating: [], checks: [], points: [], error_budget: {} },
    manifest: {}, case: '', frf: [], paths: [], lobes: [chart], cutting: { teeth: 4, depth_limit_m: 0.02, spindle_speed_rpm: 1900 } }]);
}

/** Measured receptances of the tool's tip, with the coherence of the first. */
export function toolMeasured() {
  const data = toolOnly();
  const hz = range(50).map((i) => 100 + 10 * i);
  const tip = frf('tool', ['x', 'y'], hz, 300, 2e6);
  tip.coherence = pack('f32', [2, 2, 50], range(200).map((i) => (i < 50 ? 1 - 0.004 * i : NaN)));
  data.runs[0].tool_frf = tip;
  return data;
}

/** A part without a robot: nothing coupled, no path. */
export function partAlone() {
  const data = oneRun();
  const [r] = data.runs;
  r.frf = [r.frf[0]];
  r.lobes = [r.lobes[0]];
  r.summary.lobes = [r.summary.lobes[0]];
  for (const key of ['coupling', 'robot', 'contacts', 'operating_points', 'updating']) delete r.summary[key];
  for (const key of ['route_difference', 'mac', 'frf_left_out', 'sentences']) delete r[key];
  delete r.frf[0].thinned;
  r.paths = [];
  r.shapes.modes = r.shapes.modes.filter((m) => m.of === 'part');
  delete r.shapes.robot_arm;
  r.shapes.points.forEach((p) => { p.contact = false; delete p.joined; });
  return data;
}

/** Measured part and robot: receptances and their coupling, no mesh, no lobes; the coupled modes are those of the receptance. */
export function measured() {
  const data = oneRun();
  const [r] = data.runs;
  r.summary = { case: 'measured', title: 'Measured', status: 'ok', lobes: [], contacts: r.summary.contacts, checks: [], updating: [], operating_points: [], points: [], robot: { modes: [] },
    coupling: { modes: [], main_modes: [{ frequency_hz: 36.328, damping_ratio: 0.0164 }], reductions: [], route_difference: null } };
  for (const key of ['route_difference', 'mac', 'auto_mac', 'shapes', 'reduction_error', 'cutting']) delete r[key];
  [r.lobes, r.paths] = [[], []];
  return data;
}

/** A case along a path; its summary has the path's own answers. */
export function alongPath() {
  const data = oneRun();
  const [{ summary }] = data.runs;
  const path = (name, k) => ({ name, speeds: 20, error_estimate_relative: 3e-4, deepest_everywhere: { depth_m: 0.00203 * k, spindle_speed_rpm: 10615, at_depth_limit: false }, weakest: { position: 3, at_m: [0, 0.1, 0.1], minimum_depth_m: 0.000512 * k, at_spindle_speed_rpm: 11231 } });
  summary.path = [path('part', 0.1), path('supported', 1)];
  return data;
}

/** A robot without an arm, whose end moves `times` as far as the part. */
export function noArm(times = 1) {
  const data = oneRun();
  const { shapes: s } = data.runs[0];
  delete s.robot_arm;
  for (const m of s.modes) if (m.robot) m.robot = [times, 0, 0];
  return data;
}

/** The same with text that would run as a script, were it ever taken for HTML. */
export function hostile() {
  const evil = '</script><script>window.hacked=1</script><img src=x onerror="window.hacked=2"><b>%{x} <a href="javascript:window.hacked=3">a</a>';
  const data = document([evil, evil], [run(evil, evil, 1), run(`${evil} 2`, evil, 1.3)]);
  for (const r of data.runs) r.summary.title = evil;
  data.runs[0].mac.rows = evil;
  data.runs[0].lobes[0].kind[0] = evil;
  data.program = evil;
  return data;
}

/** The page of a fit: two modes of a beam on three points along y, measured by one hammer, of which the second point is not named by the diagram's first orders. */
export function fitted({ coherence = true, shapes = true, warnings = ['the damping of the mode at 180 Hz is known to 24 % only'] } = {}) {
  const hz = range(200).map((i) => 20 + 1.5 * i);
  const [responses, forces] = [['1.x', '2.x', '3.x'], ['3.x']];
  const modes = [{ f: 60.25, z: 0.01, k: 1e6, u: [0.2, 0.6, 1] }, { f: 180.5, z: 0.02, k: 4e6, u: [-0.7, -0.4, 1] }];
  const value = (r, f) => modes.reduce(([re, im], m) => {
    const [a, b] = [1 - (f / m.f) ** 2, (2 * m.z * f) / m.f];
    const scale = (m.u[r] * m.u[2]) / (m.k * (a * a + b * b));
    return [re + a * scale, im - b * scale];
  }, [0, 0]);
  const H = (factor) => pack('f32', [3, 1, hz.length, 2], range(3).flatMap((r) => hz.flatMap((f) => value(r, f).map((v) => v * factor))), true);
  const orders = range(10).flatMap((i) => [...modes.map((m, k) => [i + 1, m.f * (1 + 0.02 / (i + 1) ** 2), m.z, i < 2 ? 0 : i === 2 + k ? 3 : i < 5 ? 1 : 7]), [i + 1, 100 + 13 * i, 0.05, i % 2 ? 5 : 0]]);
  const column = (k) => orders.map((row) => row[k]);
  const interval = (v) => [v * 0.99, v * 1.01];
  const figures = { modes: modes.map((m, i) => ({ frequency_hz: m.f, frequency_95_hz: interval(m.f), damping_ratio: m.z, damping_ratio_95: i ? [null, null] : interval(m.z), second_singular: 0, mass_kg: i ? undefined : 7, stiffness_n_m: i ? undefined : m.k })),
    chi2_per_dof: 1.02, converged: true, weights: 'scatter', terms: { inertia: true, highest_power: 1 }, lines: { count: hz.length, from_hz: hz[0], to_hz: hz.at(-1) }, misfit: [[0.01], [0.02], [0.005]], warnings, responses, forces };
  return { schema: 1, program: 'thinwall 0.0', title: 'Fit of 3 x 1 receptances: <beam>.uff', runs: [], fit: {
    figures, notes: ['2.x/3.x is taken from 3.x/2.x by reciprocity'], command: ['thinwall', 'fit', "it's a beam.uff", '--from', '20 Hz', '--out', 'fit'],
    frf: { name: 'measured', responses, forces, hz: pack('f64', [hz.length], hz), H: H(1), synthesised: H(1.01), agreement: pack('f64', [3, 1, 2], [1, 0.01, 1, 0.01, 1, 0.01]),
      ...(coherence ? { coherence: pack('f32', [3, 1, hz.length], range(3 * hz.length).map((i) => 1 - (i % 7) / 50)) } : {}) },
    diagram: { order: pack('u32', [orders.length], column(0)), hz: pack('f32', [orders.length], column(1)), damping: pack('f32', [orders.length], column(2)), agrees: pack('u32', [orders.length], column(3)) },
    stable: modes.map((m) => ({ hz: m.f, damping: m.z, orders: 5 })),
    mac: { values: pack('f32', [2, 2], [1, 0.1, 0.1, 1]), row_hz: modes.map((m) => m.f), column_hz: modes.map((m) => m.f) },
    ...(shapes ? { shapes: { points: responses.map((name, i) => ({ name: name.slice(0, 1), position_m: [0, i * 0.1, 0] })), lines: [[0, 1], [1, 2]], modes: modes.map((m) => ({ hz: m.f, shape: m.u.map((u) => [u, 0, 0, 0, 0, 0]) })) } } : {}) } };
}

/** A robot tapped at 6 postures over two columns, of which one is called like HTML; `expected` has the map's depths in mm by place. With `cut: false` it has no depths. */
export function learned({ cut = true, parts = ['errors', 'curve', 'map', 'envelope', 'next', 'sharing'], doubts = ['2 modes could not be followed'] } = {}) {
  const over = ['<x>', 'kappa_deg'];
  const grid = [[0, 0], [0, 10], [1, 0], [1, 10], [2, 10]];
  const depth = grid.map(([x, k]) => 0.002 + 0.0005 * x + 0.00001 * k);
  const banded = (values) => pack('f64', [values.length, 3], values.flatMap((v) => [v, 0.9 * v, 1.2 * v]));
  const list = (type, values) => pack(type, [values.length], values);
  const has = (part) => parts.includes(part);
  const number = (name, median) => ({ number: name, median_error: median, largest_error: 4 * median, worst_posture: 'p3', r2: 0.9, covered: 0.5 });
  const shared = ['gains', 'none', 'loses'].map((sharing, i) => ({ mode: 1, group: ['frequency_and_damping', 'real_parts', 'imaginary_parts'][i], sharing, r2_alone: 0.9, r2_together: [0.95, 0.9, 0.8][i] }));
  const figures = { postures: 6, over, spindle_speed_rpm: cut ? 9000 : undefined, doubts, notes: ['1 mode is learned from 6 postures'],
    modes: [{ mode: 1, postures: 6, least_frequency_hz: 10, largest_frequency_hz: 12, numbers: has('errors') ? [number('ln_frequency', 0.002), number('ln_damping_ratio', 0.05)] : [] }],
    ...(has('errors') && cut ? { depths: { median_error: 0.05, ninetieth_error: 0.1, largest_error: 0.2, worst_posture: 'p3', covered: 0.5 } } : {}),
    ...(has('curve') ? { curve: { tested: 2, plain: [[7, 0.02, 0.1], [14, 0.01, 0.05]].map(([postures, f, d]) => ({ postures, frequency_error: f, ...(cut ? { depth_error: d } : {}) })), ...(cut ? { with_arm: [{ postures: 7, frequency_error: 0.002, depth_error: 0.03 }, { postures: 14, frequency_error: 0.001, depth_error: 0.02 }] } : {}) } } : {}),
    ...(has('sharing') ? { shared } : {}),
    ...(has('map') ? { map: { places: 5, least_first_hz: 10, largest_first_hz: 12, ...(cut ? { least_depth_m: 0.002, least_depth_low_m: 0.0018, least_depth_high_m: 0.0024, largest_depth_m: 0.0031, least_depth_at: [0, 0] } : {}) } } : {}),
    ...(has('envelope') && cut ? { envelope: { split_hz: 100, least_low_m: 0.002, least_high_m: null, least_together_m: 0.0019 } } : {}),
    ...(has('next') ? { next: { at: [1, 10], reduction: 0.6, of_depth: cut } } : {}) };
  const ends = [[0, 0.01], [0.02, -0.02]];
  return { schema: 1, program: 'thinwall 0.0', title: 'A robot & its <postures>', runs: [], expected: new Map(grid.map((place, i) => [place.join(), depth[i] * 1e3])), postures: {
    figures, names: ['p1', 'p2', 'p3', 'p4', 'p5', 'p6'], places: pack('f64', [6, 2], [0, 0, 0, 10, 1, 0, 1, 10, 2, 10, 0.5, 5]), asked: [0.9, 4],
    ...(has('errors') ? { modes: { posture: list('u32', [0, 2]), mode: list('u32', [1, 1]), measured: pack('f64', [2, 2], ends.flatMap(() => [Math.log(11), Math.log(0.02)])), predicted: pack('f64', [2, 2], ends.flatMap(([f, z]) => [Math.log(11) + f, Math.log(0.02) + z])), deviation: pack('f64', [2, 2], [0.005, 0.02, 0.005, 0.02]) } } : {}),
    ...(figures.depths ? { depths: { posture: list('u32', [0, 2]), measured_m: list('f64', [0.002, 0.003]), predicted_m: list('f64', [0.0021, 0.0024]), low_m: list('f64', [0.0019, 0.0022]), high_m: list('f64', [0.0023, 0.0026]) } } : {}),
    ...(has('map') ? { map: { places: pack('f64', [5, 2], grid.flat()), first_hz: banded(grid.map(([x]) => 10 + x)), ...(cut ? { rpm: list('f64', grid.map(() => 9000)), depth_m: banded(depth) } : {}) } } : {}),
    ...(figures.envelope ? { envelope: { rpm: list('f64', [8000, 9000, 10000]), low_m: list('f64', [0.003, 0.002, 0.004]), high_m: list('f64', [Infinity, 0.0025, 0.003]), together_m: list('f64', [0.003, 0.0019, 0.003]) } } : {}),
    ...(has('next') ? { next: { candidates: pack('f64', [5, 2], grid.flat()), reduction: list('f64', [0.1, 0.2, 0.3, 0.6, 0.4]), path: pack('f64', [1, 2], [0.9, 4]) } } : {}) } };
}
