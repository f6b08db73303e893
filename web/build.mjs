// Builds the bundle: dist/page.js, dist/page.css and the licences of what is inside. `node build.mjs [folder]`.

import { build } from 'esbuild';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.resolve(process.argv[2] ?? path.join(here, 'dist'));
const read = (...names) => readFile(path.join(here, ...names), 'utf8');
const bundled = Object.keys(JSON.parse(await read('package.json')).dependencies);

// What Plotly's file says at its end of the code of others in it.
const plotly = 'plotly.js-cartesian-dist-min';
const inside = { [plotly]: (await read('node_modules', plotly, 'plotly-cartesian.min.js')).match(/\/\*! (Bundled license information:[^]*?)\*\/\s*window\.Plotly/)?.[1].trim() };

const versions = await Promise.all(bundled.map(async (name) => {
  const { version, license } = JSON.parse(await read('node_modules', name, 'package.json'));
  return { name, version, license, text: [(await read('node_modules', name, 'LICENSE')).trim(), inside[name]].filter(Boolean).join('\n\n') };
}));

const legal = `/*! thinwall's report page, AGPL-3.0-or-later. Holds ${versions.map((v) => `${v.name} ${v.version} (${v.license})`).join(', ')}; their licences: web/dist/LICENSES.txt in thinwall's sources.\n`
  + `${versions.map((v) => `\n${v.name}\n${v.text.replaceAll('*/', '* /')}\n`).join('')}*/`;
// Plotly's file is a function in a function, which a browser parses once for each time that it is wrapped: a tenth of a second
// of a page's start. As a module its body stands at the top.
const unwrapped = {
  name: 'unwrapped',
  setup: ({ onLoad }) => onLoad({ filter: /plotly-cartesian\.min\.js$/ }, async ({ path: file }) => {
    const text = await readFile(file, 'utf8');
    const body = text.match(/=> \{\s*"use strict";(var Plotly=[^]*?)window\.Plotly = Plotly;\s*return Plotly;\s*\}\)\);?\s*$/)?.[1];
    if (!body) throw new Error('the wrapping of Plotly is not the one that is known');
    return { contents: `${body}\nexport default Plotly;` };
  }),
};

const common = { bundle: true, minify: true, write: false, charset: 'ascii', legalComments: 'none', target: 'es2022', logLevel: 'warning', absWorkingDir: here };
const js = await build({ ...common, entryPoints: ['src/main.js'], format: 'iife', banner: { js: legal }, plugins: [unwrapped] });
const css = await build({ ...common, entryPoints: ['src/theme.css'] });

const script = js.outputFiles[0].text;
if (/<\/script|<!--|\r/i.test(script)) throw new Error('the script holds text that cannot stand in a script element');

await mkdir(out, { recursive: true });
await writeFile(path.join(out, 'page.js'), script);
await writeFile(path.join(out, 'page.css'), css.outputFiles[0].text);
await writeFile(path.join(out, 'LICENSES.txt'), versions.map((v) => `${v.name} ${v.version}\n\n${v.text}\n`).join(`\n${'-'.repeat(78)}\n\n`));
