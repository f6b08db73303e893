// The map of a robot over its workspace: a slice through the columns of its postures, as cells with values and intervals, or as a line where there is one column.

import { faint, viridisScale } from './colours.js';
import { numbers } from './decode.js';
import { choice, el } from './dom.js';
import { number, plain } from './format.js';
import { between95, gridLines, nearest, placeText, rowsOf } from './places.js';
import { between, plot } from './plot.js';

const mostWithText = 9; // cells of a side that have room for their values

/** The quantities that can be shown: { title, unit, digits, of: [value, low, high] of each place }. */
function quantities({ map, next, figures }, places) {
  const [hz, depth] = [rowsOf(map.first_hz), map.depth_m && rowsOf(map.depth_m)];
  const width = (rows) => rows.map(([value, low, high]) => [(100 * (high - low)) / value]);
  const list = depth ? [
    ['depth', { title: 'Stable depth', unit: 'mm', of: depth.map((row) => row.map((v) => v * 1e3)) }],
    ['cautious', { title: 'Lower end of the interval of the depth', unit: 'mm', of: depth.map(([, low]) => [low * 1e3]) }],
    ['depth_width', { title: 'Width of the interval of the depth', unit: '% of the depth', of: width(depth) }],
    ...(new Set(numbers(map.rpm)).size > 1 ? [['rpm', { title: 'Best spindle speed', unit: 'rpm', of: Array.from(numbers(map.rpm), (v) => [v]) }]] : [])] : [];
  list.push(['first', { title: 'First frequency', unit: 'Hz', of: hz }], ['first_width', { title: 'Width of the interval of the first frequency', unit: '% of the frequency', of: width(hz) }]);
  if (next && onTheGrid(rowsOf(next.candidates), places))
    list.push(['next', { title: 'What a test there would tell', unit: `% of the variance of the ${figures.next.of_depth ? 'depth' : 'frequencies'}`, of: Array.from(numbers(next.reduction), (v) => [v * 100]) }]);
  return new Map(list);
}

const onTheGrid = (candidates, places) => candidates.length === places.length && candidates.every((row, i) => row.every((v, c) => v === places[i][c]));

/** { chart, content } of the map. */
export function workspace(found) {
  const { over } = found.figures;
  const places = rowsOf(found.map.places);
  const grid = { places, lines: gridLines(places), over };
  const list = quantities(found, places);
  const state = { show: list.keys().next().value, x: 0, y: over.length > 1 ? 1 : null, at: grid.lines.map((values, c) => nearest(values, found.asked[c])) };
  const chart = plot({ name: 'workspace', label: 'Map over the workspace', build: (colours, narrow) => build(found, grid, list.get(state.show), state, colours, narrow), columns: () => columns(grid, list) });
  const slices = el('span', { class: 'slices' });
  const draw = () => { slices.replaceChildren(...slicesOf(grid, state, chart.draw)); chart.draw(); };
  const axis = (name, other) => choice(name === 'x' ? 'Across' : 'Upwards', over.map((column, c) => [c, column]), state[name], (v) => { if (state[other] === Number(v)) state[other] = state[name]; state[name] = Number(v); refresh(); });
  const axes = el('span', { class: 'slices' });
  const refresh = () => { axes.replaceChildren(...(over.length > 2 ? [axis('x', 'y'), axis('y', 'x')] : [])); draw(); };
  axes.append(...(over.length > 2 ? [axis('x', 'y'), axis('y', 'x')] : []));
  slices.append(...slicesOf(grid, state, chart.draw));
  return { chart, content: [el('div', { class: 'controls' }, choice('Show', [...list].map(([key, { title }]) => [key, title]), state.show, (v) => { state.show = v; chart.draw(); }), axes, slices), chart.figure,
    over.length > 2 && el('p', { class: 'note' }, 'Circles are tapped postures near this slice through the workspace; places without a colour lie beyond the tapped postures.')] };
}

/** A choice of the value of each column that is no axis. */
const slicesOf = ({ lines, over }, state, draw) => over.map((name, c) => [name, c]).filter(([, c]) => c !== state.x && c !== state.y)
  .map(([name, c]) => choice(`at ${name}`, lines[c].map((v, i) => [i, number(v, 4)]), state.at[c], (i) => { state.at[c] = Number(i); draw(); }));

/** True of a place in the slice that is shown, within half a step of the grid. */
function inSlice({ lines }, state, place) {
  return lines.every((values, c) => c === state.x || c === state.y || nearest(values, place[c]) === state.at[c]);
}

function build(found, grid, quantity, state, colours, narrow) {
  const spots = marks(found, grid, state, colours);
  return state.y === null ? line(grid, quantity, spots, colours, narrow) : cells(grid, quantity, state, spots, narrow);
}

