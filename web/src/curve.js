// Learning curves: errors at postures that were not learned from, over the number of those that were.

import { choice, el } from './dom.js';
import { isNumber } from './format.js';
import { plot } from './plot.js';

const quantities = { depth_error: 'limiting depth', frequency_error: 'frequencies' };

/** { chart, content } of the curves of postures.json. */
export function learningCurve({ plain, with_arm: withArm = [] }) {
  const shown = Object.keys(quantities).filter((key) => plain.some((point) => isNumber(point[key])));
  const state = { show: shown[0] };
  const chart = plot({ name: 'curve', label: 'Learning curve', build: (colours, narrow) => build(plain, withArm, state.show, colours, narrow), columns: () => columns(plain, withArm, shown) });
  return { chart, content: [shown.length > 1 && el('div', { class: 'controls' }, choice('Error of', shown.map((key) => [key, quantities[key]]), state.show, (key) => { state.show = key; chart.draw(); })), chart.figure] };
}

function build(plain, withArm, key, colours, narrow) {
  const curve = (name, meta, points, color, symbol) => ({ name, meta, x: points.map((p) => p.postures), y: points.map((p) => (isNumber(p[key]) ? 100 * p[key] : null)), mode: 'lines+markers', line: { color, width: 2 }, marker: { size: 8, symbol }, hovertemplate: '%{x} postures: %{y:.3~g} %' });
  const data = [curve('from taps alone', 'plain', plain, colours.part, 'circle'), ...(withArm.length ? [curve('with the arm’s model as the mean', 'arm', withArm, colours.supported, 'diamond')] : [])];
  return { data, layout: { height: narrow ? 320 : 380, hovermode: 'closest', showlegend: true, uirevision: key, xaxis: { title: 'Tapped postures', type: 'log', tickvals: plain.map((p) => p.postures), showspikes: false }, yaxis: { title: `Median error of ${narrow ? '' : 'the '}${key === 'depth_error' ? 'depth' : 'frequencies'} (%)`, rangemode: 'tozero' } } };
}

function columns(plain, withArm, shown) {
  const of = (points, name) => shown.map((key) => ({ name: `${name}: median error of ${quantities[key]}`, values: points.map((p) => p[key]) }));
  return [{ name: 'postures', values: plain.map((p) => p.postures) }, ...of(plain, 'taps alone'), ...(withArm.length ? of(withArm, 'with the arm') : [])];
}
