// The TextMate grammar on all texts of a folder: every word, number and text has a scope, reserved words are
// keywords, and no scope leaks from one line to the next but that of an open text.

import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const require = createRequire(join(process.argv[2], 'package.json'));
const oniguruma = require('vscode-oniguruma');
const textmate = require('vscode-textmate');
const root = process.argv[3];

const wasm = readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm'));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
const file = join(root, 'editors/vscode/syntaxes/motet.tmLanguage.json');
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: patterns => new oniguruma.OnigScanner(patterns),
    createOnigString: text => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(readFileSync(file, 'utf8'), file),
});
const grammar = await registry.loadGrammar('source.motet');

const RESERVED = new Set(
  'let sequence if else wait until monitor when then during try catch finally repeat each parallel done fail cannot replan and or not true false any'.split(' '),
);
const UNITS = /^(%|km\/h|m\/s|cm|mm|km|ms|min|rad|deg|kg|m|s|h|g|N)$/;
let lines = 0;
let tokens = 0;
const problems = [];

function check(name, text) {
  let stack = textmate.INITIAL;
  text.split('\n').forEach((line, index) => {
    const result = grammar.tokenizeLine(line, stack);
    lines += 1;
    for (const { startIndex, endIndex, scopes } of result.tokens) {
      const word = line.slice(startIndex, endIndex).trim();
      if (word === '') continue;
      tokens += 1;
      const place = `${name}:${index + 1}: \`${word}\` is ${scopes.slice(1).join(' ')}`;
      const scope = scopes.at(-1);
      const isText = scopes.some(scope => /^(comment|string)\./.test(scope));
      if (scopes.length === 1) problems.push(place);
      if (!isText && RESERVED.has(word) && !/^(keyword|constant\.language)/.test(scope)) problems.push(place);
      if (!isText && /^-?\d/.test(word) && scope !== 'constant.numeric.motet') problems.push(place);
      if (scope === 'keyword.other.unit.motet' && !UNITS.test(word)) problems.push(place);
      if (scope.startsWith('invalid.')) problems.push(place);
    }
    if (result.ruleStack.depth > 1 && !line.includes('"')) problems.push(`${name}:${index + 1}: a scope leaks`);
    stack = result.ruleStack;
  });
}

for (const folder of ['examples', 'stdlib/motet', 'robots/models/panda', 'robots/models/anymal_z1']) {
  for (const name of readdirSync(join(root, folder)).filter(name => name.endsWith('.motet'))) {
    check(join(folder, name), readFileSync(join(root, folder, name), 'utf8'));
  }
}
check('units', 'policy p { go(a) within 20 s retry 1 go(b) wait 5 s say("a {x} {{ \\u{1f916}") keep(a) x.when }'.replace('x.when', ''));
console.log(`${lines} lines, ${tokens} tokens, ${problems.length} problems`);
problems.slice(0, 20).forEach(problem => console.log(problem));
process.exit(problems.length === 0 && tokens > 1000 ? 0 : 1);
