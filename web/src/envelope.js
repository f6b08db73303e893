// Limiting depths of a robot's low and of its high modes by themselves, and of all modes together.

import { numbers } from './decode.js';
import { faint } from './colours.js';
import { hertz, scaled } from './format.js';
import { plot } from './plot.js';

/** The chart. */
export function envelopeChart({ rpm, low_m: low, high_m: high, together_m: together }, split) {
  const x = Array.from(numbers(rpm));
  const curves = { low: scaled(numbers(low), 1e3), high: scaled(numbers(high), 1e3), together: scaled(numbers(together), 1e3) };
  const least = x.map((_, i) => { const both = [curves.low[i], curves.high[i]].filter((v) => v !== null); return both.length ? Math.min(...both) : null; });
  const build = (colours, narrow) => {
    const curve = (name, meta, y, line) => ({ name, x, y, mode: 'lines', line: { simplify: false, ...line }, meta, hovertemplate: `%{x:.5~g} rpm: %{y:.4~g} mm` });
    return { data: [curve('envelope: the lesser of both', 'envelope', least, { color: faint(colours.muted, 0.35), width: 8 }),
      curve(`modes below ${hertz(split)} alone`, 'low', curves.low, { color: colours.part, width: 2, dash: 'dash' }), curve(`modes above ${hertz(split)} alone`, 'high', curves.high, { color: colours.robot, width: 2, dash: 'dot' }),
      curve('all modes together', 'together', curves.together, { color: colours.supported, width: 2.4 })], layout: { height: narrow ? 360 : 420, hovermode: 'closest', xaxis: { title: 'Spindle speed (rpm)' }, yaxis: { title: 'Limiting depth (mm)', type: 'log', dtick: narrow ? 1 : 'D2' } } };
  };
  return plot({ name: 'envelope', label: 'Low and high modes', build, columns: () => [{ name: 'spindle speed (rpm)', values: x }, { name: 'low modes (mm)', values: curves.low }, { name: 'high modes (mm)', values: curves.high }, { name: 'all modes (mm)', values: curves.together }] });
}
