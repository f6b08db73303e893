// Receptances: one entry of the matrices of part, robot and the coupled system, and how far the two routes differ.

import { cmif } from './cmif.js';
import { choice, el, tick } from './dom.js';
import { numbers } from './decode.js';
import { faint } from './colours.js';
import { number, plain } from './format.js';
import { between, decades, plot } from './plot.js';

const names = { measured: 'measured', tool: 'tool', part: 'part', robot: 'robot', coupled_receptance: 'coupled, receptances', coupled_spatial: 'coupled, matrices' };
const colour = { measured: 'part', tool: 'robot', part: 'part', robot: 'robot', coupled_receptance: 'supported', coupled_spatial: 'spatial' };

// What is drawn of re + i im (m/N), its axis, and whether an error band (of the modulus) belongs to it.
const displays = {
  log: { title: 'Magnitude, logarithmic', axis: '|H| (µm/N)', of: (re, im) => Math.hypot(re, im) * 1e6, type: 'log', band: true },
  linear: { title: 'Magnitude, linear', axis: '|H| (µm/N)', of: (re, im) => Math.hypot(re, im) * 1e6, band: true },
  db: { title: 'Magnitude, dB', axis: '|H| (dB re 1 m/N)', of: (re, im) => 20 * Math.log10(Math.hypot(re, im)), unit: 'dB' },
  real: { title: 'Real part', axis: 'Re H (µm/N)', of: (re) => re * 1e6 },
  imaginary: { title: 'Imaginary part', axis: 'Im H (µm/N)', of: (re, im) => im * 1e6 },
  phase: { title: 'Phase', axis: 'Phase (°)', of: (re, im) => (Math.atan2(im, re) * 180) / Math.PI, unit: '°' },
  nyquist: { title: 'Nyquist' },
  cmif: { title: 'Mode indicator (CMIF)' },
};

const frfsOf = (run) => [...(run.frf ?? []), ...(run.tool_frf ? [run.tool_frf] : [])];

export function receptances(runs) {
  const all = runs.flatMap((run, i) => frfsOf(run).map((frf) => ({ run, i, frf })));
  if (!all.length) return null;
  const state = { ...first(all), display: 'log', logFrequency: false };
  const chart = plot({ name: 'receptance', label: 'Receptances', build: (colours, narrow) => build(all, runs, state, colours, narrow), columns: () => columns(all, runs, state) });
  const set = (key) => (value) => { state[key] = value; chart.draw(); };
  const unique = (key) => [...new Set(all.filter((a) => a.frf.name !== 'robot' || all.length === 1).flatMap((a) => a.frf[key]))].map((n) => [n, n]);
  return { chart, content: [el('div', { class: 'controls' },
    choice('Response', unique('responses'), state.response, set('response')), choice('Force', unique('forces'), state.force, set('force')),
    choice('Show', Object.entries(displays).map(([k, d]) => [k, d.title]), state.display, set('display')),
    tick('logarithmic frequency', false, set('logFrequency'))), chart.figure, leftOut(runs)] };
}

/** The entry to begin with: the point of the cut, where the run says how far the robot reduces its motion or along its softest direction; else what is reduced. */
function first(all) {
  const { run, frf } = all.find((a) => a.frf.name !== 'robot') ?? all[0];
  const reduced = run.summary.coupling?.reductions?.[0]?.dof;
  const cut = frf.responses.filter((dof) => frf.forces.includes(dof) && dof.slice(0, dof.lastIndexOf('.')) === run.cutting?.at);
  const wanted = !cut.length || cut.includes(reduced) ? reduced : softest(frf, cut);
  const pick = (list) => (list.includes(wanted) ? wanted : list[0]);
  return { response: pick(frf.responses), force: pick(frf.forces) };
}

/** The degree of freedom whose receptance has the highest peak. */
function softest(frf, list) {
  if (list.length === 1) return list[0];
  const [H, n] = [numbers(frf.H), frf.hz.shape[0]];
  const peak = (dof) => {
    const at = (frf.responses.indexOf(dof) * frf.forces.length + frf.forces.indexOf(dof)) * n * 2;
    let largest = 0;
    for (let k = at; k < at + 2 * n; k += 2) largest = Math.max(largest, Math.hypot(H[k], H[k + 1]) || 0);
    return largest;
  };
  return list.reduce((a, b) => (peak(b) > peak(a) ? b : a));
}

/** The row or column of a name; the robot's end stands for the point that it touches. */
function indexOf(list, name, contacts) {
  if (list.includes(name)) return list.indexOf(name);
  const dot = name.lastIndexOf('.');
  const contact = contacts?.find((c) => c.part === name.slice(0, dot));
  return contact ? list.indexOf(`${contact.robot}${name.slice(dot)}`) : -1;
}

