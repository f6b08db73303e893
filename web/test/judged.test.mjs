// The signs of cuts that were made.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { isDoubtful, symbolOf } from '../src/judged.js';

test('a doubtful prediction has a sign of its own', () => {
  assert.equal(symbolOf({ observed: 'stable', right: true }, 'circle'), 'circle');
  assert.equal(symbolOf({ observed: 'stable', right: null }, 'circle'), 'circle-open-dot');
  assert.equal(symbolOf({ observed: 'chatter', right: false }, 'x'), 'x-open');
  assert.equal(symbolOf({ observed: 'marginal', right: null }, 'diamond'), 'diamond');
  assert.equal(isDoubtful({ observed: 'marginal', right: null }), false);
});
