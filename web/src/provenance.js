// Where the results come from: program, inputs, times, the case itself.

import { el, table } from './dom.js';
import { isNumber, number } from './format.js';

export function provenance(data) {
  return data.runs.map((run) => el('div', {}, data.runs.length > 1 && el('h3', {}, run.label), ofRun(run, data.program)));
}

function ofRun({ manifest = {}, summary, case: text }, program) {
  const times = Object.entries(manifest.timings_s ?? summary.timings_s ?? {}).sort(([, a], [, b]) => b - a);
  const facts = [['Program', manifest.program ? `${manifest.program.name} ${manifest.program.version}` : program], ['Page made by', program], ['Started (UTC)', manifest.started_utc],
    ['Threads', isNumber(manifest.threads) ? String(manifest.threads) : null], ['Seeds', manifest.seeds?.length ? manifest.seeds.join(', ') : 'none'], ['Case', summary.case], ['Status', summary.status]];
  return [
    el('div', { class: 'columns' },
      table('Run', ['', 'Value'], facts.filter(([, v]) => v)),
      times.length ? table('Time', ['Stage', 'Seconds'], times.map(([name, t]) => [name, number(t, 3)])) : null),
    manifest.inputs?.length ? table('Inputs', ['File', 'SHA-256'], manifest.inputs.map((i) => [i.name, { text: i.sha256, class: 'hash' }])) : null,
    manifest.program?.built_with && el('details', {}, el('summary', {}, 'Compiler and libraries'), el('pre', {}, manifest.program.built_with)),
    text && el('details', {}, el('summary', {}, 'The case as it was written'), el('pre', {}, text)),
  ];
}
