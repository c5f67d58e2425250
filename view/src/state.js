// State of the runs at a moment: a fold over the items of the page.

import { WORDS } from "./words.js";

const clock = (item) => (typeof item.at === "number" ? item.at : null);

/** State before the first item. */
export function fresh() {
  return {
    now: 0,
    takes: [],
    run: 0,
    policies: [],
    goals: [],
    fired: [],
    readings: {},
    series: {},
    facts: {},
    changed: {},
    bindings: {},
    holds: [],
    held: false,
    end: null,
    blocked: null,
    says: [],
    questions: [],
    swaps: [],
    guards: {},
    reasons: {},
    poses: [],
    full: false,
  };
}

/** The policy that runs. */
export const current = (state) => state.policies[state.policies.length - 1] ?? null;

const goal = (state, g) => state.goals.findLast((one) => one.g === g && one.run === state.run);

function policy(state, item) {
  state.policies.push({
    run: state.run,
    at: state.now,
    policy: item.policy,
    robot: item.robot,
    request: item.request ?? null,
    rows: item.rows,
    text: item.text ?? null,
    secs: item.secs,
    status: item.rows.map((row) => ({ s: "pending", n: "", a: 0, d: null, l: row.l })),
  });
}

/** Adds an item to a state. */
export function apply(state, item) {
  const at = clock(item);
  if (at !== null) state.now = Math.max(state.now, at);
  switch (item.t) {
    case "hello":
      state.takes = item.takes;
      break;
    case "run":
      state.run = item.run;
      Object.assign(state, { end: null, held: false, blocked: null, facts: {}, changed: {}, bindings: {}, readings: {}, guards: {}, reasons: {} });
      policy(state, item);
      if (item.request && state.says.at(-1)?.text !== item.request) {
        state.says.push({ at: state.now, who: "person", text: item.request });
      }
      break;
    case "swap":
      policy(state, item);
      state.swaps.push({ at: state.now, from: state.policies.length - 2, to: state.policies.length - 1, fates: [] });
      state.held = false;
      state.guards = {};
      state.reasons = {};
      break;
    case "say":
      state.says.push({ at: state.now, who: item.who, text: item.text });
      break;
    case "resumed":
      state.says.push({ at: state.now, who: "host", resumed: true });
      break;
    case "question":
      state.questions.push({ id: item.q, text: item.text, options: item.options, from: state.now, to: null, answer: null });
      break;
    case "answered": {
      const asked = state.questions.find((one) => one.id === item.q);
      if (asked) Object.assign(asked, { to: state.now, answer: item.text });
      break;
    }
    case "full":
      state.full = true;
      break;
  }
  for (const change of item.c ?? []) apply_change(state, change);
}

/** Reason of a failed step: the words of the driver, of geometry or of a guard, if they say more than the kind. */
export function told(state, r, why) {
  const last = state.goals.findLast((one) => one.r === r && one.p === state.policies.length - 1 && one.how === "failed");
  const reasons = [why ?? "", last?.why ?? "", state.reasons[r] ?? ""];
  return reasons.reduce((best, next) => (next.length > best.length ? next : best)) || why;
}

