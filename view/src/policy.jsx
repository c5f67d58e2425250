// Text of the policy with its findings, and what swaps changed.

import { useEffect, useMemo, useRef } from "preact/hooks";
import { current } from "./state.js";
import { Finding, secs } from "./parts.jsx";
import { WORDS } from "./words.js";

export function PolicyText({ state, chosen, choose }) {
  const policy = current(state);
  const mark = useRef(null);
  const line = chosen === null ? null : policy?.rows[chosen]?.line;
  useEffect(() => mark.current?.scrollIntoView({ block: "nearest" }), [line]);
  if (!policy) return <p class="empty">{WORDS.noSteps}</p>;
  if (!policy.text) return <p class="empty">{WORDS.noText}</p>;
  const lines = policy.text.text.replace(/\n$/, "").split("\n");
  const runs = new Set();
  policy.rows.forEach((row, i) => row.line && policy.status[i].s === "running" && runs.add(row.line));
  const found = new Map();
  for (const one of policy.text.findings) found.set(one.span.line, [...(found.get(one.span.line) ?? []), one]);
  return (
    <div class="source" tabIndex={0} role="region" aria-label={policy.text.name}>
      <div class="file">{policy.text.name}</div>
      {lines.map((text, i) => {
        const number = i + 1;
        const row = policy.rows.findIndex((one) => one.line === number);
        return (
          <div key={i}>
            <div
              ref={number === line ? mark : null}
              class={`codeline ${number === line ? "chosen" : ""} ${runs.has(number) ? "running" : ""}`}
              onClick={() => row >= 0 && choose(row)}
            >
              <span class="number">{number}</span>
              <code>{text || " "}</code>
            </div>
            {found.get(number)?.map((one, k) => (
              <Finding key={k} of={one} />
            ))}
          </div>
        );
      })}
    </div>
  );
}

const MOST = 2000;

/** Lines of two texts: same, only before, only after. Longest common subsequence. */
export function difference(before, after) {
  const [a, b] = [before.slice(0, MOST), after.slice(0, MOST)];
  const size = b.length + 1;
  const table = new Uint16Array((a.length + 1) * size);
  for (let i = a.length - 1; i >= 0; i--) {
    for (let j = b.length - 1; j >= 0; j--) {
      table[i * size + j] =
        a[i] === b[j] ? table[(i + 1) * size + j + 1] + 1 : Math.max(table[(i + 1) * size + j], table[i * size + j + 1]);
    }
  }
  const out = [];
  let [i, j] = [0, 0];
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) out.push([" ", a[i++], j++]);
    else if (i < a.length && (j >= b.length || table[(i + 1) * size + j] >= table[i * size + j + 1])) out.push(["-", a[i++]]);
    else out.push(["+", b[j++]]);
  }
  return out;
}

const textOf = (policy) =>
  policy.text ? policy.text.text.trimEnd().split("\n") : policy.rows.map((row) => "  ".repeat(row.d) + row.l);

function Swap({ swap, state }) {
  const [from, to] = [state.policies[swap.from], state.policies[swap.to]];
  const lines = useMemo(() => difference(textOf(from), textOf(to)), [from, to]);
  return (
    <article class="swap">
      <h3>
        {WORDS.swap(from.policy, to.policy)} <small>{secs(swap.at)}</small>
      </h3>
      <h4>{WORDS.fates}</h4>
      {swap.fates.length === 0 && <p>{WORDS.noFates}</p>}
      <ul class="fates">
        {swap.fates.map((fate) => (
          <li key={fate.g} class={fate.is}>
            <b>{WORDS.fate[fate.is]}</b> {fate.label}
          </li>
        ))}
      </ul>
      <h4>{WORDS.difference}</h4>
      {lines.every(([sign]) => sign === " ") ? (
        <p>{WORDS.same}</p>
      ) : (
        <pre class="diff" tabIndex={0}>
          {lines.map(([sign, text], i) => (
            <div key={i} class={{ "+": "added", "-": "removed", " ": "" }[sign]}>
              {sign} {text}
            </div>
          ))}
        </pre>
      )}
    </article>
  );
}

export function Changes({ state, isPast }) {
  if (state.swaps.length === 0) return <p class="empty">{isPast ? WORDS.noChangesYet : WORDS.noChanges}</p>;
  return (
    <div class="scroll">
      {state.swaps.map((swap, i) => (
        <Swap key={i} swap={swap} state={state} />
      ))}
    </div>
  );
}
