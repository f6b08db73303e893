// What was cut: cutter, engagement, coefficients, material and fixture, as a sentence, as a table and as a sketch. All of it is text of the case with every default.

import { el, svg, table } from './dom.js';
import { number, percent } from './format.js';

const shown = { m: ['mm', 1e3], 'm/s': ['mm/min', 6e4], 'N/m': ['N/mm', 1e-3], rad: ['°', 180 / Math.PI] }; // unit of the case: that of the page, and the factor
const ends = { flat: 'flat end mill', ball: 'ball end mill', bull_nose: 'bull-nose end mill', general: 'cutter of general shape' };

/** { value (SI), unit } of "0.016 m"; null of what is none. */
function quantity(text) {
  const [, value, unit = ''] = String(text ?? '').match(/^([-+]?[\d.]+(?:e[-+]?\d+)?)(?: (\S.*))?$/i) ?? [];
  return value === undefined ? null : { value: Number(value), unit };
}

/** A quantity of the case in a unit of the page; `unit` and `factor` say which where the usual one is not wanted. */
function display(text, unit, factor) {
  const q = quantity(text);
  if (!q) return text ?? null;
  const [name, times] = unit ? [unit, factor] : shown[q.unit] ?? [q.unit, 1];
  return `${number(q.value * times, 4)}${name && name !== '°' ? ` ${name}` : name}`;
}

/** A list of the case, or its single value as a list. */
function listOf(text) {
  if (text === undefined) return [];
  try { return [JSON.parse(text)].flat(); } catch { return [text]; }
}

const positive = (text) => (quantity(text)?.value ?? 0) !== 0;
const hasCut = (run) => Boolean(run.cutting && run.case_values?.['tool.teeth']);

/** { radius, radial (m, or null), arcs: [[from, to], …] (rad, from the normal in the sense of rotation), up } of the cut; null where it is not known. */
function engagement(values) {
  const diameter = quantity(values['tool.diameter'])?.value;
  const radial = quantity(values['cutting.radial_depth'])?.value;
  const up = values['cutting.mode'] === 'up';
  if (radial > 0 && diameter > 0) {
    const angle = Math.acos(Math.max(-1, 1 - (2 * radial) / diameter));
    return { radius: diameter / 2, radial, up, arcs: [up ? [0, angle] : [Math.PI - angle, Math.PI]] };
  }
  const [from, to] = ['entry_angle', 'exit_angle'].map((key) => listOf(values[`cutting.${key}`]).map((text) => quantity(text)?.value));
  const arcs = from.map((start, i) => [start, to[i]]).filter((arc) => arc.every(Number.isFinite));
  return arcs.length ? { radius: (diameter ?? 0) / 2, radial: null, up, arcs } : null;
}

const cutter = (v) => [ends[v['tool.end']] ?? 'cutter', v['tool.diameter'] ? `of ${display(v['tool.diameter'])}` : ''].filter(Boolean).join(' ');

/** "Cut at P: down milling, 0.2 mm radially, by a flat end mill of 16 mm with 6 teeth; Kt 2220 N/mm²." Empty where the run has no cut. */
export function cutSentence(run) {
  if (!hasCut(run)) return '';
  const v = run.case_values;
  const at = run.cutting?.at ? `Cut at ${run.cutting.at}: ` : '';
  const radial = v['cutting.radial_depth'] ? `${v['cutting.mode'] === 'up' ? 'up' : 'down'} milling, ${display(v['cutting.radial_depth'])} radially, by` : 'milling by';
  const text = `${at}${radial} a ${cutter(v)} with ${v['tool.teeth']} teeth${v['cutting.Kt'] ? `; Kt ${display(v['cutting.Kt'], 'N/mm²', 1e-6)}` : ''}.`;
  return text[0].toUpperCase() + text.slice(1);
}

