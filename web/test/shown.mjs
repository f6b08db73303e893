// Pages of invented documents, as they are seen in a browser.

import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, before } from 'node:test';
import { drawn, launch, open } from './browser.mjs';
import { compose } from './compose.mjs';

/**
 * A function that calls `see` with the page of a document, all drawn; whatever went wrong on the page fails the test.
 * Its browser is there while the tests of a file run. Without WebGL a page has a still picture in place of the moving
 * shapes, and its tests take seven tenths of the time.
 */
export function shownIn({ webgl }) {
  const folder = mkdtempSync(path.join(os.tmpdir(), 'thinwall-shown-'));
  let browser;
  before(async () => { browser = await launch(webgl); });
  after(async () => { await browser.close(); rmSync(folder, { recursive: true }); });
  return async (data, see, options) => {
    const file = path.join(folder, 'page.html');
    writeFileSync(file, compose(data));
    const page = await open(browser, file, options);
    try {
      await drawn(page);
      await see(page);
      assert.deepEqual(page.trouble, []);
    } finally {
      await page.context().close();
    }
  };
}

/** The paragraph below a section's title. */
export const lead = (page, id) => page.locator(`#${id} .lead`).first().textContent();
