// Numbers and names as people read them.

/** Significant digits, without superfluous zeros; an exponent only where it is shorter. A dash stands for no value. */
export function number(x, digits = 4) {
  if (x === null || x === undefined || Number.isNaN(x)) return '–';
  if (!Number.isFinite(x)) return x > 0 ? '∞' : '−∞';
  if (x === 0) return '0';
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e6) return minus(x.toExponential(Math.max(0, digits - 2)).replace(/\.?0+e/, 'e').replace('e+', 'e'));
  const text = size >= 10 ** (digits - 1) ? Math.round(x).toString() : x.toPrecision(digits);
  return minus(text.includes('.') ? text.replace(/\.?0+$/, '') : text);
}

/** The same with all digits kept, for columns of a table. */
export const aligned = (x, digits = 4) => (isNumber(x) && x !== 0 && Math.abs(x) >= 1e-3 && Math.abs(x) < 10 ** digits ? minus(x.toPrecision(digits)) : number(x, digits));

const minus = (text) => text.replace(/-/g, '−');

export const millimetres = (metres, digits = 3) => `${number(isNumber(metres) ? metres * 1e3 : null, digits)} mm`;
export const percent = (x, digits = 3) => `${number(isNumber(x) ? x * 100 : null, digits)} %`;
export const rpm = (x) => `${number(x, 4)} rpm`;
export const hertz = (x) => `${number(x, 4)} Hz`;
export const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);

/** Text for a plot's labels, which know a few HTML tags and %{...} of hover templates: here nothing but text, and not too long. */
export const plain = (text) => clipped(String(text), 48).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/%\{/g, '% {');

/** Scaled copy; numbers that are none become null, which a plot leaves out. */
export const scaled = (values, factor) => Array.from(values, (v) => (Number.isFinite(v) ? v * factor : null));

const clipped = (text, length) => (text.length > length ? `${text.slice(0, length - 1)}…` : text);

export const range = (n, from = 0) => Array.from({ length: n }, (_, i) => i + from);
