// Robot in its scene: the picture, and the list of things for who does not see it.

import { useEffect, useRef, useState } from "preact/hooks";
import { Stage, apart } from "./stage.js";
import { current } from "./state.js";
import { WORDS } from "./words.js";

const heldNow = (state) =>
  Object.entries(state.facts).flatMap(([fact, is]) => (is === true && /^holding\((?!any\))/.test(fact) ? [fact.slice(8, -1)] : []));

/** Things that the robot has taken: where they are now is no surprise. */
const taken = (state) =>
  state.goals.flatMap((one) => /\b(?:object|thing): ([\w-]+)/.exec(one.cmd)?.slice(1) ?? []).map((id) => `was ${id}`);

function picture(log, state, time, chosen) {
  const motion = log.motion(time, state);
  const running = state.goals.filter((one) => one.to === null && one.run === state.run);
  let paths = running.flatMap((one) => one.paths);
  const row = chosen === null ? null : current(state)?.rows[chosen];
  if (paths.length === 0 && row?.motion?.path) paths = [row.motion.path];
  return {
    ...motion,
    paths,
    blocked: state.blocked?.by ?? [],
    facts: state.facts,
    held: [...heldNow(state), ...taken(state)],
  };
}

export function SceneView({ log, state, time, chosen, tick }) {
  const canvas = useRef(null);
  const labels = useRef(null);
  const stage = useRef(null);
  const [fault, setFault] = useState(null);
  const world = log.world;
  useEffect(() => {
    if (!world || !canvas.current) return;
    try {
      stage.current = new Stage(canvas.current, labels.current, world, matchMedia("(prefers-color-scheme: dark)").matches);
    } catch (error) {
      setFault(error.message);
      return;
    }
    return () => {
      stage.current.close();
      stage.current = null;
    };
  }, [world]);
  useEffect(() => stage.current?.show(picture(log, state, time, chosen)), [world, tick, time, chosen]);
  if (!world) return <p class="empty">{WORDS.noScene}</p>;
  const { told } = log.motion(time, state);
  return (
    <div class="scene">
      {fault && <p class="empty">{WORDS.noWebgl}</p>}
      <canvas ref={canvas} tabIndex={0} role="img" aria-label={WORDS.sceneLabel} hidden={Boolean(fault)} />
      <div class="tags" ref={labels} aria-hidden="true" />
      <p class="legend">{told ? WORDS.legend : WORDS.legendBelieved}</p>
      {state.blocked && (
        <p class="blockedby" role="status">
          <b>{WORDS.blocked}:</b> {state.blocked.why}
        </p>
      )}
    </div>
  );
}

/** Things of the room with their places, in words. */
export function Things({ log, state, time }) {
  if (!log.world) return null;
  const { things } = log.motion(time, state);
  const held = heldNow(state);
  return (
    <ul class="plain">
      {log.world.things
        .filter((thing) => thing.kind !== "Surface" && thing.kind !== "Place" && thing.kind !== "Zone")
        .map((thing) => {
          const at = things[thing.id];
          const gap = at ? apart(at, thing.at) : 0;
          const blocks = state.blocked?.by.includes(thing.id);
          return (
            <li key={thing.id} class={blocks ? "blocked" : ""}>
              <b>{thing.name}</b> {WORDS.place((at ?? thing.at).slice(0, 3))}
              {held.includes(thing.id) && <span class="badge">{WORDS.holding}</span>}
              {gap > 0.03 && <small> {WORDS.apart(gap)}</small>}
            </li>
          );
        })}
    </ul>
  );
}
