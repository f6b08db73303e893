// Operating points: a speed and a depth that the case asks about, as markers of the chart and as a table.

import { table } from './dom.js';
import { hertz, isNumber, number, plain } from './format.js';
import { lobeTitle } from './lobes.js';

const sizes = { supported: 16, carried: 16, part: 8 }; // at the same place the ring of one chart goes around the mark of the other

export const pointsOf = (run) => run.summary.operating_points ?? [];

/** One trace for each chart and verdict: a circle is stable, a cross chatters, so that nobody needs the colours. */
export function pointMarks(runs, colours) {
  const several = runs.length > 1;
  const groups = new Map();
  runs.forEach((run, i) => pointsOf(run).forEach((p) => {
    const key = `${i} ${p.chart} ${p.stable ? 'stable' : 'chatter'}`;
    if (!groups.has(key)) groups.set(key, { run, i, chart: p.chart, stable: p.stable, points: [] });
    groups.get(key).points.push(p);
  }));
  return [...groups].map(([key, { run, i, chart, stable, points }]) => ({
    name: plain(`${several ? `${run.label}: ` : ''}${lobeTitle(chart)}: ${stable ? 'stable point' : 'point with chatter'}`), x: points.map((p) => p.spindle_speed_rpm), y: points.map((p) => p.depth_m * 1e3), mode: 'markers', cliponaxis: false,
    marker: { symbol: `${stable ? 'circle' : 'x'}${sizes[chart] === 16 || i ? '-open' : ''}`, size: (sizes[chart] ?? 12) + 3 * i, color: stable ? colours.good : colours.bad, line: { width: 2, color: stable ? colours.good : colours.bad } },
    customdata: points.map((p) => plain(`${number(p.spindle_speed_rpm, 5)} rpm, ${number(p.depth_m * 1e3, 3)} mm: ${stable ? 'stable' : 'chatter'}`)), hovertemplate: '%{customdata}', meta: `points ${key}`,
  }));
}

/** A row a point: the verdict, and how far it is to the boundary; null where the case asks for none. */
export function pointTable(run) {
  const points = pointsOf(run);
  if (!points.length) return null;
  const margin = (p) => {
    if (!isNumber(p.depth_margin_m)) return '–';
    if (p.depth_margin_at_limit && p.depth_margin_m < 0) return `known to ${number((p.depth_m + p.depth_margin_m) * 1e3, 3)} mm only`;
    return `${p.depth_margin_at_limit ? '≥ ' : ''}${number(p.depth_margin_m * 1e3, 3)} mm${isNumber(p.depth_margin_relative) ? ` (${number(p.depth_margin_relative * 100, 3)} %)` : ''}`;
  };
  const range = (p) => `${isNumber(p.boundary_below_rpm) ? number(p.boundary_below_rpm, 5) : 'lowest'} to ${isNumber(p.boundary_above_rpm) ? number(p.boundary_above_rpm, 5) : 'highest'}`;
  const micrometres = (x) => (isNumber(x) ? `${number(x * 1e6, 3)} µm` : null);
  const columns = [
    ['Speed (rpm)', (p) => number(p.spindle_speed_rpm, 5)], ['Depth (mm)', (p) => number(p.depth_m * 1e3, 4)], ['Chart', (p) => lobeTitle(p.chart)],
    ['Verdict', (p) => ({ text: p.stable ? '✓ stable' : '✗ chatter', class: p.stable ? 'good' : 'bad' })], ['Margin in depth', margin], ['Same verdict at (rpm)', range],
    ['Nearest chatter', (p) => (isNumber(p.chatter_frequency_hz) ? `${hertz(p.chatter_frequency_hz)}${p.bifurcation ? ` (${p.bifurcation})` : ''}` : null)],
    ['Surface error', (p) => micrometres(p.forced_vibration?.surface_location_error_m)],
    ['Peak force', (p) => (isNumber(p.forced_vibration?.peak_force_n) ? `${number(p.forced_vibration.peak_force_n, 3)} N` : null)],
    ['Contact', (p) => (p.contact ? { text: `${number(p.contact.least_force_n, 3)} to ${number(p.contact.largest_force_n, 3)} N${p.contact.lost ? ', lost' : ''}`, class: p.contact.lost ? 'bad' : undefined } : null)],
  ].filter(([, of]) => points.some((p) => of(p) !== null));
  return table('Operating points', columns.map(([head]) => head), points.map((p) => columns.map(([, of]) => of(p))), true);
}
