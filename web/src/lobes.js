// Stability lobes: the limiting depth over the spindle speed, and the chatter frequency beneath it.

import { el, table, tick } from './dom.js';
import { numbers } from './decode.js';
import { faint } from './colours.js';
import { isNumber, millimetres, number, percent, plain, rpm as speed, scaled } from './format.js';
import { between, decades, plot } from './plot.js';
import { learnedLines, learnedOf, learnedTables, proposedCuts, proposedMarks } from './learned.js';
import { observedMarks, observedOf, observedTable } from './observed.js';
import { pointMarks, pointsOf, pointTable } from './points.js';
import { followMark, onShownPoint, simulatedPoints, simulationMarks } from './simulated.js';

const titles = { part: 'part alone', supported: 'with robot', tool: 'tool', carried: 'tool on robot' };
const symbols = { hopf: 'circle', flip: 'diamond', fold: 'square' };
const signs = { hopf: '○\u00a0Hopf', flip: '◇\u00a0flip', fold: '□\u00a0fold' };
const dashes = ['solid', 'dash', 'dashdot', 'longdash']; // of the runs
const worthAStar = 1.3; // a pocket is deeper than the chart's least depth by this factor at least
/** True of the chart with the robot: that of the supported part, or of a tool on robot. */
export const withRobot = (name) => name === 'supported' || name === 'carried';
export const lobeTitle = (name) => titles[name] ?? name;

/** The section's content: the options and the plot. Null where no run has lobes. */
export function lobes(runs) {
  const curves = runs.flatMap((run, i) => (run.lobes ?? []).map((lobe) => ({ run, i, lobe, ...decodeLobe(lobe) })));
  if (!curves.length) return null;
  const options = { log: spread(curves.map((c) => c.depth)) > 300, passing: false, rates: false, crossings: false };
  const passes = curves.some((c) => c.lobe.tooth_passing_hz?.length && c.run.cutting?.teeth);
  const crosses = curves.some((c) => c.lobe.crossings);
  const rate = runs.find((r) => isNumber(r.cutting?.removal_cm3_per_min_per_m_rpm))?.cutting;
  const chart = plot({
    name: 'lobes', label: 'Stability lobes', build: (colours, narrow) => build(curves, runs, rate, options, colours, narrow), columns: () => columns(curves), click: followMark,
  });
  onShownPoint(() => chart.drawn && chart.draw());
  const option = (key, text) => tick(text, options[key], (on) => { options[key] = on; chart.draw(); });
  return { chart, content: [
    el('div', { class: 'controls' }, option('log', 'logarithmic depth'), passes && option('passing', 'tooth-passing speeds'), rate && option('rates', 'removal rate'),
      crosses && option('crossings', 'every crossing')), chart.figure, runs.flatMap((run) => tables(run, runs.length > 1))] };
}

/** What there is to see: only of what is there. */
export function lobesLead(runs) {
  const all = runs.flatMap((run) => (run.lobes ?? []).map((lobe) => ({ run, lobe })));
  const has = (status) => all.some(({ lobe }) => lobe.status.includes(status));
  const kinds = Object.keys(signs).filter((kind) => all.some(({ lobe }) => lobe.kind.some((k, i) => k === kind && lobe.status[i] === 'converged')));
  const places = [...new Set(runs.map((run) => run.cutting?.at).filter((at) => typeof at === 'string' && at))];
  const robust = [...new Set(runs.flatMap((run) => (run.summary.lobes ?? []).map((chart) => chart.robust?.confidence)).filter(isNumber))];
  return [places.length ? `The cut is at ${places.join(' or ')}.` : '', `Cuts below a line are stable${has('stable_to_depth_limit') ? '; where it is broad, down to the depth limit of the chart' : ''}.`,
    all.some(({ run, lobe }) => starred(run, lobe).length) ? 'Stars mark the best pockets.' : '', robust.length ? `Dotted: the robust limit, which holds for ${robust.map((k) => number(k, 3)).join(' or ')} standard deviations of what the case calls uncertain.` : '',
    all.some(({ lobe }) => lobe.identification_low_m) ? 'Shaded: 95 % of the limits lie there by the uncertainty of what was fitted or learned.' : '',
    all.some(({ lobe }) => lobe.compared) ? 'Thin lines: the limits of other methods, where they converged.' : '', has('not_converged') ? 'Crosses on the line did not converge.' : '',
    kinds.length ? `The lower panel gives the frequency of the chatter that begins at the line (${kinds.map((k) => signs[k]).join(', ')}${runs.length > 1 ? '; open of the first run, filled of the second' : ''}).` : '',
    runs.some((run) => pointsOf(run).length) ? 'Operating points are circles where they are stable, crosses where they chatter.' : '',
    runs.some(learnedOf) ? 'The full line is the chart before any cut; lines called learned are what is stable with 50 and 95 % of what the cuts left possible.' : '',
    runs.some((run) => proposedCuts(run).length) ? 'The star is the cut to make next, a triangle the one that removes most at the case’s risk.' : '',
    runs.some((run) => observedOf(run).length) ? 'Cuts that were made are filled where the chart is right, open and large where it is wrong: circles were stable, crosses chattered, diamonds were marginal. One that is open with a dot has a doubtful prediction and does not count.' : '',
    simulatedPoints(runs).length ? 'Diamonds were simulated; a click on one leads to its simulation.' : ''].filter(Boolean).join(' ');
}

