// Small parts that several regions share.

import { WORDS } from "./words.js";

const SIGNS = { pending: "○", running: "▶", done: "✓", failed: "✗", interrupted: "■" };

/** Sign of a status, with its word for who does not see it. */
export const Sign = ({ is }) => (
  <span class={`sign ${is}`} role="img" aria-label={WORDS.status[is]}>
    {SIGNS[is] ?? "○"}
  </span>
);

/** Time for people. */
export const secs = (value) => WORDS.secs(value);

/** Finding of a check; `place` leads to it, and `fix` mends it. */
export const Finding = ({ of, place, fix }) => (
  <div class={`finding ${of.severity}`}>
    {place}
    <b>
      {WORDS.severity[of.severity]} {of.code}
    </b>{" "}
    {of.message}
    {of.help && (
      <div>
        {WORDS.help}: {of.help}
      </div>
    )}
    {fix}
  </div>
);

/** Value of a reading without more digits than a person reads. */
export function short(value) {
  const number = Number(value);
  return value !== "" && Number.isFinite(number) ? String(Math.round(number * 1000) / 1000) : value;
}

/** Distance of a reading from its bound: positive where the condition is false. */
export function margin(read, value) {
  const number = Number.parseFloat(value);
  if (read.bound === undefined || !Number.isFinite(number)) return null;
  if (read.op === "<" || read.op === "<=") return number - read.bound;
  if (read.op === ">" || read.op === ">=") return read.bound - number;
  return null;
}

/** Last reading of a question: a measure, or a fact. */
export function reading(state, q) {
  const read = state.readings[q];
  if (read) return read.v;
  const fact = state.facts[q];
  if (fact !== undefined) return WORDS.believes[String(fact)];
  // In a policy the question names a binding, in the world its value.
  const meant = q.replace(/\b[A-Za-z_]\w*\b/g, (name) => (Object.hasOwn(state.bindings, name) ? state.bindings[name] : name));
  return meant === q ? null : reading({ ...state, bindings: {} }, meant);
}

/** Tabs of a region. */
export const Tabs = ({ name, tabs, is, set }) => (
  <div class="tabs" role="tablist" aria-label={name}>
    {Object.entries(tabs).map(([key, label]) => (
      <button
        key={key}
        role="tab"
        id={`tab-${key}`}
        aria-selected={is === key}
        aria-controls={`panel-${key}`}
        tabIndex={is === key ? 0 : -1}
        onClick={() => set(key)}
        onKeyDown={(event) => {
          const keys = Object.keys(tabs);
          const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
          if (!by) return;
          const next = keys[(keys.indexOf(key) + by + keys.length) % keys.length];
          set(next);
          document.getElementById(`tab-${next}`)?.focus();
        }}
      >
        {label}
      </button>
    ))}
  </div>
);
