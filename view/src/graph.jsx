// Graph of the steps: groups as boxes that open and close, laid out by dagre.

import dagre from "@dagrejs/dagre";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { current } from "./state.js";
import { active, isGroup, shown } from "./outline.jsx";
import { margin, reading, short } from "./parts.jsx";
import { WORDS } from "./words.js";

const MOST = 400;
const LETTERS = 38;
const cut = (text) => (text.length > LETTERS ? `${text.slice(0, LETTERS - 1)}…` : text);
const width = (row) => 36 + cut(row.l).length * 6.9 + (row.watches ? 130 : 0);

function parents(rows) {
  const stack = [];
  return rows.map((row, i) => {
    while (stack.length && rows[stack.at(-1)].d >= row.d) stack.pop();
    const parent = stack.at(-1) ?? null;
    stack.push(i);
    return parent;
  });
}

/** Places of the shown rows, of the boxes of open groups, and the ways between them. */
function layout(rows, list, closed) {
  const up = parents(rows);
  const open = (i) => isGroup(rows, i) && !closed.has(i);
  const graph = new dagre.graphlib.Graph({ compound: true });
  graph.setGraph({ rankdir: "TB", nodesep: 18, ranksep: 22, marginx: 12, marginy: 12 });
  graph.setDefaultEdgeLabel(() => ({}));
  const inside = (i) => (open(i) ? `g${i}` : null);
  for (const i of list) {
    graph.setNode(`n${i}`, { width: width(rows[i]), height: 30, i });
    if (open(i)) {
      graph.setNode(`g${i}`, { i, box: true });
      graph.setParent(`n${i}`, `g${i}`);
    }
  }
  for (const i of list) {
    const parent = up[i];
    const own = inside(i) ?? `n${i}`;
    if (parent !== null && inside(parent)) graph.setParent(own, inside(parent));
  }
  // A step follows those before it. A heading belongs to the step before it, or to its parent: a handler or a
  // branch begins there, and a cleanup follows it.
  const tails = new Map();
  const ends = (i) => {
    if (!open(i)) return [i];
    let child = null;
    for (let k = i + 1; k < rows.length && rows[k].d > rows[i].d; k++) if (rows[k].d === rows[i].d + 1) child = k;
    return child === null ? [i] : ends(child);
  };
  for (const i of list) {
    const parent = up[i];
    const before = tails.get(parent) ?? [];
    const is_heading = rows[i].n === undefined;
    const follow = () => before.flatMap(ends).forEach((end) => rows[end].kind !== "end" && graph.setEdge(`n${end}`, `n${i}`));
    if (before.length === 0) {
      if (parent !== null) graph.setEdge(`n${parent}`, `n${i}`);
      tails.set(parent, [i]);
    } else if (is_heading && rows[i].l !== "finally") {
      const owner = rows[before[0]].n === undefined ? parent : before[0];
      if (owner !== null) graph.setEdge(`n${owner}`, `n${i}`);
      tails.set(parent, [...before, i]);
    } else {
      follow();
      tails.set(parent, [i]);
    }
  }
  dagre.layout(graph);
  const nodes = [];
  const boxes = [];
  for (const name of graph.nodes()) {
    const node = graph.node(name);
    (node.box ? boxes : nodes).push({ ...node, depth: rows[node.i].d });
  }
  boxes.sort((one, other) => one.depth - other.depth);
  const edges = graph.edges().map((edge) => graph.edge(edge).points.map(({ x, y }) => `${x},${y}`).join(" "));
  const { width: w, height: h } = graph.graph();
  return { nodes, boxes, edges, w: Math.max(w, 50), h: Math.max(h, 50) };
}

export function GraphView({ state, chosen, choose, closed, toggle }) {
  const policy = current(state);
  const [scale, setScale] = useState(0.9);
  const box = useRef(null);
  const rows = policy?.rows ?? [];
  const key = [...closed].join();
  const many = shown(rows, closed).length > MOST;
  // A graph of a thousand boxes is no picture: its groups are closed until a person opens them.
  const folded = useMemo(() => {
    if (!many) return closed;
    const outer = rows.map((_, i) => i).filter((i) => isGroup(rows, i) && rows[i].d > 0);
    const all = new Set([...closed, ...outer]);
    if (shown(rows, all).length > MOST) rows.forEach((_, i) => isGroup(rows, i) && all.add(i));
    return all;
  }, [rows, key, many]);
  const plan = useMemo(() => {
    const list = shown(rows, folded).slice(0, MOST);
    return rows.length ? layout(rows, list, folded) : null;
  }, [rows, folded]);
  const running = policy && active(policy);
  useEffect(() => {
    // Of a step in a closed group the group is shown.
    const node = plan?.nodes.findLast((one) => one.i <= (chosen ?? running ?? -1));
    if (node && box.current) {
      const { clientWidth, clientHeight } = box.current;
      box.current.scrollTo({ left: node.x * scale - clientWidth / 2, top: node.y * scale - clientHeight / 2 });
    }
  }, [plan, chosen, running, scale]);
  if (!plan) return <p class="empty">{WORDS.noSteps}</p>;
  return (
    <div class="graph">
      <div class="bar">
        <button class="small" aria-label={WORDS.smaller} onClick={() => setScale(Math.max(0.2, scale / 1.25))}>
          −
        </button>
        <button class="small" aria-label={WORDS.larger} onClick={() => setScale(Math.min(2.5, scale * 1.25))}>
          +
        </button>
      </div>
      <div class="canvas" ref={box} tabIndex={0} role="group" aria-label={WORDS.graph}>
        <svg width={plan.w * scale} height={plan.h * scale} viewBox={`0 0 ${plan.w} ${plan.h}`}>
          {plan.boxes.map((one) => (
            <rect key={`b${one.i}`} class="box" x={one.x - one.width / 2} y={one.y - one.height / 2} width={one.width} height={one.height} rx="8" />
          ))}
          {plan.edges.map((points, i) => (
            <polyline key={i} class="edge" points={points} />
          ))}
          {plan.nodes.map((one) => {
            const row = rows[one.i];
            const is = policy.status[one.i];
            const group = isGroup(rows, one.i);
            const reads = (row.watches ?? []).flatMap((watch) => watch.reads);
            const read = reads.find((each) => reading(state, each.q) !== null);
            const value = read ? reading(state, read.q) : null;
            const by = read ? margin(read, value) : null;
            return (
              <g
                key={one.i}
                class={`node ${row.n === undefined ? "heading" : is.s} ${chosen === one.i ? "chosen" : ""}`}
                transform={`translate(${one.x - one.width / 2} ${one.y - one.height / 2})`}
                tabIndex={0}
                role="button"
                aria-label={`${is.l}, ${WORDS.status[is.s]}`}
                onClick={() => (chosen === one.i && group ? toggle(one.i) : choose(one.i))}
                onKeyDown={(event) => event.key === "Enter" && (chosen === one.i && group ? toggle(one.i) : choose(one.i))}
              >
                <title>{is.l}</title>
                <rect width={one.width} height={one.height} rx="6" />
                <text x="10" y="19.5">
                  {group ? (folded.has(one.i) ? "▸ " : "▾ ") : ""}
                  {cut(is.l)}
                </text>
                {value !== null && (
                  <text class="read" x={one.width - 8} y="19.5" text-anchor="end">
                    {short(value)}
                    {by === null ? "" : ` (${WORDS.margin(short(by))})`}
                  </text>
                )}
              </g>
            );
          })}
        </svg>
      </div>
    </div>
  );
}