/** Beneath the chart: the operating points, and what else is known of its limits. */
function tables(run, labelled) {
  const list = [observedTable(run), ...learnedTables(run), pointTable(run), chartTable(run)].filter(Boolean);
  return [labelled && list.length ? el('h3', {}, run.label) : null, ...list];
}

/** Robust limits and other methods' charts, where the case asks for them. */
function chartTable({ summary }) {
  const rows = (summary.lobes ?? []).flatMap((chart) => [
    ...(chart.robust ? [[`${lobeTitle(chart.name)}, robust at ${number(chart.robust.confidence, 3)} standard deviations`, millimetres(chart.robust.minimum_depth_m), speed(chart.robust.at_spindle_speed_rpm), null]] : []),
    ...(chart.compared ?? []).map((other) => [`${lobeTitle(chart.name)}, ${(other.name ?? other.method).replaceAll('_', ' ')}`, millimetres(other.minimum_depth_m),
      speed(other.minimum_at_spindle_speed_rpm), `${percent(other.largest_relative_difference, 2)} at ${speed(other.at_spindle_speed_rpm)}`])]);
  return rows.length ? table('Robust limits and other methods', ['Chart', 'Least depth', 'At', 'Largest difference'], rows, true) : null;
}

/** Greatest over least of the positive values of several lists: where it is large, a linear axis hides the lower ones. */
function spread(lists) {
  const values = lists.flatMap((list) => Array.from(list).filter((v) => v > 0));
  return values.reduce((a, b) => Math.max(a, b), 0) / values.reduce((a, b) => Math.min(a, b), Infinity);
}

function decodeLobe(lobe) {
  const [rpm, depth, error, chatter] = [lobe.rpm, lobe.depth_m, lobe.error_relative, lobe.chatter_hz].map(numbers);
  const found = lobe.status.map((s, k) => s === 'converged' && Number.isFinite(chatter[k]));
  const compared = (lobe.compared ?? []).map((other) => ({ name: other.name, rpm: numbers(other.rpm), depth: numbers(other.depth_m), status: other.status }));
  return { rpm, depth, error, chatter, found, compared, robust: numbers(lobe.robust_depth_m), low: numbers(lobe.identification_low_m), high: numbers(lobe.identification_high_m), truncation: numbers(lobe.truncation_m), noise: numbers(lobe.noise_deviation_m) };
}

const label = (curve, runs) => plain((runs.length > 1 ? `${curve.run.label}: ` : '') + lobeTitle(curve.lobe.name));
const colourOf = (curve, colours) => colours[curve.lobe.name] ?? colours.robot;

