// Milling in the time domain: what a simulated operating point does, and the vibration over speed and depth.

import { button, choice, el, table, tick } from './dom.js';
import { numbers } from './decode.js';
import { faint, viridisScale } from './colours.js';
import { isNumber, number, percent, plain, scaled } from './format.js';
import { folded, later, logTicks, plot } from './plot.js';
import { lobeTitle, withRobot } from './lobes.js';
import { growing, onShownPoint, showPoint, shownPoint, simulatedPoints, titleOf } from './simulated.js';

const origins = { tooth_passing: ['tooth passing', 'part', 'circle'], spindle: ['spindle', 'robot', 'square'], other: ['chatter', 'bad', 'x'] };
const motions = { periodic: () => 'repeats itself with the cut', period_n: (p) => `repeats itself after ${p.period} periods of the cut`, quasi_periodic: (p) => `never repeats itself${stable(p) ? ', though small ones decay: take more steps first (simulation.steps, simulation.steps_a_turn), then settle more turns, or it is chatter that a large enough disturbance begins' : ''}`, growing: () => 'grows', settling: (p) => `has not settled, though small ones decay${isNumber(p.period_difference) ? `: it still changes by ${percent(p.period_difference, 2)} of its size` : ''}` };
const micrometresOf = (vector) => (vector ? `${number(vector[0] * 1e6, 4)}, ${number(vector[1] * 1e6, 4)} µm` : null); // along the feed, across
const stable = (p) => isNumber(p.growth?.lobes_modulus) && p.growth.lobes_modulus < 1;
const motionOf = (p) => (p.approach?.length ? 'enters at a border' : p.status === 'overflowed' ? `outgrew the cutter after ${number(p.simulated_s, 3)} s` : p.status === 'surface_lost' ? `is too fast or too large for exact paths after ${number(p.simulated_s, 3)} s: take simulation.paths = "region"` : `${motions[p.motion]?.(p) ?? p.motion}${{ unsettled: '; forces did not settle', too_coarse: `; steps are too few from ${number(p.simulated_s, 3)} s on: take more by simulation.steps_a_turn` }[p.status] ?? ''}`);

/** The section's content; null where nothing was simulated. */
export function simulation(runs) {
  const points = simulatedPoints(runs);
  const blocks = [...(points.length ? atPoints(runs, points) : []), map(runs)].filter(Boolean);
  return blocks.length ? blocks : null;
}

/** What the section shows, in a sentence. */
export function simulationLead(runs) {
  const all = runs.map((run) => run.summary.simulation).filter(Boolean);
  const largest = (key) => all.map((s) => s[key]?.max_relative).filter(isNumber).reduce((a, b) => Math.max(a, b), -Infinity);
  const agreement = [['growth_difference', 'The growth of a small vibration is that of the lobes to'], ['forced_difference', 'the periodic motion that in closed form to']]
    .filter(([key]) => Number.isFinite(largest(key))).map(([key, text]) => `${text} ${number(largest(key), 2)}`).join(', ');
  return [`The cut step by step, teeth on ${[...new Set(all.map((s) => (s.paths === 'circular' ? 'circles' : 'their real paths')))].join(' or ')}: what vibration it settles in, on either side of the boundary.`, agreement ? `${agreement}.` : ''].filter(Boolean).join(' ');
}

