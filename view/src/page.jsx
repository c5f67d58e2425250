// The page: gathers items, keeps the moment that is shown and the chosen step, and draws the regions.

import { render } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { Head, Questions } from "./controls.jsx";
import { Known, StepDetails, Talk } from "./details.jsx";
import { Camera } from "./camera.jsx";
import { GraphView } from "./graph.jsx";
import { Lanes } from "./lanes.jsx";
import { Outline, active } from "./outline.jsx";
import { Changes, PolicyText } from "./policy.jsx";
import { SceneView } from "./scene.jsx";
import { Log, current } from "./state.js";
import { Tabs } from "./parts.jsx";
import { Motions, Room, Writer, useBench } from "./bench.jsx";
import { WORDS } from "./words.js";

const MAIN = { steps: WORDS.steps, graph: WORDS.graph, text: WORDS.text, changes: WORDS.changes };
const SIDE = { scene: WORDS.scene, step: WORDS.step, known: WORDS.known, talk: WORDS.talk };
const NARROW = matchMedia("(max-width: 60rem)");

/** Simulated seconds of a recorded run that pass in a second while it plays. */
const PACE = 6;

/**
 * `connect` gives the items of a run. `ask` answers the questions of a workbench: on a page of its own, which
 * brings `examples`, or on that of a program whose first item says that it takes questions.
 */
function Page({ connect, ask, examples }) {
  const [log, setLog] = useState(() => new Log());
  const [playing, setPlaying] = useState(false);
  const [tick, setTick] = useState(0);
  const [link, setLink] = useState("connecting");
  const [time, setTime] = useState(null);
  const [chosen, setChosen] = useState(null);
  const [closed, setClosed] = useState(new Set());
  const [follow, setFollow] = useState(true);
  const [main, setMain] = useState("steps");
  const [side, setSide] = useState("scene");
  const [narrow, setNarrow] = useState(NARROW.matches);
  const [only, setOnly] = useState("steps");

  const fresh = (items) => {
    const next = new Log();
    items.forEach((item) => next.add(item));
    setLog(next);
    setChosen(null);
    setClosed(new Set());
    const runs = next.live.policies.length > 0;
    setTime(runs ? 0 : null);
    setPlaying(runs);
    setTick((tick) => tick + 1);
  };
  const bench = useBench({ ask, examples, isTaken: link === "bench" || log.live.takes.includes("ask"), show: fresh });

  useEffect(() => {
    let is_due = false;
    let policies = 0;
    const add = (item) => {
      log.add(item);
      if (is_due) return;
      is_due = true;
      // Many items of one moment are drawn once.
      requestAnimationFrame(() => {
        is_due = false;
        if (log.live.policies.length !== policies) {
          policies = log.live.policies.length;
          setChosen(null);
          setClosed(new Set());
        }
        setTick((tick) => tick + 1);
      });
    };
    connect(add, setLink);
    const change = () => setNarrow(NARROW.matches);
    NARROW.addEventListener("change", change);
    return () => NARROW.removeEventListener("change", change);
  }, []);

  const moment = useRef(0);
  moment.current = time ?? log.end;
  // A layout effect ends with the drawing that halts: no frame of before sets the time again. The first frame gives the time from
  // which the others count: the time of a frame may lie before the moment in which it was asked for.
  useLayoutEffect(() => {
    if (!playing) return;
    let last = null;
    let frame = requestAnimationFrame(function next(now) {
      const at = moment.current + ((now - (last ?? now)) / 1000) * PACE;
      last = now;
      if (at >= log.end) {
        setTime(null);
        setPlaying(false);
        return;
      }
      setTime(at);
      frame = requestAnimationFrame(next);
    });
    return () => cancelAnimationFrame(frame);
  }, [playing, log]);

  const state = log.at(time);
  const policy = current(state);
  const safe = chosen !== null && policy && chosen < policy.rows.length ? chosen : null;
  useEffect(() => {
    document.title = policy ? `${policy.policy} · Motet` : "Motet";
  }, [policy?.policy]);
  const toggle = (i) =>
    setClosed((closed) => {
      const next = new Set(closed);
      if (!next.delete(i)) next.add(i);
      return next;
    });
  const choose = (i) => {
    setChosen(i);
    if (side === "talk" || side === "known") setSide("step");
  };
  const regions = {
    write: () => <Writer bench={bench} />,
    motions: () => <Motions bench={bench} />,
    steps: () => <Outline state={state} now={time ?? log.end} chosen={safe} choose={choose} closed={closed} toggle={toggle} follow={follow} setFollow={setFollow} />,
    graph: () => <GraphView state={state} chosen={safe} choose={choose} closed={closed} toggle={toggle} />,
    text: () => <PolicyText state={state} chosen={safe} choose={choose} />,
    changes: () => <Changes state={state} isPast={time !== null} />,
    scene: () => <SceneView log={log} state={state} time={time} chosen={safe} tick={tick} />,
    step: () => <StepDetails state={state} chosen={safe ?? (follow && policy ? active(policy) : null)} showLine={() => (narrow ? setOnly("text") : setMain("text"))} />,
    known: () => <Known log={log} state={state} time={time} />,
    talk: () => <Talk state={state} world={log.world} />,
    camera: () => <Camera />,
  };
  const mains = bench.isOn ? { write: WORDS.write, steps: WORDS.steps, graph: WORDS.graph } : MAIN;
  const sides = bench.isOn ? { scene: WORDS.scene, motions: WORDS.motions, step: WORDS.step, known: WORDS.known } : link === "live" ? { ...SIDE, camera: WORDS.camera } : SIDE;
  const [mainIs, sideIs] = [main in mains ? main : "write", side in sides ? side : "scene"];
  const onlyIs = only in { ...mains, ...sides } ? only : "write";
  useEffect(() => {
    if (bench.isOn) [setMain("write"), setOnly("write")];
  }, [bench.isOn]);
  const panel = (key) => (
    <div class="panel" role="tabpanel" id={`panel-${key}`} aria-labelledby={`tab-${key}`}>
      {regions[key]()}
    </div>
  );
  return (
    <div class={`page ${time === null ? "" : "pasttime"}`}>
      <Head state={state} live={log.live} link={link} time={time} />
      {bench.isOn && <Room bench={bench} toMotions={() => (narrow ? setOnly("motions") : setSide("motions"))} />}
      <Questions state={state} live={log.live} link={link} world={log.world} />
      {narrow ? (
        <main class="one">
          <Tabs name="Motet" tabs={{ ...mains, ...sides }} is={onlyIs} set={setOnly} />
          {panel(onlyIs)}
        </main>
      ) : (
        <main class="two">
          <section>
            <Tabs name={WORDS.steps} tabs={mains} is={mainIs} set={setMain} />
            {panel(mainIs)}
          </section>
          <section>
            <Tabs name={WORDS.scene} tabs={sides} is={sideIs} set={setSide} />
            {panel(sideIs)}
          </section>
        </main>
      )}
      {(!bench.isOn || log.live.policies.length > 0) && <Lanes
        log={log}
        live={log.live}
        time={time}
        setTime={(time) => {
          setPlaying(false);
          setTime(time);
        }}
        isLive={link === "live" && !bench.isOn}
        playing={playing}
        play={
          link === "live" && !bench.isOn
            ? null
            : () => {
                if (!playing && time === null) setTime(0);
                setPlaying(!playing);
              }
        }
        choose={(bar) => bar.p === state.policies.length - 1 && choose(bar.r)}
      />}
    </div>
  );
}

/** Draws the page into its document. */
export const start = (parts) => render(<Page {...parts} />, document.getElementById("app"));
