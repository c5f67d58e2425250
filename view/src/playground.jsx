// Page without a server: the workbench is a module in a worker.

import { start } from "./page.jsx";
import { WORDS } from "./words.js";

let worker = null;
let waiting = new Map();
let number = 0;
let opened = null;

function begin() {
  worker = new Worker("worker.js");
  worker.onmessage = ({ data }) => {
    waiting.get(data.id)?.(data.answer);
    waiting.delete(data.id);
    if (data.broken) restart();
  };
  worker.onerror = restart;
}

/** A module that has stopped is of no further use: a new one opens the same room. */
function restart() {
  worker.terminate();
  for (const answer of waiting.values()) answer({ error: WORDS.broken });
  waiting = new Map();
  begin();
  if (opened) send(opened);
}

function send(question) {
  number += 1;
  const id = number;
  const answer = new Promise((resolve) => waiting.set(id, resolve));
  worker.postMessage({ id, question: JSON.stringify(question) });
  return answer;
}

begin();
start({
  connect: (_, is) => is("bench"),
  ask: (question) => {
    if (question.ask === "open") opened = question;
    return send(question);
  },
  examples: JSON.parse(document.getElementById("examples").textContent),
});
