// Predictions at postures that were held out of the learning, over what was measured there, with their intervals of 95 %.

import { numbers } from './decode.js';
import { choice, el } from './dom.js';
import { number, percent, plain } from './format.js';
import { placeText, rowsOf } from './places.js';
import { plot } from './plot.js';

const reach = 1.96; // standard deviations

/** Points { x, y, low, high, inside, text } and words of each quantity. */
function quantities(found) {
  const { names, figures: { over } } = found;
  const places = rowsOf(found.places);
  const where = (i) => `${names[i]} (${placeText(over, places[i])})`;
  const list = new Map();
  if (found.depths) {
    const [at, x, y, low, high] = ['posture', 'measured_m', 'predicted_m', 'low_m', 'high_m'].map((key) => Array.from(numbers(found.depths[key])));
    list.set('depth', { title: 'limiting depths', x: 'With the measured modes (mm)', y: 'Predicted by the others (mm)', diagonal: true, log: true, points: at.map((i, k) => ({ x: x[k] * 1e3, y: y[k] * 1e3, low: low[k] * 1e3, high: high[k] * 1e3,
      inside: x[k] >= low[k] && x[k] <= high[k], text: `${where(i)}: ${number(y[k] * 1e3, 3)} mm for ${number(x[k] * 1e3, 3)} mm` })) });
  }
  const { modes } = found;
  const [at, mode, measured, predicted, deviation] = [numbers(modes.posture), numbers(modes.mode), ...['measured', 'predicted', 'deviation'].map((key) => rowsOf(modes[key]))];
  const ofModes = (t, factor, unit) => Array.from(at, (i, k) => {
    const [error, width] = [predicted[k][t] - measured[k][t], reach * deviation[k][t]];
    return { x: Math.exp(measured[k][t]) * factor, y: 100 * error, low: 100 * (error - width), high: 100 * (error + width), inside: Math.abs(error) <= width, text: `mode ${mode[k]} at ${where(i)}: ${number(Math.exp(measured[k][t]) * factor, 4)} ${unit}, ${percent(error, 2)} off` };
  });
  list.set('frequency', { title: 'frequencies', x: 'Measured frequency (Hz)', y: 'Error of the prediction (%)', log: true, points: ofModes(0, 1, 'Hz') });
  list.set('damping', { title: 'damping ratios', x: 'Measured damping ratio (%)', y: 'Error of the prediction (%)', points: ofModes(1, 100, '%') });
  return list;
}

/** { chart, content } of the comparison. */
export function heldOut(found) {
  const list = quantities(found);
  const state = { show: list.keys().next().value };
  const chart = plot({ name: 'held-out', label: 'Predicted over measured', build: (colours, narrow) => build(list.get(state.show), colours, narrow), columns: () => columns(list.get(state.show)) });
  return { chart, content: [el('div', { class: 'controls' }, choice('Of', [...list].map(([key, { title }]) => [key, title]), state.show, (v) => { state.show = v; chart.draw(); })), chart.figure] };
}

function build({ title, x, y, diagonal, log, points }, colours, narrow) {
  const group = (name, inside, symbol, color) => {
    const some = points.filter((p) => p.inside === inside);
    return some.length ? [{ name: `${name} (${some.length})`, x: some.map((p) => p.x), y: some.map((p) => p.y), mode: 'markers', marker: { symbol, size: 7, color }, meta: inside ? 'inside' : 'outside',
      error_y: { type: 'data', symmetric: false, array: some.map((p) => p.high - p.y), arrayminus: some.map((p) => p.y - p.low), color, thickness: 0.9, width: 0 },
      customdata: some.map((p) => plain(p.text)), hovertemplate: '%{customdata}<extra></extra>' }] : [];
  };
  const xs = points.map((p) => p.x);
  const [from, to] = [xs.reduce((a, b) => Math.min(a, b), Infinity), xs.reduce((a, b) => Math.max(a, b), -Infinity)];
  const exact = { name: 'exact', x: [from, to], y: diagonal ? [from, to] : [0, 0], mode: 'lines', line: { color: colours.muted, width: 1.2, dash: 'dash' }, hoverinfo: 'skip', meta: 'exact' };
  return { data: [exact, ...group('within its interval', true, 'circle', colours.part), ...group('beyond its interval', false, 'x', colours.bad)], layout: {
    height: narrow ? 360 : 440, hovermode: 'closest', uirevision: title, xaxis: { title: x, type: log ? 'log' : 'linear', showspikes: false, ...(log ? { nticks: 8 } : {}) }, yaxis: { title: y, type: diagonal ? 'log' : 'linear' } } };
}

const columns = ({ x, y, points }) => [{ name: x, values: points.map((p) => p.x) }, { name: y, values: points.map((p) => p.y) }, { name: 'low end of 95 %', values: points.map((p) => p.low) }, { name: 'high end of 95 %', values: points.map((p) => p.high) }];
