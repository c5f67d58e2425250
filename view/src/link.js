// Link of the page to the program that serves it, or to the items in its own file.

const TOKEN = location.hash.slice(1);

/** Reads the items in the file of the page, or connects. Calls `add` with each, and `is` with the state of the link. */
export function connect(add, is) {
  const inside = document.getElementById("items");
  if (inside) {
    for (const item of JSON.parse(inside.textContent)) add(item);
    is("file");
    return;
  }
  is("connecting");
  const source = new EventSource(`events?token=${encodeURIComponent(TOKEN)}`);
  source.onopen = () => is("live");
  source.onmessage = (event) => {
    const item = JSON.parse(event.data);
    if (item.t === "over") {
      source.close();
      is("over");
    } else add(item);
  };
  source.onerror = () => is(source.readyState === EventSource.CLOSED ? "refused" : "reconnecting");
}

/** Address of the latest picture of the robot's camera; the number tells one from the next. */
export const picture = (number) => `picture?token=${encodeURIComponent(TOKEN)}&n=${number}`;

/** Sends a command. Gives the reason if it is not taken. */
export async function send(command, body = {}) {
  try {
    const reply = await fetch(command, {
      method: "POST",
      headers: { "content-type": "application/json", "x-motet-token": TOKEN },
      body: JSON.stringify(body),
    });
    return reply.ok ? null : await reply.text();
  } catch (error) {
    return String(error.message);
  }
}

/** Asks the workbench of the program. Gives its answer, with `error` where there is none. */
export async function ask(question) {
  try {
    const reply = await fetch("ask", {
      method: "POST",
      headers: { "content-type": "application/json", "x-motet-token": TOKEN },
      body: JSON.stringify(question),
    });
    return reply.ok ? await reply.json() : { error: await reply.text() };
  } catch (error) {
    return { error: String(error.message) };
  }
}
