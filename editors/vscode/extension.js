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
    vscode.commands.registerCommand("vcut.restart", restart),
    vscode.workspace.onDidChangeConfiguration(changed),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
