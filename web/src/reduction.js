// How good the reduced model is, the mesh that it came from, and the coupling.

import { el, table } from './dom.js';
import { hertz, isNumber, number, percent, plain } from './format.js';
import { plot } from './plot.js';

/** The reduction's figures as a table of one row a figure, one column a run. */
function reductionTable(runs) {
  const of = (f) => (run) => (run.summary.reduction ? f(run.summary.reduction, run.summary) : null);
  return figures('Reduction', runs, [
    ['Method', of((r) => r.method?.replaceAll('_', '-'))],
    ['Full model', of((r) => isNumber(r.full_dofs) ? `${r.full_dofs} degrees of freedom` : null)],
    ['Reduced model', of((r) => isNumber(r.size) ? `${r.size}: ${r.interface_dofs} at the points, ${r.kept_modes} modes` : null)],
    ['Largest error of a frequency', of((r) => relative(r.max_relative_frequency_error))],
    ['Largest error of a receptance', of((r) => relative(r.max_relative_receptance_error))],
    ['Left out of the part’s receptances', of((_, s) => truncated(s.error_budget?.part))],
  ]);
}

/** What the two ways of coupling say of each other, and what the receptances are off by. */
function couplingTable(runs) {
  const of = (f) => (run) => f(run.summary);
  return figures('Coupling', runs, [
    ['Left out of the coupled receptances', of((s) => truncated(s.error_budget?.coupled))],
    ...['part', 'robot', 'coupled'].map((name) => [`Noise of the receptances, ${name}`, of((s) => noise(s.error_budget?.[name]))]),
    ['Difference of the two routes', of((s) => (s.coupling?.route_difference ? `${number(s.coupling.route_difference.max_relative, 3)} at ${hertz(s.coupling.route_difference.at_frequency_hz)}` : null))],
    ['Largest condition number of the coupling', of((s) => (isNumber(s.coupling?.kernel_condition_max) ? number(s.coupling.kernel_condition_max, 3) : null))],
  ]);
}

function meshTable(runs) {
  const of = (f) => (run) => (run.summary.mesh ? f(run.summary.mesh, run.summary) : null);
  const count = (key) => of((m) => (isNumber(m[key]) ? String(m[key]) : null));
  return figures('Mesh', runs, [
    ['Nodes', count('nodes')], ['Elements', count('elements')], ['Order of the elements', count('order')], ['Degrees of freedom', count('dofs')],
    ['Worst quality (1 is best)', of((m) => (isNumber(m.min_quality) ? number(m.min_quality, 3) : null))],
    ['Smallest dihedral angle', of((m) => (isNumber(m.smallest_dihedral_deg) ? `${number(m.smallest_dihedral_deg, 3)}°` : null))],
    ['Worst aspect ratio', of((m) => (isNumber(m.worst_aspect_ratio) ? number(m.worst_aspect_ratio, 3) : null))],
    ['Estimated error of the frequencies', of((m) => estimated(m, 'max_relative_frequency_error'))],
    ['Estimated error of the receptances', of((m) => estimated(m, 'max_relative_receptance_error'))],
    ['Mass of the part', of((_, s) => (isNumber(s.part?.mass_kg) ? `${number(s.part.mass_kg, 4)} kg` : null))],
  ]);
}

/** With what was asked for, where it was not reached. */
const estimated = ({ error_estimate: e }, key) => (isNumber(e?.[key]) ? percent(e[key], 2) + (e.met === false && e[key] > e.tolerance ? `, more than the ${percent(e.tolerance, 2)} asked for` : '') : null);
const relative = (x) => (isNumber(x) ? percent(x, 2) : null);
const truncated = (budget) => (budget?.truncation ? `${percent(budget.truncation.largest_relative, 2)} at ${hertz(budget.truncation.at_frequency_hz)}` : null);

const noise = (budget) => (budget?.noise ? `${percent(budget.noise.largest_relative, 2)} at ${hertz(budget.noise.at_frequency_hz)}` : null);

/** The section: its title and sentence say what is in it, and it is not there where nothing is. */
export function quality(runs) {
  const plotted = reductionPlot(runs);
  const [reduction, mesh, coupling] = [reductionTable(runs), meshTable(runs), couplingTable(runs)];
  const names = [(reduction || plotted) && 'reduction', mesh && 'mesh', coupling && 'coupling'].filter(Boolean);
  if (!names.length) return null;
  const list = names.length > 1 ? `${names.slice(0, -1).join(', ')} and ${names.at(-1)}` : names[0];
  const lead = [reduction || plotted || mesh ? `How much the ${names.filter((n) => n !== 'coupling').map((n) => (n === 'mesh' ? 'mesh' : 'reduced model')).join(' and the ')} leave${(reduction || plotted) && mesh ? '' : 's'} out of the full one.` : '',
    coupling ? 'What is known of the errors of the coupling.' : ''].filter(Boolean).join(' ');
  return { chart: plotted, title: list[0].toUpperCase() + list.slice(1), lead, content: [plotted?.figure, el('div', { class: 'columns' }, [reduction, mesh, coupling].filter(Boolean))] };
}

/** Rows without a value in any run are left out; null where none is left. */
function figures(caption, runs, rows) {
  const filled = rows.map(([name, f]) => [name, ...runs.map(f)]).filter(([, ...values]) => values.some((v) => v !== null && v !== undefined));
  return filled.length ? table(caption, ['', ...runs.map((r) => (runs.length > 1 ? r.label : 'Value'))], filled) : null;
}

/** Error against size; null where no run has it. */
function reductionPlot(runs) {
  const having = runs.filter((run) => run.reduction_error?.modes?.length);
  if (!having.length) return null;
  return plot({
    name: 'reduction', label: 'Error of the reduction against its size',
    build: (colours, narrow) => ({
      data: having.map((run, i) => ({ name: plain(run.label), x: run.reduction_error.modes, y: run.reduction_error.error, mode: 'lines+markers', showlegend: having.length > 1,
        line: { color: colours.part, width: 2, dash: i ? 'dash' : 'solid' }, marker: { size: 7 }, hovertemplate: '%{x} modes: %{y:.2~e}', meta: `reduction ${i}` })),
      layout: { height: narrow ? 280 : 320, hovermode: 'closest', margin: { l: 64, r: 16, t: 12, b: 46 },
        xaxis: { title: 'Modes kept', showspikes: false }, yaxis: { title: 'Largest relative error', type: 'log', dtick: 1 } },
    }),
    columns: () => having.flatMap((run) => [{ name: `${run.label}: modes kept`, values: run.reduction_error.modes }, { name: `${run.label}: largest relative error`, values: run.reduction_error.error }]),
  });
}