function build(curves, runs, rate, options, colours, narrow) {
  const points = [...runs.flatMap(pointsOf), ...runs.flatMap((run) => observedOf(run).at(-1)?.cuts ?? []), ...runs.flatMap(proposedCuts), ...simulatedPoints(runs).map(({ point }) => point)];
  const speeds = [...curves.flatMap((c) => [c.rpm[0], c.rpm.at(-1)]), ...points.map((p) => p.spindle_speed_rpm)];
  const [from, to] = [Math.min(...speeds), Math.max(...speeds)];
  const edge = (to - from) * 0.012;
  const depths = [...curves.flatMap((c) => Array.from(c.depth)), ...points.map((p) => p.depth_m)].filter((d) => d > 0).map((d) => d * 1e3);
  const [least, greatest] = [depths.reduce((a, b) => Math.min(a, b)), depths.reduce((a, b) => Math.max(a, b))];
  const data = [
    ...curves.flatMap((c) => limit(c, runs, colours, options.log)),
    ...curves.map((c) => chatterMarks(c, runs, from, to, colours, narrow)),
    ...curves.flatMap((c) => pockets(c, runs, colours)),
    ...learnedLines(runs, colours),
    ...observedMarks(runs, colours),
    ...proposedMarks(runs, colours),
    ...pointMarks(runs, colours),
    ...simulationMarks(runs, colours),
    ...(options.crossings ? curves.flatMap((c) => crossings(c, colours)) : []),
    ...(options.rates && rate ? contours(rate.removal_cm3_per_min_per_m_rpm, from, to, greatest, colours) : []),
  ];
  const [low, high] = options.log ? [Math.log10(least * 0.6), Math.log10(greatest * (options.passing ? 8 : 1.6))] : [0, greatest * (options.passing ? 1.36 : 1.12)];
  const frequencies = curves.map((c) => Array.from(c.chatter).filter((f, k) => c.found[k] && f > 0));
  const wide = spread(frequencies) > 20;
  const marks = [...speedMarks(runs, from, to, colours), ...(options.passing ? passing(curves, from, to, colours) : [])];
  return { data, layout: {
    height: narrow ? 560 : 660, hovermode: 'x unified', hoversubplots: 'axis', uirevision: `lobes ${options.log}`,
    // One run's legend is one line, whose room is known: a second pass of Plotly to find it takes a third of the time.
    margin: { l: narrow ? 56 : 72, r: narrow ? 10 : 18, t: short(runs, points) ? 32 : 12, b: 46, autoexpand: !short(runs, points) || options.rates },
    xaxis: { title: 'Spindle speed (rpm)', anchor: 'y2', ticks: '', unifiedhovertitle: { text: '%{x:.5~g} rpm' }, range: [from - edge, to + edge], domain: [0, 1] },
    yaxis: { title: 'Depth of cut (mm)', domain: [0.36, 1], type: options.log ? 'log' : 'linear', range: [low, high], dtick: options.log ? (Math.log10(greatest / least) > 2 ? 1 : 'D2') : undefined },
    yaxis2: { title: narrow ? 'Chatter (Hz)' : 'Chatter frequency (Hz)', domain: [0, 0.3], ...(wide ? { type: 'log', ...decades(frequencies.flat()) } : { rangemode: 'tozero' }) },
    shapes: [...marks.flatMap((m) => m.shapes ?? []), ...limitLines(runs, colours)],
    annotations: [...marks.flatMap((m) => m.annotations ?? []), ...limitNotes(runs, curves, options.log, colours)],
  } };
}

/** Whether the legend is one line. */
const short = (runs, points) => runs.length === 1 && !points.length && runs[0].lobes.every((lobe) => !lobe.robust_depth_m && !lobe.compared);

/** The limit with its error band, and the stretches that end at the chart's depth limit. */
function limit(curve, runs, colours, log) {
  const { lobe, rpm, depth, i } = curve;
  const colour = colourOf(curve, colours);
  const name = label(curve, runs);
  const x = Array.from(rpm);
  const y = scaled(depth.map((d, k) => (lobe.status[k] === 'not_converged' ? NaN : d)), 1e3);
  const at = (status) => lobe.status.map((s, k) => (s === status ? depth[k] * 1e3 : null));
  const group = `${i} ${lobe.name}`;
  const line = { simplify: false, color: colour, width: 2, dash: dashes[i % dashes.length] };
  const filled = runs.length === 1 && !log && lobe === (curve.run.lobes.find((l) => withRobot(l.name)) ?? lobe);
  const result = [...identified(curve, x, colour, group), ...band(curve, x, colour, group),
    { name, x, y, mode: 'lines', line, legendgroup: group, fill: filled ? 'tozeroy' : 'none', fillcolor: faint(colour, 0.07), hovertemplate: '%{y:.4~g} mm', meta: `limit ${group}` }];
  if (lobe.status.includes('stable_to_depth_limit')) {
    result.push({ name: `${name}: stable to the depth limit`, x, y: at('stable_to_depth_limit'), mode: 'lines', showlegend: false, line: { color: faint(colour, 0.45), width: 7 }, legendgroup: group, hoverinfo: 'skip', meta: `to limit ${group}` });
  }
  if (lobe.status.includes('not_converged')) {
    result.push({ name: 'not converged', showlegend: false, x, y: at('not_converged'), mode: 'markers', marker: { color: colours.bad, symbol: 'x', size: 7 }, hovertemplate: '%{y:.4~g} mm', meta: `not converged ${group}` });
  }
  return [...result, ...asked(curve, colour, name, group)];
}

