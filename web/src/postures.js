// The page of a robot that was tapped at some postures: its map, how far it is to be trusted, and the posture to tap next.

import { numbers } from './decode.js';
import { learningCurve } from './curve.js';
import { el, table } from './dom.js';
import { envelopeChart } from './envelope.js';
import { hertz, isNumber, millimetres, number, percent, rpm } from './format.js';
import { heldOut } from './heldout.js';
import { placeText, rowsOf } from './places.js';
import { later } from './plot.js';
import { section } from './section.js';
import { workspace } from './workspace.js';

const mostCandidates = 8;

/** The headline, the sections, and a call that draws what is seen first. */
export function posturesPage({ postures: found, title }) {
  const { figures } = found;
  const map = found.map && workspace(found);
  const errors = found.modes && heldOut(found);
  const envelope = found.envelope && envelopeChart(found.envelope, figures.envelope.split_hz);
  const curve = figures.curve && learningCurve(figures.curve);
  for (const chart of [errors?.chart, curve?.chart, envelope]) if (chart) later(chart.draw);
  const sections = [
    section('map', 'Over the workspace', () => mapLead(figures), [map?.content]),
    section('next', 'The posture to tap next', () => nextLead(figures), [figures.next && candidates(found)]),
    section('held-out', 'Postures that were held out', () => heldOutLead(figures), [errors?.content, errors && modeTable(figures)]),
    section('curve', 'How many postures', () => curveLead(figures), [curve?.content]),
    section('remarks', 'Doubts and remarks', () => 'What a user should know before the map is used.', [remarks(figures)]),
    section('envelope', 'Low and high modes', () => envelopeLead(figures, found), [envelope?.figure]),
    section('sharing', 'Learning together', () => sharingLead(figures), [figures.shared?.length && sharingTable(figures)]),
    errors ? null : section('modes', 'Modes', () => 'Followed over the postures; a number is one mode of the robot everywhere.', [modeTable(figures)]),
  ].filter(Boolean);
  return { header: header(found, title), sections, start: () => map?.chart.draw() };
}

function header(found, title) {
  const { figures } = found;
  const { map, depths, next, modes, doubts } = figures;
  const tiles = [
    map && isNumber(map.least_depth_m) && ['Least stable depth', millimetres(map.least_depth_m), `at ${placeText(figures.over, map.least_depth_at)}; 95 % lie in ${number(map.least_depth_low_m * 1e3, 3)} … ${millimetres(map.least_depth_high_m)}`],
    depths && ['Error of a predicted depth', percent(depths.median_error, 2), `median of ${figures.postures} postures held out; nine in ten within ${percent(depths.ninetieth_error, 2)}`],
    depths && ['Within their intervals', percent(depths.covered, 3), 'of the depths held out; 95 % are meant to be', depths.covered >= 0.9 ? 'good' : 'bad'],
    !depths && modes[0]?.numbers?.length > 0 && ['Error of a predicted frequency', percent(Math.max(...modes.map((m) => m.numbers[0].median_error)), 2), 'median at postures held out, of the mode that is worst'],
    next && ['A tap more would take', percent(next.reduction, 2), `of the variance of the ${next.of_depth ? 'depth' : 'frequencies'} along the path, at ${placeText(figures.over, next.at)}`],
    doubts.length > 0 && ['Doubts', number(doubts.length), 'see below', 'bad'],
  ].filter(Boolean);
  return el('header', { class: 'headline', id: 'answer' }, el('h1', {}, title), el('p', { class: 'answer' }, answer(found)),
    el('dl', { class: 'tiles' }, tiles.map(([name, value, note, mark]) => el('div', {}, el('dt', {}, name), el('dd', { class: mark }, value), el('dd', { class: 'note' }, note)))));
}

function answer({ figures: { map, postures, modes, spindle_speed_rpm: speed }, map: { rpm: speeds } = {} }) {
  const tapped = `${postures} tapped postures`;
  if (map && isNumber(map.least_depth_m)) return `Between its ${tapped} the robot cuts ${number(map.least_depth_m * 1e3, 3)} to ${millimetres(map.largest_depth_m)} deep without chatter${new Set(numbers(speeds)).size > 1 ? ', each at its best speed' : ` at ${rpm(speed)}`}.`;
  if (map) return `Between its ${tapped} the robot’s first frequency lies between ${number(map.least_first_hz, 4)} and ${hertz(map.largest_first_hz)}.`;
  return `${modes.length} modes were followed over ${tapped}, from ${number(modes[0].least_frequency_hz, 4)} to ${hertz(modes.at(-1).largest_frequency_hz)}.`;
}

function mapLead({ map, over, depths }) {
  const depth = map && isNumber(map.least_depth_m);
  return `${depth ? 'The deepest cut without chatter' : 'The lowest frequency'} at ${map.places} places between the tapped postures${over.length > 2 ? `, of which one slice is shown: two of ${over.length} coordinates are its axes, the others are fixed` : ''}. The range beneath a value is meant to hold the true one in 95 of 100 cases${depths ? `; at the postures held out it did in ${percent(depths.covered, 2)}` : ''}.`;
}

