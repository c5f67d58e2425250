// The workbench: choose a room, write a policy or ask for one, see its findings and motions, and run it.

import { useEffect, useRef, useState } from "preact/hooks";
import { Finding } from "./parts.jsx";
import { WORDS } from "./words.js";

const PAUSE = 150;
const FIRST = 'policy hello {\n    say("Hello!")\n    done\n}\n';

/** Policy, robot and scene that the address of the page names, as links of the book do; null without them. */
function wanted() {
  const named = new URLSearchParams(location.hash.slice(1));
  const text = named.get("policy");
  if (text === null) return null;
  try {
    const bytes = Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
    return { text: new TextDecoder().decode(bytes), robot: named.get("robot"), scene: named.get("scene") };
  } catch {
    return null;
  }
}

/** State of the workbench and what it can do. `show` draws the items of a run. */
export function useBench({ ask, examples, isTaken, show }) {
  const [rooms, setRooms] = useState(null);
  const [room, setRoom] = useState(null);
  const [text, setText] = useState("");
  const [found, setFound] = useState(null);
  const [busy, setBusy] = useState(null);
  const [says, setSays] = useState(null);
  const [motions, setMotions] = useState(null);
  const [options, setOptions] = useState({ seed: 0, profile: "ideal" });
  const turn = useRef(0);

  const open = async (robot, scene) => {
    setBusy(WORDS.working);
    const answer = await ask({ ask: "open", robot, scene });
    setBusy(null);
    setSays(answer.error ?? null);
    if (answer.error) return;
    setRoom({ robot, scene });
    setMotions(null);
    show(answer.world ? [answer.world] : []);
  };
  useEffect(() => {
    if (!isTaken || rooms) return;
    ask({ ask: "rooms" }).then((all) => {
      if (all.error) return setSays(all.error);
      setRooms(all);
      const first = wanted() ?? examples?.[0] ?? { text: FIRST };
      setText(first.text);
      const choice = (names, name) => (names.includes(name) ? name : names[0]);
      open(choice(all.robots, first.robot), choice(all.scenes, first.scene));
    });
  }, [isTaken]);

  // Each change is checked once the keys rest; only the newest answer counts.
  useEffect(() => {
    if (!room || !text) return;
    const mine = ++turn.current;
    const timer = setTimeout(async () => {
      const answer = await ask({ ask: "check", text });
      if (mine !== turn.current) return;
      setFound(answer.error ? null : lines(answer.lines));
      if (answer.error) setSays(answer.error);
    }, PAUSE);
    return () => clearTimeout(timer);
  }, [text, room]);

  const work = (question, then) => async () => {
    setBusy(WORDS.working);
    setSays(null);
    const answer = await ask(question());
    setBusy(null);
    if (answer.error) setSays(answer.error);
    else then(answer);
  };
  return {
    isOn: rooms !== null,
    rooms,
    room,
    open,
    examples: examples ?? [],
    text,
    setText: (next) => {
      setText(next);
      setSays(null);
    },
    found,
    busy,
    says,
    motions,
    options,
    setOptions,
    fix: work(
      () => ({ ask: "fix", text }),
      (answer) => {
        setText(answer.text);
        setSays(WORDS.fixed(answer.applied));
      },
    ),
    format: work(() => ({ ask: "format", text }), (answer) => setText(answer.text)),
    plan: (request) =>
      work(
        () => ({ ask: "plan", request }),
        (answer) => {
          setText(answer.text);
          setSays(answer.notes.join(" ") || null);
        },
      )(),
    decide: work(() => ({ ask: "feasible", text }), setMotions),
    run: work(
      () => ({ ask: "run", text, seed: Number(options.seed) || 0, profile: options.profile }),
      (answer) => {
        if (answer.ok) show(answer.items);
        else setFound(lines(answer.lines));
      },
    ),
  };
}

const lines = (text) => text.split("\n").filter(Boolean).map((line) => JSON.parse(line));

const Choice = ({ name, options, is, set, tip }) => (
  <label title={tip}>
    {name}{" "}
    <select value={is} onChange={(event) => set(event.currentTarget.value)}>
      {Object.entries(options).map(([value, label]) => (
        <option key={value} value={value}>
          {label}
        </option>
      ))}
    </select>
  </label>
);

const same = (names) => Object.fromEntries(names.map((name) => [name, name]));

