// Tables: the modes, the fits, the checks.

import { el, table } from './dom.js';
import { numbers } from './decode.js';
import { aligned, isNumber, number } from './format.js';

const shownModes = 12;

/** Modes of the part alone, of the robot, and of both, with the part's mode that each of the latter is most like. */
export function modeTables(run) {
  const alone = run.summary.part?.modes ?? [];
  const robot = run.summary.robot?.modes ?? [];
  const { modes: coupled = [], main_modes: main = [] } = run.summary.coupling ?? {};
  const like = likeness(run.mac);
  return [
    alone.length ? modeTable('Part alone', alone) : null,
    coupled.length ? modeTable('Part with robot', coupled, like && ['Most like alone (MAC)', like]) : null,
    !coupled.length && main.length ? modeTable('Part with robot: main modes of the receptance', main) : null,
    robot.length ? modeTable('Robot alone', robot) : null,
  ];
}

/** One sentence on the modes that there are. */
export function modesLead(runs) {
  const any = (of) => runs.some(({ summary }) => of(summary)?.length);
  const part = any((s) => s.part?.modes);
  if (any((s) => s.coupling?.modes) || any((s) => s.coupling?.main_modes)) return part ? 'What the robot does to the part’s own frequencies and damping.' : 'Frequencies and damping of the part with the robot.';
  return part ? 'The part’s own frequencies and damping.' : 'The robot’s own frequencies and damping.';
}

function modeTable(caption, modes, extra) {
  const rows = modes.map((m, i) => [i + 1, aligned(m.frequency_hz, 5), aligned(isNumber(m.damping_ratio) ? m.damping_ratio * 100 : null, 3), ...(extra ? [extra[1](i)] : [])]);
  const head = ['Mode', 'Frequency (Hz)', 'Damping ratio (%)', ...(extra ? [extra[0]] : [])];
  const first = table(caption, head, rows.slice(0, shownModes));
  if (rows.length <= shownModes) return first;
  return el('div', {}, first, el('details', {}, el('summary', {}, `${rows.length - shownModes} more`), table(`${caption}, continued`, head, rows.slice(shownModes))));
}

function likeness(mac) {
  if (!mac) return null;
  const values = numbers(mac.values);
  const [rows, columns] = mac.values.shape;
  return (j) => {
    if (j >= columns) return '–';
    let best = 0;
    for (let i = 1; i < rows; i++) if (values[i * columns + j] > values[best * columns + j]) best = i;
    const value = values[best * columns + j];
    return value >= 0.5 ? `${best + 1} (${value.toFixed(2)})` : 'none';
  };
}

/** Fits: what each parameter was moved to, and how near that came to what was wanted. Values are in SI units. */
export function fitTables(run) {
  const fits = run.summary.updating ?? [];
  const unit = (u) => (u ? ` ${u}` : '');
  const parameters = fits.flatMap((fit) => (fit.parameters ?? []).map((p) => [fit.name, { text: p.key, class: 'prose' }, `${number(p.fitted, 5)}${unit(p.unit)}`, number(p.start, 5), { text: `${number(p.lower, 4)} to ${number(p.upper, 4)}${p.at_bound ? ', at a bound' : ''}`, class: p.at_bound ? 'bad' : undefined }]));
  const targets = fits.flatMap((fit) => (fit.targets ?? []).map((t) => [fit.converged === false ? `${fit.name}: did not converge` : fit.name, t.quantity?.replaceAll('_', ' '), withUnit(t.reached, unitOf(t.quantity), 6), withUnit(t.wanted, unitOf(t.quantity), 6)]));
  const tables = [parameters.length ? table('Fitted parameters (SI units)', ['Fit', 'Key', 'Fitted', 'Started from', 'Bounds'], parameters, true) : null,
    targets.length ? table('What they were fitted to', ['Fit', 'Quantity', 'Reached', 'Wanted'], targets, true) : null].filter(Boolean);
  return tables.length ? [el('div', {}, tables)] : [];
}

/** Checks: what came out, what was expected, and where that expectation is from. */
export function checkTable(run) {
  const checks = run.summary.checks ?? [];
  if (!checks.length) return null;
  const expected = (c) => {
    const u = unitOfCheck(c, run.summary);
    if (isNumber(c.expected)) return withUnit(c.expected, u, 5, isNumber(c.tolerance) ? ` ± ${number(c.tolerance * u[1], 2)}` : '');
    if (isNumber(c.at_most)) return `at most ${withUnit(c.at_most, u, 3)}`;
    return isNumber(c.at_least) ? `at least ${withUnit(c.at_least, u, 3)}` : '–';
  };
  return table('Checks', ['Check', 'Value', 'Expected', 'Origin', 'Holds'], checks.map((c) => [c.name, withUnit(c.value, unitOfCheck(c, run.summary), 5), expected(c), { text: c.origin, class: 'prose' },
    { text: c.ok ? '✓ yes' : '✗ no', class: c.ok ? 'good' : 'bad' }]), true);
}

/** How far the two routes to the coupled receptances are apart; null where there is one. */
export function routesNote({ label, summary }, labelled) {
  const apart = summary.coupling?.route_difference;
  if (!apart) return null;
  return el('p', { class: 'note' }, `${labelled ? `${label}: t` : 'T'}he two routes to the coupled receptance, by matrices and by receptances, differ by ${number(apart.max_relative, 2)} at ${number(apart.at_frequency_hz, 4)} Hz, relative to the largest entry.`);
}

const withUnit = (x, [unit, factor], digits, more = '') => (isNumber(x) ? `${number(x * factor, digits)}${more}${unit}` : '–');

// The end of a quantity's name: its unit as it is shown, and the factor from SI to that. The first that fits counts.
const ends = { _n_per_m: [' N/m', 1], _m_per_n: [' µm/N', 1e6], _n_s_per_m: [' N s/m', 1], _n_m: [' N m', 1], _cm3_per_min: [' cm³/min', 1], _frequency: [' Hz', 1], _hz: [' Hz', 1], _rpm: [' rpm', 1], _kg: [' kg', 1], _deg: ['°', 1], _rad: [' rad', 1],
  _m3: [' m³', 1], _w: [' W', 1], _n: [' N', 1], _s: [' s', 1], _m: [' mm', 1e3] };
const none = ['', 1];

const unitOf = (quantity = '') => Object.entries(ends).find(([end]) => quantity?.endsWith(end))?.[1] ?? none;

/** The check's own unit if it says one; else by the name of its quantity: of a fit's target, by what that is. */
function unitOfCheck({ unit, quantity = '' }, summary) {
  if (unit) return { m: [' mm', 1e3], 'm/N': [' µm/N', 1e6] }[unit] ?? [unit === '°' ? unit : ` ${unit}`, 1];
  const [, fit, target] = quantity.match(/^updating\[(\d+)\]\.targets\[(\d+)\]\.(?:reached|wanted)$/) ?? [];
  return unitOf(fit ? summary.updating?.[fit]?.targets?.[target]?.quantity : quantity.replace(/(\[\d+\])+$/, ''));
}
