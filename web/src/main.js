// The page: its sections in order, from the data document.

import './csp.js';
import { button, el, icon } from './dom.js';
import { readDocument } from './decode.js';
import { toggleTheme } from './colours.js';
import { drawWaiting, later } from './plot.js';
import { forcesOverATurn } from './turn.js';
import { whatWasCut } from './cut.js';
import { firstLines, headline } from './headline.js';
import { remarks } from './remarks.js';
import { lobes, lobesLead } from './lobes.js';
import { forcedLead, forcedOverSpeed } from './forced.js';
import { paths } from './paths.js';
import { receptances, receptancesLead } from './receptances.js';
import { checkTable, fitTables, routesNote, modesLead, modeTables } from './tables.js';
import { macPlot } from './mac.js';
import { modes3d } from './modes3d.js';
import { quality } from './reduction.js';
import { provenance } from './provenance.js';
import { simulation, simulationLead } from './simulation.js';
import { section } from './section.js';
import { fitPage } from './fit.js';
import { posturesPage } from './postures.js';

/** The runs' own blocks, side by side and each under its label where there are two. */
function sideBySide(runs, of) {
  const blocks = runs.map((run, i) => [run, of(run, i).filter(Boolean)]).filter(([, b]) => b.length);
  if (!blocks.length) return [];
  return [el('div', { class: 'columns' }, blocks.flatMap(([run, b]) => (runs.length > 1 ? [el('div', {}, el('h3', {}, run.label), b)] : b)))];
}

function macs(run, i) {
  const plots = [];
  if (run.mac) plots.push(['Part against part with robot', macPlot(`mac-${i}`, 'MAC of the part alone and with robot', run.mac, run.mac.rows, run.mac.columns)]);
  if (run.auto_mac) plots.push(['Part against itself', macPlot(`auto-mac-${i}`, 'auto-MAC of the part', { ...run.auto_mac, column_hz: run.auto_mac.row_hz }, 'part alone', 'part alone')]);
  plots.forEach(([, p]) => later(p.draw));
  return plots.map(([title, p]) => el('div', {}, el('h4', {}, title), p.figure));
}

function macLead(runs) {
  return ['1 says the same shape, 0 nothing in common.', runs.some((run) => run.mac) ? 'Against the part with robot, a mode off the diagonal has changed its place.' : '',
    runs.some((run) => run.auto_mac) ? 'Against itself, a high value off the diagonal says that two modes are hard to tell apart.' : ''].filter(Boolean).join(' ');
}

/** The page of one run or of several: what stands above the sections, these, and what to draw at once. */
function runsPage(data) {
  const { runs } = data;
  const charts = { lobes: lobes(runs), path: paths(runs), frf: receptances(runs), shapes: modes3d(runs), quality: quality(runs) };
  for (const p of [charts.frf?.chart, charts.path?.chart, charts.quality?.chart]) if (p) later(p.draw);
  const macBlocks = sideBySide(runs, macs);
  const sections = [
    section('lobes', 'Stability lobes', () => lobesLead(runs), [charts.lobes?.content]),
    section('path', 'Along the path', () => 'The limiting depth by position and speed; the lower panel gives the depth that is stable at every position.', [charts.path?.content]),
    section('forced', 'Surface and forces', forcedLead, [forcedOverSpeed(runs), forcesOverATurn(runs)]),
    section('simulation', 'Simulation', () => simulationLead(runs), [simulation(runs)]),
    section('cut', 'What was cut', () => 'Cutter, engagement, coefficients, material and fixture, as the case has them with every default.', [whatWasCut(runs)]),
    section('remarks', 'Remarks', () => 'What the run has to say of its limits and of their errors.', [remarks(data, firstLines(data))]),
    section('receptances', 'Receptances', () => receptancesLead(runs), [charts.frf?.content]),
    section('modes', 'Modes', () => modesLead(runs), [sideBySide(runs, modeTables), macBlocks.length ? el('h3', { id: 'mac' }, 'Likeness of the shapes (MAC)') : null, macBlocks.length ? el('p', { class: 'lead' }, macLead(runs)) : null, macBlocks]),
    section('shapes', 'Mode shapes', () => 'Drag to turn; click, then scroll to zoom. The motion is drawn much enlarged.', [charts.shapes?.content]),
    section('fits', 'Fitted parameters', () => 'Values of the case that the run changed so that it gives what was measured.', [sideBySide(runs, fitTables)]),
    section('quality', charts.quality?.title, () => charts.quality.lead, [charts.quality?.content]),
    section('checks', 'Checks', () => 'Values that the case expects, with where the expectation comes from.', [runs.map((run) => [runs.length > 1 && checkTable(run) && el('h3', {}, run.label), checkTable(run), routesNote(run, runs.length > 1)])]),
    section('provenance', 'Provenance', () => 'What was computed, from what, by which program.', [provenance(data)]),
  ].filter(Boolean);
  return { header: headline(data), sections, start: () => { charts.lobes?.chart.draw(); charts.shapes?.start(); } };
}

function main() {
  const page = document.getElementById('page');
  try {
    const data = readDocument();
    const { header, sections, start } = (data.fit ? fitPage : data.postures ? posturesPage : runsPage)(data);
    const links = [['answer', 'Answer'], ...sections.map((s) => [s.id, s.title])];
    page.replaceChildren(
      el('nav', { 'aria-label': 'Contents' }, el('div', { class: 'links' }, links.map(([id, title]) => el('a', { href: `#${id}` }, title))),
        button(icon('half'), 'Light or dark', toggleTheme)),
      el('main', {}, header, sections, el('footer', {}, `Made by ${data.program}. This file holds all that it shows and fetches nothing.`)));
    start();
  } catch (error) {
    page.replaceChildren(el('p', { class: 'failure', role: 'alert' }, `This page cannot be shown: ${error.message}.`));
    console.error(error);
  }
  ready();
  drawWaiting();
}

/** Says when the page can be used, in ms since it was opened. */
function ready() {
  const now = performance.now();
  document.documentElement.dataset.ready = now.toFixed(0);
  dispatchEvent(new CustomEvent('thinwall:ready', { detail: now }));
}

main();