/** The robust limit, dotted, and other methods' limits, thin: what the case asks for beside its chart. */
function asked({ rpm, robust, lobe, compared }, colour, name, group) {
  const line = (kind, dash, x, depth, status) => ({ name: `${name}, ${kind}`, x: Array.from(x), y: scaled(depth.map((d, k) => (status[k] === 'not_converged' ? NaN : d)), 1e3), mode: 'lines',
    line: { simplify: false, color: faint(colour, 0.85), width: 1.4, dash }, legendgroup: `${group} ${kind}`, hovertemplate: '%{y:.4~g} mm', meta: `${kind} ${group}` });
  return [...(robust ? [line('robust', 'dot', rpm, robust, lobe.status)] : []),
    ...compared.map((other, k) => line(other.name.replaceAll('_', ' '), dashes[1 + (k % (dashes.length - 1))], other.rpm, other.depth, other.status))];
}

/** The chatter's frequency as a line that breaks where it jumps, with a mark of its kind here and there: one on every speed hides all others. */
function chatterMarks(curve, runs, from, to, colours, narrow) {
  const { lobe, rpm, chatter, found, i } = curve;
  const [x, y, symbol, size, kinds] = [[], [], [], [], []];
  let [marked, before] = [null, null];
  rpm.forEach((n, k) => {
    const f = found[k] && chatter[k] > 0 ? chatter[k] : null;
    if (f !== null && before !== null && Math.abs(f - before) > 0.05 * before) { x.push(n); y.push(null); symbol.push('circle'); size.push(0); kinds.push(''); marked = null; }
    const place = Math.floor(((n - from) / (to - from || 1)) * (narrow ? 24 : 48) + 0.5 * (i % 2)); // those of a second run between those of the first
    const mark = f !== null && place !== marked;
    if (mark) marked = place;
    x.push(n); y.push(f); symbol.push((symbols[lobe.kind[k]] ?? 'circle') + (i % 2 ? '' : '-open')); size.push(mark ? 8 : 0); kinds.push(plain(lobe.kind[k]));
    before = f;
  });
  const colour = colourOf(curve, colours);
  return { name: label(curve, runs), x, y, yaxis: 'y2', mode: 'lines+markers', legendgroup: `${i} ${lobe.name}`, showlegend: false, connectgaps: false, line: { simplify: false, color: colour, width: 1.4, dash: dashes[i % dashes.length] },
    marker: { color: colour, size, symbol, line: { width: 1.3, color: colour } }, customdata: kinds, hovertemplate: '%{y:.4~g} Hz (%{customdata})', meta: `chatter ${i} ${lobe.name}` };
}

/** Depth plus and minus what is known of its error: of the computation, of the part's reduction, twice the measurement's deviation. */
function band({ lobe, depth, error, truncation, noise }, x, colour, group) {
  const width = Array.from(depth, (d, k) => [error?.[k] * d, Math.abs(truncation?.[k]), 2 * noise?.[k]].filter(Number.isFinite).reduce((a, b) => a + b, 0));
  const edge = (sign) => width.map((w, k) => (lobe.status[k] === 'converged' ? Math.max(0, depth[k] + sign * w) * 1e3 : null));
  return [{ ...between(x, edge(-1), edge(1)), fillcolor: faint(colour, 0.28), legendgroup: group, meta: `band ${group}` }];
}

/** The range in which 95 % of the limits lie by the uncertainty of a fitted tool or a learned robot. */
function identified({ low, high }, x, colour, group) {
  if (!low || !high) return [];
  const edge = (values) => Array.from(values, (d, k) => (Number.isFinite(low[k]) && Number.isFinite(high[k]) ? d * 1e3 : null));
  return [{ ...between(x, edge(low), edge(high)), fillcolor: faint(colour, 0.18), legendgroup: group, meta: `identified ${group}` }];
}

