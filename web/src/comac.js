// How alike the shapes of two structures are at each place (COMAC, Lieven and Ewins 1988): 1 where they move alike in every pair of modes, 0 where nothing agrees.

import { numbers } from './decode.js';
import { shapeOf } from './shapes.js';

const alike = 0.5; // MAC of two modes that are a pair at least

/** Pairs of a run's shapes, part alone and with the robot: each mode with the one that it is most like. */
function pairs({ shapes, mac }) {
  if (!mac || !shapes) return [];
  const values = numbers(mac.values);
  const columns = mac.values.shape[1];
  const [alone, coupled] = ['part', 'coupled'].map((of) => shapes.modes.filter((m) => m.of === of && m.number <= mac.values.shape[of === 'part' ? 0 : 1]));
  return alone.flatMap((a) => {
    const at = (b) => values[(a.number - 1) * columns + b.number - 1];
    const best = coupled.reduce((x, y) => (x && at(x) >= at(y) ? x : y), null);
    return best && at(best) >= alike ? [[a, best]] : [];
  });
}

/** Of every vertex (Σ |a·b|)² / (Σ a·a Σ b·b) over the pairs of a run, each shape scaled to the same norm so that all count alike; null where there is no pair. */
export function comac(run) {
  const list = pairs(run).map((pair) => pair.map((mode) => { const { vectors } = shapeOf(mode); return { vectors, scale: 1 / (Math.sqrt(vectors.reduce((sum, x) => sum + x * x, 0)) || 1) }; }));
  return list.length ? likeness(list) : null;
}

/** The same of pairs of { vectors (three a vertex), scale }. */
export function likeness(list) {
  const count = list[0][0].vectors.length / 3;
  return Float32Array.from({ length: count }, (_, v) => {
    let [across, first, second] = [0, 0, 0];
    for (const [a, b] of list) {
      let [ab, aa, bb] = [0, 0, 0];
      for (let k = 3 * v; k < 3 * v + 3; k++) { ab += a.vectors[k] * b.vectors[k]; aa += a.vectors[k] ** 2; bb += b.vectors[k] ** 2; }
      across += Math.abs(ab) * a.scale * b.scale;
      first += aa * a.scale ** 2;
      second += bb * b.scale ** 2;
    }
    return first * second > 0 ? across ** 2 / (first * second) : 0;
  });
}