/** { hz, re, im, deviation } of the chosen entry, or null. An entry that is left out (NaN) is that of its transpose. */
function entry({ run, frf }, { response, force }) {
  const contacts = run.summary.contacts;
  let [r, f] = [indexOf(frf.responses, response, contacts), indexOf(frf.forces, force, contacts)];
  if (r < 0 || f < 0) return null;
  const [hz, H, deviation] = [numbers(frf.hz), numbers(frf.H), numbers(frf.deviation)];
  const n = hz.length;
  const at = () => r * frf.forces.length + f;
  if (Number.isNaN(H[at() * n * 2])) [r, f] = [frf.responses.indexOf(frf.forces[f]), frf.forces.indexOf(frf.responses[r])];
  if (r < 0 || f < 0) return null;
  const values = H.subarray(at() * n * 2, (at() + 1) * n * 2);
  const coherence = numbers(frf.coherence)?.subarray(at() * n, (at() + 1) * n);
  const poles = numbers(frf.synthesised)?.subarray(at() * n * 2, (at() + 1) * n * 2);
  const [frac, error] = numbers(frf.agreement)?.subarray(at() * 2, (at() + 1) * 2) ?? [];
  const synthesised = poles && Number.isFinite(frac) ? { re: poles.filter((_, k) => k % 2 === 0), im: poles.filter((_, k) => k % 2 === 1), frac, error } : null;
  return { hz, coherence, synthesised, re: values.filter((_, k) => k % 2 === 0), im: values.filter((_, k) => k % 2 === 1), deviation: deviation?.subarray(at() * n, (at() + 1) * n) };
}

const stiff = (runs) => {
  const all = runs.flatMap((run) => run.frf ?? []);
  return all.some((f) => f.name !== 'robot') ? 'part' : all.length ? 'robot' : 'tool';
};

/** What there is to see, and what is not shown of what was computed. */
export function receptancesLead(runs) {
  const apart = runs.filter((run) => run.route_difference).map((run) => numbers(run.route_difference).reduce((a, b) => (b > a ? b : a), 0));
  const of = apart.length ? ` The two ways of coupling differ by at most ${number(Math.max(...apart), 2)}, relative to the largest entry of their frequency (lower panel).` : '';
  return `How far a point moves by a force, over frequency: a lower peak is a stiffer, better damped ${stiff(runs)}.${of}${runs.some((run) => frfsOf(run).some((frf) => frf.coherence)) && !of ? ' Where the coherence (lower panel) falls below 1, noise or what is not linear makes the measurement uncertain.' : ''}`;
}

/** What the page leaves out: degrees of freedom, and lines between those that it draws. */
function leftOut(runs) {
  return runs.flatMap((run) => {
    const of = runs.length > 1 ? `${run.label}: ` : '';
    const thinned = frfsOf(run).filter((frf) => frf.thinned);
    const lines = [...new Set(thinned.map(({ thinned: t }) => `${t.to} of ${t.from} lines`))].join(', ');
    return [...(run.frf_left_out?.length ? [`${of}Left out of this page, in the result folder: ${run.frf_left_out.join(', ')}.`] : []),
      ...(thinned.length ? [`${of}Drawn here: ${lines}; all of them are in the result folder.`] : [])];
  }).map((text) => el('p', { class: 'note' }, text));
}

const label = (one, runs) => (runs.length > 1 ? `${one.run.label}: ` : '') + (names[one.frf.name] ?? one.frf.name);

/** Colours say what it is, dashes of which run: matrices lie upon receptances, so their dashes are finer. */
function style({ frf: { name }, i }, colours) {
  const fine = name === 'coupled_spatial';
  const dash = fine ? ['1px,3px', '6px,3px,1px,3px', '1px,6px'] : ['solid', 'dash', 'dashdot'];
  return { simplify: false, color: colours[colour[name]] ?? colours.mark, width: fine ? 1.3 : 1.8, dash: dash[i % dash.length] };
}

function build(all, runs, state, colours, narrow) {
  const shown = all.map((one) => ({ one, e: entry(one, state) })).filter(({ e }) => e);
  const title = `${plain(state.response)} by a force at ${plain(state.force)}`;
  const note = { text: title, xref: 'paper', yref: 'paper', x: 0.995, y: 0.99, xanchor: 'right', yanchor: 'top', showarrow: false, font: { size: 12 }, bgcolor: faint(colours.paper, 0.75) };
  const margin = { l: narrow ? 54 : 70, r: narrow ? 10 : 18, t: 12, b: 46 };
  if (state.display === 'cmif') return indicator(all, runs, state, margin, colours, narrow);
  return state.display === 'nyquist' ? nyquist(shown, runs, note, margin, colours, narrow) : overFrequency(shown, runs, state, note, margin, colours, narrow);
}

