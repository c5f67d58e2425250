// Outline of the steps: a tree of which only the visible part is in the document.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { current, told } from "./state.js";
import { Sign, margin, reading, secs, short } from "./parts.jsx";
import { WORDS } from "./words.js";

const HEIGHT = 28;

/** Rows that are shown where some groups are closed, and for each whether it has rows inside. */
export function shown(rows, closed) {
  const list = [];
  let hidden = Infinity;
  for (let i = 0; i < rows.length; i++) {
    const { d } = rows[i];
    if (d > hidden) continue;
    hidden = closed.has(i) ? d : Infinity;
    list.push(i);
  }
  return list;
}

export const isGroup = (rows, i) => i + 1 < rows.length && rows[i + 1].d > rows[i].d;

/** The innermost row that runs, or that failed last. */
export function active(policy) {
  const { rows, status } = policy;
  let best = null;
  for (let i = 0; i < rows.length; i++) {
    if (status[i].s === "running" && (best === null || rows[i].d >= rows[best].d)) best = i;
  }
  return best;
}

function Badges({ row, state }) {
  const reads = (row.watches ?? []).flatMap((watch) => watch.reads);
  return reads.slice(0, 3).map((read) => {
    const value = reading(state, read.q);
    const by = value === null ? null : margin(read, value);
    const near = by !== null && by < Math.max(0.1 * Math.abs(read.bound), 1e-9);
    return (
      <span key={read.q} class={`badge ${near ? "near" : ""}`} title={by === null ? "" : WORDS.margin(short(by))}>
        {read.q} = {value === null ? "?" : short(value)}
      </span>
    );
  });
}

export function Outline({ state, now, chosen, choose, closed, toggle, follow, setFollow }) {
  const policy = current(state);
  const box = useRef(null);
  const [view, setView] = useState({ top: 0, height: 600 });
  const rows = policy?.rows ?? [];
  const list = shown(rows, closed);
  const running = policy && active(policy);

  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const size = () => setView((view) => ({ ...view, height: element.clientHeight }));
    const observer = new ResizeObserver(size);
    observer.observe(element);
    size();
    return () => observer.disconnect();
  }, [policy === null]);
  const bring = (i) => {
    const element = box.current;
    const place = list.indexOf(i) * HEIGHT;
    if (!element || place < 0) return;
    if (place < element.scrollTop + HEIGHT || place > element.scrollTop + element.clientHeight - 2 * HEIGHT) {
      element.scrollTop = Math.max(0, place - element.clientHeight / 3);
    }
  };
  useEffect(() => {
    if (follow && running !== null) bring(running);
  }, [follow, running, view.height]);

  if (!policy) return <p class="empty">{WORDS.noSteps}</p>;
  const first = Math.max(0, Math.floor(view.top / HEIGHT) - 8);
  const visible = list.slice(first, first + Math.ceil(view.height / HEIGHT) + 16);
  const go = (i) => {
    choose(i);
    bring(i);
  };
  const onKeyDown = (event) => {
    const at = list.indexOf(chosen ?? list[0]);
    const i = list[at];
    const parent = () => {
      for (let k = i - 1; k >= 0; k--) if (rows[k].d < rows[i].d) return k;
      return i;
    };
    const to = {
      ArrowDown: () => list[Math.min(at + 1, list.length - 1)],
      ArrowUp: () => list[Math.max(at - 1, 0)],
      Home: () => list[0],
      End: () => list[list.length - 1],
      ArrowRight: () => (closed.has(i) ? (toggle(i), i) : isGroup(rows, i) ? i + 1 : i),
      ArrowLeft: () => (isGroup(rows, i) && !closed.has(i) ? (toggle(i), i) : parent()),
    }[event.key];
    if (!to) return;
    event.preventDefault();
    setFollow(false);
    go(to());
  };
  return (
    <div class="outline">
      <div class="bar">
        <button
          class="small"
          onClick={() => {
            const groups = rows.map((_, i) => i).filter((i) => isGroup(rows, i));
            const open = groups.every((i) => !closed.has(i));
            groups.forEach((i) => closed.has(i) !== open && toggle(i));
          }}
        >
          {closed.size ? WORDS.expand : WORDS.collapse}
        </button>
        <label class="check">
          <input type="checkbox" checked={follow} onChange={(event) => setFollow(event.currentTarget.checked)} />
          {WORDS.follow}
        </label>
      </div>
      <div
        class="tree"
        ref={box}
        role="tree"
        aria-label={WORDS.steps}
        tabIndex={0}
        aria-activedescendant={chosen === null ? undefined : `row-${chosen}`}
        onKeyDown={onKeyDown}
        onScroll={(event) => setView({ top: event.currentTarget.scrollTop, height: event.currentTarget.clientHeight })}
      >
        <div class="space" style={{ height: `${list.length * HEIGHT}px` }}>
          {visible.map((i, k) => {
            const row = rows[i];
            const is = policy.status[i];
            const group = isGroup(rows, i);
            return (
              <div
                key={i}
                id={`row-${i}`}
                role="treeitem"
                aria-level={row.d + 1}
                aria-selected={chosen === i}
                aria-expanded={group ? !closed.has(i) : undefined}
                class={`row ${is.s} ${row.n === undefined ? "heading" : ""} ${chosen === i ? "chosen" : ""}`}
                style={{ top: `${(first + k) * HEIGHT}px`, paddingLeft: `${6 + Math.min(row.d, 20) * 14}px` }}
                onClick={() => {
                  setFollow(false);
                  choose(i);
                }}
              >
                <span
                  class="fold"
                  aria-hidden="true"
                  onClick={(event) => {
                    if (!group) return;
                    event.stopPropagation();
                    toggle(i);
                  }}
                >
                  {group ? (closed.has(i) ? "▸" : "▾") : ""}
                </span>
                {row.n === undefined ? null : <Sign is={is.s} />}
                <span class="label">{is.l}</span>
                <Badges row={row} state={state} />
                {is.n && <span class="note">{is.s === "failed" ? told(state, i, is.n) : is.n}</span>}
                <span class="took">{is.d !== null ? secs(is.d) : is.s === "running" ? secs(Math.max(0, now - is.a)) : ""}</span>
              </div>
            );
          })}
        </div>
      </div>
    </div>
  );
}
