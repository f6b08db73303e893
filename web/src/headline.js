// The answer: the headline, one sentence on the cut, three figures, and the other figures of the verdict as a strip.

import { el, table } from './dom.js';
import { hertz, isNumber, millimetres, number, percent, rpm } from './format.js';
import { cutSentence } from './cut.js';
import { lobeTitle, withRobot } from './lobes.js';
import { sentencesOf } from './remarks.js';

const cards = 3; // figures that stand large; the others are a strip beneath them
const openlyDifferent = 8;

export function headline(data) {
  const { runs } = data;
  const { summary } = runs[0];
  const title = runs.length > 1 ? runs.map((run) => run.label).join(' and ') : summary.title || summary.case;
  const answers = firstLines(data);
  return el('header', { class: 'headline', id: 'answer' },
    el('h1', {}, title),
    answers.map((answer) => el('p', { class: runs.length > 1 ? 'answer several' : 'answer' }, answer)),
    differences(data),
    runs.map((run, i) => ofRun(run, sentencesOf(data, i, answers), runs.length > 1)));
}

/** The headline's first line; of a comparison what it says of no single run, and the first line of every run, which begins with its label. */
export function firstLines({ headline: lines = [], runs }) {
  if (runs.length === 1) return [lines[0] ?? ''];
  const of = (run) => lines.filter((line) => line.startsWith(`${run.label}: `));
  const single = new Set(runs.flatMap(of));
  return [...new Set([...lines.filter((line) => !single.has(line)), ...runs.map((run) => of(run)[0]).filter(Boolean)])];
}

/** Where the cases of several runs differ: [[key, value of the first, value of the second, …]]. */
function differences({ differences: list = [], runs }) {
  if (runs.length < 2 || !list.length) return null;
  const text = (v) => (v === null || v === undefined || v === '' ? null : typeof v === 'object' ? JSON.stringify(v) : isNumber(v) ? number(v, 6) : String(v));
  const rows = list.map(([key, ...values]) => [key, ...runs.map((_, i) => ({ text: text(values[i]), class: 'prose' }))]);
  const part = (caption, some) => table(caption, ['Key', ...runs.map((run) => run.label)], some);
  return el('div', { class: 'differences' }, part('What differs', rows.slice(0, openlyDifferent)),
    rows.length > openlyDifferent && el('details', {}, el('summary', {}, `${rows.length - openlyDifferent} more differences`), part('What differs, continued', rows.slice(openlyDifferent))));
}

function ofRun(run, sentences, labelled) {
  const { summary } = run;
  const figures = [...(summary.path?.length ? ofPath(summary.path) : ofCharts(summary)), ...verdict(summary), ...error(summary, sentences), ...frequencies(summary), ...checks(summary)];
  const list = (name, some) => (some.length ? el('dl', { class: name }, some.map(([title, value, note, mark]) => el('div', {}, el('dt', {}, title), el('dd', { class: mark }, value), el('dd', { class: 'note' }, note)))) : null);
  const cut = cutSentence(run);
  return [labelled && el('h2', { class: 'run' }, run.label), cut && el('p', { class: 'cutting' }, cut), list('tiles', figures.slice(0, cards)), list('tiles strip', figures.slice(cards))];
}

/** Of the first operating point of the chart that counts: margin, contact, power, surface; and the depth that is robust. */
function verdict(summary) {
  const { main } = charts(summary.lobes);
  const point = (summary.operating_points ?? []).find((p) => p.chart === main?.name);
  const result = point && isNumber(point.depth_margin_m) ? [[`Margin at ${rpm(point.spindle_speed_rpm)} and ${millimetres(point.depth_m)}`,
    `${point.depth_margin_at_limit ? '≥ ' : ''}${millimetres(point.depth_margin_m)}`, point.stable ? 'stable' : 'chatter', point.stable ? 'good' : 'bad']] : [];
  const { contact, forced_vibration: forced } = point ?? {};
  const holds = main?.at_case_speed?.contact;
  if (contact) result.push(['Contact force', `${number(contact.least_force_n, 3)} to ${number(contact.largest_force_n, 3)} N`, contact.lost ? 'the cut pulls the contact open' : `preload ${number(contact.preload_n, 3)} N`, contact.lost ? 'bad' : undefined]);
  else if (holds) result.push(['Contact', isNumber(holds.lost_above_m) ? `lost above ${millimetres(holds.lost_above_m)}` : 'holds', `preload ${number(holds.preload_n, 3)} N`, isNumber(holds.lost_above_m) ? 'bad' : 'good']);
  if (isNumber(forced?.mean_power_w)) result.push(['Mean power', `${number(forced.mean_power_w, 3)} W`, `peak force ${number(forced.peak_force_n, 3)} N`]);
  if (isNumber(forced?.surface_location_error_m)) result.push(['Surface location error', `${number(forced.surface_location_error_m * 1e6, 3)} µm`, forced.surface_location_error_m > 0 ? 'overcut' : 'undercut']);
  if (main?.robust) result.push(['Robust depth', millimetres(main.robust.minimum_depth_m), `at every speed, ${number(main.robust.confidence, 3)} standard deviations`]);
  return result;
}