function atPoints(runs, points) {
  const several = runs.length > 1;
  const current = () => points[shownPoint()];
  const state = { of: 'vibration', log: true };
  const has = (key) => points.some(({ tables }) => tables[key]);
  const chart = (name, label, key, build, columns) => has(key) && plot({ name, label, build: (colours, narrow) => (current().tables[key] ? build(current(), colours, narrow) : nothing(colours)), columns: () => (current().tables[key] ? columns(current()) : []) });
  const trace = chart('simulation-trace', 'Vibration and force over time', 'trace', timeTrace, ({ tables }) => columnsOf(tables.trace));
  const spectrum = chart('simulation-spectrum', 'Spectrum', 'spectrum', (p, colours, narrow) => spectrumOf(p, state, colours, narrow), ({ tables }) => columnsOf(tables.spectrum));
  const orbit = chart('simulation-orbit', 'Path of the tool against the part', 'trace', orbitOf, ({ tables }) => columnsOf(tables.trace));
  const section = chart('simulation-section', 'Poincaré section', 'passes', sectionOf, ({ tables }) => columnsOf(tables.passes));
  const forces = chart('simulation-forces', 'Forces over the angle', 'trace', forcesOf, ({ tables }) => columnsOf(tables.trace));
  const wall = chart('simulation-wall', 'The wall', 'walls', wallOf, ({ tables }) => tables.walls.flatMap((w) => columnsOf({ x_m: w.x_m, error_m: w.error_m }, ` ${w.side}`)));
  const charts = [trace, spectrum, orbit, section, forces, wall].filter(Boolean);
  charts.forEach((c) => later(c.draw));
  const pick = choice('Point', points.map((p, k) => [k, titleOf(p, several)]), 0, (v) => showPoint(Number(v)));
  const said = el('p', { class: 'lead', role: 'status' }, sentenceOf(current().point));
  onShownPoint((k) => {
    pick.querySelector('select').value = String(k);
    said.textContent = sentenceOf(points[k].point);
    charts.forEach((c) => c.drawn && c.draw());
  });
  const back = document.createElement('span');
  if (runs.some((run) => run.lobes?.length)) back.append(button('On the chart', 'Show this point on the chart of the lobes', () => document.getElementById('lobes')?.scrollIntoView({ behavior: 'smooth' })));
  const boxes = (...list) => el('div', { class: 'columns' }, list.filter(([, c]) => c).map(([title, c]) => el('div', {}, el('h4', {}, title), c.figure)));
  return [pointTable(runs, points), charts.length > 0 && el('div', { class: 'controls' }, pick, back), said,
    trace && [el('h3', {}, 'Over time'), trace.figure],
    spectrum && [el('h3', {}, 'Spectrum'), el('div', { class: 'controls' }, choice('Of', [['vibration', 'vibration'], ['force', 'force']], state.of, (v) => { state.of = v; spectrum.draw(); }), tick('logarithmic', state.log, (on) => { state.log = on; spectrum.draw(); })), spectrum.figure],
    (orbit || section) && boxes(['Path of the tool against the part', orbit], ['Poincaré section', section]),
    (forces || wall) && boxes(['Forces over the angle', forces], ['The wall', wall])].filter(Boolean);
}

const nothing = (colours) => ({ data: [], layout: { height: 120, xaxis: { visible: false }, yaxis: { visible: false }, annotations: [{ text: 'not recorded of this point', xref: 'paper', yref: 'paper', x: 0.5, y: 0.5, showarrow: false, font: { color: colours.muted } }] } });
const columnsOf = (arrays, suffix = '') => Object.entries(arrays).map(([name, array]) => ({ name: `${name}${suffix}`, values: Array.from(numbers(array)) }));

/** The way of a mean deflection to its end, in a sentence. */
const approachOf = (a) => ` ${a.direction === 'feed' ? 'Along the feed' : 'Across'} its mean deflection ends at ${number(a.final_m * 1e6, 4)} µm, overshoots by ${percent(a.overshoot, 3)} and ${a.settling_2_s == null ? 'has not settled within the record' : `stays within 2 % of its end after ${number(a.settling_2_s, 3)} s`}.`;

/** The motion of a point in words, with what of it counts. */
function sentenceOf(p) {
  const lost = p.share_without_contact > 0.001 ? ` Teeth are out of the material in ${percent(p.share_without_contact, 2)} of the cut.` : '';
  const support = p.opening_contact?.open_share > 0 ? ` The support is out of touch in ${percent(p.opening_contact.open_share, 2)} of the time, by up to ${number(p.opening_contact.widest_m * 1e6, 3)} µm.` : '';
  if (p.approach?.length) return `The tool enters at a border.${p.approach.filter((a) => a.final_m).map(approachOf).join('')}${lost}${support}`;
  return `Its vibration ${motionOf(p)}.${lost}${support}${p.forced_vibration ? ` In closed form it is the same to ${number(p.forced_vibration.difference_relative, 2)}${p.forced_vibration.left_of_beginning > 1e-6 ? `, with ${number(p.forced_vibration.left_of_beginning, 2)} of its beginning left` : ''}.` : ''}`;
}

