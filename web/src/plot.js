// A plot: its box, its buttons, and its drawing anew when width or colours change.

import Plotly from 'plotly.js-cartesian-dist-min';
import { button, el } from './dom.js';
import { isPrinting, onColours, palette, printPalette } from './colours.js';
import { number } from './format.js';

const paperWidth = { whole: 660, half: 316 }; // px of a printed page and of one of its columns, as in theme.css
const plots = [];
const coarse = matchMedia('(pointer: coarse)').matches;
const config = { displayModeBar: false, displaylogo: false, doubleClick: 'reset', scrollZoom: false, showTips: false };

/**
 * A figure with its plot. `build(colours, narrow)` gives { data, layout }; `columns()` gives [{ name, values }] of the CSV,
 * names with units. `click(event)` hears of marks that are clicked on. `draw()` draws it; nothing is drawn before.
 */
export function plot({ name, label, build, columns, click }) {
  const box = el('div', { class: 'plot', id: `plot-${name}`, role: 'img', 'aria-label': label });
  const figure = el('figure', { class: 'figure' }, box, el('div', { class: 'exports' },
    button('Reset view', `${label}: reset the view`, () => Plotly.relayout(box, resetRanges(box))),
    button('SVG', `${label}: save as SVG`, async () => save(`${name}.svg`, 'image/svg+xml', await toSvg(build, box))),
    button('CSV', `${label}: save as CSV`, () => save(`${name}.csv`, 'text/csv', toCsv(columns())))));
  const self = { box, figure, click, drawn: false, draw() { draw(self, build); } };
  new ResizeObserver(() => { if (self.drawn && box.clientWidth !== self.width && !isPrinting()) self.draw(); }).observe(box);
  plots.push(self);
  return self;
}

/** A plot that is folded away under a line of text, and drawn when it is first unfolded; `content` holds its figure. */
export function folded(summary, chart, ...content) {
  return el('details', { class: 'folded', toggle: () => chart.draw() }, el('summary', {}, summary), content);
}

/** Draws a plot when the page has nothing better to do; all are drawn before printing. */
export function later(draw) {
  waiting.push(draw);
}
const waiting = [];
const flush = () => { while (waiting.length) waiting.shift()(); };
export function drawWaiting() {
  if (!waiting.length) return;
  const idle = window.requestIdleCallback ?? ((f) => setTimeout(f, 30));
  idle(() => { waiting.shift()?.(); drawWaiting(); });
}
addEventListener('beforeprint', flush);

onColours(() => {
  if (isPrinting()) flush();
  plots.forEach((p) => p.drawn && p.draw());
});

function draw(self, build) {
  const width = isPrinting() ? paperWidth[self.box.closest('.columns') ? 'half' : 'whole'] : self.box.clientWidth;
  if (!width) return;
  self.width = width;
  self.drawn = true;
  const { data, layout } = build(palette(), width < 560);
  if (isPrinting() && width === paperWidth.whole) layout.height *= 0.62;
  Plotly.react(self.box, data, complete(layout, palette(), width), config);
  if (self.click) self.box.removeAllListeners('plotly_click').on('plotly_click', self.click);
}

const resetRanges = (box) => Object.fromEntries(Object.keys(box.layout).filter((k) => /^[xy]axis\d*$/.test(k))
  .flatMap((k) => (box.layout[k].home ? [[`${k}.range`, box.layout[k].home]] : [[`${k}.autorange`, true]])));

