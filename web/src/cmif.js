// The complex mode indicator function: the singular values of an FRF matrix, line by line (Shih et al. 1988). A peak of the first is a mode; a second
// singular value that peaks at the same place is a second mode there.

import { numbers } from './decode.js';

const rotation = /\.r([xyz]|\()/; // a degree of freedom in rad, whose size does not compare with one in m

/** { hz, values: [largest, second, …] } of an FRF of the document, each a list over the lines, m/N, of the translations; null where the matrix has gaps. At most `most` values. */
export function cmif(frf, most = 3) {
  const [hz, H] = [numbers(frf.hz), numbers(frf.H)];
  const [responses, forces] = [frf.responses, frf.forces].map((list) => list.map((name, i) => [name, i]).filter(([name]) => !rotation.test(name)).map(([, i]) => i));
  const n = hz.length;
  const at = (r, c) => (r * frf.forces.length + c) * n * 2;
  const place = (r, c) => {
    if (!Number.isNaN(H[at(r, c)])) return at(r, c);
    const [i, j] = [frf.responses.indexOf(frf.forces[c]), frf.forces.indexOf(frf.responses[r])]; // an entry that is left out is that of its transpose
    return i < 0 || j < 0 || Number.isNaN(H[at(i, j)]) ? null : at(i, j);
  };
  const places = responses.map((r) => forces.map((c) => place(r, c)));
  if (!places.flat().length || places.flat().includes(null)) return null;
  const count = Math.min(most, responses.length, forces.length);
  const values = Array.from({ length: count }, () => new Float64Array(n));
  for (let k = 0; k < n; k++) singularValues(places.map((row) => row.map((p) => [H[p + 2 * k], H[p + 2 * k + 1]]))).slice(0, count).forEach((s, i) => { values[i][k] = s; });
  return { hz, values };
}

/** Singular values of a complex matrix (rows of [re, im]), the largest first: one-sided Jacobi rotations of its columns until they are orthogonal (Hestenes 1958). */
export function singularValues(matrix) {
  const columns = matrix[0].map((_, c) => matrix.map((row) => [...row[c]]));
  for (let sweep = 0; sweep < 30; sweep++) {
    let turned = false;
    for (let p = 0; p < columns.length - 1; p++) for (let q = p + 1; q < columns.length; q++) turned = orthogonalise(columns[p], columns[q]) || turned;
    if (!turned) break;
  }
  return columns.map((column) => Math.hypot(...column.flat())).sort((a, b) => b - a);
}

/** Turns two columns into orthogonal ones; false where they are. */
function orthogonalise(a, b) {
  let [aa, bb, re, im] = [0, 0, 0, 0]; // squares, and aᴴb
  a.forEach(([x, y], i) => { const [u, v] = b[i]; aa += x * x + y * y; bb += u * u + v * v; re += x * u + y * v; im += x * v - y * u; });
  const size = Math.hypot(re, im);
  if (!(size > 1e-12 * Math.sqrt(aa * bb))) return false;
  const zeta = (bb - aa) / (2 * size);
  const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.hypot(1, zeta));
  const c = 1 / Math.hypot(1, t);
  const [pr, pi] = [re / size, -im / size]; // b times the conjugate phase makes aᴴb real
  a.forEach(([x, y], i) => {
    const [u, v] = [b[i][0] * pr - b[i][1] * pi, b[i][0] * pi + b[i][1] * pr];
    a[i] = [c * (x - t * u), c * (y - t * v)];
    b[i] = [c * (t * x + u), c * (t * y + v)];
  });
  return true;
}
