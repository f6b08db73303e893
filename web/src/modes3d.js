// The moving mode shapes: choice, sliders, legend and labels around a view (WebGL, or a still picture without it).

import { comac } from './comac.js';
import { button, choice, el, icon, slider, svg, tick } from './dom.js';
import { isPrinting, onColours, viridis } from './colours.js';
import { hertz, number, percent } from './format.js';
import { save } from './plot.js';
import { armSize, shapeOf, surface } from './shapes.js';
import { hasWebGL, scene } from './scene.js';
import { picture } from './picture.js';

const still = matchMedia('(prefers-reduced-motion: reduce)');
const largest = 0.14; // displacement at full amplitude, in diameters of the part
const onlyRobot = 100; // times as far as the part: what the part does then is not worth its colours

/** { content, start() } of the section; null where no run has shapes. `start` makes the picture once the section is in the page. */
export function modes3d(runs) {
  const entries = runs.flatMap((run) => (run.shapes?.modes ?? []).map((mode) => ({ run, mode })));
  if (!entries.length) return null;
  const parts = elements();
  const state = { at: firstMode(entries), amplitude: 0.6, phase: 0, playing: false, colour: 'displacement', view: 'part', outline: true, seen: false };
  const viewer = { entries, parts, state, several: runs.length > 1 };
  const content = layout(viewer);
  return { content, start: () => start(viewer) };
}

/** The first coupled mode, since that is what the robot makes of the part; else the first there is. */
const firstMode = (entries) => Math.max(0, entries.findIndex(({ mode }) => mode.of === 'coupled'));

function elements() {
  const canvas = el('canvas', { tabindex: 0, role: 'img', class: 'shape' });
  const labels = svg('svg', { class: 'labels', 'aria-hidden': 'true' });
  return { canvas, labels, box: el('div', { class: 'stage' }, canvas, labels), note: el('p', { class: 'note', 'aria-live': 'polite' }), legend: el('div', { class: 'legend' }), warning: el('p', { class: 'note' }) };
}

const kinds = { part: 'part alone', coupled: 'part with robot' };
const shorter = { part: 'part', coupled: 'part with robot' };
const describe = ({ mode }) => `${shorter[mode.of] ?? mode.of} ${mode.number}: ${hertz(mode.hz)}`;

function options({ entries, several }) {
  const groups = new Map();
  entries.forEach((entry, i) => {
    const group = `${several ? `${entry.run.label}: ` : ''}${kinds[entry.mode.of] ?? entry.mode.of}`;
    if (!groups.has(group)) groups.set(group, []);
    groups.get(group).push([i, describe(entry)]);
  });
  return [...groups].map(([group, list]) => ({ group, options: list }));
}

function layout(viewer) {
  const { parts, state, entries } = viewer;
  const change = (key, then) => (value) => { state[key] = value; then(viewer); };
  parts.play = button([icon('play'), ' Play'], 'Play or pause the motion', () => play(viewer, !state.playing));
  parts.phase = slider('Phase', { min: 0, max: 360, step: 1, value: 0 }, (v) => { play(viewer, false); state.phase = v; draw(viewer); });
  const mode = choice('Mode', options(viewer), state.at, (v) => { state.at = Number(v); showMode(viewer); });
  const step = (d) => { state.at = (state.at + d + entries.length) % entries.length; mode.querySelector('select').value = state.at; showMode(viewer); };
  const thick = entries.some(({ run }) => run.shapes.thickness_m);
  const paired = entries.some(({ run }) => run.mac);
  const arm = entries.some(({ run, mode }) => run.shapes.robot_arm && mode.robot);
  parts.canvas.addEventListener('keydown', (event) => key(viewer, event));
  return [
    el('div', { class: 'controls' }, mode, el('span', { class: 'pair' }, button(icon('back'), 'Previous mode', () => step(-1)), button(icon('play'), 'Next mode', () => step(1))),
      (thick || paired) && choice('Colour', [['displacement', 'displacement'], ...(thick ? [['thickness', 'wall thickness']] : []), ...(paired ? [['comac', 'likeness alone and with robot']] : [])], 'displacement', change('colour', showMode)),
      arm && choice('View', [['part', 'part'], ['all', 'part and robot']], 'part', change('view', showMode)),
      slider('Amplitude', { min: 0, max: 1, step: 0.01, value: state.amplitude }, change('amplitude', draw)), parts.phase, parts.play,
      tick('undeformed edges', true, (on) => { viewer.view?.outline(on); draw(viewer); })),
    parts.warning,
    el('figure', { class: 'figure' }, parts.box,
      el('figcaption', { class: 'under' }, parts.legend, parts.note),
      el('div', { class: 'exports' }, button('+', 'Closer', () => viewer.view.zoom(0.8)), button('−', 'Farther', () => viewer.view.zoom(1.25)), button('Reset view', 'Mode shape: reset the view', () => viewer.view.home()),
        button('PNG', 'Mode shape: save the picture', () => parts.canvas.toBlob((blob) => save(`mode-${entries[state.at].mode.of}-${entries[state.at].mode.number}.png`, 'image/png', blob))),
        button('CSV', 'Mode shape: save as CSV', () => save(`mode-${entries[state.at].mode.of}-${entries[state.at].mode.number}.csv`, 'text/csv', csv(entries[state.at]))))),
  ];
}