/** The layout that all plots share, in the page's colours and type; an axis' own settings go before. */
function complete(layout, colours, width) {
  const narrow = width < 560;
  const axis = {
    gridcolor: colours.grid, linecolor: colours.axis, tickcolor: colours.axis, zerolinecolor: colours.grid, showline: true, mirror: true,
    ticks: 'outside', ticklen: 4, automargin: true, hoverformat: '.5~g', tickformat: '~g', nticks: narrow ? 6 : undefined,
  };
  const spike = { showspikes: true, spikemode: 'across', spikesnap: 'cursor', spikethickness: 1, spikedash: 'dot', spikecolor: colours.muted };
  const result = {
    width, paper_bgcolor: colours.paper, plot_bgcolor: colours.paper, uirevision: 'keep', dragmode: coarse ? false : 'zoom',
    font: { family: 'system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif', size: narrow ? 11 : 13, color: colours.ink },
    margin: { l: narrow ? 50 : 64, r: narrow ? 8 : 16, t: 10, b: 46, pad: 0 }, modebar: { remove: ['all'] },
    hoverlabel: { bgcolor: colours.hover, bordercolor: colours.axis, font: { color: colours.ink, size: 12 }, align: 'left', namelength: -1 },
    legend: { orientation: 'h', x: 0, y: 1.01, xanchor: 'left', yanchor: 'bottom', bgcolor: 'rgba(0,0,0,0)', font: { size: narrow ? 11 : 12 }, traceorder: 'normal' },
    ...layout,
  };
  for (const key of Object.keys(result)) {
    if (!/^[xy]axis\d*$/.test(key)) continue;
    const { title, ...own } = result[key];
    result[key] = { ...axis, ...(key[0] === 'x' ? { ...spike, mirror: own.anchor === 'y2' ? 'all' : true } : {}), ...own, title: { text: title, standoff: 8, font: { size: narrow ? 11 : 13 } } };
    if (own.range) result[key].home = own.range;
  }
  return result;
}

async function toSvg(build, box) {
  const { data, layout } = build(printPalette, false);
  const height = layout.height ?? box.clientHeight;
  const url = await Plotly.toImage({ data, layout: { ...complete(layout, printPalette, 900), height } }, { format: 'svg', width: 900, height });
  return decodeURIComponent(url.slice(url.indexOf(',') + 1));
}

function toCsv(columns) {
  const rows = Math.max(...columns.map((c) => c.values.length));
  const quote = (value) => {
    const text = value === null || value === undefined || Number.isNaN(value) ? '' : String(value);
    return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  const lines = [columns.map((c) => quote(c.name)).join(',')];
  for (let i = 0; i < rows; i++) lines.push(columns.map((c) => quote(c.values[i])).join(','));
  return `${lines.join('\n')}\n`;
}

/** Hands a file to the browser's downloads. */
export function save(name, type, content) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: `${type};charset=utf-8` }));
  el('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** The area between two curves, as polygons: one for each stretch without a gap (null). */
export function between(x, low, high) {
  const [outlineX, outlineY] = [[], []];
  for (let i = 0; i < x.length;) {
    if (low[i] === null || high[i] === null) { i++; continue; }
    let end = i;
    while (end < x.length && low[end] !== null && high[end] !== null) end++;
    outlineX.push(...x.slice(i, end), ...x.slice(i, end).reverse(), null);
    outlineY.push(...low.slice(i, end), ...high.slice(i, end).reverse(), null);
    i = end;
  }
  return { x: outlineX, y: outlineY, fill: 'toself', mode: 'lines', line: { width: 0 }, hoverinfo: 'skip', showlegend: false };
}

/** A logarithmic axis over positive values, from a share `least` of them on: its range, and few ticks, since a panel may be low: at 1, 2, 5 of a decade, or at 1, 3, or at some decades. */
export function decades(values, least = 0) {
  const sorted = values.filter((v) => v > 0).sort((a, b) => a - b);
  if (!sorted.length) return {};
  const range = [Math.log10(sorted[Math.floor(least * (sorted.length - 1))]) - 0.1, Math.log10(sorted.at(-1)) + 0.1];
  const span = range[1] - range[0];
  if (span > 2.4) return { range, dtick: Math.max(1, Math.ceil((Math.floor(range[1]) - Math.ceil(range[0])) / 3)) };
  const all = [];
  for (let d = Math.floor(range[0]); d <= range[1]; d++) for (const m of span < 1.2 ? [1, 2, 5] : [1, 3]) all.push(Number(`${m}e${d}`));
  return { range, tickvals: all.filter((v) => Math.log10(v) >= range[0] && Math.log10(v) <= range[1]) };
}

/** Ticks of an axis of logarithms: 1, 2, 5 of each decade between two values. */
export function logTicks(low, high) {
  const values = [];
  for (let d = Math.floor(Math.log10(low)); d <= Math.ceil(Math.log10(high)); d++) {
    for (const m of [1, 2, 5]) if (m * 10 ** d >= low * 0.999 && m * 10 ** d <= high * 1.001) values.push(m * 10 ** d);
  }
  return { tickvals: values.map(Math.log10), ticktext: values.map((v) => number(v, 2)) };
}