function overFrequency(shown, runs, state, note, margin, colours, narrow) {
  const display = displays[state.display];
  const data = shown.flatMap(({ one, e }) => {
    const x = Array.from(e.hz);
    const y = x.map((_, k) => display.of(e.re[k], e.im[k])).map((v) => (Number.isFinite(v) ? v : null));
    const line = style(one, colours);
    return [...(display.band && e.deviation && one.frf.name !== 'coupled_spatial' ? errorBand(x, y, e.deviation, line.color) : []),
      { name: plain(label(one, runs)), x, y, mode: 'lines', line, hovertemplate: `%{y:.4~g} ${display.unit ?? 'µm/N'}`, meta: `${one.i} ${one.frf.name}` }, ...synthesisedOf(one, e, x, display, runs, colours)];
  });
  const apart = runs.flatMap((run, i) => difference(run, i, runs, colours));
  const coherent = apart.length ? [] : shown.flatMap(({ one, e }) => coherenceOf(one, e, runs, colours));
  const routes = [...apart, ...coherent];
  return { data: [...data, ...routes], layout: {
    height: narrow ? 480 : 580, hovermode: 'x unified', hoversubplots: 'axis', uirevision: `${state.display} ${state.logFrequency}`, margin, annotations: [note],
    xaxis: { title: 'Frequency (Hz)', anchor: routes.length ? 'y2' : 'y', ticks: '', unifiedhovertitle: { text: '%{x:.5~g} Hz' }, type: state.logFrequency ? 'log' : 'linear', dtick: state.logFrequency ? (narrow ? 1 : 'D2') : undefined },
    yaxis: { title: display.axis, domain: [routes.length ? 0.34 : 0, 1], type: display.type ?? 'linear', dtick: display.type === 'log' ? 1 : state.display === 'phase' ? 90 : undefined },
    ...(routes.length ? { yaxis2: { domain: [0, 0.26], ...(coherent.length ? { title: 'Coherence', range: [0, 1.03] } : { title: narrow ? 'Difference' : 'Difference of routes', type: 'log', ...decades(routes.flatMap((r) => r.y), 0.01) }) } } : {}),
  } };
}

function errorBand(x, y, deviation, color) {
  const edge = (sign) => y.map((v, k) => (v === null || !Number.isFinite(deviation[k]) ? null : Math.max(v * 1e-3, v + sign * deviation[k] * 1e6)));
  return [{ ...between(x, edge(-1), edge(1)), fillcolor: faint(color, 0.22) }];
}

function difference(run, i, runs, colours) {
  const values = numbers(run.route_difference);
  const coupled = run.frf?.find((f) => f.name.startsWith('coupled'));
  if (!values || !coupled) return [];
  return [{ name: plain(`${runs.length > 1 ? `${run.label}: ` : ''}difference of the two routes`), x: Array.from(numbers(coupled.hz)), y: Array.from(values, (v) => (v > 0 ? v : null)), yaxis: 'y2', mode: 'lines',
    line: { color: colours.mark, width: 1.2, dash: i ? 'dash' : 'solid' }, hovertemplate: '%{y:.2~e}', meta: `${i} difference` }];
}

/** What the poles that were fitted to a measured entry make of it, and how well both agree. */
function synthesisedOf(one, { synthesised }, x, display, runs, colours) {
  if (!synthesised) return [];
  const { re, im, frac, error } = synthesised;
  return [{ name: plain(`${one.frf.name === 'measured' ? '' : `${label(one, runs)}, `}fitted: FRAC ${number(frac, 4)}, ${error < 1e-4 ? 'below 0.01' : number(error * 100, 2)} % off`), x, y: x.map((_, k) => display.of(re[k], im[k])).map((v) => (Number.isFinite(v) ? v : null)), mode: 'lines',
    line: { simplify: false, color: colours.mark, width: 1.4, dash: 'dash' }, hovertemplate: `%{y:.4~g} ${display.unit ?? 'µm/N'}`, meta: `${one.i} ${one.frf.name} synthesised` }];
}

/** The coherence of a measured entry, where its file has one. */
function coherenceOf(one, { hz, coherence }, runs, colours) {
  if (!coherence || !coherence.some(Number.isFinite)) return [];
  return [{ name: plain(`${label(one, runs)}: coherence`), x: Array.from(hz), y: Array.from(coherence, (v) => (Number.isFinite(v) ? v : null)), yaxis: 'y2', mode: 'lines',
    line: { color: style(one, colours).color, width: 1.2, dash: one.i ? 'dash' : 'solid' }, hovertemplate: '%{y:.3~g}', meta: `${one.i} ${one.frf.name} coherence` }];
}

