// Forces on the tool over a turn, at the operating points: the resultant as a polar curve, or its components over the angle.

import { choice, el } from './dom.js';
import { numbers } from './decode.js';
import { faint } from './colours.js';
import { number } from './format.js';
import { folded, plot } from './plot.js';
import { lobeTitle, withRobot } from './lobes.js';

const components = [['feed', 'along the feed', 'part'], ['normal', 'along the normal', 'supported'], ['axis', 'along the axis', 'robot']];
const degrees = (rad) => (rad * 180) / Math.PI;

/** The folded plot of the stable points; null where no run has any. */
export function forcesOverATurn(runs) {
  const points = runs.flatMap((run) => (run.lobes ?? []).flatMap((lobe) => (lobe.forces ?? []).map((forces) => ({ run, lobe, forces })))).sort((a, b) => withRobot(b.lobe.name) - withRobot(a.lobe.name));
  if (!points.length) return null;
  const state = { at: 0, over: 'polar' };
  const title = ({ run, lobe, forces: f }) => `${runs.length > 1 ? `${run.label}: ` : ''}${lobeTitle(lobe.name)}, ${number(f.spindle_speed_rpm, 5)} rpm, ${number(f.depth_m * 1e3, 4)} mm`;
  const chart = plot({ name: 'turn', label: 'Forces over a turn', build: (colours, narrow) => (state.over === 'polar' ? polar : straight)(points[state.at], colours, narrow), columns: () => columns(points[state.at]) });
  return folded('Over a turn of the tool', chart, el('div', { class: 'controls' },
    choice('Point', points.map((p, i) => [i, title(p)]), state.at, (v) => { state.at = Number(v); chart.draw(); }),
    choice('Show', [['polar', 'resultant, polar'], ['angle', 'components over the angle']], state.over, (v) => { state.over = v; chart.draw(); })), chart.figure);
}

/** Angle (rad) and forces over one whole turn: a period that is repeated until the turn is full. */
function turn({ forces }) {
  const [rotation, ...parts] = [forces.rotation_rad, ...components.map(([key]) => forces[`force_${key}_n`])].map((a) => Array.from(numbers(a)));
  const period = rotation.at(-1) - rotation[0];
  const times = Math.max(1, Math.round((2 * Math.PI) / period));
  const repeated = (list, step) => Array.from({ length: times }, (_, i) => list.map((v) => v + i * step)).flat();
  return { angle: repeated(rotation, period), parts: parts.map((list) => repeated(list, 0)) };
}

function polar(point, colours, narrow) {
  const { angle, parts } = turn(point);
  const size = angle.map((_, k) => Math.hypot(...parts.map((p) => p[k])));
  const largest = size.reduce((a, b) => Math.max(a, b), 0) || 1;
  const step = [1, 2, 5, 10].map((m) => m * 10 ** Math.floor(Math.log10(largest / 2))).find((s) => largest / s <= 5);
  const rings = Array.from({ length: Math.ceil(largest / step) }, (_, i) => (i + 1) * step);
  const reach = rings.at(-1);
  const [across, along] = [Math.sin, Math.cos]; // from the top, clockwise, as the spindle turns seen from above
  const rays = Array.from({ length: 8 }, (_, i) => (i * Math.PI) / 4);
  return { data: [{ name: 'resultant force', x: angle.map((a, k) => size[k] * across(a)), y: angle.map((a, k) => size[k] * along(a)), customdata: angle.map((a, k) => [degrees(a) % 360, size[k]]), mode: 'lines', showlegend: false,
    line: { simplify: false, color: colours[point.lobe.name] ?? colours.robot, width: 1.8 }, fill: 'toself', fillcolor: faint(colours[point.lobe.name] ?? colours.robot, 0.1), hovertemplate: '%{customdata[0]:.4~g}°: %{customdata[1]:.4~g} N<extra></extra>', meta: 'resultant' }],
  layout: { height: narrow ? 380 : 480, hovermode: 'closest', uirevision: `turn polar ${point.forces.spindle_speed_rpm}`, margin: { l: 20, r: 20, t: 20, b: 20 },
    xaxis: { visible: false, range: [-1.15 * reach, 1.15 * reach] }, yaxis: { visible: false, scaleanchor: 'x', range: [-1.15 * reach, 1.15 * reach] },
    shapes: [...rings.map((r) => ({ type: 'circle', layer: 'below', x0: -r, x1: r, y0: -r, y1: r, line: { color: colours.grid, width: 1 } })),
      ...rays.map((a) => ({ type: 'line', layer: 'below', x0: 0, y0: 0, x1: reach * across(a), y1: reach * along(a), line: { color: colours.grid, width: 1 } }))],
    annotations: [...rings.map((r) => ({ text: `${number(r, 3)} N`, x: r * across(Math.PI / 8), y: r * along(Math.PI / 8), showarrow: false, font: { size: 11, color: colours.muted }, bgcolor: faint(colours.paper, 0.75) })),
      ...rays.map((a) => ({ text: `${Math.round(degrees(a))}°`, x: 1.09 * reach * across(a), y: 1.09 * reach * along(a), showarrow: false, font: { size: 11, color: colours.muted } }))] } };
}

function straight(point, colours, narrow) {
  const { angle, parts } = turn(point);
  const x = angle.map(degrees);
  return { data: components.map(([key, name, colour], i) => ({ name, x, y: parts[i], mode: 'lines', line: { simplify: false, color: colours[colour], width: 1.6, dash: ['solid', 'dash', 'dot'][i] }, hovertemplate: '%{y:.4~g} N', meta: key })),
    layout: { height: narrow ? 340 : 400, hovermode: 'x unified', uirevision: `turn angle ${point.forces.spindle_speed_rpm}`, margin: { l: narrow ? 54 : 70, r: narrow ? 10 : 18, t: 32, b: 46 },
      xaxis: { title: 'Rotation since the first tooth entered (°)', unifiedhovertitle: { text: '%{x:.4~g}°' }, range: [x[0], x.at(-1)], dtick: narrow ? 90 : 45 }, yaxis: { title: 'Force on the tool (N)', zeroline: true } } };
}

function columns({ forces }) {
  return [{ name: 'rotation over a period (rad)', values: Array.from(numbers(forces.rotation_rad)) }, ...components.map(([key, name]) => ({ name: `force ${name} (N)`, values: Array.from(numbers(forces[`force_${key}_n`])) }))];
}