function pointTable(runs, points) {
  const several = runs.length > 1;
  const columns = [
    ['Point', (p) => titleOf(p, several)], ['Motion', ({ point }) => ({ text: motionOf(point), class: growing(point) ? 'bad' : 'good' })],
    ['|μ|', ({ point }) => (isNumber(point.growth.lobes_modulus) ? number(point.growth.march_modulus ?? point.growth.lobes_modulus, 6) : 'not found')],
    ['From lobes', ({ point }) => (isNumber(point.growth.difference_relative) ? number(Math.abs(point.growth.difference_relative), 2) : 'not found')],
    ['Peak to peak', ({ point }) => micrometresOf(point.peak_to_peak_m)],
    ['Peak force', ({ point }) => (isNumber(point.peak_force_n) ? `${number(point.peak_force_n, 4)} N` : null)], ['Power', ({ point }) => (isNumber(point.mean_power_w) ? `${number(point.mean_power_w, 3)} W` : null)],
    ['Without contact', ({ point }) => (isNumber(point.share_without_contact) ? percent(point.share_without_contact, 2) : null)],
    ['Wall', ({ point }) => (point.walls?.length ? point.walls.map((w) => `${number(w.location_error_m * 1e6, 3)} µm, R_a ${number(w.R_a_m * 1e6, 2)}, R_q ${number(w.R_q_m * 1e6, 2)}, R_t ${number(w.R_t_m * 1e6, 2)} µm`).join('; ') : null)],
  ].filter(([, of]) => points.some((p) => of(p) !== null));
  return table('Simulated points', columns.map(([head]) => head), points.map((p) => columns.map(([, of]) => of(p))), true);
}

const lines = (name, x, y, colour, more = {}) => ({ name, x, y, mode: 'lines', line: { simplify: false, color: colour, width: 1.3, ...(more.dash ? { dash: more.dash } : {}) }, hovertemplate: '%{y:.4~g}', ...more.trace });

function timeTrace({ tables: { trace }, point }, colours, narrow) {
  const t = Array.from(numbers(trace.time_s));
  const x = t.map((s) => (s - t[0]) * 1e3);
  const turn = 6e4 / point.spindle_speed_rpm;
  const few = Math.min(x.at(-1), 6 * turn);
  const of = (key, factor) => scaled(numbers(trace[key]), factor);
  return { data: [
    lines('along the feed', x, of('x_m', 1e6), colours.part, { trace: { meta: 'x_m' } }), lines('across', x, of('y_m', 1e6), colours.supported, { trace: { meta: 'y_m' } }),
    lines('force along the feed', x, of('force_x_n', 1), colours.part, { dash: 'dot', trace: { yaxis: 'y2', showlegend: false, meta: 'force_x_n' } }), lines('force across', x, of('force_y_n', 1), colours.supported, { dash: 'dot', trace: { yaxis: 'y2', showlegend: false, meta: 'force_y_n' } })],
  layout: { height: narrow ? 400 : 460, hovermode: 'x unified', hoversubplots: 'axis', uirevision: `simulation ${point.files}`, margin: { l: narrow ? 54 : 70, r: narrow ? 10 : 18, t: 32, b: 46 },
    xaxis: { title: `Time since ${number(t[0], 4)} s (ms)`, anchor: 'y2', unifiedhovertitle: { text: '%{x:.5~g} ms' }, range: [0, few] }, yaxis: { title: 'Tool against part (µm)', domain: [0.52, 1] }, yaxis2: { title: 'Force (N)', domain: [0, 0.46] } } };
}

function spectrumOf({ tables: { spectrum }, point }, { of, log }, colours, narrow) {
  const vibration = of === 'vibration';
  const [keys, factor, unit] = vibration ? [['x_m', 'y_m'], 1e6, 'µm'] : [['force_x_n', 'force_y_n'], 1, 'N'];
  const x = Array.from(numbers(spectrum.frequency_hz));
  const curves = keys.map((key, k) => ({ ...lines(k ? 'across' : 'along the feed', x, scaled(numbers(spectrum[key]), factor), faint(k ? colours.supported : colours.part, 0.8), { trace: { meta: key } }), hovertemplate: `%{x:.5~g} Hz: %{y:.4~g} ${unit}` }));
  const found = (vibration ? point.vibration_lines : point.force_lines) ?? [];
  const amplitude = (line) => (vibration ? line.amplitude_m : line.amplitude_n) * factor;
  const marks = Object.entries(origins).flatMap(([origin, [told, colour, symbol]]) => {
    const name = origin === 'other' && stable(point) ? 'of the structure' : told; // what is left of the beginning
    const own = found.filter((line) => line.origin === origin);
    return own.length ? [{ name: plain(name), x: own.map((line) => line.frequency_hz), y: own.map(amplitude), mode: 'markers', marker: { symbol, size: 9, color: colours[colour], line: { width: 1.5, color: colours[colour] } }, hovertemplate: `${name}: %{x:.5~g} Hz, %{y:.4~g} ${unit}<extra></extra>`, meta: `lines ${origin}` }] : [];
  });
  const high = found.reduce((a, line) => Math.max(a, amplitude(line)), 0) || 1;
  const to = Math.min(x.at(-1) ?? 1, 1.25 * found.reduce((a, line) => Math.max(a, line.frequency_hz), point.spindle_speed_rpm / 15));
  return { data: [...curves, ...marks], layout: { height: narrow ? 340 : 400, hovermode: 'closest', uirevision: `spectrum ${point.files} ${of} ${log}`, margin: { l: narrow ? 54 : 70, r: narrow ? 10 : 18, t: 32, b: 46 },
    xaxis: { title: 'Frequency (Hz)', range: [0, to] }, yaxis: { title: `Amplitude (${unit})`, ...(log ? { type: 'log', dtick: 1, range: [Math.log10(high) - 4, Math.log10(high) + 0.3] } : { rangemode: 'tozero' }) } } };
}

