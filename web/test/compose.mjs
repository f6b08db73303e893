// Puts template, bundle and a data document together as the program does. `node test/compose.mjs data.json report.html`.

import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const web = path.join(path.dirname(fileURLToPath(import.meta.url)), '..');
const read = (name) => readFileSync(path.join(web, name), 'utf8');
const sha256 = (text) => createHash('sha256').update(text, 'utf8').digest('base64');
const escapes = { '<': '\\u003c', '>': '\\u003e', '&': '\\u0026', '\u2028': '\\u2028', '\u2029': '\\u2029' };
const entities = { '<': '&lt;', '>': '&gt;', '&': '&amp;', '"': '&quot;' };

/** The finished page of a data document (an object). */
export function compose(data, dist = 'dist') {
  const [script, style] = [read(`${dist}/page.js`), read(`${dist}/page.css`)];
  const values = {
    SCRIPT: script, STYLE: style, SCRIPT_HASH: sha256(script), STYLE_HASH: sha256(style),
    TITLE: (data.title ?? data.runs[0].summary.title ?? data.runs[0].label).replace(/[<>&"]/g, (c) => entities[c]),
    DATA: JSON.stringify(data).replace(/[<>&\u2028\u2029]/g, (c) => escapes[c]),
  };
  return read('template.html').replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);
}

/** The data document of a finished page. */
export const documentOf = (file) => JSON.parse(readFileSync(file, 'utf8').match(/<script type="application\/json" id="data">(.*?)<\/script>/s)[1]);

/** The kind of a page: "fit", "postures" or "runs". */
export const kindOf = (file) => ['fit', 'postures'].find((kind) => documentOf(file)[kind]) ?? 'runs';

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  writeFileSync(process.argv[3], compose(JSON.parse(readFileSync(process.argv[2], 'utf8'))));
}
