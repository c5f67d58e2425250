// Head of the page: state of the run, stop, pause, go on, a new request; and the questions that wait.

import { useState } from "preact/hooks";
import { send } from "./link.js";
import { current } from "./state.js";
import { secs } from "./parts.jsx";
import { WORDS } from "./words.js";

function useSend() {
  const [fault, setFault] = useState(null);
  return [fault, async (command, body) => setFault(await send(command, body))];
}

export function Head({ state, live, link, time }) {
  const [fault, command] = useSend();
  const [line, setLine] = useState("");
  const policy = current(state);
  const is_live = link === "live" && live.run > 0 && live.end === null;
  const takes = (what) => live.takes.includes(what);
  const how = state.end ? state.end.how : policy ? (state.held ? "held" : "running") : "idle";
  const calls = policy ? policy.rows.map((row, i) => [row, policy.status[i]]).filter(([row]) => row.kind === "call") : [];
  const done = calls.filter(([, is]) => is.s === "done").length;
  return (
    <header>
      <div class="title">
        <h1>{policy?.policy ?? "Motet"}</h1>
        {policy?.robot && <span class="robot">{policy.robot}</span>}
        <span class={`chip ${how}`} role="status">
          {{ idle: live.questions.some((one) => one.to === null) ? WORDS.asking : WORDS.waiting, held: WORDS.held, running: WORDS.running }[how] ?? WORDS.ended[how]}
        </span>
        {policy && <span class="progress">{WORDS.summary(done)}</span>}
        {time !== null && <span class="chip past">{is_live ? WORDS.past(secs(time)) : WORDS.replayed(secs(time))}</span>}
        <span class="link" role="status">
          {{ connecting: WORDS.connecting, reconnecting: WORDS.reconnecting, refused: WORDS.refused, over: WORDS.over }[link]}
        </span>
      </div>
      {live.takes.length > 0 && (
        <div class="controls">
          {takes("hold") && (
            <button disabled={!is_live || live.held} onClick={() => command("hold")}>
              {WORDS.pause}
            </button>
          )}
          {takes("hold") && (
            <button disabled={!is_live || !live.held} onClick={() => command("proceed")}>
              {WORDS.proceed}
            </button>
          )}
          {takes("stop") && (
            <button class="danger" disabled={!is_live} onClick={() => command("stop")}>
              {WORDS.stop}
            </button>
          )}
          {takes("say") && (
            <form
              onSubmit={(event) => {
                event.preventDefault();
                if (line.trim()) command("say", { text: line });
                setLine("");
              }}
            >
              <input
                aria-label={WORDS.request}
                placeholder={WORDS.request}
                value={line}
                maxLength={2000}
                disabled={link !== "live"}
                onInput={(event) => setLine(event.currentTarget.value)}
              />
              <button disabled={link !== "live" || !line.trim()}>{WORDS.send}</button>
            </form>
          )}
        </div>
      )}
      {fault && (
        <p class="fault" role="alert">
          {WORDS.failedSend(fault)}
        </p>
      )}
      {state.end?.why && (
        <p class={`endwhy ${state.end.how}`}>
          <b>{WORDS.ended[state.end.how]}:</b> {state.end.why}
        </p>
      )}
      {state.full && <p class="fault">{WORDS.full}</p>}
    </header>
  );
}

function Question({ question, now, names, canAnswer }) {
  const [text, setText] = useState("");
  const [fault, command] = useSend();
  const give = (answer) => command("answer", { question: question.id, text: answer });
  const left = question.by === undefined || question.by > 1e6 ? null : question.by - now;
  return (
    <section class="question" role="alertdialog" aria-label={WORDS.question}>
      <p class="asked">{question.text}</p>
      {left !== null && (
        <p class="quiet">{WORDS.until(secs(question.by), left > 0 ? WORDS.left(secs(left)) : "")}</p>
      )}
      {canAnswer && (
        <>
          <div class="options">
            {question.options.map((option) => (
              <button key={option} title={option} onClick={() => give(option)}>
                {names[option] ?? option}
              </button>
            ))}
          </div>
          <form
            onSubmit={(event) => {
              event.preventDefault();
              if (text.trim()) give(text);
            }}
          >
            <input aria-label={WORDS.ownAnswer} placeholder={WORDS.ownAnswer} value={text} maxLength={2000} onInput={(event) => setText(event.currentTarget.value)} />
            <button disabled={!text.trim()}>{WORDS.answer}</button>
          </form>
        </>
      )}
      {fault && (
        <p class="fault" role="alert">
          {WORDS.failedSend(fault)}
        </p>
      )}
    </section>
  );
}

export function Questions({ state, live, link, world }) {
  const names = Object.fromEntries(world?.things.map((thing) => [thing.id, thing.name]) ?? []);
  const open = state.questions.filter((one) => one.to === null);
  const canAnswer = link === "live" && live.takes.includes("answer") && state === live;
  return open.map((one) => <Question key={one.id} question={one} now={state.now} names={names} canAnswer={canAnswer} />);
}