function apply_change(state, change) {
  const running = current(state);
  switch (change.k) {
    case "enter":
    case "row": {
      const of = change.v === undefined ? running : state.policies.filter((one) => one.run === state.run)[change.v];
      const row = of?.status[change.r];
      if (!row) break;
      if (change.k === "enter") {
        delete state.reasons[change.r];
        // What has run behind it in its block, has run in an earlier round of a loop.
        const depth = of.rows[change.r].d;
        for (let i = change.r + 1; i < of.rows.length && of.rows[i].d >= depth; i++) {
          Object.assign(of.status[i], { s: "pending", n: "", d: null });
        }
      }
      Object.assign(row, { s: change.s, n: change.n, a: change.a, d: change.d ?? null, l: change.l ?? row.l });
      break;
    }
    case "start": {
      const one = {
        g: change.g,
        run: state.run,
        p: state.policies.length - 1,
        r: change.r,
        label: change.l ?? change.cmd,
        cmd: change.cmd,
        uses: change.uses,
        from: state.now,
        to: null,
        how: null,
        why: null,
        is: "starts",
        by: change.by,
        paths: change.paths,
        open: change.open,
        feedback: "",
      };
      state.goals.push(one);
      state.blocked = null;
      if (change.q) {
        state.questions.push({
          id: `${state.run}:${change.g}`,
          text: change.q.text,
          options: change.q.options,
          from: state.now,
          to: null,
          answer: null,
          by: change.by,
          r: change.r,
        });
      }
      break;
    }
    case "update": {
      const one = goal(state, change.g);
      if (one) Object.assign(one, { p: state.policies.length - 1, r: change.r, label: change.l ?? change.cmd, by: change.by, paths: change.paths });
      break;
    }
    case "goal": {
      const one = goal(state, change.g);
      if (one && one.to === null) {
        Object.assign(one, { to: state.now, how: change.how, why: change.why });
        const swap = state.swaps.at(-1);
        if (change.how === "interrupted" && swap && one.p < swap.to && !swap.fates.some((fate) => fate.g === one.g)) {
          swap.fates.push({ g: one.g, label: one.label, is: "cancelled" });
        }
      }
      const asked = state.questions.find((each) => each.id === `${state.run}:${change.g}`);
      if (asked) Object.assign(asked, { to: state.now, answer: change.how === "done" ? change.why : null });
      break;
    }
    case "state": {
      const one = goal(state, change.g);
      if (one) one.is = change.is;
      break;
    }
    case "feedback": {
      const one = goal(state, change.g);
      if (one) one.feedback = change.text;
      break;
    }
    case "fate": {
      const swap = state.swaps.at(-1);
      const one = goal(state, change.g);
      if (swap && one && !swap.fates.some((fate) => fate.g === change.g)) {
        swap.fates.push({ g: change.g, label: one.label, is: change.is });
        if (change.is !== "cancelled") one.p = swap.to;
      }
      break;
    }
    case "fired":
      state.fired.push({ at: state.now, p: state.policies.length - 1, r: change.r, w: change.w, truth: change.truth });
      break;
    case "guard":
      state.guards[`${change.r}:${change.i}`] = change.truth;
      if (change.truth !== "true") state.reasons[change.r] = WORDS.refuted(running?.rows[change.r]?.needs?.[change.i]?.text ?? "", change.truth);
      break;
    case "verdict":
      if (change.text !== "feasible") state.reasons[change.r] = change.text;
      break;
    case "read": {
      state.readings[change.q] = { v: change.v, at: state.now };
      const number = Number.parseFloat(change.v);
      if (Number.isFinite(number)) (state.series[change.q] ??= []).push([state.now, number]);
      break;
    }
    case "fact":
      // Those of the head are where the run begins.
      if (change.f in state.facts) state.changed[change.f] = change.v;
      state.facts[change.f] = change.v;
      break;
    case "bind":
      state.bindings[change.b] = change.v;
      break;
    case "held":
      state.held = change.is;
      if (change.is) state.holds.push({ from: state.now, to: null });
      else if (state.holds.length) state.holds.at(-1).to ??= state.now;
      break;
    case "blocked":
      state.blocked = { why: change.why, by: change.by ?? [] };
      break;
    case "pose":
      state.poses.push({ at: state.now, pose: change.pose, things: {} });
      break;
    case "end":
      state.end = { how: change.how, why: told(state, change.r, change.why), r: change.r, at: change.at };
      if (change.by?.length) state.blocked = { why: change.why, by: change.by };
      for (const one of state.goals) if (one.run === state.run && one.to === null) one.to = state.now;
      for (const one of state.questions) one.to ??= state.now;
      if (state.holds.length) state.holds.at(-1).to ??= state.now;
      state.held = false;
      break;
  }
}

/** Items of the page with their times, the state after all of them, and that at any moment. */
export class Log {
  items = [];
  live = fresh();
  world = null;
  moves = [];
  #marks = [];
  #past = null;

  add(item) {
    if (item.t === "world") this.world = item;
    else if (item.t === "moved") this.#moved(item);
    else {
      apply(this.live, item);
      this.items.push([this.live.now, item]);
      if (this.items.length % 2000 === 0) this.#marks.push([this.items.length, structuredClone(this.live)]);
      this.#past = null;
    }
  }

  #moved(item) {
    const last = this.moves.at(-1);
    if (!last || item.at > last.at) this.moves.push(item);
    else if (item.at === last.at) Object.assign(last.things, item.things);
  }

  /** Time of the last thing that is known. */
  get end() {
    return Math.max(this.live.now, this.moves.at(-1)?.at ?? 0);
  }

  /** State at a time; the live one for null. */
  at(time) {
    if (time === null) return this.live;
    if (this.#past?.time === time) return this.#past.state;
    const mark = this.#marks.findLast(([count]) => this.items[count - 1][0] <= time);
    const state = mark ? structuredClone(mark[1]) : fresh();
    for (let i = mark?.[0] ?? 0; i < this.items.length && this.items[i][0] <= time; i++) apply(state, this.items[i][1]);
    this.#past = { time, state };
    return state;
  }

  /** Poses of links and things at a time. */
  motion(time, state) {
    const limit = time ?? Infinity;
    let pose = this.world?.pose ?? null;
    let base = -1;
    const things = {};
    for (const move of this.moves) {
      if (move.at > limit) break;
      [pose, base] = [move.pose, move.at];
      Object.assign(things, move.things);
    }
    for (const known of state.poses) if (known.at >= base && known.at <= limit) pose = known.pose;
    return { pose, things, told: base >= 0 };
  }
}