function nextLead({ next }) {
  return `A test there is expected to take ${percent(next.reduction, 2)} of what is still uncertain in ${next.of_depth ? 'the limiting depth' : 'the frequencies'} along the path of the cut, whatever it finds.`;
}

function candidates({ next, figures }) {
  const [places, share] = [rowsOf(next.candidates), numbers(next.reduction)];
  const order = places.map((_, i) => i).sort((a, b) => share[b] - share[a]).slice(0, mostCandidates);
  const along = rowsOf(next.path);
  return [table('Best candidates', ['', ...figures.over, 'Uncertainty taken'], order.map((i, k) => [String(k + 1), ...places[i].map((v) => number(v, 4)), percent(share[i], 2)])),
    el('p', { class: 'note' }, along.length === 1 ? `The path is one place: ${placeText(figures.over, along[0])}.` : `The path has ${along.length} places.`)];
}

function heldOutLead({ depths }) {
  return `Each posture was predicted by folds that had not learned from it: what the map is worth where nobody tapped. An arm as the mean, if there is one, was calibrated on all of them.${depths ? ` Depths are off by ${percent(depths.median_error, 2)} in the median, and by ${percent(depths.largest_error, 2)} at ${depths.worst_posture}, the worst.` : ''} Bars are intervals of 95 %.`;
}

function curveLead({ curve: { tested, plain, with_arm: arm = [] } }) {
  const key = isNumber(plain[0].depth_error) ? 'depth_error' : 'frequency_error';
  const what = key === 'depth_error' ? 'depth' : 'frequency';
  const at = (points) => `${percent(points[0][key], 2)} with ${points[0].postures} and ${percent(points.at(-1)[key], 2)} with ${points.at(-1).postures} of the others`;
  return `${tested} postures were never learned from. Their ${what} is predicted with a median error of ${at(plain)}.${arm.length ? ` With the arm’s model, calibrated on the same taps, it is ${at(arm)}.` : ''} A curve that still falls says that more postures pay.`;
}

function modeTable({ modes }) {
  const errors = modes.some((m) => m.numbers?.length);
  const most = (n) => `${percent(n.largest_error, 2)} at ${n.worst_posture}`;
  const rows = modes.map((m) => [String(m.mode), String(m.postures), `${number(m.least_frequency_hz, 4)} … ${number(m.largest_frequency_hz, 4)}`,
    ...(errors ? (m.numbers?.length > 1 ? [percent(m.numbers[0].median_error, 2), most(m.numbers[0]), percent(m.numbers[0].covered, 3), percent(m.numbers[1].median_error, 2), most(m.numbers[1]), percent(m.numbers[1].covered, 3)] : [null, null, null, null, null, null]) : [])]);
  return table('Modes', ['Mode', 'Postures', 'Frequency (Hz)', ...(errors ? ['Error of frequency, median', 'largest', 'in 95 %', 'Error of damping, median', 'largest', 'in 95 %'] : [])], rows);
}

function remarks({ doubts, notes }) {
  const list = (title, lines) => lines.length > 0 && [el('h3', {}, title), el('ul', { class: 'sentences' }, lines.map((line) => el('li', {}, line)))];
  return [doubts.length ? list('Doubts', doubts) : el('p', {}, 'Nothing speaks against the map.'), list('Remarks', notes)];
}

function envelopeLead({ envelope, over }, { asked }) {
  return `At ${placeText(over, asked)}: the limits of the arm’s slow modes by themselves, of the fast modes of spindle and tool by themselves, and of all together, which is the answer. Both kinds share one surface that the next tooth cuts, so that together they may allow less than either. The arm’s modes alone allow ${millimetres(envelope.least_low_m)} at every speed, all together ${millimetres(envelope.least_together_m)}.`;
}

const groups = [['frequency_and_damping', 'Frequency and damping'], ['real_parts', 'Residue, real parts'], ['imaginary_parts', 'Residue, imaginary parts']];
const verdicts = { gains: ['✓ gains', 'good'], none: ['same', undefined], loses: ['✗ loses', undefined] };

function sharingLead({ shared }) {
  const count = (kind) => shared.filter((s) => s.sharing === kind).length;
  return `Numbers of a mode that are alike can be learned by one process instead of one each. R² at postures held out tells whether that pays (1: all of the variation is predicted): of ${shared.length} groups ${count('gains')} gain, ${count('none')} share nothing, ${count('loses')} lose. The map learns each number by itself.`;
}

function sharingTable({ shared }) {
  const modes = [...new Set(shared.map((s) => s.mode))];
  const cell = (mode, group) => {
    const one = shared.find((s) => s.mode === mode && s.group === group);
    if (!one) return null;
    const [word, mark] = verdicts[one.sharing];
    return { text: `${number(one.r2_alone, 3)} → ${number(one.r2_together, 3)} ${word}`, class: mark };
  };
  return table('R² alone → together', ['Mode', ...groups.map(([, text]) => text)], modes.map((mode) => [String(mode), ...groups.map(([group]) => cell(mode, group))]));
}