/** Line of the room, the request and the buttons. */
export function Room({ bench, toMotions }) {
  const [request, setRequest] = useState("");
  const { rooms, room, options, setOptions } = bench;
  const isWrong = bench.found === null || bench.found.some((one) => one.severity === "error");
  return (
    <section class="bench" aria-label={WORDS.write}>
      <div class="controls">
        {room && <Choice name={WORDS.robot} options={same(rooms.robots)} is={room.robot} set={(robot) => bench.open(robot, room.scene)} />}
        {room && <Choice name={WORDS.room} options={same(rooms.scenes)} is={room.scene} set={(scene) => bench.open(room.robot, scene)} />}
        {bench.examples.length > 0 && (
          <Choice
            name={WORDS.example}
            options={{ "": WORDS.ownText, ...same(bench.examples.map((one) => one.name)) }}
            is={bench.examples.find((one) => one.text === bench.text)?.name ?? ""}
            set={(name) => {
              const example = bench.examples.find((one) => one.name === name);
              if (!example) return;
              bench.setText(example.text);
              if (example.robot !== room.robot || example.scene !== room.scene) bench.open(example.robot, example.scene);
            }}
          />
        )}
        <form
          onSubmit={(event) => {
            event.preventDefault();
            if (request.trim()) bench.plan(request);
          }}
        >
          <input aria-label={WORDS.planFor} placeholder={WORDS.planFor} value={request} maxLength={2000} onInput={(event) => setRequest(event.currentTarget.value)} />
          <button disabled={!room || !request.trim()}>{WORDS.plan}</button>
        </form>
      </div>
      <div class="controls">
        <button class="primary" disabled={!room || isWrong || bench.busy} onClick={bench.run}>
          {WORDS.run}
        </button>
        <Choice name={WORDS.profile} tip={WORDS.tips.profile} options={WORDS.profiles} is={options.profile} set={(profile) => setOptions({ ...options, profile })} />
        <label title={WORDS.tips.seed}>
          {WORDS.seed} <input type="number" min="0" max="999999" value={options.seed} onInput={(event) => setOptions({ ...options, seed: event.currentTarget.value })} />
        </label>
        <button
          title={WORDS.tips.motions}
          disabled={!room || bench.busy}
          onClick={() => {
            toMotions();
            bench.decide();
          }}
        >
          {WORDS.decide}
        </button>
        <button title={WORDS.tips.fixAll} disabled={!room || bench.busy} onClick={bench.fix}>
          {WORDS.fixAll}
        </button>
        <button title={WORDS.tips.format} disabled={!room || bench.busy} onClick={bench.format}>
          {WORDS.format}
        </button>
        <span role="status" class="quiet">
          {bench.busy ?? bench.says}
        </span>
      </div>
    </section>
  );
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/** Text with the edits of a fix, whose places count bytes. */
export function edited(text, edits) {
  let bytes = encoder.encode(text);
  for (const edit of [...edits].sort((a, b) => b.start - a.start)) {
    const [before, after, middle] = [bytes.slice(0, edit.start), bytes.slice(edit.end), encoder.encode(edit.text)];
    bytes = new Uint8Array([...before, ...middle, ...after]);
  }
  return decoder.decode(bytes);
}

/** Place in a text of a place in its bytes. */
const placeOf = (text, byte) => decoder.decode(encoder.encode(text).slice(0, byte)).length;

/** Pieces of a text with the severity of the finding in each. */
function pieces(text, found) {
  const spans = found
    .map((one) => ({ from: placeOf(text, one.span.start), to: placeOf(text, one.span.end), is: one.severity }))
    .filter((one) => one.is !== "note" && one.to > one.from)
    .sort((a, b) => a.from - b.from);
  const out = [];
  let at = 0;
  for (const { from, to, is } of spans) {
    if (from < at) continue;
    out.push([text.slice(at, from), null], [text.slice(from, to), is]);
    at = to;
  }
  return [...out, [text.slice(at), null]];
}

/** Editor with the findings below. */
export function Writer({ bench }) {
  const area = useRef(null);
  const back = useRef(null);
  const numbers = useRef(null);
  const { text, found } = bench;
  const follow = () => {
    back.current.scrollTop = numbers.current.scrollTop = area.current.scrollTop;
    back.current.scrollLeft = area.current.scrollLeft;
  };
  const goTo = (one) => {
    const [from, to] = [placeOf(text, one.span.start), placeOf(text, one.span.end)];
    area.current.focus();
    area.current.setSelectionRange(from, to);
    const line = text.slice(0, from).split("\n").length;
    area.current.scrollTop = Math.max(0, (line - 4) * 19);
    follow();
  };
  return (
    <div class="writer">
      <div class="editor">
        <pre class="numbers" ref={numbers} aria-hidden="true">
          {text.split("\n").map((_, i) => `${i + 1}\n`)}
        </pre>
        <div class="sheet">
          <pre class="back" ref={back} aria-hidden="true">
            {pieces(text, found ?? []).map(([piece, is], i) => (is ? <mark key={i} class={is}>{piece}</mark> : piece))}
            {"\n\n"}
          </pre>
          <textarea
            ref={area}
            aria-label={WORDS.policyText}
            spellcheck={false}
            autocapitalize="off"
            autocomplete="off"
            wrap="off"
            value={text}
            onInput={(event) => bench.setText(event.currentTarget.value)}
            onScroll={follow}
          />
        </div>
      </div>
      <div class="findings" role="region" aria-live="polite" aria-label={WORDS.text}>
        {found?.every((one) => one.severity === "note") && <p class="clean">{WORDS.clean}</p>}
        {found?.map((one, i) => (
          <Finding
            key={i}
            of={one}
            place={
              <>
                <button class="link" onClick={() => goTo(one)}>
                  {WORDS.line(one.span.line)}
                </button>{" "}
              </>
            }
            fix={
              one.fix && (
                <button class="small" onClick={() => bench.setText(edited(text, one.fix.edits))}>
                  {WORDS.fixOne(one.fix.title)}
                </button>
              )
            }
          />
        ))}
      </div>
    </div>
  );
}

/** Verdicts on motions, with their picture. */
export function Motions({ bench }) {
  const { motions } = bench;
  if (!motions) return <p class="empty">{bench.busy ?? WORDS.noMotions}</p>;
  return (
    <div class="scroll motions">
      <p class="quiet">{WORDS.whichMotions}</p>
      <ul class="plain">
        {motions.says.map((line, i) => (
          <li key={i} class={/: feasible/.test(line) ? "" : "blocked"}>
            {line}
          </li>
        ))}
      </ul>
      {motions.left_out > 0 && <p class="quiet">{WORDS.leftOut(motions.left_out)}</p>}
      <img alt={WORDS.picture} src={`data:image/svg+xml;charset=utf-8,${encodeURIComponent(motions.picture)}`} />
    </div>
  );
}