/** The chart that counts, with the robot if there is one, and the part's own beside it. */
function charts(list = []) {
  const named = (name) => list.find((l) => l.name === name);
  const robots = list.find((l) => withRobot(l.name));
  const main = robots ?? named('part') ?? list[0];
  return { main, other: robots && named('part'), who: main && lobeTitle(main.name) };
}

function ofCharts(summary) {
  const { main, other, who } = charts(summary.lobes);
  if (!main) return [];
  const depth = (l) => `${l?.at_depth_limit ? '≥ ' : ''}${millimetres(l?.limiting_depth_m)}`;
  const result = [];
  const now = main.at_case_speed;
  if (now) result.push([`Limit at ${rpm(now.spindle_speed_rpm)}, ${who}`, depth(now), other?.at_case_speed ? `alone ${depth(other.at_case_speed)}` : 'the speed of the case']);
  const unlimited = main.speeds > 0 && main.speeds_stable_to_depth_limit === main.speeds;
  result.push([`Lowest limit, ${who}`, `${unlimited ? '≥ ' : ''}${millimetres(main.minimum_depth_m)}`,
    other ? `alone ${millimetres(other.minimum_depth_m)}: ${number(main.minimum_depth_m / other.minimum_depth_m, 3)} times` : `at ${rpm(main.at_spindle_speed_rpm)}`]);
  const best = main.best_pocket;
  if (best) {
    const title = best.at_chart_edge ? 'Edge of the chart' : main.robust ? 'Best robust pocket' : 'Best pocket';
    result.push([`${title}, ${who}`, `${best.at_depth_limit ? '≥ ' : ''}${millimetres(best.depth_m)} at ${rpm(best.spindle_speed_rpm)}`,
      (isNumber(best.removal_rate_cm3_per_min) ? `${number(best.removal_rate_cm3_per_min, 3)} cm³/min; ` : '')
      + `nine tenths at ${number(best.from_spindle_speed_rpm, 4)} to ${rpm(best.to_spindle_speed_rpm)}`]);
  }
  return result;
}

/** Where a path is cut, its single positions are no answer. */
function ofPath(list) {
  const { main, other, who } = charts(list);
  const result = [];
  const deepest = main.deepest_everywhere;
  if (deepest) {
    const alone = other?.deepest_everywhere;
    result.push([`Deepest everywhere, ${who}`, `${deepest.at_depth_limit ? '≥ ' : ''}${millimetres(deepest.depth_m)}`, `at ${rpm(deepest.spindle_speed_rpm)}${alone ? `; alone ${millimetres(alone.depth_m)}` : ''}`]);
  }
  const { weakest } = main;
  if (weakest) {
    const place = weakest.at_m ? `position ${weakest.position}, (${weakest.at_m.map((x) => number(x * 1e3, 4)).join(', ')}) mm` : `position ${weakest.position}`;
    result.push([`Weakest of the path, ${who}`, millimetres(weakest.minimum_depth_m), `${place}, at ${rpm(weakest.at_spindle_speed_rpm)}`]);
  }
  return result;
}

/** One source for the error: where a sentence gives it, no second figure stands beside that. */
function error({ lobes = [], path = [] }, sentences) {
  if (sentences.some((s) => /estimated error/i.test(s))) return [];
  const errors = (path.length ? path : lobes).map((chart) => chart.error_estimate_relative).filter(isNumber);
  return errors.length ? [['Estimated error of the limits', percent(Math.max(...errors), 2), 'of the computation, see below for the model’s']] : [];
}

function frequencies(summary) {
  const alone = summary.part?.modes?.[0]?.frequency_hz;
  const { modes = [], main_modes: main = [] } = summary.coupling ?? {};
  const coupled = (modes.length ? modes : main)[0]?.frequency_hz;
  const robot = summary.robot?.modes?.[0]?.frequency_hz;
  const name = modes.length || !isNumber(coupled) ? 'First mode' : 'First main mode';
  if (isNumber(coupled)) return [[name, hertz(coupled), `with robot${isNumber(alone) ? `; alone ${hertz(alone)}` : ''}`]];
  if (isNumber(alone)) return [[name, hertz(alone), 'part alone']];
  return isNumber(robot) ? [[name, hertz(robot), 'robot']] : [];
}

function checks(summary) {
  const all = summary.checks ?? [];
  const good = all.filter((c) => c.ok).length;
  return all.length ? [['Checks', `${good} of ${all.length} hold`, good === all.length ? 'all as expected' : 'see below']] : [];
}