/** The best pockets that are some: the list is filled up with what is hardly deeper than the rest. */
function starred(run, lobe) {
  const chart = run.summary.lobes?.find((l) => l.name === lobe.name);
  return (chart?.robust?.best_pockets ?? chart?.best_pockets ?? []).filter((p) => p.depth_m > worthAStar * chart.minimum_depth_m);
}

function pockets(curve, runs, colours) {
  const best = starred(curve.run, curve.lobe);
  if (!best.length) return [];
  const colour = colourOf(curve, colours);
  const note = (p) => `${number(p.spindle_speed_rpm, 5)} rpm, ${number(p.depth_m * 1e3, 3)} mm${isNumber(p.removal_rate_cm3_per_min) ? `, ${number(p.removal_rate_cm3_per_min, 3)} cm³/min` : ''}`;
  const star = curve.i % 2 ? 'hexagram' : 'star';
  return [{ name: `${label(curve, runs)}, best pocket`, x: best.map((p) => p.spindle_speed_rpm), y: best.map((p) => p.depth_m * 1e3), mode: 'markers+text',
    text: best.map((p, k) => (k || curve.i || p.at_chart_edge ? '' : 'best ')), textposition: 'bottom left', showlegend: false, legendgroup: `${curve.i} ${curve.lobe.name}`, textfont: { color: colour, size: 11 }, cliponaxis: false,
    marker: { symbol: best.map((p, k) => (k ? `${star}-open` : star)), size: 11, color: colour, line: { width: 1.2, color: colour } },
    customdata: best.map(note), hovertemplate: '%{customdata}', meta: `pockets ${curve.i} ${curve.lobe.name}` }];
}

function crossings({ lobe, i }, colours) {
  if (!lobe.crossings) return [];
  const colour = faint(colours[lobe.name] ?? colours.robot, 0.5);
  const [x, depth, chatter] = [lobe.crossings.rpm, lobe.crossings.depth_m, lobe.crossings.chatter_hz].map(numbers);
  const common = { x: Array.from(x), mode: 'markers', marker: { color: colour, size: 3 }, hoverinfo: 'skip', showlegend: false, legendgroup: `${i} ${lobe.name}` };
  return [{ ...common, y: scaled(depth, 1e3) }, { ...common, y: Array.from(chatter), yaxis: 'y2' }];
}

/** Lines of equal removal rate, depth = Q/(k n), at round values of Q. */
function contours(k, from, to, greatest, colours) {
  const most = k * (greatest / 1e3) * to;
  const step = 10 ** Math.floor(Math.log10(most));
  const nice = [0.1, 0.2, 0.5, 1, 2, 5].map((m) => m * step).filter((q) => q < most * 0.95);
  const x = Array.from({ length: 61 }, (_, j) => from + ((to - from) * j) / 60);
  return nice.map((q, j) => {
    const y = x.map((n) => (q / k / n) * 1e3).map((d) => (d > greatest * 1.08 ? null : d));
    return { name: 'removal rate (cm³/min)', x, y, mode: 'lines+text', line: { color: colours.muted, width: 1, dash: 'dot' }, hoverinfo: 'skip', legendgroup: 'rates', showlegend: j === 0,
      text: x.map((n, m) => (m === 57 ? number(q, 3) : '')), textposition: 'top center', textfont: { size: 11, color: colours.muted }, meta: `rate ${q}` };
  });
}

/** The case's speed, and what lies beyond the spindle's range. */
function speedMarks(runs, from, to, colours) {
  const speeds = [...new Set(runs.map((r) => r.cutting?.spindle_speed_rpm).filter(isNumber))];
  const lines = speeds.filter((n) => n >= from && n <= to).map((n) => ({
    shapes: [{ type: 'line', x0: n, x1: n, y0: 0, y1: 1, yref: 'paper', line: { color: colours.ink, width: 1.2, dash: 'dash' }, layer: 'above' }],
    annotations: [{ x: n, y: 0.3, yref: 'paper', yanchor: 'bottom', xanchor: 'left', text: ` case: ${number(n, 5)} rpm`, showarrow: false, font: { size: 11, color: colours.ink } }],
  }));
  const limits = runs.map((r) => r.cutting?.spindle_range_rpm).filter(Boolean);
  const beyond = (x0, x1) => ({ shapes: [{ type: 'rect', x0, x1, y0: 0, y1: 1, yref: 'paper', fillcolor: faint(colours.muted, 0.18), line: { width: 0 }, layer: 'below' }],
    annotations: [{ x: (x0 + x1) / 2, y: 0.66, yref: 'paper', yanchor: 'middle', text: 'beyond the spindle', textangle: -90, showarrow: false, font: { size: 11, color: colours.muted } }] });
  const outside = limits.slice(0, 1).flatMap(([a, b]) => [...(a > from * 1.001 ? [beyond(from, a)] : []), ...(isNumber(b) && b < to * 0.999 ? [beyond(b, to)] : [])]);
  return [...lines, ...outside];
}

