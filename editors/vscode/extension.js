// Starts `motet lsp` for the policies of a workspace.

const vscode = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

let client;

function start() {
  const settings = vscode.workspace.getConfiguration('motet');
  const json = settings.get('json').map(pattern => ({ language: 'json', pattern }));
  const server = { command: settings.get('path'), args: ['lsp', '--stdio', ...settings.get('arguments')] };
  client = new LanguageClient('motet', 'Motet', server, {
    documentSelector: [{ language: 'motet' }, ...json],
    // The server watches what its projects are read from.
    synchronize: { fileEvents: [] },
  });
  return client.start().catch(error => {
    const open = 'Open settings';
    vscode.window
      .showErrorMessage(`The command \`${server.command} lsp\` cannot be started: ${error.message}`, open)
      .then(choice => choice === open && vscode.commands.executeCommand('workbench.action.openSettings', 'motet.path'));
  });
}

async function stop() {
  const old = client;
  client = undefined;
  // A server that never started cannot be stopped.
  await old?.stop().catch(() => undefined);
}

exports.activate = context => {
  context.subscriptions.push(
    vscode.commands.registerCommand('motet.restart', async () => {
      await stop();
      await start();
    }),
    vscode.commands.registerCommand('motet.output', () => client?.outputChannel.show()),
    vscode.workspace.onDidChangeConfiguration(change => {
      if (change.affectsConfiguration('motet')) {
        vscode.commands.executeCommand('motet.restart');
      }
    }),
  );
  return start();
};

exports.deactivate = stop;
