// The page of a fit: modes with their intervals, measured over fitted, stabilisation diagram, likeness of shapes.

import { el, table } from './dom.js';
import { aligned, isNumber, number, percent } from './format.js';
import { macPlot } from './mac.js';
import { later } from './plot.js';
import { pointShapes } from './pointshapes.js';
import { receptances } from './receptances.js';
import { section } from './section.js';
import { stabilisation, stabilisationLead } from './stabilisation.js';

/** The headline, the sections, and a call that draws what is seen first. */
export function fitPage({ fit, title }) {
  const run = { label: 'fit', summary: {}, frf: [fit.frf] };
  const frf = receptances([run]);
  const diagram = stabilisation(fit);
  const mac = fit.mac && macPlot('mac', 'auto-MAC of the modes', fit.mac, 'fit', 'fit');
  const shapes = pointShapes(fit.shapes);
  for (const chart of [diagram?.chart, mac]) if (chart) later(chart.draw);
  const sections = [
    section('receptances', 'Measured over fitted', () => receptanceLead(fit), [frf.content]),
    section('modes', 'Modes', () => 'With intervals of 95 % by the covariance of the fit; mass and stiffness along the line of the mode at the driving points. σ₂/σ₁ is how far a free residue is from one shape.', [modeTable(fit.figures)]),
    section('remarks', 'Doubts and remarks', () => 'What a user should know before the modes are used.', [remarks(fit)]),
    section('stabilisation', 'Stabilisation diagram', () => stabilisationLead(fit), [diagram?.content]),
    section('mac', 'Likeness of the modes (auto-MAC)', () => 'Of the residues as vectors: 1 says the same shape, 0 nothing in common. A high value off the diagonal says that two modes are hard to tell apart with these points.', [mac?.figure]),
    section('shapes', 'Mode shapes', () => 'On the points whose places are known. Drag to turn; the motion is drawn much enlarged.', [shapes?.content]),
    section('misfit', 'Misfit by entry', () => 'Root mean square of what the fit leaves, relative to what was measured.', [misfitTable(fit.figures)]),
  ].filter(Boolean);
  return { header: header(fit, title), sections, start: () => { frf.chart.draw(); shapes?.start(); } };
}

function header(fit, title) {
  const { modes, chi2_per_dof: chi2, lines, misfit } = fit.figures;
  const worst = Math.max(...misfit.flat());
  const hz = (mode) => number(mode.frequency_hz, 4);
  const answer = `${modes.length === 1 ? `One mode at ${hz(modes[0])} Hz` : `${modes.length} modes from ${hz(modes[0])} to ${hz(modes.at(-1))} Hz`}; the fit leaves ${percent(worst, 2)} of the entry that is worst.`;
  const tiles = [['χ² a degree of freedom', number(chi2, 3), '1 where model and weights are right', chi2 > 1.3 ? 'bad' : 'good'],
    ['Worst misfit', percent(worst, 2), `of ${misfit.length} × ${misfit[0].length} entries`],
    ['Lines', number(lines.count, 6), `${number(lines.from_hz, 5)} to ${number(lines.to_hz, 5)} Hz, weighed by ${fit.figures.weights}`],
    ['Doubts', number(fit.figures.warnings.length), fit.figures.warnings.length ? 'see below' : 'none', fit.figures.warnings.length ? 'bad' : 'good']];
  return el('header', { class: 'headline', id: 'answer' }, el('h1', {}, title), el('p', { class: 'answer' }, answer),
    el('dl', { class: 'tiles' }, tiles.map(([name, value, note, mark]) => el('div', {}, el('dt', {}, name), el('dd', { class: mark }, value), el('dd', { class: 'note' }, note)))));
}

function receptanceLead({ frf }) {
  return `Receptances as they were measured, and what the modes make of them (dashed).${frf.coherence ? ' Where the coherence (lower panel) falls below 1, noise or what is not linear makes the measurement uncertain.' : ''} The mode indicator has the singular values of the whole matrix.`;
}

function modeTable({ modes }) {
  const between = ([low, high], factor, digits) => (isNumber(low) && isNumber(high) ? `${number(low * factor, digits)} … ${number(high * factor, digits)}` : null);
  const rows = modes.map((mode, i) => [String(i + 1), aligned(mode.frequency_hz, 6), between(mode.frequency_95_hz, 1, 6), aligned(mode.damping_ratio * 100, 4), between(mode.damping_ratio_95, 100, 4),
    isNumber(mode.mass_kg) ? number(mode.mass_kg, 4) : null, isNumber(mode.stiffness_n_m) ? number(mode.stiffness_n_m * 1e-6, 4) : null, number(mode.second_singular, 2)]);
  return table('Modes', ['Mode', 'Frequency (Hz)', '95 %', 'Damping (%)', '95 %', 'Mass (kg)', 'Stiffness (N/µm)', 'σ₂/σ₁'], rows);
}

function remarks({ figures, notes }) {
  const list = (title, lines) => lines.length > 0 && [el('h3', {}, title), el('ul', { class: 'sentences' }, lines.map((line) => el('li', {}, line)))];
  return [figures.warnings.length ? list('Doubts', figures.warnings) : el('p', {}, 'Nothing speaks against the fit.'), list('Remarks', notes)];
}

function misfitTable({ misfit, responses, forces }) {
  const [mostRows, mostColumns] = [40, 12];
  const shown = misfit.slice(0, mostRows).map((row, i) => [responses[i], ...row.slice(0, mostColumns).map((m) => percent(m, 2))]);
  const more = [[responses.length - mostRows, 'responses'], [forces.length - mostColumns, 'forces']].filter(([n]) => n > 0).map(([n, what]) => `${n} more ${what}`);
  return [table('Misfit (response by force)', ['', ...forces.slice(0, mostColumns)], shown), more.length > 0 && el('p', { class: 'note' }, `${more.join(' and ')} are in fit.json.`)];
}
