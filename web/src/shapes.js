// A run's surface and mode shapes as numbers that can be drawn; shapes are decoded when they are first looked at.

import { numbers } from './decode.js';

const surfaces = new WeakMap();

/**
 * What is drawn of `shapes`, lengths in m: { positions, triangles, fixture (a flag a triangle), centre, radius, size, points (with their nearest vertex
 * and the surface's normal there), held (vertices of a fixture's marks and normals), fixtures (their names), edges (pairs of vertices), arm, pushes (those of the points where a robot
 * without an arm pushes, and along what), thickness (of a triangle: { values, low, high, median }), direction (to look from at first) }.
 */
export function surface(shapes) {
  if (!surfaces.has(shapes)) surfaces.set(shapes, decode(shapes));
  return surfaces.get(shapes);
}

function decode(shapes) {
  const raw = numbers(shapes.vertices);
  const positions = Float32Array.from(raw, (q, i) => shapes.origin_m[i % 3] + shapes.step_m * q);
  const triangles = numbers(shapes.triangles);
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
  const size = high.map((h, k) => h - low[k]);
  const fixture = new Uint8Array(triangles.length / 3);
  for (const f of shapes.fixtures ?? []) numbers(f.triangles).forEach((t) => { fixture[t] = 1; });
  const facets = facetsOf(positions, triangles);
  const result = { positions, triangles, fixture, size, centre: low.map((l, k) => (l + high[k]) / 2), radius: Math.hypot(...size) / 2 };
  const normalAt = normalsAt(triangles, facets);
  result.points = (shapes.points ?? []).map((p) => { const vertex = nearest(positions, p.position_m); return outwards(p, vertex, normalAt(vertex, () => true)); });
  result.held = spaced(positions, triangles.filter((_, i) => fixture[(i / 3) | 0]), result.radius * 0.07).map((v) => ({ v, normal: normalAt(v, (t) => fixture[t]) }));
  result.edges = sharpEdges(triangles, positions.length / 3, facets.normals);
  result.fixtures = (shapes.fixtures ?? []).map((f) => f.name);
  result.arm = shapes.robot_arm ?? null;
  if (!result.arm) for (const p of result.points) if (p.contact) Object.assign(p, pushOf(p));
  result.pushes = result.points.filter((p) => p.push);
  result.thickness = thicknessOf(numbers(shapes.thickness_m), facets.areas);
  result.direction = firstView(result, facets);
  return result;
}

/** A point with its vertex, normal and joined directions; these have no sign, so those are taken that point out of the part. */
function outwards(point, vertex, normal) {
  const out = (d) => (d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2] < 0 ? d.map((x) => -x) : d);
  return { ...point, vertex, normal, joined: (point.joined ?? []).map(out) };
}

/** { push, along }: the direction in which a robot pushes at a contact, from outside inwards, and which of the joined ones it is: that nearest to the surface's normal. */
function pushOf({ joined, normal }) {
  const along = (d) => d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2];
  const best = joined.reduce((a, b) => (Math.abs(along(b)) > Math.abs(along(a)) ? b : a), joined[0] ?? normal);
  const sign = along(best) > 0 ? -1 : 1;
  return { push: best.map((x) => (sign * x) / Math.hypot(...best)), along: best };
}

/**
 * Values of the triangles and the range of their colours: the least is always inside, the highest tenth of the surface is not, since the faces
 * across a wall are as thick as the wall is wide.
 */
function thicknessOf(values, areas) {
  if (!values) return null;
  const order = Array.from(values.keys()).filter((t) => Number.isFinite(values[t])).sort((a, b) => values[a] - values[b]);
  if (!order.length) return null;
  const whole = order.reduce((sum, t) => sum + areas[t], 0);
  const share = (p) => { let sum = 0; return values[order.find((t) => (sum += areas[t]) >= p * whole) ?? order.at(-1)]; };
  const [low, largest] = [values[order[0]], values[order.at(-1)]];
  return { values, low, median: share(0.5), largest, high: Math.min(largest, Math.max(share(0.9), 1.2 * low)) };
}

/** Edges where two triangles meet at more than 30 degrees, or that only one has: pairs of vertices. */
function sharpEdges(triangles, count, normals) {
  const seen = new Map(); // by both ends, the lower first: the triangle that has the edge and waits for its neighbour
  const sharp = [];
  triangles.forEach((a, i) => {
    const t = (i / 3) | 0;
    const b = triangles[i % 3 === 2 ? i - 2 : i + 1];
    const key = a < b ? a * count + b : b * count + a;
    const other = seen.get(key);
    if (other === undefined) { seen.set(key, t); return; }
    seen.delete(key);
    const cosine = normals[3 * t] * normals[3 * other] + normals[3 * t + 1] * normals[3 * other + 1] + normals[3 * t + 2] * normals[3 * other + 2];
    if (cosine < 0.866) sharp.push(a, b);
  });
  for (const key of seen.keys()) sharp.push(Math.floor(key / count), key % count);
  return sharp;
}

/** Unit normals and areas (times two) of the triangles. */
function facetsOf(p, triangles) {
  const [normals, areas] = [new Float32Array(triangles.length), new Float32Array(triangles.length / 3)];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]];
    const [ux, uy, uz, vx, vy, vz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2], p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(nx, ny, nz) || 1;
    normals[i] = nx / length;
    normals[i + 1] = ny / length;
    normals[i + 2] = nz / length;
    areas[i / 3] = length;
  }
  return { normals, areas };
}

