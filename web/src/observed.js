// Cuts that were made: what was seen of them on the chart, and how often the chart predicts it, as a table.

import { table } from './dom.js';
import { isNumber, number, percent, plain } from './format.js';
import { lobeTitle } from './lobes.js';
import { isDoubtful, isWrong, symbolOf } from './judged.js';

const shown = { stable: 'circle', chatter: 'x', marginal: 'diamond' };

/** The judged cuts of a run, each chart's own list. */
export const observedOf = (run) => (run.summary.lobes ?? []).filter((chart) => chart.observed).map((chart) => ({ chart: chart.name, ...chart.observed }));

function note(cut) {
  const said = cut.predicted_stable ? 'stable' : 'chatter';
  const chance = isNumber(cut.chatter_probability) ? `, ${percent(cut.chatter_probability, 2)} of the draws chatter` : '';
  return `${number(cut.spindle_speed_rpm, 5)} rpm, ${number(cut.depth_m * 1e3, 3)} mm: seen ${cut.observed}, predicted ${said}${isDoubtful(cut) ? ', which is doubtful' : ''}${chance}`;
}

/** A trace for each outcome: its sign says what was seen, a thick ring that the prediction is wrong. Of several charts the last is shown. */
export function observedMarks(runs, colours) {
  return runs.flatMap((run, i) => {
    const judged = observedOf(run).at(-1);
    if (!judged) return [];
    return Object.entries(shown).flatMap(([outcome, symbol]) => {
      const cuts = judged.cuts.filter((cut) => cut.observed === outcome);
      if (!cuts.length) return [];
      const colour = { stable: colours.good, chatter: colours.bad, marginal: colours.mark }[outcome];
      return [{ name: `${runs.length > 1 ? `${plain(run.label)}: ` : ''}seen ${outcome}`, x: cuts.map((c) => c.spindle_speed_rpm), y: cuts.map((c) => c.depth_m * 1e3), mode: 'markers', cliponaxis: false,
        marker: { symbol: cuts.map((c) => symbolOf(c, symbol)), size: cuts.map((c) => (isWrong(c) ? 13 : 8)), color: colour, line: { width: cuts.map((c) => (isWrong(c) ? 2.5 : 1)), color: colour } },
        customdata: cuts.map(note), hovertemplate: '%{customdata}', meta: `observed ${i} ${outcome}` }];
    });
  });
}

/** "41 of 46, 89 % (77 to 95 %)"; null where nothing was counted. */
export const share = (s) => (s && s.of ? `${s.right} of ${s.of}, ${number(100 * s.share, 2)} % (${number(100 * s.low, 2)} to ${number(100 * s.high, 2)} %)` : null);

/** How often each chart is right; null where no cut was made. */
export function observedTable(run) {
  const list = observedOf(run);
  if (!list.length) return null;
  const certain = (c) => (c ? `stable ${c.certainly_stable} (${c.certainly_stable_that_chattered} chattered), chatter ${c.certainly_unstable} (${c.certainly_unstable_that_were_stable} stable), open ${c.open}` : null);
  const columns = [
    ['Chart', (o) => lobeTitle(o.chart)], ['Right, 95 % interval', (o) => share(o.prediction)], ['Zeroth order', (o) => share(o.textbook)],
    ['Stable but predicted chatter', (o) => o.stable_wrong], ['Chatter but predicted stable', (o) => o.chatter_wrong], ['Marginal', (o) => o.marginal], ['Doubtful', (o) => o.doubtful ?? null], ['Certain', (o) => certain(o.certainty)],
    ['Frequencies, median difference', (o) => (isNumber(o.median_frequency_difference_relative) ? `${o.frequencies_heard}, ${percent(o.median_frequency_difference_relative, 2)}` : null)],
  ].filter(([, of]) => list.some((o) => of(o) !== null));
  return table('Cuts that were made', columns.map(([head]) => head), list.map((o) => columns.map(([, of]) => of(o))), true);
}