function start(viewer) {
  const { parts, state } = viewer;
  const context = hasWebGL(parts.canvas);
  const drawn = (project, matrix) => label(viewer, project, matrix);
  viewer.view = context ? scene(parts.canvas, context, drawn) : picture(parts.canvas, drawn);
  parts.box.dataset.view = context ? 'webgl' : 'picture';
  if (!context) {
    parts.warning.textContent = 'This browser has no WebGL: the picture stands still, at the phase chosen.';
    parts.play.disabled = true;
  }
  const resize = () => {
    const [w, h] = [parts.box.clientWidth, parts.box.clientHeight];
    if (!w || isPrinting()) return;
    parts.labels.setAttribute('viewBox', `0 0 ${w} ${h}`);
    parts.size = [w, h];
    viewer.view.resize(w, h);
  };
  viewer.view.recolour();
  resize();
  showMode(viewer);
  new ResizeObserver(resize).observe(parts.box);
  onColours(() => { if (isPrinting()) play(viewer, false); viewer.view.recolour(); });
  new IntersectionObserver(([entry]) => { state.seen = entry.isIntersecting; if (state.seen && state.playing) play(viewer, true); }).observe(parts.box);
  if (context && !still.matches) play(viewer, true);
}

function showMode(viewer) {
  const { entries, state, view, parts } = viewer;
  const { run, mode } = entries[state.at];
  const body = surface(run.shapes);
  const shape = shapeOf(mode);
  const whole = Boolean(shape.robot) && (!body.arm || state.view === 'all' || shape.reach > onlyRobot); // the symbol of a robot without an arm is small
  const moved = viewer.body !== body || viewer.whole !== whole;
  if (viewer.body !== body) { view.show(body); viewer.body = body; nameLabels(viewer); }
  const levels = levelsOf(viewer, shape);
  view.mode(shape, levels);
  legend(parts.legend, levels, body, shape);
  parts.note.textContent = noteOf(viewer, shape);
  parts.canvas.setAttribute('aria-label', `Shape of ${parts.note.textContent} Arrow keys turn it, + and − zoom.`);
  if (moved) view.home(whole);
  viewer.whole = whole;
  draw(viewer);
}

/** The colours: how far each place moves as a share of the part's largest, or the wall's thickness; and what they stand for in words. */
function levelsOf({ body, state, entries }, shape) {
  const { thickness } = body;
  const like = state.colour === 'comac' && comac(entries[state.at].run);
  if (like) return { values: like, flat: false, title: 'part alone against with robot (COMAC)', from: '0', to: '1' };
  if (state.colour !== 'thickness' || !thickness) {
    const values = shape.reach > onlyRobot ? new Float32Array(shape.lengths.length) : shape.lengths;
    return { values, flat: false, title: 'displacement', from: '0', to: 'largest' };
  }
  const { values, low, high, largest } = thickness;
  const mm = (t) => `${number(t * 1e3, 3)} mm`;
  return { values: values.map((t) => (Number.isFinite(t) ? (t - low) / (high - low || 1) : -1)), flat: true, title: 'wall thickness', from: mm(low), to: `${mm(high)}${largest > 1.001 * high ? ' and more' : ''}` };
}

function noteOf({ several, entries, state, body }, shape) {
  const { run, mode } = entries[state.at];
  const { thinned } = run.shapes;
  const { thickness } = body;
  return [`${several ? `${run.label}, ` : ''}${kinds[mode.of] ?? mode.of}, mode ${mode.number}: ${hertz(mode.hz)}, damping ${percent(mode.damping)}.`,
    shape.reach > onlyRobot ? 'Here the robot alone moves.' : shape.reach > 1.5 ? `The robot’s end moves ${number(shape.reach, 2)} times as far as the part.` : '',
    state.colour === 'thickness' && thickness ? `Thinnest ${number(thickness.low * 1e3, 3)} mm; half of the surface at most ${number(thickness.median * 1e3, 3)} mm.` : '',
    thinned ? `The surface is thinned from ${thinned.from} to ${thinned.to} vertices for this page.` : ''].filter(Boolean).join(' ');
}

/** By how far everything is displaced now: the farthest of part and robot by a share of the part's diameter, or of the arm's where it alone moves. */
function amountOf({ state, body, entries }) {
  const { reach } = shapeOf(entries[state.at].mode);
  const diameter = reach > onlyRobot && body.arm ? armSize(body.arm) : 2 * body.radius;
  return (state.amplitude * largest * diameter * Math.cos((state.phase * Math.PI) / 180)) / reach;
}

