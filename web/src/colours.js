// Colours of the plots: Okabe and Ito's, which colour-blind people tell apart, and viridis for quantities.

const light = {
  paper: '#ffffff', ink: '#1b1f24', muted: '#57606a', grid: '#e4e8ec', axis: '#8c959f', hover: '#ffffff',
  part: '#0072b2', supported: '#d55e00', robot: '#009e73', spatial: '#000000', mark: '#cc79a7', good: '#007a5a', bad: '#b94a00',
};
const dark = {
  paper: '#15191e', ink: '#e6edf3', muted: '#9aa4af', grid: '#2a3138', axis: '#5b6670', hover: '#20262d',
  part: '#56b4e9', supported: '#f08a3c', robot: '#2fc497', spatial: '#f5f5f5', mark: '#e39cc4', good: '#2fc497', bad: '#f08a3c',
};

const system = matchMedia('(prefers-color-scheme: dark)');
const listeners = [];
let printing = false;

const isDark = () => !printing && (document.documentElement.dataset.theme ?? (system.matches ? 'dark' : 'light')) === 'dark';
export const palette = () => (isDark() ? dark : light);
export const printPalette = light;
export const isPrinting = () => printing;

/** Calls back when colours change: by the system, the page's button, or for paper. */
export function onColours(listener) { listeners.push(listener); }
const changed = () => listeners.forEach((listener) => listener());

export function toggleTheme() {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  changed();
}

function print(on) {
  if (on === printing) return;
  printing = on;
  changed();
}

system.addEventListener('change', changed);
addEventListener('beforeprint', () => print(true));
addEventListener('afterprint', () => print(false));
matchMedia('print').addEventListener('change', (event) => print(event.matches));

/** A colour with an opacity, for fills. */
export const faint = (colour, opacity) => colour + Math.round(opacity * 255).toString(16).padStart(2, '0');

// Every sixteenth colour of viridis (CC0, van der Walt and Smith), linear between.
const stops = ['440154', '481a6c', '472f7d', '414487', '39568c', '31688e', '2a788e', '23888e', '1f988b', '22a884', '35b779',
  '54c568', '7ad151', 'a5db36', 'd2e21b', 'fde725'].map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)));

/** Red, green, blue, 0 to 255, at t of 0 to 1. */
export function viridis(t) {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((c, k) => Math.round(c + (at - i) * (stops[i + 1][k] - c)));
}

export const viridisScale = stops.map((c, i) => [i / (stops.length - 1), `rgb(${c.join(',')})`]);
