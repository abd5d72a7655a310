// The types of the interface: a program that uses it compiles, and what they promise is there.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { ROOT } from './places.mjs';

test('a program that uses all of the interface compiles', () => {
  const options = ['--noEmit', '--strict', '--target', 'es2022', '--module', 'nodenext', '--lib', 'es2022,dom,dom.iterable'];
  try {
    execFileSync(join(ROOT, 'web/node_modules/.bin/tsc'), [...options, join(ROOT, 'web/test/types.mts')]);
  } catch (error) {
    assert.fail(String(error.stdout));
  }
});

test('functions of the types are functions of the module, and the other way round', () => {
  const names = (file, pattern) => {
    const text = readFileSync(join(ROOT, 'web/js', file), 'utf8');
    return [...text.matchAll(pattern)].map((match) => match[1]).sort();
  };
  const typed = names('welkin.d.ts', /^export function (\w+)/gm);
  const lists = names('welkin.js', /^export \{([^}]*)\}/gm);
  const listed = lists.flatMap((list) => list.split(',').map((name) => name.trim()).filter(Boolean));
  const made = names('welkin.js', /^export (?:(?:async )?function|const) (\w+)/gm);
  assert.deepEqual([...listed, ...made].sort(), typed);
});