function draw(viewer) {
  if (viewer.body) viewer.view.draw(amountOf(viewer));
}

/** Runs only while the picture is seen: a page in the background costs nothing. */
function play(viewer, on) {
  const { state, parts } = viewer;
  state.playing = on;
  parts.play.replaceChildren(icon(on ? 'pause' : 'play'), on ? ' Pause' : ' Play');
  if (!on || viewer.running) return;
  viewer.running = true;
  let before = null;
  const frame = (now) => {
    viewer.running = state.playing && state.seen;
    if (!viewer.running) return;
    if (before !== null) state.phase = (state.phase + ((now - before) / 1000) * 240) % 360;
    before = now;
    parts.phase.input.value = state.phase;
    draw(viewer);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

function key({ view }, event) {
  const actions = { ArrowLeft: () => view.turn(-0.1, 0), ArrowRight: () => view.turn(0.1, 0), ArrowUp: () => view.turn(0, 0.1), ArrowDown: () => view.turn(0, -0.1), '+': () => view.zoom(0.9), '-': () => view.zoom(1.1) };
  if (!actions[event.key]) return;
  actions[event.key]();
  event.preventDefault();
}

/** A bar of the colours, and what the other colours stand for. */
function legend(box, { title, from, to }, body, shape) {
  const bar = svg('svg', { class: 'bar', viewBox: '0 0 64 4', preserveAspectRatio: 'none', 'aria-hidden': 'true' });
  for (let i = 0; i < 64; i++) bar.append(svg('rect', { x: i, y: 0, width: 1.2, height: 4, fill: `rgb(${viridis(i / 63).join(',')})` }));
  const swatch = (colour, text) => el('span', { class: 'key' }, svgSwatch(colour), text);
  box.replaceChildren(el('span', { class: 'key' }, `${title}: ${from} `, bar, ` ${to}`),
    body.held.length ? swatch('#cc79a7', heldBy(body.fixtures)) : '',
    body.points.length ? swatch('#d55e00', `points${body.points.some((p) => p.joined.some((d) => !(shape.robot && d === p.along))) ? '; arrows: directions joined' : ''}`) : '',
    shape.robot && (body.arm || body.pushes.length) ? swatch('#009e73', 'robot') : '');
}

const heldBy = (names) => (names.length && names.join() !== 'held' ? `held: ${names.join(', ')}` : 'held');
const svgSwatch = (colour) => svg('svg', { class: 'swatch', viewBox: '0 0 10 10', 'aria-hidden': 'true' }, svg('circle', { cx: 5, cy: 5, r: 5, fill: colour }));

/** Names at the points and the axes in the corner, drawn over the canvas. */
function nameLabels(viewer) {
  const { parts, body } = viewer;
  viewer.names = body.points.map((p) => svg('text', { class: 'point' }, p.name));
  viewer.triad = ['x', 'y', 'z'].map((name) => [svg('line', {}), svg('text', {}, name)]);
  parts.labels.replaceChildren(...viewer.names, ...viewer.triad.flat());
}

function label(viewer, project, matrix) {
  const { parts, state, body, names, entries } = viewer;
  if (!names) return;
  const [w, h] = parts.size;
  const shape = shapeOf(entries[state.at].mode);
  const amount = amountOf(viewer);
  names.forEach((text, i) => {
    const point = body.points[i];
    const [x, y] = project(point.position_m.map((p, k) => p + amount * shape.vectors[3 * point.vertex + k]));
    text.setAttribute('x', (x * w + 9).toFixed(1));
    text.setAttribute('y', (y * h - 8).toFixed(1));
  });
  const [x0, y0, r] = [40, h - 40, 26];
  viewer.triad.forEach(([line, text], k) => {
    const [dx, dy] = [matrix[4 * k] * r, -matrix[4 * k + 1] * r];
    const values = { x1: x0, y1: y0, x2: x0 + dx, y2: y0 + dy };
    for (const [name, v] of Object.entries(values)) line.setAttribute(name, v.toFixed(1));
    text.setAttribute('x', (x0 + dx * 1.35 - 3).toFixed(1));
    text.setAttribute('y', (y0 + dy * 1.35 + 4).toFixed(1));
  });
}

function csv({ run, mode }) {
  const { positions } = surface(run.shapes);
  const { vectors } = shapeOf(mode);
  const lines = ['x (mm),y (mm),z (mm),dx (of the largest),dy (of the largest),dz (of the largest)'];
  for (let i = 0; i < positions.length; i += 3) {
    lines.push([0, 1, 2].map((k) => (positions[i + k] * 1e3).toPrecision(6)).concat([0, 1, 2].map((k) => vectors[i + k].toPrecision(5))).join(','));
  }
  return `${lines.join('\n')}\n`;
}
