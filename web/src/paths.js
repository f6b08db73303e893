// Along a path: the limiting depth over position and spindle speed, as a map, a line for each position or stacked lines, and beneath it what holds at every position.

import { choice, el, tick } from './dom.js';
import { numbers } from './decode.js';
import { faint, printPalette, viridis, viridisScale } from './colours.js';
import { number, plain, scaled } from './format.js';
import { decades, logTicks, plot } from './plot.js';
import { lobeTitle, withRobot } from './lobes.js';

export function paths(runs) {
  const maps = runs.flatMap((run) => (run.paths ?? []).map((path) => ({ run, path })));
  if (!maps.length) return null;
  const several = runs.length > 1;
  const supported = maps.findIndex((m) => withRobot(m.path.name));
  const state = { at: Math.max(0, supported), log: true, waterfall: false };
  const title = ({ run, path }) => (several ? `${run.label}: ` : '') + lobeTitle(path.name);
  const chart = plot({ name: 'path', label: 'Depth along the path', build: (colours, narrow) => build(maps, state, title, colours, narrow), columns: () => columns(maps[state.at].path) });
  return { chart, content: [el('div', { class: 'controls' },
    choice('Map of', maps.map((m, i) => [i, title(m)]), state.at, (v) => { state.at = Number(v); chart.draw(); }),
    choice('Show', [['', maps.every(({ path }) => few(path)) ? 'lines' : 'map'], ['waterfall', 'waterfall']], '', (v) => { state.waterfall = Boolean(v); chart.draw(); }),
    maps.some(({ path }) => !few(path)) && tick('logarithmic', state.log, (on) => { state.log = on; chart.draw(); })), chart.figure] };
}

/** Length along the path to each position, in mm. */
function lengths(path) {
  const p = numbers(path.positions);
  const s = [0];
  for (let i = 3; i < p.length; i += 3) s.push(s.at(-1) + Math.hypot(p[i] - p[i - 3], p[i + 1] - p[i - 2], p[i + 2] - p[i - 1]) * 1e3);
  return s;
}

function rows(path) {
  const [depth, n] = [numbers(path.depth_m), path.rpm.shape[0]];
  return lengths(path).map((_, i) => scaled(depth.subarray(i * n, (i + 1) * n), 1e3));
}

const least = (map) => map[0].map((_, j) => map.reduce((m, row) => (row[j] === null ? m : Math.min(m, row[j])), Infinity)).map((v) => (Number.isFinite(v) ? v : null));

const few = (path) => path.positions.shape[0] <= 6; // so many positions are lines, not a map

function build(maps, state, title, colours, narrow) {
  const { run, path } = maps[state.at];
  const [x, y, z] = [Array.from(numbers(path.rpm)), lengths(path), rows(path)];
  const all = z.flat().filter((v) => v > 0);
  const [low, high] = [all.reduce((a, b) => Math.min(a, b), Infinity), all.reduce((a, b) => Math.max(a, b), 0)];
  const bar = { title: { text: 'mm', side: 'top', font: { size: 12 } }, thickness: 12, outlinewidth: 0, len: 0.64, y: 1, yanchor: 'top', ...(state.log ? logTicks(low, high) : {}) };
  const map = { type: 'heatmap', x, y, z: state.log ? z.map((r) => r.map((v) => (v > 0 ? Math.log10(v) : null))) : z, customdata: z, colorscale: viridisScale, colorbar: bar,
    hovertemplate: '%{x:.5~g} rpm<br>%{y:.4~g} mm along the path<br>depth %{customdata:.4~g} mm<extra></extra>', meta: 'map' };
  const dashes = { supported: ['solid', 'dash', 'longdash'], carried: ['solid', 'dash', 'longdash'], part: ['dot', 'dashdot', 'longdashdot'] }; // of the runs
  const order = [...new Set(maps.map((m) => m.run))];
  const curves = maps.map((m) => ({ name: plain(title(m)), x: Array.from(numbers(m.path.rpm)), y: least(rows(m.path)), yaxis: 'y2', mode: 'lines',
    line: { color: colours[m.path.name] ?? colours.robot, width: 2, dash: dashes[m.path.name]?.[order.indexOf(m.run) % 3] }, hovertemplate: '%{x:.5~g} rpm: %{y:.4~g} mm everywhere', meta: `least ${order.indexOf(m.run)} ${m.path.name}` }));
  const best = maps.filter((m) => m.run === run).flatMap(({ path: { name } }) => {
    const deepest = run.summary.path?.find((p) => p.name === name)?.deepest_everywhere;
    return deepest ? [{ x: [deepest.spindle_speed_rpm], y: [deepest.depth_m * 1e3], yaxis: 'y2', mode: 'markers', showlegend: false, marker: { symbol: 'star', size: 11, color: colours[name] ?? colours.robot },
      hovertemplate: 'deepest everywhere: %{y:.4~g} mm at %{x:.5~g} rpm<extra></extra>', meta: `deepest ${name}` }] : [];
  });
  const n = run.cutting?.spindle_speed_rpm;
  const length = y.at(-1);
  const stacked = state.waterfall && length > 0;
  const fall = stacked ? waterfall(x, y, z, { low, high, log: state.log }, colours) : null;
  const data = fall ? fall.data : few(path) ? perPosition(x, y, z, bar) : [map];
  const alone = { domain: [0.4, 1], ...(fall ? { title: narrow ? 'Position (mm)' : 'Position along the path (mm)', range: fall.range } : few(path) ? { title: narrow ? 'Depth (mm)' : 'Depth, each position (mm)', type: 'log', ...decades(all) } : { title: narrow ? 'Position (mm)' : 'Position along the path (mm)', ...(length > 0 ? { range: [0, length] } : {}) }) };
  return { data: [...data, ...curves, ...best], layout: {
    height: narrow ? 500 : 560, hovermode: 'closest', uirevision: `path ${state.at} ${Boolean(fall)}`, ...(fall ? { annotations: [fall.note] } : {}), margin: { l: narrow ? 50 : 64, r: narrow ? 8 : 16, t: 12, b: 46 },
    xaxis: { title: 'Spindle speed (rpm)', anchor: 'y2', ticks: '', range: [x[0], x.at(-1)] },
    yaxis: alone,
    yaxis2: { title: narrow ? 'Depth (mm)' : 'Depth, all positions (mm)', domain: [0, 0.32], type: 'log', dtick: 1 },
    legend: { orientation: 'h', x: 0, y: 0.325, xanchor: 'left', yanchor: 'bottom', font: { size: 11 } },
    shapes: n ? [{ type: 'line', x0: n, x1: n, y0: 0, y1: 1, yref: 'paper', line: { color: colours.ink, width: 1.2, dash: 'dash' } }] : [],
  } };
}

