// The shape without WebGL: triangles sorted by depth and painted from behind on a 2-D canvas, in parallel projection.

import { palette, viridis } from './colours.js';
import { armAt, extent, pointAt, symbolLength } from './shapes.js';

/** The same view as of scene.js. */
export function picture(canvas, drawn) {
  const pen = canvas.getContext('2d');
  let [surface, shape, levels, amount, width, height, scale, axes] = [null, null, null, 0, 1, 1, 1, null];
  let direction = [1, 0, 0];
  let magnification = 1;
  let whole = false;
  let room = null;
  let undeformed = true;

  const project = (p) => {
    const d = p.map((x, k) => x - room.centre[k]);
    return [width / 2 + scale * dot(axes.right, d), height / 2 - scale * dot(axes.up, d), dot(axes.toward, d)];
  };

  function paint() {
    axes = basis(direction);
    room = extent(surface, whole);
    const reach = (axis) => Math.max(...room.points.map((p) => Math.abs(dot(axis, p))));
    scale = magnification * 0.93 * Math.min(width / reach(axes.right), height / reach(axes.up)) / 2;
    pen.fillStyle = palette().paper;
    pen.fillRect(0, 0, width, height);
    const placed = displaced(surface, shape, amount).map(project);
    paintTriangles(pen, surface, placed, levels);
    if (undeformed) paintEdges(pen, surface, project);
    paintMarks(pen, surface, shape, amount, project);
    drawn((p) => { const [x, y] = project(p); return [x / width, y / height]; }, viewMatrix(axes));
  }

  return {
    show(next) { surface = next; direction = surface.direction; },
    mode(next, nextLevels) { [shape, levels] = [next, nextLevels]; },
    draw(next) { amount = next; paint(); },
    outline(on) { undeformed = on; },
    turn(x, y) {
      const azimuth = Math.atan2(direction[1], direction[0]) + x;
      const elevation = Math.min(1.5, Math.max(-1.5, Math.asin(direction[2]) + y));
      direction = [Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation)];
      paint();
    },
    zoom(factor) { magnification /= factor; paint(); },
    home(robot = whole) { whole = robot; direction = surface.direction; magnification = 1; paint(); },
    resize(w, h) {
      const ratio = Math.min(2, devicePixelRatio);
      [canvas.width, canvas.height, width, height] = [w * ratio, h * ratio, w, h];
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      if (shape) paint();
    },
    recolour() { if (shape) paint(); },
  };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

function basis(toward) {
  const right = unit(cross([0, 0, 1], toward));
  return { toward, right, up: cross(toward, right) };
}

const viewMatrix = ({ right, up, toward }) => [0, 1, 2].flatMap((k) => [right[k], up[k], toward[k], 0]);

function displaced({ positions }, { vectors }, amount) {
  const result = [];
  for (let i = 0; i < positions.length; i += 3) result.push([positions[i] + amount * vectors[i], positions[i + 1] + amount * vectors[i + 1], positions[i + 2] + amount * vectors[i + 2]]);
  return result;
}

function paintTriangles(pen, { triangles, fixture }, placed, levels) {
  const order = Array.from(fixture.keys(), (t) => [t, placed[triangles[3 * t]][2] + placed[triangles[3 * t + 1]][2] + placed[triangles[3 * t + 2]][2]]).sort((a, b) => a[1] - b[1]);
  for (const [t] of order) {
    const [a, b, c] = [0, 1, 2].map((k) => placed[triangles[3 * t + k]]);
    const n = unit(cross([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]).map((x) => x || 1e-30));
    const light = 0.7 + 0.3 * Math.abs(n[2]);
    const level = levels.flat ? levels.values[t] : [0, 1, 2].reduce((s, k) => s + levels.values[triangles[3 * t + k]] / 3, 0);
    const colour = (fixture[t] ? [204, 121, 167] : level < -0.5 ? [153, 153, 153] : viridis(level)).map((x) => Math.round(x * light));
    pen.fillStyle = pen.strokeStyle = `rgb(${colour.join(',')})`;
    pen.lineWidth = 0.5;
    pen.beginPath();
    pen.moveTo(a[0], a[1]);
    pen.lineTo(b[0], b[1]);
    pen.lineTo(c[0], c[1]);
    pen.closePath();
    pen.fill();
    pen.stroke();
  }
}

/** The undeformed part's edges. */
function paintEdges(pen, { positions, edges }, project) {
  pen.strokeStyle = palette().muted;
  pen.lineWidth = 0.8;
  const at = (v) => project([positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]]);
  for (let i = 0; i < edges.length; i += 2) line(pen, [at(edges[i]), at(edges[i + 1])]);
}

function paintMarks(pen, surface, shape, amount, project) {
  pen.strokeStyle = '#cc79a7';
  pen.lineWidth = 4;
  for (const { v, normal } of surface.held) {
    const at = [0, 1, 2].map((k) => surface.positions[3 * v + k]);
    line(pen, [at, at.map((x, k) => x + normal[k] * surface.radius * 0.048)].map(project));
  }
  for (const point of surface.points) {
    const at = pointAt(point, shape, amount);
    const [x, y] = project(at);
    pen.fillStyle = pen.strokeStyle = '#d55e00';
    pen.beginPath();
    pen.arc(x, y, point.contact ? 5 : 3, 0, 7);
    pen.fill();
    pen.lineWidth = 2.5;
    for (const d of point.joined) if (!(shape.robot && d === point.along)) line(pen, [[x, y], project(at.map((v, k) => v + d[k] * surface.radius * 0.22))]);
  }
  if (!shape.robot) return;
  pen.strokeStyle = '#009e73';
  pen.lineWidth = 6;
  pen.lineJoin = pen.lineCap = 'round';
  if (surface.arm) line(pen, armAt(surface.arm, shape.robot, amount).map(project));
  for (const { position_m: at, push } of surface.pushes) {
    const tip = at.map((x, k) => x + amount * shape.robot[k]);
    line(pen, [tip, tip.map((x, k) => x - push[k] * symbolLength * 2 * surface.radius)].map(project));
  }
}

function line(pen, points) {
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}
