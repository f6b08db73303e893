// Modal assurance criterion: how alike two sets of shapes are, as a heat map with the values in its cells.

import { numbers } from './decode.js';
import { viridisScale } from './colours.js';
import { number, plain, range } from './format.js';
import { plot } from './plot.js';

/** `mac` as in the document; rows and columns are what its axes are called. */
export function macPlot(name, label, { values, row_hz: rowHz, column_hz: columnHz }, rows, columns) {
  const v = numbers(values);
  const [r, c] = values.shape;
  const z = range(r).map((i) => Array.from(v.subarray(i * c, (i + 1) * c)));
  return plot({
    name, label,
    build: (colours, narrow) => build({ z, rowHz, columnHz, rows, columns }, narrow),
    columns: () => [{ name: `${rows} (Hz)`, values: rowHz }, ...columnHz.map((f, j) => ({ name: `MAC with ${columns} ${number(f, 5)} Hz`, values: z.map((row) => row[j]) }))],
  });
}

function build({ z, rowHz, columnHz, rows, columns }, narrow) {
  const [r, c] = [z.length, z[0].length];
  const values = Math.max(r, c) <= 14;
  const heat = { type: 'heatmap', z, x: range(c, 1), y: range(r, 1), zmin: 0, zmax: 1, colorscale: viridisScale, xgap: 1, ygap: 1, meta: 'mac',
    text: z.map((row) => row.map((m) => (values && m >= 0.05 ? m.toFixed(2).replace(/^0/, '') : ''))), texttemplate: '%{text}', textfont: { size: narrow && Math.max(r, c) > 8 ? 9 : 11 },
    customdata: z.map((row, i) => row.map((_, j) => [rowHz[i], columnHz[j]])), hovertemplate: `%{customdata[0]:.4~g} Hz and %{customdata[1]:.4~g} Hz<br>MAC %{z:.3f}<extra></extra>`,
    colorbar: { thickness: 10, outlinewidth: 0, len: 1, tickvals: [0, 0.5, 1] } };
  const ticks = (hz) => ({ tickvals: range(hz.length, 1), ticktext: hz.map((f) => number(f, 3)), showgrid: false, showspikes: false });
  return { data: [heat], layout: {
    height: narrow ? 320 : 400, hovermode: 'closest', margin: { l: 56, r: 8, t: 12, b: 60 },
    xaxis: { title: `${plain(columns)} (Hz)`, ...ticks(columnHz), tickangle: -60 },
    yaxis: { title: `${plain(rows)} (Hz)`, ...ticks(rowHz), autorange: 'reversed' },
  } };
}