const square = (title, across) => ({ xaxis: { title, zeroline: true }, yaxis: { title: across, scaleanchor: 'x', zeroline: true } });

function orbitOf({ tables: { trace }, point }, colours, narrow) {
  return { data: [lines('path', scaled(numbers(trace.x_m), 1e6), scaled(numbers(trace.y_m), 1e6), colours.part, { trace: { showlegend: false, hovertemplate: '%{x:.4~g} µm, %{y:.4~g} µm<extra></extra>', meta: 'orbit' } })],
    layout: { height: narrow ? 320 : 380, hovermode: 'closest', uirevision: `orbit ${point.files}`, ...square('Along the feed (µm)', 'Across (µm)') } };
}

function sectionOf({ tables: { passes }, point }, colours, narrow) {
  const [x, y] = [scaled(numbers(passes.entry_x_m), 1e6), scaled(numbers(passes.entry_y_m), 1e6)];
  const entry = Array.from(numbers(passes.entry_s));
  const turns = entry.map((s) => ((s - entry[0]) * point.spindle_speed_rpm) / 60);
  const first = turns.flatMap((turn, i) => (Math.abs(turn - Math.round(turn)) < 0.01 ? [i] : []));
  const dots = (name, at, colour, size, symbol, meta) => ({ name, x: at.map((i) => x[i]), y: at.map((i) => y[i]), mode: 'markers', marker: { size, symbol, color: colour, line: { width: 1, color: colour } }, hovertemplate: '%{x:.4~g} µm, %{y:.4~g} µm', meta });
  return { data: [dots('once a tooth', turns.map((_, i) => i), faint(colours.part, 0.6), 4, 'circle', 'once a tooth'), dots('once a turn', first, colours.supported, 6, 'circle-open', 'once a turn')],
    layout: { height: narrow ? 320 : 380, hovermode: 'closest', uirevision: `section ${point.files}`, margin: { l: narrow ? 50 : 64, r: 16, t: 32, b: 46 }, ...square('Along the feed at entry (µm)', 'Across at entry (µm)') } };
}

function forcesOf({ tables: { trace }, point }, colours, narrow) {
  const t = numbers(trace.time_s);
  const turn = 60 / point.spindle_speed_rpm;
  const end = t.at(-1);
  const begin = Array.from(t).findIndex((s) => end - s < 2.001 * turn); // the last two turns
  const angle = Array.from(t).slice(begin).map((s) => (((s / turn + 1e-6) % 1) * 360)); // a trace may begin within a turn
  const broken = (key) => scaled(numbers(trace[key]), 1).slice(begin).flatMap((f, i) => (i && angle[i] < angle[i - 1] ? [null, f] : [f]));
  const x = angle.flatMap((a, i) => (i && a < angle[i - 1] ? [null, a] : [a]));
  return { data: [lines('along the feed', x, broken('force_x_n'), colours.part, { trace: { meta: 'force_x_n' } }), lines('across', x, broken('force_y_n'), colours.supported, { trace: { meta: 'force_y_n' } })],
    layout: { height: narrow ? 300 : 340, hovermode: 'closest', uirevision: `forces ${point.files}`, margin: { l: narrow ? 50 : 64, r: 16, t: 32, b: 46 }, xaxis: { title: 'Angle since a tooth entered (°)', range: [0, 360], dtick: 90 }, yaxis: { title: 'Force on the tool (N)', zeroline: true } } };
}

