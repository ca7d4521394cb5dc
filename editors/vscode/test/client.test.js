// The client against an editor of plain objects: what it registers, with which settings it starts the server, and that it
// stops what it has started.

const assert = require("node:assert");
const fs = require("node:fs");
const Module = require("node:module");
const path = require("node:path");
const test = require("node:test");

const root = path.join(__dirname, "..");
const manifest = JSON.parse(fs.readFileSync(path.join(root, "package.json"), "utf8"));

/** An editor with these settings, and a server that starts or fails. */
function editor(settings, fault) {
  const seen = { clients: [], commands: new Map(), errors: [], changed: undefined, tasks: [], saved: 0 };
  class LanguageClient {
    constructor(id, name, server, options) {
      Object.assign(this, { id, name, server, options, running: false });
      seen.clients.push(this);
    }
    async start() {
      if (fault) {
        throw fault;
      }
      this.running = true;
    }
    isRunning() {
      return this.running;
    }
    async stop() {
      this.running = false;
    }
  }
  const disposable = { dispose() {} };
  const vscode = {
    workspace: {
      getConfiguration: (section) => ({
        get: (key, otherwise) => settings[`${section}.${key}`] ?? otherwise,
      }),
      onDidChangeConfiguration: (listener) => {
        seen.changed = listener;
        return disposable;
      },
    },
    window: {
      showErrorMessage: (text) => seen.errors.push(text),
      showInputBox: async (options) => options.value,
      activeTextEditor: undefined,
    },
    languages: { getDiagnostics: () => [] },
    tasks: { executeTask: async (task) => seen.tasks.push(task) },
    TaskScope: { Workspace: 2 },
    Task: class {
      constructor(definition, scope, name, source, execution) {
        Object.assign(this, { definition, scope, name, source, execution });
      }
    },
    ProcessExecution: class {
      constructor(command, args) {
        Object.assign(this, { command, args });
      }
    },
    commands: {
      registerCommand: (name, body) => {
        seen.commands.set(name, body);
        return disposable;
      },
    },
  };
  const mocks = { vscode, "vscode-languageclient/node": { LanguageClient, TransportKind: { stdio: 0 } } };
  return { seen, mocks };
}

/** The extension as it is loaded by such an editor. */
function extension(mocks) {
  // Its source: what is packaged is made from it.
  const file = path.join(root, "extension.js");
  const load = Module._load;
  delete require.cache[require.resolve(file)];
  Module._load = (name, ...rest) => mocks[name] ?? load(name, ...rest);
  try {
    return require(file);
  } finally {
    Module._load = load;
  }
}

test("the server is started with the settings, started anew, and stopped", async () => {
  const settings = { "vcut.server.path": "/opt/vcutc", "vcut.planning": "never" };
  const { seen, mocks } = editor(settings);
  const { activate, deactivate } = extension(mocks);
  const context = { subscriptions: [] };
  await activate(context);
  assert.strictEqual(seen.clients.length, 1);
  const [first] = seen.clients;
  assert.deepStrictEqual(first.server, { command: "/opt/vcutc", args: ["lsp"], transport: 0 });
  assert.deepStrictEqual(first.options.documentSelector, [{ language: "vcut" }]);
  assert.deepStrictEqual(first.options.initializationOptions, { planning: "never" });
  assert.ok(first.running && context.subscriptions.every((one) => typeof one.dispose === "function"));

  await seen.commands.get("vcut.restart")();
  assert.ok(!first.running && seen.clients[1].running);
  settings["vcut.planning"] = "whileTyping";
  await seen.changed({ affectsConfiguration: (section) => section === "editor" });
  assert.strictEqual(seen.clients.length, 2, "settings of others change nothing");
  await seen.changed({ affectsConfiguration: (section) => section === "vcut" });
  assert.strictEqual(seen.clients[2].options.initializationOptions.planning, "whileTyping");
  assert.ok(seen.clients.every((one) => one.options.synchronize === undefined), "the server asks for its watchers");

  await deactivate();
  assert.ok(seen.clients.every((client) => !client.running));
});

test("a server that does not start is told of, with the setting that mends it", async () => {
  const { seen, mocks } = editor({}, new Error("spawn vcutc ENOENT"));
  const { activate, deactivate } = extension(mocks);
  await activate({ subscriptions: [] });
  assert.strictEqual(seen.errors.length, 1);
  assert.match(seen.errors[0], /`vcutc lsp` does not start: spawn vcutc ENOENT\. Set `vcut\.server\.path`/);
  await deactivate();
});

test("commands run the compiler on the saved job, and explain the diagnostic under the cursor", async () => {
  const { seen, mocks } = editor({ "vcut.server.path": "/opt/vcutc" });
  await extension(mocks).activate({ subscriptions: [] });
  await seen.commands.get("vcut.check")();
  assert.deepStrictEqual([seen.tasks.length, seen.errors.length], [0, 1], "without a job there is nothing to run");

  const document = { languageId: "vcut", uri: { fsPath: "/jobs/a b.vcut" }, save: async () => (seen.saved += 1) };
  mocks.vscode.window.activeTextEditor = { document, selection: { active: 7 } };
  mocks.vscode.languages.getDiagnostics = () => [
    { code: "VC0101", range: { contains: (place) => place === 3 } },
    { code: "VC0403", range: { contains: (place) => place === 7 } },
  ];
  for (const command of ["vcut.check", "vcut.report", "vcut.explain"]) {
    await seen.commands.get(command)();
  }
  assert.strictEqual(seen.saved, 2);
  assert.deepStrictEqual(seen.tasks.map(({ execution }) => [execution.command, ...execution.args]), [
    ["/opt/vcutc", "check", "/jobs/a b.vcut"],
    ["/opt/vcutc", "watch", "/jobs/a b.vcut", "--serve"],
    ["/opt/vcutc", "explain", "VC0403"],
  ]);
});

test("commands and settings are those of the manifest", async () => {
  const { seen, mocks } = editor({});
  await extension(mocks).activate({ subscriptions: [] });
  const { commands, configuration } = manifest.contributes;
  assert.deepStrictEqual([...seen.commands.keys()], commands.map((one) => one.command));
  const settings = Object.entries(configuration.properties);
  assert.deepStrictEqual(settings.map(([name]) => name), ["vcut.server.path", "vcut.planning"]);
  const [client] = seen.clients;
  assert.strictEqual(client.server.command, configuration.properties["vcut.server.path"].default);
  assert.strictEqual(client.options.initializationOptions.planning, configuration.properties["vcut.planning"].default);
});
