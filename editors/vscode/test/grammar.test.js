// What the grammar takes words for, on lines of jobs; and that every example of the repository is coloured to its end.

const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const test = require("node:test");
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const root = path.join(__dirname, "..");
const examples = path.join(root, "..", "..", "examples");

async function grammar() {
  const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
  await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => {
      const file = path.join(root, "syntaxes", "vcut.tmLanguage.json");
      return textmate.parseRawGrammar(fs.readFileSync(file, "utf8"), file);
    },
  });
  return registry.loadGrammar("source.vcut");
}

/** The tokens of a line that have a scope of their own: [text, scope without the ending]. */
function tokens(vcut, line) {
  const { tokens } = vcut.tokenizeLine(line, textmate.INITIAL);
  return tokens
    .filter((token) => token.scopes.length > 1)
    .map((token) => [
      line.slice(token.startIndex, token.endIndex).trim(),
      token.scopes.at(-1).replace(/\.vcut$/, ""),
    ]);
}

test("words are what they are", async () => {
  const vcut = await grammar();
  const expected = [
    ["job \"rib\"", [["job", "keyword.control"], ["\"", "string.quoted.double"], ["rib", "string.quoted.double"], ["\"", "string.quoted.double"]]],
    ["let width = 0.8 * chord // wide", [
      ["let", "keyword.control"], ["width", "variable.other.constant"], ["=", "keyword.operator"],
      ["0.8", "constant.numeric"], ["*", "keyword.operator"], ["// wide", "comment.line.double-slash"],
    ]],
    ["blade wheel = disc {", [
      ["blade", "keyword.other.block"], ["wheel", "entity.name.type"], ["=", "keyword.operator"], ["disc", "keyword.other.kind"],
    ]],
    ["  spin = 3000 rev/min", [
      ["spin", "entity.other.attribute-name"], ["=", "keyword.operator"], ["3000", "constant.numeric"], ["rev/min", "keyword.other.unit"],
    ]],
    ["rough vcut {", [["rough", "keyword.other.block"], ["vcut", "keyword.other.kind"]]],
    ["  layer = auto", [["layer", "entity.other.attribute-name"], ["=", "keyword.operator"], ["auto", "constant.language"]]],
    ["  residual = shift", [["residual", "entity.other.attribute-name"], ["=", "keyword.operator"], ["shift", "support.constant"]]],
    ["  limits { swing <= 50 deg }", [
      ["limits", "entity.other.attribute-name"], ["swing", "entity.other.attribute-name"], ["<=", "keyword.operator"],
      ["50", "constant.numeric"], ["deg", "keyword.other.unit"],
    ]],
    ["cut = 12 m/min, overlap = 30 %", [
      ["cut", "entity.other.attribute-name"], ["=", "keyword.operator"], ["12", "constant.numeric"], ["m/min", "keyword.other.unit"],
      ["overlap", "entity.other.attribute-name"], ["=", "keyword.operator"], ["30", "constant.numeric"], ["%", "keyword.other.unit"],
    ]],
    ["  line to (10 mm, min(a, 2mm))", [
      ["line", "keyword.other.curve"], ["to", "keyword.other.curve"], ["10", "constant.numeric"], ["mm", "keyword.other.unit"],
      ["min", "support.function"], ["2", "constant.numeric"], ["mm", "keyword.other.unit"],
    ]],
    ["machine left = five_axis \"x\" {", [
      ["machine", "keyword.other.block"], ["left", "entity.name.type"], ["=", "keyword.operator"], ["five_axis", "keyword.other.kind"],
      ["\"", "string.quoted.double"], ["x", "string.quoted.double"], ["\"", "string.quoted.double"],
    ]],
    ["ready = after(0.5 s)", [
      ["ready", "entity.other.attribute-name"], ["=", "keyword.operator"], ["after", "support.type"],
      ["0.5", "constant.numeric"], ["s", "keyword.other.unit"],
    ]],
  ];
  expected.push(
    ["profile = dxf(\"rib.dxf\", side = upper, unit = pt)", [
      ["profile", "keyword.other.block"], ["=", "keyword.operator"], ["dxf", "support.type"],
      ["\"", "string.quoted.double"], ["rib.dxf", "string.quoted.double"], ["\"", "string.quoted.double"],
      ["side", "entity.other.attribute-name"], ["=", "keyword.operator"], ["upper", "support.constant"],
      ["unit", "entity.other.attribute-name"], ["=", "keyword.operator"], ["pt", "support.constant"],
    ]],
    ["  svg \"rib.svg\" { unit = px }", [
      ["svg", "keyword.other.curve"], ["\"", "string.quoted.double"], ["rib.svg", "string.quoted.double"],
      ["\"", "string.quoted.double"], ["unit", "entity.other.attribute-name"], ["=", "keyword.operator"],
      ["px", "support.constant"],
    ]],
    ["  tips (3 mm, 4 mm)", [
      ["tips", "keyword.other.curve"], ["3", "constant.numeric"], ["mm", "keyword.other.unit"],
      ["4", "constant.numeric"], ["mm", "keyword.other.unit"],
    ]],
    ["  tips", [["tips", "keyword.other.curve"]]],
    ["  step \"wing.stp\"", [
      ["step", "keyword.other.curve"], ["\"", "string.quoted.double"], ["wing.stp", "string.quoted.double"],
      ["\"", "string.quoted.double"],
    ]],
    ["  row (1 mm, 2 mm, 3 mm)", [
      ["row", "keyword.other.curve"], ["1", "constant.numeric"], ["mm", "keyword.other.unit"],
      ["2", "constant.numeric"], ["mm", "keyword.other.unit"], ["3", "constant.numeric"], ["mm", "keyword.other.unit"],
    ]],
    ["  body (40 mm, 8 mm)", [
      ["body", "keyword.other.curve"], ["40", "constant.numeric"], ["mm", "keyword.other.unit"],
      ["8", "constant.numeric"], ["mm", "keyword.other.unit"],
    ]],
  );
  for (const [line, wanted] of expected) {
    assert.deepStrictEqual(tokens(vcut, line), wanted, line);
  }
});

test("the examples of the repository end outside of comments and texts", async () => {
  const vcut = await grammar();
  const files = fs.readdirSync(examples).filter((file) => file.endsWith(".vcut"));
  assert.ok(files.length > 8);
  for (const file of files) {
    let state = textmate.INITIAL;
    let units = 0;
    for (const line of fs.readFileSync(path.join(examples, file), "utf8").split(/\r?\n/)) {
      const result = vcut.tokenizeLine(line, state);
      units += result.tokens.filter((token) => token.scopes.includes("keyword.other.unit.vcut")).length;
      state = result.ruleStack;
    }
    assert.strictEqual(state.depth, 1, `${file} ends within something`);
    assert.ok(units > 3, `${file}: ${units} units`);
  }
});

test("the manifest names files that exist, and snippets have a text", () => {
  const manifest = JSON.parse(fs.readFileSync(path.join(root, "package.json"), "utf8"));
  const { languages, grammars, snippets } = manifest.contributes;
  const named = [manifest.main, languages[0].configuration, grammars[0].path, snippets[0].path];
  for (const file of named) {
    assert.ok(fs.existsSync(path.join(root, file)), file);
  }
  const texts = JSON.parse(fs.readFileSync(path.join(root, snippets[0].path), "utf8"));
  for (const [name, snippet] of Object.entries(texts)) {
    assert.ok(snippet.prefix && snippet.body.length > 1, name);
  }
});
