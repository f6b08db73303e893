// Places of a robot's postures: rows of numbers, one for each column over which it was learned.

import { numbers } from './decode.js';
import { isNumber, number } from './format.js';

/** The rows of an array of two dimensions. */
export function rowsOf(array) {
  const [values, [n, m]] = [numbers(array), array.shape];
  return Array.from({ length: n }, (_, i) => Array.from(values.subarray(i * m, (i + 1) * m)));
}

/** "x_mm 1700, kappa_deg 25". */
export const placeText = (over, place) => over.map((name, c) => `${name} ${number(place[c], 4)}`).join(', ');

/** The different values of each column, ascending: the lines of the grid on which the places lie. */
export const gridLines = (places) => places[0].map((_, c) => [...new Set(places.map((p) => p[c]))].sort((a, b) => a - b));

/** The number of the value that is nearest. */
export const nearest = (values, x) => values.reduce((best, v, i) => (Math.abs(v - x) < Math.abs(values[best] - x) ? i : best), 0);

/** "0.9 … 1.2", the ends of an interval; empty where it is not known. */
export const between95 = (low, high, factor, digits = 3) => (isNumber(low) && isNumber(high) ? `${number(low * factor, digits)} … ${number(high * factor, digits)}` : '');