/** The surface's outward normal at a vertex, of those of its triangles that are wanted. */
function normalsAt(triangles, { normals, areas }) {
  const met = new Map();
  return (vertex, wanted) => {
    if (!met.size) triangles.forEach((v, i) => { if (!met.has(v)) met.set(v, []); met.get(v).push((i / 3) | 0); });
    const sum = [0, 0, 0];
    for (const t of met.get(vertex) ?? []) if (wanted(t)) for (const k of [0, 1, 2]) sum[k] += areas[t] * normals[3 * t + k];
    const length = Math.hypot(...sum);
    return length > 0 ? sum.map((x) => x / length) : [0, 0, 1];
  };
}

/** Some of the vertices, about evenly apart, where a fixture's marks stand: in each cell of a grid the one nearest to its middle. */
function spaced(positions, vertices, apart) {
  const cells = new Map();
  for (const v of new Set(vertices)) {
    const at = [0, 1, 2].map((k) => positions[3 * v + k] / apart);
    const cell = at.map(Math.round);
    const distance = Math.hypot(...at.map((x, k) => x - cell[k]));
    const key = cell.join();
    if (!(cells.get(key)?.distance <= distance)) cells.set(key, { v, distance });
  }
  return Array.from(cells.values(), ({ v }) => v);
}

function nearest(positions, [x, y, z]) {
  let best = 0;
  let least = Infinity;
  for (let i = 0; i < positions.length; i += 3) {
    const d = (positions[i] - x) ** 2 + (positions[i + 1] - y) ** 2 + (positions[i + 2] - z) ** 2;
    if (d < least) [best, least] = [i / 3, d];
  }
  return best;
}

const decodedShapes = new WeakMap();

/** { vectors (of the vertices), lengths, robot, reach } of a mode; its largest length on the part is 1, `reach` counts the robot's end too. */
export function shapeOf(mode) {
  if (!decodedShapes.has(mode)) {
    const vectors = Float32Array.from(numbers(mode.shape), (q) => q * mode.step);
    const lengths = new Float32Array(vectors.length / 3);
    for (let v = 0; v < lengths.length; v++) lengths[v] = Math.hypot(vectors[3 * v], vectors[3 * v + 1], vectors[3 * v + 2]);
    decodedShapes.set(mode, { vectors, lengths, robot: mode.robot ?? null, reach: Math.max(1, Math.hypot(...(mode.robot ?? [0]))) });
  }
  return decodedShapes.get(mode);
}

/** The diagonal of the arm's box, m. */
export const armSize = (arm) => Math.hypot(...[0, 1, 2].map((k) => Math.max(...arm.map((p) => p[k])) - Math.min(...arm.map((p) => p[k]))));

/** The displaced joints of the robot's arm: its end moves by `robot`, its base stays. */
export function armAt(arm, robot, amount) {
  return arm.map((joint, i) => joint.map((x, k) => x + amount * (robot?.[k] ?? 0) * (i / (arm.length - 1))));
}

/** Where a point is when its vertex is displaced. */
export const pointAt = (point, { vectors }, amount) => point.position_m.map((x, k) => x + amount * vectors[3 * point.vertex + k]);

/** The direction to look from at first: on the widest face, from above and aside (z is up), from that of four sides where most of contacts and fixtures is seen. */
function firstView({ size, points, fixture }, { normals, areas }) {
  const thin = size.indexOf(Math.min(...size));
  const direction = [0.5, -0.55, 0.45];
  if (size[thin] < 0.5 * Math.max(...size)) direction[thin] = Math.sign(direction[thin]) * 1;
  const length = Math.hypot(...direction);
  const sides = [[1, 1], [-1, 1], [1, -1], [-1, -1]].map(([x, y]) => [x * direction[0] / length, y * direction[1] / length, direction[2] / length]);
  const facing = (d, n, at = 0) => d[0] * n[at] + d[1] * n[at + 1] + d[2] * n[at + 2] > 0.05;
  const held = Array.from(fixture.keys()).filter((t) => fixture[t]);
  const area = held.reduce((sum, t) => sum + areas[t], 0) || 1;
  const score = (d) => points.reduce((sum, p) => sum + (facing(d, p.normal) ? (p.contact ? 1 : 0.25) : 0), 0) + (0.5 * held.reduce((sum, t) => sum + (facing(d, normals, 3 * t) ? areas[t] : 0), 0)) / area;
  return sides.map((d) => [d, score(d)]).reduce((a, b) => (b[1] > a[1] + 1e-3 ? b : a))[0];
}

/** Half of a robot's symbol in diameters of the part: how far it stands from its contact. */
export const symbolLength = 0.16;

/** What has to be in the picture: the part's box with room for its motion and, where it is shown, the robot; { centre, points about it }. */
export function extent({ centre, size, radius, arm, pushes }, robot) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((c) => centre.map((x, k) => x + ((c >> k) & 1 ? 0.5 : -0.5) * (size[k] + 0.15 * radius)));
  const points = [...corners, ...(robot ? [...(arm ?? []), ...pushes.map((p) => p.position_m.map((x, k) => x - p.push[k] * symbolLength * 2 * radius))] : [])];
  const middle = [0, 1, 2].map((k) => (Math.min(...points.map((p) => p[k])) + Math.max(...points.map((p) => p[k]))) / 2);
  return { centre: middle, points: points.map((p) => p.map((x, k) => x - middle[k])) };
}
