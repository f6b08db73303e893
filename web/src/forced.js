// The forced motion of a stable cut: over the speeds of a chart, the surface that it leaves, its largest force and what is left of a contact's preload.

import { choice, el } from './dom.js';
import { numbers } from './decode.js';
import { faint } from './colours.js';
import { number, plain, scaled } from './format.js';
import { folded, plot } from './plot.js';
import { lobeTitle, withRobot } from './lobes.js';

const panels = [
  { key: 'surface_location_error_m', title: 'Surface location error (µm)', short: 'Surface (µm)', unit: 'µm', factor: 1e6, name: 'surface location error (m)' },
  { key: 'peak_force_n', title: 'Peak force (N)', short: 'Force (N)', unit: 'N', factor: 1, name: 'peak force (N)', fromZero: true },
  { key: 'least_contact_force_n', title: 'Least contact force (N)', short: 'Contact (N)', unit: 'N', factor: 1, name: 'least contact force (N)', fromZero: true },
];

/** The curves of all runs; the supported part's first, since that is the cut which is asked about. */
const curvesOf = (runs) => runs.flatMap((run) => (run.lobes ?? []).flatMap((lobe) => (lobe.forced ?? []).map((curve) => ({ run, lobe, curve })))).sort((a, b) => withRobot(b.lobe.name) - withRobot(a.lobe.name));

/** The folded plot; null where no run has such curves. */
export function forcedOverSpeed(runs) {
  const curves = curvesOf(runs);
  if (!curves.length) return null;
  const state = { at: 0 };
  const title = ({ run, lobe, curve }) => `${runs.length > 1 ? `${run.label}: ` : ''}${lobeTitle(lobe.name)}, ${number(curve.depth_m * 1e3, 4)} mm`;
  const chart = plot({ name: 'forced', label: 'Surface and forces over the speed', build: (colours, narrow) => build(curves[state.at], colours, narrow), columns: () => columns(curves[state.at].curve) });
  return folded('Over the spindle speed', chart, el('div', { class: 'controls' },
    choice('Cut', curves.map((c, i) => [i, title(c)]), state.at, (v) => { state.at = Number(v); chart.draw(); })), chart.figure);
}

/** Stretches of the speed at which the cut chatters, each from amid its neighbours: [[from, to], …]. */
function chattering(rpm, force) {
  const stable = Array.from(force, Number.isFinite);
  const amid = (k) => (k === 0 ? rpm[0] : k === rpm.length ? rpm[k - 1] : 0.5 * (rpm[k - 1] + rpm[k]));
  const stretches = [];
  for (let k = 0; k < rpm.length; k++) {
    if (stable[k]) continue;
    const begin = k;
    while (k + 1 < rpm.length && !stable[k + 1]) k++;
    stretches.push([amid(begin), amid(k + 1)]);
  }
  return stretches;
}

function build({ run, lobe, curve }, colours, narrow) {
  const x = Array.from(numbers(curve.rpm));
  const shown = panels.filter(({ key }) => curve[key] && numbers(curve[key]).some(Number.isFinite));
  const n = Math.max(1, shown.length);
  const axis = (i) => (i ? `y${i + 1}` : 'y');
  const colour = colours[lobe.name] ?? colours.robot;
  const data = shown.map((panel, i) => ({ name: panel.title, x, y: scaled(numbers(curve[panel.key]), panel.factor), yaxis: axis(i), mode: 'lines+markers', connectgaps: false, showlegend: false,
    line: { simplify: false, color: colour, width: 1.8 }, marker: { size: 3, color: colour }, hovertemplate: `%{y:.4~g} ${panel.unit}`, meta: panel.key }));
  const stretches = chattering(x, numbers(curve.peak_force_n));
  data.push({ name: 'chatter: no forced motion is seen', x: [null], y: [null], mode: 'markers', showlegend: stretches.length > 0, hoverinfo: 'skip', marker: { symbol: 'square', size: 12, color: faint(colours.bad, 0.25) }, meta: 'chatter' });
  const preload = run.summary.lobes?.find((l) => l.name === lobe.name)?.forced_over_speed?.find((f) => Math.abs(f.depth_m - curve.depth_m) <= 1e-9 * f.depth_m)?.preload_n;
  const contact = shown.findIndex(({ key }) => key === 'least_contact_force_n');
  const level = (value, dash) => ({ type: 'line', xref: 'paper', x0: 0, x1: 1, yref: axis(contact), y0: value, y1: value, line: { color: dash ? colours.muted : colours.bad, width: 1.2, dash: dash ?? 'solid' } });
  const height = (1 - 0.05 * (n - 1)) / n;
  const axes = Object.fromEntries(shown.map((panel, i) => [`yaxis${i ? i + 1 : ''}`, { title: narrow ? panel.short : panel.title, domain: [1 - (i + 1) * height - i * 0.05, 1 - i * (height + 0.05)].map((d) => Math.max(0, d)), ...(panel.fromZero ? { rangemode: 'tozero' } : { zeroline: true }) }]));
  return { data, layout: {
    height: (narrow ? 120 : 150) + 150 * n, hovermode: 'x unified', hoversubplots: 'axis', uirevision: `forced ${lobe.name} ${curve.depth_m}`, margin: { l: narrow ? 56 : 72, r: narrow ? 10 : 18, t: 32, b: 46 },
    xaxis: { title: 'Spindle speed (rpm)', anchor: axis(n - 1), unifiedhovertitle: { text: '%{x:.5~g} rpm' }, range: [x[0], x.at(-1)] }, ...axes,
    shapes: [...stretches.map(([x0, x1]) => ({ type: 'rect', x0, x1, yref: 'paper', y0: 0, y1: 1, layer: 'below', fillcolor: faint(colours.bad, 0.14), line: { width: 0 } })),
      ...(contact < 0 ? [] : [level(0), ...(preload ? [level(preload, 'dash')] : [])])],
    annotations: contact < 0 || !preload ? [] : [{ text: plain('preload'), xref: 'paper', x: 0.995, xanchor: 'right', yref: axis(contact), y: preload, yanchor: 'top', showarrow: false, font: { size: 11, color: colours.muted } }],
  } };
}

function columns(curve) {
  return [{ name: 'spindle speed (rpm)', values: Array.from(numbers(curve.rpm)) }, ...panels.filter(({ key }) => curve[key]).map(({ key, name }) => ({ name, values: scaled(numbers(curve[key]), 1) }))];
}

/** What the section shows, in a sentence. */
export const forcedLead = () => 'The vibration that the teeth force in a stable cut: where the wall comes to lie (positive: overcut), how large the force on the tool becomes, and what is left of the force in a contact with a preload.';
