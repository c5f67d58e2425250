// The page: gathers items, keeps the moment that is shown and the chosen step, and draws the regions.

import { render } from "preact";
import { useEffect, useState } from "preact/hooks";
import { Head, Questions } from "./controls.jsx";
import { Known, StepDetails, Talk } from "./details.jsx";
import { GraphView } from "./graph.jsx";
import { Lanes } from "./lanes.jsx";
import { connect } from "./link.js";
import { Outline } from "./outline.jsx";
import { Changes, PolicyText } from "./policy.jsx";
import { SceneView } from "./scene.jsx";
import { Log, current } from "./state.js";
import { Tabs } from "./parts.jsx";
import { WORDS } from "./words.js";

const log = new Log();
const MAIN = { steps: WORDS.steps, graph: WORDS.graph, text: WORDS.text, changes: WORDS.changes };
const SIDE = { scene: WORDS.scene, step: WORDS.step, known: WORDS.known, talk: WORDS.talk };
const NARROW = matchMedia("(max-width: 60rem)");

function Page() {
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
    steps: () => <Outline state={state} now={time ?? log.end} chosen={safe} choose={choose} closed={closed} toggle={toggle} follow={follow} setFollow={setFollow} />,
    graph: () => <GraphView state={state} chosen={safe} choose={choose} closed={closed} toggle={toggle} />,
    text: () => <PolicyText state={state} chosen={safe} choose={choose} />,
    changes: () => <Changes state={state} />,
    scene: () => <SceneView log={log} state={state} time={time} chosen={safe} tick={tick} />,
    step: () => <StepDetails state={state} chosen={safe} showLine={() => (narrow ? setOnly("text") : setMain("text"))} />,
    known: () => <Known log={log} state={state} time={time} />,
    talk: () => <Talk state={state} />,
  };
  const panel = (key) => (
    <div class="panel" role="tabpanel" id={`panel-${key}`} aria-labelledby={`tab-${key}`}>
      {regions[key]()}
    </div>
  );
  return (
    <div class={`page ${time === null ? "" : "pasttime"}`}>
      <Head state={state} live={log.live} link={link} time={time} />
      <Questions state={state} live={log.live} link={link} world={log.world} />
      {narrow ? (
        <main class="one">
          <Tabs name="Motet" tabs={{ ...MAIN, ...SIDE }} is={only} set={setOnly} />
          {panel(only)}
        </main>
      ) : (
        <main class="two">
          <section>
            <Tabs name={WORDS.steps} tabs={MAIN} is={main} set={setMain} />
            {panel(main)}
          </section>
          <section>
            <Tabs name={WORDS.scene} tabs={SIDE} is={side} set={setSide} />
            {panel(side)}
          </section>
        </main>
      )}
      <Lanes
        log={log}
        live={log.live}
        time={time}
        setTime={setTime}
        choose={(bar) => bar.p === state.policies.length - 1 && choose(bar.r)}
      />
    </div>
  );
}

render(<Page />, document.getElementById("app"));
