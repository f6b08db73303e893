// Shapes of a test on its points: dots and lines that move, drawn on a canvas.

import { isPrinting, onColours, palette } from './colours.js';
import { button, choice, el, icon, slider } from './dom.js';
import { number } from './format.js';
import { displacements } from './motion.js';

const turnPerPixel = 0.008;
const periodMs = 1600;

/** { content, start } of shapes as in the document; null without them. */
export function pointShapes(shapes) {
  if (!shapes?.modes.length) return null;
  const state = { mode: 0, scale: 0.25, yaw: 0.7, pitch: 0.45, phase: 0, playing: !matchMedia('(prefers-reduced-motion: reduce)').matches };
  const canvas = el('canvas', { class: 'shape', tabindex: 0, role: 'img', 'aria-label': 'Shape of a mode on the points of the test' });
  const draw = () => paint(canvas, shapes, state);
  const play = button(icon(state.playing ? 'pause' : 'play'), 'Play or pause', () => {
    state.playing = !state.playing;
    play.replaceChildren(icon(state.playing ? 'pause' : 'play'));
    if (state.playing) run();
  });
  const run = () => { requestAnimationFrame((now) => { state.phase = (2 * Math.PI * now) / periodMs; draw(); if (state.playing) run(); }); };
  turnByPointer(canvas, state, draw);
  new ResizeObserver(draw).observe(canvas);
  onColours(draw);
  const names = shapes.modes.map((mode, i) => [i, `${i + 1}: ${number(mode.hz, 5)} Hz`]);
  return { start: () => { draw(); if (state.playing) run(); }, content: [
    el('div', { class: 'controls' }, choice('Mode', names, 0, (value) => { state.mode = Number(value); draw(); }), play,
      slider('Amplitude', { min: 0.02, max: 0.6, step: 0.01, value: state.scale }, (value) => { state.scale = value; draw(); })),
    el('div', { class: 'stage' }, canvas)] };
}

function turnByPointer(canvas, state, draw) {
  canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    state.yaw += event.movementX * turnPerPixel;
    state.pitch = Math.max(-1.5, Math.min(1.5, state.pitch + event.movementY * turnPerPixel));
    draw();
  });
  canvas.addEventListener('keydown', ({ key }) => {
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[key];
    if (!step) return;
    state.yaw += step[0];
    state.pitch += step[1];
    draw();
  });
}

/** Middle and radius of the points, m. */
function extentOf(points) {
  const middle = [0, 1, 2].map((k) => (Math.max(...points.map((p) => p.position_m[k])) + Math.min(...points.map((p) => p.position_m[k]))) / 2);
  return { middle, radius: Math.max(1e-12, ...points.map((p) => Math.hypot(...p.position_m.map((x, k) => x - middle[k])))) };
}

function paint(canvas, { points, lines, modes }, state) {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (!width || !height) return;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext('2d');
  const colours = palette();
  const { middle, radius } = extentOf(points);
  const size = (0.36 * Math.min(width, height)) / radius;
  const [cy, sy, cp, sp] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.pitch), Math.sin(state.pitch)];
  const onPaper = (p) => { // z up, seen along y at first
    const [x, y, z] = p.map((v, k) => v - middle[k]);
    const [u, v] = [cy * x - sy * y, sy * x + cy * y];
    return [width / 2 + size * u, height / 2 - size * (cp * z + sp * v)];
  };
  const moved = displacements(modes[state.mode].shape, state.playing && !isPrinting() ? state.phase : 0);
  const rest = points.map((p) => onPaper(p.position_m));
  const there = points.map((p, i) => onPaper(p.position_m.map((x, k) => x + state.scale * radius * moved[i][k])));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  net(pen, rest, lines, colours.grid, 1, 2);
  pen.strokeStyle = colours.muted;
  pen.lineWidth = 1;
  pen.beginPath();
  rest.forEach((a, i) => { pen.moveTo(...a); pen.lineTo(...there[i]); });
  pen.stroke();
  net(pen, there, lines, colours.supported, 2, 4);
  if (points.length > 40) return;
  pen.fillStyle = colours.muted;
  pen.font = '12px system-ui, sans-serif';
  points.forEach((p, i) => pen.fillText(p.name, rest[i][0] + 6, rest[i][1] - 6));
}

function net(pen, at, lines, colour, width, dot) {
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  for (const [i, k] of lines) { pen.moveTo(...at[i]); pen.lineTo(...at[k]); }
  pen.stroke();
  for (const [x, y] of at) { pen.beginPath(); pen.arc(x, y, dot, 0, 2 * Math.PI); pen.fill(); }
}
