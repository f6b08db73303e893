// Elements made by hand. Text goes in as text nodes only: names of a case are not to be trusted, and nothing here parses HTML.

/** An element with attributes (a function is an event listener, false leaves one out) and children (strings become text). */
export function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  set(node, attributes);
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}

/** The same for SVG. */
export function svg(tag, attributes = {}, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  set(node, attributes);
  node.append(...children);
  return node;
}

function set(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') node.addEventListener(name, value);
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value === true ? '' : value);
  }
}

// Drawn by hand, since common fonts lack the characters.
const icons = { play: 'M 3 1 L 15 8 L 3 15 Z', back: 'M 13 1 L 1 8 L 13 15 Z', pause: 'M 2 1 H 6 V 15 H 2 Z M 10 1 H 14 V 15 H 10 Z', half: 'M 8 1 A 7 7 0 0 0 8 15 Z M 8 0 A 8 8 0 0 1 8 16 A 8 8 0 0 1 8 0 M 8 1.5 A 6.5 6.5 0 0 0 8 14.5 A 6.5 6.5 0 0 0 8 1.5' };

/** A small picture for a button: "play", "back", "pause", "half". */
export const icon = (name) => svg('svg', { class: 'icon', viewBox: '0 0 16 16', 'aria-hidden': 'true' }, svg('path', { d: icons[name], 'fill-rule': 'evenodd' }));

/** A labelled choice: options are [value, text] or { group, options } of such; change is called with the value. */
export function choice(label, options, value, change) {
  const option = ([v, text]) => el('option', { value: v, selected: String(v) === String(value) }, text);
  const select = el('select', { change: () => change(select.value) },
    options.map((o) => (o.group ? el('optgroup', { label: o.group }, o.options.map(option)) : option(o))));
  return el('label', { class: 'control' }, el('span', {}, label), select);
}

/** A labelled tick box. */
export function tick(label, checked, change) {
  const box = el('input', { type: 'checkbox', checked, change: () => change(box.checked) });
  return el('label', { class: 'control tick' }, box, el('span', {}, label));
}

/** A labelled slider. */
export function slider(label, { min, max, step, value }, change) {
  const input = el('input', { type: 'range', min, max, step, value, input: () => change(Number(input.value)) });
  return Object.assign(el('label', { class: 'control' }, el('span', {}, label), input), { input });
}

export const button = (text, label, click) => el('button', { type: 'button', 'aria-label': label, title: label, click }, text);

/** A table; cells are text, or { text, class }. The first column is the row's heading. On a phone a `stacked` one shows a row's cells one below the other. */
export function table(caption, head, rows, stacked = false) {
  const cell = (tag, content, extra = {}) => {
    const { text, class: name } = typeof content === 'object' && content !== null ? content : { text: content };
    return el(tag, { ...extra, class: name }, text ?? '–');
  };
  return el('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': caption },
    el('table', { class: stacked && 'stacked' }, el('caption', {}, caption),
      el('thead', {}, el('tr', {}, head.map((h) => cell('th', h, { scope: 'col' })))),
      el('tbody', {}, rows.map((row) => el('tr', {}, row.map((c, i) => (i ? cell('td', c, { 'data-head': stacked && head[i] }) : cell('th', c, { scope: 'row' }))))))));
}