function coefficients(v) {
  const of = (keys, unit, factor) => keys.filter((k) => positive(v[`cutting.${k}`])).map((k) => `${k} ${display(v[`cutting.${k}`], unit, factor)}`);
  const all = [...of(['Kt', 'Kr', 'Ka'], 'N/mm²', 1e-6), ...of(['Kte', 'Kre', 'Kae'], 'N/mm', 1e-3), ...of(['shear_stress'], 'N/mm²', 1e-6).map((s) => s.replace('_', ' '))];
  return all.length ? `${v['cutting.law'] ?? 'linear'}: ${all.join(', ')}` : null;
}

/** Where the coefficients are from: a fit, or what the case says behind them. */
function origin(run) {
  const fitted = (run.summary.updating ?? []).flatMap((fit) => fit.parameters ?? []).filter((p) => /^cutting\.(K|shear)/.test(p.key ?? '')).map((p) => p.key.slice('cutting.'.length));
  if (fitted.length) return `${fitted.join(', ')} fitted by the run`;
  const remarks = [...(run.case ?? '').matchAll(/^\s*(?:Kt|Kr|shear_stress)\s*=[^#\n]*#\s*(.+)$/gm)].map(([, remark]) => remark.trim());
  return remarks.length ? [...new Set(remarks)].join('; ') : 'given by the case, which names no source';
}

function material(v) {
  const of = 'part.material.';
  const [E, nu, rho] = ['youngs_modulus', 'poisson_ratio', 'density'].map((key) => v[of + key]);
  return E ? [`E ${display(E, 'GPa', 1e-9)}`, nu && `ν ${nu}`, rho && `density ${display(rho).replace('^3', '³')}`].filter(Boolean).join(', ') : null;
}

function fixture(v) {
  const on = Object.entries(v).filter(([key]) => /^part\.supports\[\d+\]\.(on|at|box|sphere)$/.test(key)).map(([, where]) => where);
  return on.length ? `held at ${on.join(', ')}` : null;
}

function robot({ summary }) {
  if (summary.robot?.carries === 'tool') return 'carries the tool';
  const list = (summary.contacts ?? []).map((c) => `${c.robot} at ${c.part}${c.stiffness_n_per_m?.length && c.stiffness_n_per_m.every((k) => k === null) ? ' (rigid)' : c.model ? ` (${c.model})` : ''}`);
  return list.length ? list.join(', ') : null;
}

function engaged(v) {
  const e = engagement(v);
  if (!e) return null;
  const degrees = (x) => number((x * 180) / Math.PI, 3);
  const teeth = `teeth cut from ${e.arcs.map(([a, b]) => `${degrees(a)}° to ${degrees(b)}°`).join(' and ')}`;
  return e.radial === null ? teeth : `${e.up ? 'up' : 'down'} milling, radial depth ${display(v['cutting.radial_depth'])} (${percent(e.radial / (2 * e.radius), 3)} of the diameter); ${teeth}`;
}

function feed(v) {
  const [rate, speed, tooth] = [quantity(v['cutting.feed_rate']), quantity(v['cutting.spindle_speed']), quantity(v['cutting.feed_per_tooth'])];
  if (tooth) return `${display(v['cutting.feed_per_tooth'])} a tooth`;
  if (!rate) return null;
  return display(v['cutting.feed_rate']) + (speed ? `, ${number((rate.value * 60e3) / speed.value / Number(v['tool.teeth']), 3)} mm a tooth at ${display(v['cutting.spindle_speed'])}` : '');
}

const rows = [
  ['Cutter', (v) => cutter(v) + (v['tool.length'] ? `, edges ${display(v['tool.length'])} long` : '')],
  ['Teeth', (v) => [v['tool.teeth'], v['tool.pitches'] && `pitches ${listOf(v['tool.pitches']).map((p) => display(p)).join(', ')}`].filter(Boolean).join('; ')],
  ['Helix', (v) => [...new Set(listOf(v['tool.helices'] ?? v['tool.helix']).map((h) => display(h)))].join(', ') || 'none'],
  ['Runout', (v) => (v['tool.runout'] ? listOf(v['tool.runout']).map((r) => display(r)).join(', ') : null)],
  ['Engagement', engaged], ['Feed', feed],
  ['Cutting coefficients', coefficients], ['Their origin', (_, run) => origin(run)],
  ['Material', material], ['Fixture', fixture], ['Robot', (_, run) => robot(run)],
];

/** Table and sketch of the runs that cut; nothing where none does. */
export function whatWasCut(runs) {
  const cuts = runs.filter(hasCut);
  if (!cuts.length) return [];
  const filled = rows.map(([name, of]) => [name, ...cuts.map((run) => ({ text: of(run.case_values, run), class: 'prose' }))]).filter(([, ...values]) => values.some(({ text }) => text));
  const sketches = cuts.map((run) => sketch(run, cuts.length > 1)).filter(Boolean);
  return [el('div', { class: 'cut' }, table('What was cut', ['', ...cuts.map((run) => (cuts.length > 1 ? run.label : 'Cut'))], filled, cuts.length > 1), el('div', {}, sketches))];
}

/** The cut seen from the spindle, feed to the right: angles count from the top, clockwise, as the tool turns. */
function sketch(run, labelled) {
  const e = engagement(run.case_values);
  if (!e) return null;
  const R = 46;
  const at = (angle, r = R) => [r * Math.sin(angle), -r * Math.cos(angle)].map((x) => x.toFixed(2)).join(' ');
  const arc = (from, to, r = R) => `A ${r} ${r} 0 ${to - from > Math.PI ? 1 : 0} 1 ${at(to, r)}`;
  const wedge = ([from, to]) => (to - from > 2 * Math.PI - 1e-6 ? svg('circle', { r: R, class: 'engaged' }) : svg('path', { class: 'engaged', d: `M 0 0 L ${at(from)} ${arc(from, to)} Z` }));
  const teeth = toothAngles(run.case_values).map((angle) => svg('circle', { class: 'tooth', r: 2.2, ...place(at(angle)) }));
  return el('figure', { class: 'sketch' }, svg('svg', { viewBox: '-84 -80 168 160', role: 'img', 'aria-label': `The engagement, seen from the spindle: ${engaged(run.case_values)}.` },
    ...stock(e, R), svg('circle', { r: R, class: 'cutter' }), ...e.arcs.map(wedge), ...teeth,
    svg('path', { class: 'turns', d: `M ${at(-2.2, 20)} ${arc(-2.2, 0.4, 20)}` }), svg('path', { class: 'head', d: 'M 0 -5 L 9 0 L 0 5 Z', transform: `translate(${at(0.4, 20)}) rotate(26)` }),
    svg('path', { class: 'turns', d: 'M 0 0 H 66' }), svg('path', { class: 'head', d: 'M 66 -5 L 77 0 L 66 5 Z' }), svg('text', { x: 57, y: -8 }, 'feed')),
  el('figcaption', { class: 'note' }, `${labelled ? `${run.label}: t` : 'T'}he cut seen from the spindle, to scale; the shaded sector is where teeth cut.`));
}

/** Each tooth follows the one before it by its pitch. */
function toothAngles(values) {
  const count = Math.min(60, Number(values['tool.teeth']) || 0);
  const pitches = listOf(values['tool.pitches']).map((text) => quantity(text)?.value);
  const angles = [0];
  for (let j = 1; j < count; j++) angles.push(angles[j - 1] - (Number.isFinite(pitches[j]) ? pitches[j] : (2 * Math.PI) / count));
  return angles;
}

const place = (text) => { const [cx, cy] = text.split(' '); return { cx, cy }; };

/** The part: ahead of the cutter its wall is thicker by the radial depth. Unknown where angles are given. */
function stock({ radius, radial, up }, R) {
  if (radial === null) return [];
  const a = (radial / radius) * R;
  const [far, side] = [78, up ? -1 : 1];
  const corner = [[-far, R], [0, R], [0, R - a], [far, R - a], [far, far], [-far, far]].map(([x, y]) => `${x},${(side * y).toFixed(2)}`);
  return [svg('polygon', { class: 'stock', points: corner.join(' ') }), svg('text', { x: -76, y: up ? -68 : 74 }, 'part')];
}