/** The depth at each position as a line above its place along the path; the nearer ones hide what is behind them. { data, range, note } */
function waterfall(x, y, z, { low, high, log }, colours) {
  const most = 40;
  const shown = y.map((_, i) => i).filter((i) => y.length <= most || i % Math.ceil(y.length / most) === 0);
  const height = (2.5 * y.at(-1)) / Math.max(1, shown.length - 1);
  const share = log ? (d) => Math.log(d / low) / (Math.log(high / low) || 1) : (d) => d / high;
  const [darkest, span] = colours.paper === printPalette.paper ? [0, 0.9] : [0.3, 0.7]; // what is to be read on this paper
  const above = (d, s) => (d > 0 ? s + height * share(d) : null);
  const data = shown.reverse().flatMap((i) => [
    { x: [x[0], x.at(-1)], y: [y[i], y[i]], mode: 'lines', showlegend: false, hoverinfo: 'skip', line: { color: colours.grid, width: 1 }, meta: `base ${i}` },
    { name: `at ${number(y[i], 4)} mm`, x, y: z[i].map((d) => above(d, y[i])), customdata: z[i], mode: 'lines', showlegend: false, fill: 'tonexty', fillcolor: faint(colours.paper, 0.8), connectgaps: false,
      line: { simplify: false, color: `rgb(${viridis(darkest + (span * y[i]) / y.at(-1)).join(',')})`, width: 1.5 }, hovertemplate: `%{x:.5~g} rpm<br>${number(y[i], 4)} mm along the path<br>depth %{customdata:.4~g} mm<extra></extra>`, meta: `stacked ${i}` }]);
  const text = log ? `each line from ${number(low, 3)} mm at its base to ${number(high, 3)} mm, logarithmic` : `each line from 0 at its base to ${number(high, 3)} mm`;
  return { data, range: [-0.02 * y.at(-1), y.at(-1) + 1.4 * height],
    note: { text, xref: 'paper', yref: 'paper', x: 0.995, y: 0.995, xanchor: 'right', yanchor: 'top', showarrow: false, font: { size: 12 }, bgcolor: faint(colours.paper, 0.75) } };
}

/** A line for each position, coloured by its place along the path, which the bar tells. */
function perPosition(x, y, z, bar) {
  const length = y.at(-1) || 1;
  const colour = (s) => `rgb(${viridis((0.9 * s) / length).join(',')})`; // the brightest tenth is not to be read on paper
  const scale = viridisScale.map(([t]) => [t, `rgb(${viridis(0.9 * t).join(',')})`]);
  const lines = z.map((depth, i) => ({ name: `at ${number(y[i], 4)} mm`, x, y: depth, mode: 'lines', showlegend: false, line: { simplify: false, color: colour(y[i]), width: 1.8 },
    hovertemplate: `%{x:.5~g} rpm<br>${number(y[i], 4)} mm along the path<br>depth %{y:.4~g} mm<extra></extra>`, meta: `position ${i}` }));
  return [...lines, { x: [null], y: [null], mode: 'markers', showlegend: false, hoverinfo: 'skip', marker: { color: [0], cmin: 0, cmax: length, colorscale: scale, showscale: true, colorbar: { ...bar, tickvals: y, ticktext: y.map((s) => number(s, 4)) } }, meta: 'scale' }];
}

function columns(path) {
  const speeds = Array.from(numbers(path.rpm));
  const z = rows(path);
  return [{ name: 'spindle speed (rpm)', values: speeds }, ...lengths(path).map((s, i) => ({ name: `limiting depth (mm) at ${number(s, 4)} mm along the path`, values: z[i] }))];
}
