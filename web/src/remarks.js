// What else there is to say of a run: plain sentences, and what its limits hinge on.

import { el, table } from './dom.js';
import { hertz, number, rpm } from './format.js';
import { lobeTitle } from './lobes.js';

const openly = 5; // sentences that are shown without being asked for
const most = 6; // parameters of a chart
const worthARow = 0.05; // of the first

/** What is left to say of a run: of the headline and of its own sentences, each once. */
export function sentencesOf({ headline: lines = [], runs }, i, answers) {
  const { label, sentences = [] } = runs[i];
  const prefix = runs.length > 1 ? `${label}: ` : '';
  const bare = (line) => (line.startsWith(prefix) ? line.slice(prefix.length) : line);
  const said = new Set(answers.map(bare));
  return [...new Set([...lines.filter((line) => line.startsWith(prefix)).map(bare), ...sentences])].filter((sentence) => !said.has(sentence));
}

/** The content of the section: of each run its sentences, five of them openly, and the folded table of sensitivities. */
export function remarks(data, answers) {
  const { runs } = data;
  const list = (some) => el('ul', { class: 'sentences' }, some.map((sentence) => el('li', {}, sentence)));
  return runs.map((run, i) => {
    const sentences = sentencesOf(data, i, answers);
    const content = [sentences.length ? list(sentences.slice(0, openly)) : null,
      sentences.length > openly && el('details', {}, el('summary', {}, `${sentences.length - openly} more`), list(sentences.slice(openly))), hinges(run)].filter(Boolean);
    return content.length ? [runs.length > 1 && el('h3', {}, run.label), content] : [];
  });
}

const words = { frequency: 'natural frequency', damping_ratio: 'damping', receptance: 'compliance' };

/** By how much 1 % more of a parameter moves the limit at the case's speed: those that matter most. */
function hinges({ summary }) {
  const charts = (summary.lobes ?? []).filter((chart) => chart.at_case_speed?.sensitivities?.length);
  const rows = charts.flatMap(({ name, at_case_speed: { sensitivities: list } }) => list.slice(0, most).filter((s) => Math.abs(s.sensitivity) >= worthARow * Math.abs(list[0].sensitivity))
    .map((s) => [(words[s.parameter] ?? s.parameter) + (s.mode_frequency_hz ? ` of the mode at ${hertz(s.mode_frequency_hz)}` : ''), lobeTitle(name), `${s.sensitivity > 0 ? '+' : ''}${number(s.sensitivity, 3)} %`]));
  if (!rows.length) return null;
  return el('details', { class: 'hinges' }, el('summary', {}, 'What it hinges on'),
    table(`Change of the limit at ${rpm(charts[0].at_case_speed.spindle_speed_rpm)} by 1 % more of a parameter`, ['1 % more', 'Chart', 'Changes the limit by'], rows, true));
}