function nyquist(shown, runs, note, margin, colours, narrow) {
  const trace = (name, e, { re, im }, line, meta) => ({ name, x: Array.from(re, (v) => v * 1e6), y: Array.from(im, (v) => v * 1e6), customdata: Array.from(e.hz), mode: 'lines', line, hovertemplate: '%{customdata:.5~g} Hz: %{x:.4~g}, %{y:.4~g} µm/N', meta });
  const data = shown.flatMap(({ one, e }) => [trace(plain(label(one, runs)), e, e, style(one, colours), `${one.i} ${one.frf.name}`),
    ...(e.synthesised ? [trace('fitted', e, e.synthesised, { simplify: false, color: colours.mark, width: 1.4, dash: 'dash' }, `${one.i} ${one.frf.name} synthesised`)] : [])]);
  return { data, layout: { height: narrow ? 480 : 580, hovermode: 'closest', uirevision: 'nyquist', margin, annotations: [note],
    xaxis: { title: 'Re H (µm/N)', zeroline: true }, yaxis: { title: 'Im H (µm/N)', scaleanchor: 'x', zeroline: true } } };
}

/** Singular values of the whole matrices: the first strong, the others thin, of every FRF with more than one degree of freedom. */
function indicator(all, runs, state, margin, colours, narrow) {
  const curves = all.flatMap((one) => {
    if (one.frf.name === 'coupled_spatial') return []; // lies upon that of the receptances
    const line = style(one, colours);
    const fitted = one.frf.name === 'measured' && one.frf.synthesised; // of every entry
    return [{ frf: one.frf, line, name: label(one, runs), meta: `${one.i} ${one.frf.name}` },
      ...(fitted ? [{ frf: { ...one.frf, H: fitted }, line: { ...line, color: colours.mark, dash: 'dash' }, name: 'fitted', meta: `${one.i} ${one.frf.name} synthesised` }] : [])];
  });
  const data = curves.flatMap(({ frf, line, name, meta }) => {
    const found = cmif(frf);
    return (found?.values ?? []).map((values, k) => ({ name: plain(`${name}${k ? `, singular value ${k + 1}` : ''}`), showlegend: k === 0, legendgroup: meta, x: Array.from(found.hz), y: Array.from(values, (v) => (v > 0 ? v * 1e6 : null)),
      mode: 'lines', line: { ...line, width: k ? 0.9 : 2, color: k ? faint(line.color, 0.7) : line.color }, hovertemplate: '%{y:.4~g} µm/N', meta: `${meta} cmif ${k}` }));
  });
  return { data, layout: { height: narrow ? 480 : 580, hovermode: 'x unified', uirevision: `cmif ${state.logFrequency}`, margin,
    xaxis: { title: 'Frequency (Hz)', unifiedhovertitle: { text: '%{x:.5~g} Hz' }, type: state.logFrequency ? 'log' : 'linear' }, yaxis: { title: 'Singular values of H (µm/N)', type: 'log', dtick: 1 } } };
}

function columns(all, runs, state) {
  if (state.display === 'cmif') {
    return all.flatMap((one) => { const found = cmif(one.frf); const name = `${one.run.label}, ${names[one.frf.name] ?? one.frf.name}`;
      return found ? [{ name: `${name}: frequency (Hz)`, values: Array.from(found.hz) }, ...found.values.map((v, k) => ({ name: `${name}: singular value ${k + 1} (m/N)`, values: Array.from(v) }))] : []; });
  }
  const of = `${state.response}/${state.force}`;
  return all.flatMap((one) => {
    const e = entry(one, state);
    const name = `${one.run.label}, ${names[one.frf.name] ?? one.frf.name}`;
    return e ? [{ name: `${name}: frequency (Hz)`, values: Array.from(e.hz) }, { name: `${name}: Re ${of} (m/N)`, values: Array.from(e.re) }, { name: `${name}: Im ${of} (m/N)`, values: Array.from(e.im) },
      ...(e.synthesised ? [{ name: `${name}, fitted: Re ${of} (m/N)`, values: Array.from(e.synthesised.re) }, { name: `${name}, fitted: Im ${of} (m/N)`, values: Array.from(e.synthesised.im) }] : []),
      ...(e.coherence ? [{ name: `${name}: coherence ${of}`, values: Array.from(e.coherence) }] : [])] : [];
  }).concat(runs.flatMap((run) => (run.route_difference ? [{ name: `${run.label}: difference of the routes (relative)`, values: Array.from(numbers(run.route_difference)) }] : [])));
}