/** Speeds at which a main mode makes a whole number k of waves between two teeth: n = 60 f/(k teeth). */
function passing(curves, from, to, colours) {
  const result = [];
  const labelled = [];
  for (const { run, lobe, i } of curves) {
    if (i || !run.cutting?.teeth) continue;
    const colour = colours[lobe.name] ?? colours.robot;
    for (const f of lobe.tooth_passing_hz ?? []) {
      for (let k = 1; k <= 12; k++) {
        const n = (60 * f) / (k * run.cutting.teeth);
        if (n < from || n > to) continue;
        const room = labelled.every((other) => Math.abs(other - n) > (to - from) * 0.025);
        if (room) labelled.push(n);
        result.push({
          shapes: [{ type: 'line', x0: n, x1: n, y0: 0.36, y1: 1, yref: 'paper', line: { color: faint(colour, 0.6), width: 1, dash: 'dot' }, layer: 'below' }],
          annotations: room ? [{ x: n, y: 0.985, yref: 'paper', yanchor: 'top', xanchor: 'right', text: k > 1 ? `${number(f, 3)} Hz, 1/${k}` : `${number(f, 3)} Hz`, textangle: -90, showarrow: false, font: { size: 11, color: colour }, bgcolor: faint(colours.paper, 0.7) }] : [],
        });
      }
    }
  }
  return result;
}

function limitLines(runs, colours) {
  const limits = [...new Set(runs.map((r) => r.cutting?.depth_limit_m).filter(isNumber))];
  return limits.map((d) => ({ type: 'line', xref: 'paper', x0: 0, x1: 1, y0: d * 1e3, y1: d * 1e3, line: { color: colours.muted, width: 1 }, layer: 'below' }));
}

function limitNotes(runs, curves, log, colours) {
  const limits = [...new Set(runs.map((r) => r.cutting?.depth_limit_m).filter(isNumber))];
  const reached = (d) => curves.some((c) => c.depth.some((x) => x > 0.9 * d));
  return limits.filter(reached).map((d) => ({ xref: 'paper', x: 0.006, xanchor: 'left', y: log ? Math.log10(d * 1e3) : d * 1e3, yanchor: 'bottom', text: `depth limit ${number(d * 1e3, 3)} mm`, showarrow: false, font: { size: 11, color: colours.muted } }));
}

function columns(curves) {
  return curves.flatMap(({ run, lobe, rpm, depth, error, chatter, robust, low, high, compared }) => {
    const of = `${run.label}, ${lobeTitle(lobe.name)}`;
    return [{ name: `${of}: spindle speed (rpm)`, values: Array.from(rpm) }, { name: `${of}: limiting depth (mm)`, values: scaled(depth, 1e3) },
      { name: `${of}: estimated error (relative)`, values: Array.from(error ?? []) }, { name: `${of}: chatter frequency (Hz)`, values: Array.from(chatter) },
      { name: `${of}: kind`, values: lobe.kind }, { name: `${of}: status`, values: lobe.status },
      ...(low && high ? [{ name: `${of}: low end of 95 % (mm)`, values: scaled(low, 1e3) }, { name: `${of}: high end of 95 % (mm)`, values: scaled(high, 1e3) }] : []),
      ...(robust ? [{ name: `${of}: robust depth (mm)`, values: scaled(robust, 1e3) }] : []),
      ...compared.flatMap((other) => [{ name: `${of}, ${other.name}: spindle speed (rpm)`, values: Array.from(other.rpm) }, { name: `${of}, ${other.name}: limiting depth (mm)`, values: scaled(other.depth, 1e3) }])];
  });
}
