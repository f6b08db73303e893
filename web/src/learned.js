// What the cuts that were made taught: the learned chart, the cut to make next, and the parameters before and after.

import { el, table } from './dom.js';
import { isNumber, number, percent, plain } from './format.js';
import { share } from './observed.js';

/** What a run's last chart learned; undefined where no cut was learned from. */
export const learnedOf = (run) => (run.summary.lobes ?? []).at(-1)?.learned;

/** The cuts that are proposed: the one that tells most, and the one that removes most at the case's risk. */
export const proposedCuts = (run) => [learnedOf(run)?.next_cut, learnedOf(run)?.productive_cut].filter(Boolean);

const prefix = (runs, run) => (runs.length > 1 ? `${plain(run.label)}: ` : '');

/** The depths that are stable with 50 and 95 % of what the cuts left possible. */
export function learnedLines(runs, colours) {
  return runs.flatMap((run, i) => {
    const learned = learnedOf(run);
    if (!learned) return [];
    const line = (name, key, dash) => ({ name: `${prefix(runs, run)}${name}`, x: learned.rows.map((row) => row.spindle_speed_rpm), y: learned.rows.map((row) => row[key] * 1e3),
      mode: 'lines', line: { color: colours.mark, width: 1.6, dash }, hovertemplate: '%{y:.4~g} mm', meta: `learned ${i} ${key}` });
    return [line('learned', 'median_m', 'dash'), line('learned, stable with 95 %', 'stable_95_m', 'dot')];
  });
}

const place = (cut) => `${number(cut.spindle_speed_rpm, 5)} rpm, ${number(cut.depth_m * 1e3, 3)} mm`;
const risk = (cut) => `chatters with a probability of ${percent(cut.chatter_probability, 2)}`;

/** "narrows the relative standard deviation of the limit at 9000 rpm from 12 % to 7 %". */
function gain(cut) {
  const what = isNumber(cut.for_rpm) ? `the limit at ${number(cut.for_rpm, 5)} rpm` : 'the best speed';
  return `narrows the relative standard deviation of ${what} from ${percent(cut.deviation_before, 2)} to ${percent(cut.deviation_after, 2)}`;
}

/** A trace for each cut that is proposed. */
export function proposedMarks(runs, colours) {
  const mark = (run, i, cut, name, symbol, note) => ({ name: `${prefix(runs, run)}${name}`, x: [cut.spindle_speed_rpm], y: [cut.depth_m * 1e3], mode: 'markers', cliponaxis: false,
    marker: { symbol, size: 17, color: colours.mark, line: { width: 1.5, color: colours.paper } }, customdata: [`${name}: ${place(cut)}, ${note}`], hovertemplate: '%{customdata}', meta: `proposed ${i} ${symbol}` });
  return runs.flatMap((run, i) => {
    const { next_cut: next, productive_cut: productive } = learnedOf(run) ?? {};
    return [next && mark(run, i, next, 'next cut', 'star-diamond', `${risk(next)}; ${gain(next)}`), productive && mark(run, i, productive, 'removes most', 'triangle-up', risk(productive))].filter(Boolean);
  });
}

const said = (run) => {
  const { next_cut: next, productive_cut: productive } = learnedOf(run);
  return [
    next ? `The next cut to make is ${place(next)}: it ${risk(next)}, and its outcome ${gain(next)}.` : 'No next cut is proposed; the run’s warnings say why.',
    productive ? `The cut that removes most at the case’s risk is ${place(productive)}, which ${risk(productive)}.` : '',
  ].filter(Boolean).join(' ');
};

const names = { frequency: 'frequency', damping_ratio: 'damping ratio', mass: 'modal mass, share' };
const units = { frequency: ' Hz' };

function parameterRow(p) {
  if (p.parameter === 'speed_exponent') {
    const value = (v, deviation) => `${number(v, 2)} ± ${number(deviation, 2)}`;
    return ['exponent q of the coefficients over the speed, n^−q', value(p.before, p.relative_deviation_before), value(p.after, p.relative_deviation_after), `${number(p.moved, 2)} deviations`];
  }
  const of = isNumber(p.mode_frequency_hz) ? ` at ${number(p.mode_frequency_hz, 4)} Hz` : '';
  const scale = p.parameter in names ? 1 : 1e-6;
  const unit = p.parameter in names ? units[p.parameter] ?? '' : ' N/mm²';
  const value = (v, relative) => `${number(v * scale, 4)}${unit} ± ${percent(relative, 2)}`;
  return [`${names[p.parameter] ?? p.parameter}${of}`, value(p.before, p.relative_deviation_before), value(p.after, p.relative_deviation_after), `${number(p.moved, 2)} deviations`];
}

/** The next cut in words, the shares before and after, and every parameter; an empty list where nothing was learned. */
export function learnedTables(run) {
  const learned = learnedOf(run);
  if (!learned) return [];
  const shares = [['the case as it stands', learned.before], ['after learning, the cuts learned from', learned.after], ['cuts left out of what was learned', learned.cross_validated]]
    .filter(([, s]) => s).map(([what, s]) => [what, share(s)]);
  const against = (learned.contradictions ?? []).map((cut) => [place(cut), `seen ${cut.observed}`, percent(cut.chatter_probability, 2)]);
  return [
    el('p', { class: 'next-cut' }, said(run)),
    table('Cuts on the right side', ['Chart', 'Right, 95 % interval'], shares, true),
    table('What the cuts taught', ['Parameter', 'Before', 'After', 'Moved by'], learned.parameters.map(parameterRow), true),
    against.length ? table('Cuts that contradict the others', ['Cut', 'Seen', 'Probability of chatter by all cuts'], against, true) : null,
  ].filter(Boolean);
}
