// Lanes over time: goals by resource, monitors, questions, pauses, readings; and the playhead.

import { useEffect, useRef, useState } from "preact/hooks";
import { secs, short } from "./parts.jsx";
import { WORDS } from "./words.js";

const LANE = 24;
const MOST_BARS = 1500;

/** A step of the time axis that a person reads: 1, 2 or 5 times a power of ten. */
function step(span, count) {
  const raw = span / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * ([1, 2, 5, 10].find((one) => one * power >= raw) ?? 10);
}

/** Bars and marks of a state, by lane. */
export function lanes(state) {
  const byName = new Map();
  const lane = (name) => byName.get(name) ?? byName.set(name, { name, bars: [], marks: [], line: null }).get(name);
  for (const one of state.goals.slice(-MOST_BARS)) {
    const names = one.uses.length ? one.uses : [WORDS.lane.none];
    for (const name of names) lane(name).bars.push({ from: one.from, to: one.to, is: one.how ?? "running", label: one.label, why: one.why, p: one.p, r: one.r });
  }
  for (const one of state.fired) {
    lane(WORDS.lane.monitors).marks.push({ at: one.at, label: `${WORDS.fired}: ${state.policies[one.p]?.rows[one.r]?.watches?.[one.w]?.text ?? ""}`, p: one.p, r: one.r });
  }
  for (const one of state.questions) lane(WORDS.lane.questions).bars.push({ from: one.from, to: one.to, is: one.to === null ? "waits" : "asked", label: one.text, why: one.answer });
  for (const one of state.holds) lane(WORDS.lane.held).bars.push({ from: one.from, to: one.to, is: "held", label: WORDS.held });
  for (const [q, points] of Object.entries(state.series).slice(0, 4)) if (points.length > 1) lane(q).line = points;
  return [...byName.values()];
}

export function Lanes({ log, live, time, setTime, isLive, playing, play, choose }) {
  const box = useRef(null);
  const [wide, setWide] = useState(800);
  const [bar, setBar] = useState(0);
  useEffect(() => {
    const observer = new ResizeObserver(() => {
      setWide(box.current?.clientWidth ?? 800);
      setBar((box.current?.offsetWidth ?? 0) - (box.current?.clientWidth ?? 0));
    });
    observer.observe(box.current);
    return () => observer.disconnect();
  }, []);
  const end = Math.max(log.end, 1);
  const list = lanes(live);
  const LEFT = wide < 700 ? 100 : 168;
  const room = Math.max(wide - LEFT - 14, 100);
  const x = (at) => LEFT + (Math.min(at, end) / end) * room;
  const high = list.length * LANE + 22;
  const each = step(end, Math.max(2, Math.floor(room / 90)));
  const ticks = Array.from({ length: Math.floor(end / each) + 1 }, (_, i) => i * each);
  const scrub = (event) => {
    const { left } = box.current.getBoundingClientRect();
    const at = ((event.clientX - left - LEFT) / room) * end;
    setTime(Math.min(Math.max(at, 0), end));
  };
  const now = time ?? end;
  return (
    <section class="lanes" aria-label={WORDS.lanes}>
      <div class="scrub" style={{ gridTemplateColumns: `${LEFT - 18}px 1fr`, paddingRight: `${6 + bar}px` }}>
        <div class="moment">
          <output>{secs(now)}</output>
        {isLive ? (
          <button class={time === null ? "small on" : "small"} aria-pressed={time === null} onClick={() => setTime(null)}>
            {time === null ? WORDS.live : WORDS.now}
          </button>
        ) : (
          <span class="keys">
            <button class="small" disabled={!play || live.policies.length === 0} title={playing ? WORDS.halt : WORDS.play} aria-label={playing ? WORDS.halt : WORDS.play} onClick={play}>
              {playing ? "❚❚" : "▶"}
            </button>
            <button class="small" disabled={time === null} title={WORDS.end} aria-label={WORDS.end} onClick={() => setTime(null)}>
              ▶❙
            </button>
          </span>
        )}
        </div>
        <input
          type="range"
          aria-label={WORDS.playhead}
          aria-valuetext={secs(now)}
          min="0"
          max={end}
          step={end / 1000}
          value={now}
          onInput={(event) => setTime(Number(event.currentTarget.value))}
        />
      </div>
      <div class="chart" ref={box}>
        <svg
          width={wide}
          height={high}
          role="img"
          aria-label={WORDS.lanes}
          onPointerDown={(event) => {
            if (event.clientX - box.current.getBoundingClientRect().left < LEFT) return;
            event.currentTarget.setPointerCapture(event.pointerId);
            scrub(event);
          }}
          onPointerMove={(event) => event.buttons === 1 && event.currentTarget.hasPointerCapture(event.pointerId) && scrub(event)}
        >
          {ticks.map((at) => (
            <g key={at}>
              <line class="tick" x1={x(at)} x2={x(at)} y1="0" y2={high - 18} />
              <text class="time" x={x(at)} y={high - 5} text-anchor={at === 0 ? "start" : x(at) > wide - 50 ? "end" : "middle"}>
                {secs(at).replace(".0 s", " s")}
              </text>
            </g>
          ))}
          {live.swaps.map((swap) => (
            <line key={swap.to} class="swapline" x1={x(swap.at)} x2={x(swap.at)} y1="0" y2={high - 18}>
              <title>{WORDS.swap(live.policies[swap.from].policy, live.policies[swap.to].policy)}</title>
            </line>
          ))}
          {list.map((lane, k) => (
            <g key={lane.name} transform={`translate(0 ${k * LANE})`}>
              <text class="name" x="6" y="16">
                {lane.name.length > LEFT / 7.2 ? `${lane.name.slice(0, Math.floor(LEFT / 7.2) - 1)}…` : lane.name}
              </text>
              {lane.bars.map((bar, i) => {
                const [from, to] = [x(bar.from), x(bar.to ?? end)];
                return (
                  <g key={i} class={`bar ${bar.is}`} onClick={() => bar.r !== undefined && choose(bar)}>
                    <title>
                      {bar.label} · {secs(bar.from)} – {bar.to === null ? "…" : secs(bar.to)}
                      {bar.why ? ` · ${bar.why}` : ""}
                    </title>
                    <rect x={from} y="3" width={Math.max(to - from, 3)} height={LANE - 6} rx="3" />
                    {to - from > 46 && (
                      <text x={from + 5} y="16">
                        {bar.label.slice(0, Math.floor((to - from - 8) / 6.6))}
                      </text>
                    )}
                  </g>
                );
              })}
              {lane.marks.map((mark, i) => (
                <g key={i} class="mark" onClick={() => choose(mark)}>
                  <title>
                    {secs(mark.at)} · {mark.label}
                  </title>
                  <path d={`M ${x(mark.at)} 4 l 6 8 l -6 8 l -6 -8 z`} />
                </g>
              ))}
              {lane.line && <Curve points={lane.line} x={x} />}
            </g>
          ))}
          <line class="playhead" x1={x(now)} x2={x(now)} y1="0" y2={high - 16} />
        </svg>
      </div>
    </section>
  );
}

function Curve({ points, x }) {
  const values = points.map(([, value]) => value);
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const y = (value) => LANE - 5 - ((value - least) / (most - least || 1)) * (LANE - 10);
  return (
    <g class="curve">
      <title>
        {short(least)} – {short(most)}
      </title>
      <polyline points={points.map(([at, value]) => `${x(at).toFixed(1)},${y(value).toFixed(1)}`).join(" ")} />
    </g>
  );
}
