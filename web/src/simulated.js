// Simulated operating points: which of them is on show, and their marks on the chart of the lobes, which lead to it.

import { number, plain } from './format.js';
import { lobeTitle, withRobot } from './lobes.js';

/** Every simulated point of all runs with its tables; the supported part's first, since that is the cut which is asked about. */
export const simulatedPoints = (runs) => runs.flatMap((run, i) => (run.summary.simulation?.points ?? []).map((point, k) => ({ run, i, point, tables: run.simulation?.points?.[k] ?? {} })))
  .sort((a, b) => a.i - b.i || withRobot(b.point.chart) - withRobot(a.point.chart));

export const growing = ({ growth }) => growth.lobes_modulus > 1;
export const placeOf = (p) => `${number(p.spindle_speed_rpm, 5)} rpm, ${number(p.depth_m * 1e3, 4)} mm`;
export const titleOf = ({ run, point }, several) => `${several ? `${run.label}: ` : ''}${lobeTitle(point.chart)}, ${placeOf(point)}`;

let shown = 0;
const listeners = [];
/** The number of the point on show, among simulatedPoints(). */
export const shownPoint = () => shown;
/** Calls back when another point is to be shown. */
export const onShownPoint = (listener) => { listeners.push(listener); };
export function showPoint(index) {
  shown = index;
  listeners.forEach((listener) => listener(index));
}

/** A diamond for each point, filled where it is on show; a click leads to its simulation. */
export function simulationMarks(runs, colours) {
  const points = simulatedPoints(runs);
  return points.length ? [{ name: 'simulated point', x: points.map(({ point }) => point.spindle_speed_rpm), y: points.map(({ point }) => point.depth_m * 1e3), mode: 'markers', cliponaxis: false,
    marker: { symbol: points.map((_, k) => (k === shown ? 'diamond' : 'diamond-open')), size: points.map(({ point }) => (withRobot(point.chart) ? 15 : 10)), color: colours.mark, line: { width: 2, color: colours.mark } },
    customdata: points.map(({ point }) => plain(`${placeOf(point)}, simulated: ${point.motion.replaceAll('_', ' ')}`)), hovertemplate: '%{customdata}', meta: 'simulated' }] : [];
}

/** Shows the simulation of a point of the chart that was clicked on. */
export function followMark(event) {
  const mark = event.points.find((p) => p.data.meta === 'simulated');
  if (!mark) return;
  showPoint(mark.pointNumber);
  document.getElementById('simulation')?.scrollIntoView({ behavior: 'smooth' });
}