function wallOf({ tables: { walls }, point }, colours, narrow) {
  return { data: walls.map((w, k) => lines(plain(`${w.side}${w.height_m > 0 ? `, ${number(w.height_m * 1e3, 3)} mm up` : ''}`), scaled(numbers(w.x_m), 1e3), scaled(numbers(w.error_m), 1e6), [colours.part, colours.supported, colours.robot][k % 3], { trace: { showlegend: walls.length > 1, hovertemplate: '%{x:.4~g} mm: %{y:.4~g} µm<extra></extra>', meta: `wall ${k}` } })),
    layout: { height: narrow ? 300 : 340, hovermode: 'closest', uirevision: `wall ${point.files}`, margin: { l: narrow ? 50 : 64, r: 16, t: walls.length > 1 ? 32 : 12, b: 46 }, xaxis: { title: 'Along the feed (mm)' }, yaxis: { title: 'Error of the wall (µm)', zeroline: true } } };
}

/** The vibration over speed and depth with the limit drawn on it; null where no run has one. */
function map(runs) {
  const maps = runs.flatMap((run) => (run.simulation?.maps ?? []).map((m) => ({ run, m }))).sort((a, b) => withRobot(b.m.name) - withRobot(a.m.name));
  if (!maps.length) return null;
  const state = { at: 0 };
  const title = ({ run, m }) => `${runs.length > 1 ? `${run.label}: ` : ''}${lobeTitle(m.name)}`;
  const chart = plot({ name: 'simulation-map', label: 'Vibration over speed and depth', build: (colours, narrow) => mapOf(maps[state.at], colours, narrow), columns: () => mapColumns(maps[state.at].m) });
  const left = maps.map(({ run, m }) => run.summary.simulation?.maps?.find((s) => s.chart === m.name)).reduce((sum, s) => sum + (s?.points_unsettled ?? 0), 0);
  const note = left > 0 && el('p', { class: 'lead' }, `At ${left} points forces within steps did not settle; they are left blank.`);
  return folded('Vibration over speed and depth', chart, maps.length > 1 && el('div', { class: 'controls' }, choice('Map of', maps.map((m, i) => [i, title(m)]), 0, (v) => { state.at = Number(v); chart.draw(); })), note, chart.figure);
}

function mapOf({ run, m }, colours, narrow) {
  const [x, y, all] = [Array.from(numbers(m.rpm)), Array.from(numbers(m.depth_m), (d) => d * 1e3), scaled(numbers(m.peak_to_peak_m), 1e6)];
  const z = y.map((_, d) => x.map((__, s) => all[s * y.length + d]));
  const positive = all.filter((v) => v > 0);
  const [low, high] = [positive.reduce((a, b) => Math.min(a, b), Infinity), positive.reduce((a, b) => Math.max(a, b), 0)];
  const lobe = run.lobes?.find((l) => l.name === m.name);
  const edge = (color, width, meta) => ({ name: 'limit of the lobes', x: Array.from(numbers(lobe.rpm)), y: scaled(numbers(lobe.depth_m), 1e3), mode: 'lines', line: { simplify: false, color, width }, hoverinfo: 'skip', showlegend: false, meta });
  const limit = lobe ? [edge('#000000', 4, 'limit edge'), edge('#ffffff', 2, 'limit')] : []; // to be seen on any colour
  return { data: [{ type: 'heatmap', x, y, z: z.map((row) => row.map((v) => (v > 0 ? Math.log10(v) : null))), customdata: z, colorscale: viridisScale, colorbar: { title: { text: 'µm', side: 'top', font: { size: 12 } }, thickness: 12, outlinewidth: 0, ...logTicks(low, high) },
    hovertemplate: '%{x:.5~g} rpm, %{y:.4~g} mm<br>%{customdata:.4~g} µm peak to peak<extra></extra>', meta: 'map' }, ...limit],
  layout: { height: narrow ? 360 : 460, hovermode: 'closest', uirevision: `map ${m.name}`, xaxis: { title: 'Spindle speed (rpm)', range: [x[0], x.at(-1)] }, yaxis: { title: 'Depth of cut (mm)', range: [0, y.at(-1)] } } };
}

function mapColumns(m) {
  const [x, y, all] = [m.rpm, m.depth_m, m.peak_to_peak_m].map(numbers);
  return [{ name: 'spindle speed (rpm)', values: Array.from(all, (_, i) => x[Math.floor(i / y.length)]) }, { name: 'depth (m)', values: Array.from(all, (_, i) => y[i % y.length]) }, { name: 'peak to peak (m)', values: Array.from(all) }];
}