/** The slice as cells. Colours are the same in every slice. */
function cells({ places, lines, over }, { title, unit, of }, state, spots, narrow) {
  const [x, y] = [lines[state.x], lines[state.y]];
  const shown = y.map(() => x.map(() => null));
  places.forEach((place, i) => { if (inSlice({ lines }, state, place)) shown[y.indexOf(place[state.y])][x.indexOf(place[state.x])] = of[i]; });
  const values = of.map(([v]) => v).filter(Number.isFinite);
  const [least, most] = [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
  const heat = { type: 'heatmap', x, y, z: shown.map((row) => row.map((cell) => cell?.[0] ?? null)), zmin: least, zmax: most, colorscale: viridisScale, xgap: 2, ygap: 2, meta: 'map', hoverongaps: false,
    customdata: shown.map((row) => row.map((cell) => (cell ? `${number(cell[0], 4)} ${unit}${cell.length > 1 ? `; 95 % lie in ${between95(cell[1], cell[2], 1)}` : ''}` : ''))),
    hovertemplate: `${plain(over[state.x])} %{x:.4~g}, ${plain(over[state.y])} %{y:.4~g}<br>%{customdata}<extra></extra>`,
    colorbar: { title: { text: plain(unit), side: 'right', font: { size: 12 } }, thickness: 12, outlinewidth: 0, len: 1 } };
  const words = Math.max(x.length, y.length) <= mostWithText ? [cellTexts(x, y, shown, (v) => (v - least) / (most - least || 1), narrow)] : [];
  return { data: [heat, ...words, ...spots], layout: { height: narrow ? 400 : 570, hovermode: 'closest', uirevision: `${title} ${state.x} ${state.y}`,
    xaxis: { title: plain(over[state.x]), tickvals: x, showgrid: false, showspikes: false }, yaxis: { title: plain(over[state.y]), tickvals: y, showgrid: false, showspikes: false } } };
}

/** The value of each cell and its interval, beneath the cell's middle, where a mark may stand; in the ink that its colour calls for. */
function cellTexts(x, y, shown, share, narrow) {
  const full = shown.flatMap((row, j) => row.map((cell, i) => ({ cell, x: x[i], y: y[j] })).filter(({ cell }) => Number.isFinite(cell?.[0])));
  const step = y.length > 1 ? y[1] - y[0] : 1;
  const text = ({ cell }) => number(cell[0], 3) + (cell.length > 1 && !narrow && x.length <= 6 ? `<br><span style="font-size:11px">${between95(cell[1], cell[2], 1)}</span>` : '');
  return { x: full.map((f) => f.x), y: full.map((f) => f.y - 0.06 * step), text: full.map(text), mode: 'text', textposition: 'bottom center', showlegend: false, hoverinfo: 'skip', meta: 'values',
    textfont: { size: narrow ? 10 : 14, color: full.map(({ cell }) => (share(cell[0]) > 0.5 ? '#101418' : '#ffffff')) } };
}

function line({ places, over }, { title, unit, of }, spots, colours, narrow) {
  const x = places.map(([v]) => v);
  const end = (k) => of.map((row) => (Number.isFinite(row[k]) ? row[k] : null));
  const band = of[0].length > 1 ? [{ ...between(x, end(1), end(2)), fillcolor: faint(colours.supported, 0.22), meta: 'band' }] : [];
  const curve = { x, y: end(0), mode: 'lines+markers', showlegend: false, line: { color: colours.supported, width: 2 }, hovertemplate: `${plain(over[0])} %{x:.4~g}: %{y:.4~g} ${plain(unit)}<extra></extra>`, meta: 'map' };
  return { data: [...band, curve, ...spots], layout: { height: narrow ? 340 : 420, hovermode: 'closest', uirevision: title, xaxis: { title: plain(over[0]) }, yaxis: { title: `${title} (${unit})`, rangemode: 'tozero' } } };
}

/** The tapped postures of the slice, the posture that is asked for, and the one to tap next. On a line they stand at its foot. */
function marks(found, grid, state, colours) {
  const { over, next } = found.figures;
  const spot = (name, list, marker) => (list.length ? [{ name, x: list.map((p) => p[state.x]), y: list.map((p) => (state.y === null ? 0 : p[state.y])), mode: 'markers', cliponaxis: false, marker,
    customdata: list.map((p) => plain(placeText(over, p))), hovertemplate: `${name}: %{customdata}<extra></extra>`, meta: name }] : []);
  const tapped = rowsOf(found.places).filter((p) => inSlice(grid, state, p));
  return [...spot('tapped', tapped, { symbol: 'circle', size: 7, color: colours.paper, line: { color: colours.ink, width: 1.3 } }),
    ...spot('asked for', found.asked.length ? [found.asked] : [], { symbol: 'star', size: 15, color: colours.supported, line: { color: colours.paper, width: 1.2 } }),
    ...spot('to tap next', next ? [next.at] : [], { symbol: 'diamond', size: 13, color: colours.mark, line: { color: colours.paper, width: 1.2 } })];
}

function columns({ places, over }, list) {
  const own = [...list.values()].flatMap(({ title, unit, of }) => ['', ' low end of 95 %', ' high end of 95 %'].slice(0, of[0].length).map((end, k) => ({ name: `${title}${end} (${unit})`, values: of.map((row) => row[k]) })));
  return [...over.map((name, c) => ({ name, values: places.map((p) => p[c]) })), ...own];
}
