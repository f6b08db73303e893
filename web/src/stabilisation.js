// The stabilisation diagram of a fit: poles of all orders over frequency, and the command line that names those which are chosen by clicks.

import { commandOf, toggled } from './chosen.js';
import { cmif } from './cmif.js';
import { faint } from './colours.js';
import { numbers } from './decode.js';
import { button, choice, el } from './dom.js';
import { number } from './format.js';
import { plot } from './plot.js';

// Marks by the bits that tell agreement with the order before: 1 frequency, 2 damping, 4 participation of the references.
const kinds = [
  { agrees: 7, name: 'stable', symbol: 'circle', colour: 'supported', size: 7 },
  { agrees: 3, name: 'frequency and damping', symbol: 'triangle-up', colour: 'part', size: 8 },
  { agrees: 5, name: 'frequency and vector', symbol: 'diamond', colour: 'robot', size: 7 },
  { agrees: 1, name: 'frequency', symbol: 'circle-open', colour: 'mark', size: 6 },
  { agrees: 0, name: 'new', symbol: 'x-thin', colour: 'muted', size: 5 },
];
const verticals = { order: { title: 'Order', axis: 'Order of the model' }, damping: { title: 'Damping', axis: 'Damping ratio (%)' } };

/** { chart, content } of the diagram, or null where there is none. */
export function stabilisation(fit) {
  if (!fit.diagram) return null;
  const poles = { order: numbers(fit.diagram.order), hz: numbers(fit.diagram.hz), damping: numbers(fit.diagram.damping), agrees: numbers(fit.diagram.agrees) };
  const behind = cmif(fit.frf, 1);
  const fitted = fit.figures.modes.map((mode) => mode.frequency_hz);
  const state = { vertical: 'order', chosen: fitted };
  const line = el('code', { class: 'command' });
  const chart = plot({ name: 'stabilisation', label: 'Stabilisation diagram', build: (colours, narrow) => build(poles, behind, state, colours, narrow), columns: () => columns(poles),
    click: ({ points }) => { const pole = points.find((p) => p.data.meta?.startsWith('poles')); if (pole) choose(toggled(state.chosen, pole.x)); } });
  const show = () => { line.textContent = commandOf(fit.command, state.chosen); };
  const choose = (chosen) => { state.chosen = chosen; show(); chart.draw(); };
  show();
  return { chart, content: [
    el('div', { class: 'controls' }, choice('Over', Object.entries(verticals).map(([k, v]) => [k, v.title]), state.vertical, (value) => { state.vertical = value; chart.draw(); }),
      button('Choose none', 'Choose no pole', () => choose([])), button('As fitted', 'Choose the poles of this fit', () => choose(fitted))),
    chart.figure,
    el('p', { class: 'note' }, 'The fit with the poles that are chosen:'),
    el('div', { class: 'chosen' }, line, button('Copy', 'Copy the command', () => copy(line)))] };
}

/** To the clipboard; where the browser does not let a file do that, the text is selected. */
async function copy(line) {
  getSelection().selectAllChildren(line);
  try { await navigator.clipboard.writeText(line.textContent); } catch { document.execCommand('copy'); }
}

function build(poles, behind, state, colours, narrow) {
  const value = state.vertical === 'order' ? poles.order : poles.damping;
  const factor = state.vertical === 'order' ? 1 : 100;
  const data = behind ? [{ name: 'largest singular value of H', meta: 'cmif', x: Array.from(behind.hz), y: Array.from(behind.values[0], (v) => (v > 0 ? v * 1e6 : null)), yaxis: 'y2', mode: 'lines', line: { color: faint(colours.muted, 0.55), width: 1.4, simplify: false }, hoverinfo: 'skip' }] : [];
  for (const kind of kinds) {
    const at = Array.from(poles.agrees.keys()).filter((i) => poles.agrees[i] === kind.agrees);
    if (!at.length) continue;
    data.push({ name: kind.name, meta: `poles ${kind.agrees}`, x: at.map((i) => poles.hz[i]), y: at.map((i) => value[i] * factor), customdata: at.map((i) => [poles.order[i], poles.damping[i] * 100]), mode: 'markers',
      marker: { symbol: kind.symbol, size: kind.size, color: colours[kind.colour], line: { width: kind.symbol === 'x-thin' ? 1 : 0, color: colours[kind.colour] } },
      hovertemplate: '%{x:.6~g} Hz, damping %{customdata[1]:.3~g} %, order %{customdata[0]}<extra></extra>' });
  }
  return { data, layout: { height: narrow ? 440 : 540, hovermode: 'closest', uirevision: state.vertical, margin: { l: narrow ? 50 : 60, r: narrow ? 46 : 64, t: 12, b: 46 },
    shapes: state.chosen.map((x) => ({ type: 'line', x0: x, x1: x, yref: 'paper', y0: 0, y1: 1, line: { color: colours.ink, width: 1.2, dash: 'dot' }, layer: 'below' })),
    xaxis: { title: 'Frequency (Hz)', showspikes: false, mirror: false }, yaxis: { title: verticals[state.vertical].axis, rangemode: 'tozero', mirror: false },
    ...(behind ? { yaxis2: { title: narrow ? undefined : 'Singular value (µm/N)', type: 'log', dtick: 1, overlaying: 'y', side: 'right', showgrid: false, mirror: false } } : {}) } };
}

function columns({ order, hz, damping, agrees }) {
  const bit = (b) => Array.from(agrees, (a) => (a & b ? 1 : 0));
  return [{ name: 'order', values: Array.from(order) }, { name: 'frequency (Hz)', values: Array.from(hz) }, { name: 'damping ratio', values: Array.from(damping) },
    { name: 'frequency agrees', values: bit(1) }, { name: 'damping agrees', values: bit(2) }, { name: 'vector agrees', values: bit(4) }];
}

/** A sentence or two on what the diagram shows. */
export function stabilisationLead(fit) {
  const stable = fit.stable.length;
  return `Poles of models of rising order against the order before: what is real stays. ${stable} ${stable === 1 ? 'frequency stays' : 'frequencies stay'} over the orders; dotted lines are ${number(fit.figures.modes.length)} modes of this fit. Click on poles to choose others: the line below fits with them.`;
}
