// A section of the page.

import { el } from './dom.js';

/** A section with its heading (an anchor), what to see in a sentence, and its content; null where there is none. The sentence is asked for where there is a content only. */
export function section(id, title, sentence, content) {
  const filled = content.flat(3).filter(Boolean);
  if (!filled.length) return null;
  return Object.assign(el('section', { id }, el('h2', {}, el('a', { href: `#${id}` }, title)), el('p', { class: 'lead' }, sentence()), filled), { title });
}
