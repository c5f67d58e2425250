// What is known of the chosen step, and what the robot knows.

import { current, told } from "./state.js";
import { Sign, margin, reading, secs, short } from "./parts.jsx";
import { Things } from "./scene.jsx";
import { WORDS } from "./words.js";

export function StepDetails({ state, chosen, showLine }) {
  const policy = current(state);
  const row = chosen === null ? null : policy?.rows[chosen];
  if (!row) return <p class="empty">{WORDS.noStep}</p>;
  const is = policy.status[chosen];
  const attempts = state.goals.filter((one) => one.r === chosen && one.p === state.policies.length - 1);
  const verdict = (word) => <span class={`badge ${word}`}>{WORDS[word]}</span>;
  return (
    <div class="scroll details">
      <h3>
        {row.n !== undefined && <Sign is={is.s} />} {is.l}
      </h3>
      <p>
        {row.n !== undefined && WORDS.status[is.s]}
        {is.d !== null && ` · ${WORDS.took} ${secs(is.d)}`}
        {row.secs && ` · ${WORDS.expected} ${WORDS.within(secs(row.secs[0]), secs(row.secs[1]))}`}
        {row.line && (
          <>
            {" · "}
            <button class="link" onClick={showLine}>
              {WORDS.line(row.line)}
            </button>
          </>
        )}
      </p>
      {is.n && (
        <p class={is.s === "failed" ? "why failed" : "why"}>
          {is.s === "failed" && <b>{WORDS.why}: </b>}
          {is.s === "failed" ? told(state, chosen, is.n) : is.n}
        </p>
      )}
      {attempts.length > 0 && <h4>{WORDS.attempts}</h4>}
      <ul class="plain">
        {attempts.map((one, i) => (
          <li key={i}>
            <Sign is={one.how ?? "running"} /> {secs(one.from)}
            {one.to !== null && ` – ${secs(one.to)}`} {one.why ?? one.feedback}
            {one.how === null && <small> {one.is === "held" ? WORDS.held : one.is}</small>}
          </li>
        ))}
      </ul>
      {row.needs && <h4>{WORDS.needs}</h4>}
      <ul class="plain">
        {row.needs?.map((need, i) => {
          const truth = state.guards[`${chosen}:${i}`];
          return (
            <li key={i}>
              {need.text} {verdict(need.verdict)} {truth && <b class={truth === "true" ? "yes" : "no"}>{truth}</b>}
            </li>
          );
        })}
      </ul>
      {row.motion && (
        <>
          <h4>{WORDS.motion}</h4>
          <p>
            {row.motion.text} {verdict(row.motion.verdict)}{" "}
            {row.motion.clearance !== undefined && WORDS.clearance((row.motion.clearance * 1000).toFixed(0))} {row.motion.why}
          </p>
        </>
      )}
      {row.watches && <h4>{WORDS.watches}</h4>}
      <ul class="plain">
        {row.watches?.map((watch, i) => (
          <li key={i}>
            {watch.text}
            <ul class="plain">
              {watch.reads.map((read) => {
                const value = reading(state, read.q);
                const by = value === null ? null : margin(read, value);
                return (
                  <li key={read.q}>
                    {read.q}: {value === null ? WORDS.unread : WORDS.reading(short(value))}
                    {by !== null && `, ${WORDS.margin(short(by))}`}
                  </li>
                );
              })}
            </ul>
          </li>
        ))}
      </ul>
    </div>
  );
}

function List({ of, title, show }) {
  const entries = Object.entries(of);
  return (
    <>
      <h4>{title}</h4>
      {entries.length === 0 && <p class="quiet">{WORDS.nothing}</p>}
      <ul class="plain">
        {entries.map(([name, value]) => (
          <li key={name}>
            <code>{name}</code> {show(value)}
          </li>
        ))}
      </ul>
    </>
  );
}

const truth = (value) => <b class={{ true: "yes", false: "no" }[value] ?? ""}>{WORDS.believes[String(value)]}</b>;

export function Known({ log, state, time }) {
  const others = Object.entries(state.facts).filter(([fact]) => !(fact in state.changed));
  return (
    <div class="scroll details">
      <List of={state.bindings} title={WORDS.bindings} show={(value) => `= ${value}`} />
      <List
        of={state.readings}
        title={WORDS.readings}
        show={({ v, at }) => (
          <>
            = {short(v)} <small>{secs(at)}</small>
          </>
        )}
      />
      <List of={state.changed} title={WORDS.beliefs} show={truth} />
      <details>
        <summary>{WORDS.otherBeliefs(others.length)}</summary>
        <ul class="plain">
          {others.map(([fact, value]) => (
            <li key={fact}>
              <code>{fact}</code> {truth(value)}
            </li>
          ))}
        </ul>
      </details>
      {log.world && <h4>{WORDS.things}</h4>}
      <Things log={log} state={state} time={time} />
    </div>
  );
}

export function Talk({ state, world }) {
  const names = Object.fromEntries(world?.things.map((thing) => [thing.id, `${thing.name} (${thing.id})`]) ?? []);
  if (state.says.length === 0 && state.questions.length === 0) return <p class="empty">{WORDS.nothing}</p>;
  const lines = [
    ...state.says.map((say) => ({ at: say.at, who: WORDS.who[say.who], text: say.resumed ? WORDS.resumed : say.text })),
    ...state.questions.map((one) => ({ at: one.from, who: WORDS.who.robot, text: one.text })),
    ...state.questions.filter((one) => one.to !== null).map((one) => ({ at: one.to, who: WORDS.who.person, text: one.answer === null ? WORDS.unanswered : (names[one.answer] ?? one.answer) })),
  ];
  lines.sort((one, other) => one.at - other.at);
  return (
    <ol class="scroll talk">
      {lines.map((line, i) => (
        <li key={i}>
          <small>{secs(line.at)}</small> <b>{line.who}</b> {line.text}
        </li>
      ))}
    </ol>
  );
}
