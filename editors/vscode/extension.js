// The client: starts `vcutc lsp` for job files, and starts it anew when it is asked to or when its settings change.
// Which files on the disk are watched is asked for by the server, which knows what jobs name.

const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

/** @type {LanguageClient | undefined} */
let client;

async function start() {
  const settings = vscode.workspace.getConfiguration("vcut");
  const command = settings.get("server.path", "vcutc");
  const server = { command, args: ["lsp"], transport: TransportKind.stdio };
  const options = {
    documentSelector: [{ language: "vcut" }],
    initializationOptions: { planning: settings.get("planning", "whileTyping") },
  };
  client = new LanguageClient("vcut", "vcut", server, options);
  try {
    await client.start();
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    vscode.window.showErrorMessage(
      `The language server \`${command} lsp\` does not start: ${why}. Set \`vcut.server.path\`.`,
    );
  }
}

async function stop() {
  const running = client;
  client = undefined;
  if (running?.isRunning()) {
    await running.stop();
  }
}

/** Runs the compiler in a panel that stays open. */
async function run(name, args) {
  const command = vscode.workspace.getConfiguration("vcut").get("server.path", "vcutc");
  const task = new vscode.Task(
    { type: "vcut", name },
    vscode.TaskScope.Workspace,
    name,
    "vcut",
    new vscode.ProcessExecution(command, args),
  );
  await vscode.tasks.executeTask(task);
}

/** The file of the job in front, saved, so that the compiler sees what the editor shows. */
async function job() {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "vcut") {
    vscode.window.showErrorMessage("Open a job file first.");
    return undefined;
  }
  await document.save();
  return document.uri.fsPath;
}

async function check() {
  const file = await job();
  if (file) {
    await run("check", ["check", file]);
  }
}

async function showReport() {
  const file = await job();
  if (file) {
    await run("report", ["watch", file, "--serve"]);
  }
}

/** Shows the page of a code; that of the diagnostic under the cursor is proposed. */
async function explain() {
  const editor = vscode.window.activeTextEditor;
  const known = editor ? vscode.languages.getDiagnostics(editor.document.uri) : [];
  const here = known.find((one) => one.range.contains(editor.selection.active)) ?? known[0];
  const code = await vscode.window.showInputBox({ prompt: "Code of a diagnostic", value: here?.code ?? "VC0203" });
  if (code) {
    await run("explain", ["explain", code]);
  }
}

async function activate(context) {
  const restart = async () => {
    await stop();
    await start();
  };
  const changed = async (event) => {
    if (event.affectsConfiguration("vcut")) {
      await restart();
    }
  };
  context.subscriptions.push(
    vscode.commands.registerCommand("vcut.check", check),
    vscode.commands.registerCommand("vcut.report", showReport),
    vscode.commands.registerCommand("vcut.explain", explain),
    vscode.commands.registerCommand("vcut.restart", restart),
    vscode.workspace.onDidChangeConfiguration(changed),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
