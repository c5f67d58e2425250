"""Drawings for notebooks, as SVG."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

__all__ = ["Bar", "lanes", "outline"]

#: Height of a row and width of a letter, in pixels.
ROW, LETTER = 22.0, 7.2
#: Colours for all kinds of colour vision (Okabe and Ito 2008).
COLOURS = {"done": "#009E73", "failed": "#D55E00", "interrupted": "#E69F00", "running": "#0072B2"}


@dataclass(frozen=True)
class Bar:
    """A span of time in a lane, in s, with a label and an ending: a key of `COLOURS`."""

    lane: str
    start: float
    end: float
    label: str
    ending: str


def outline(tree: str) -> str:
    """An indented text as boxes, each joined to the one that it stands under."""
    rows = [line for line in tree.splitlines() if line.strip()]
    depths = [len(line) - len(line.lstrip()) for line in rows]
    parts: list[str] = []
    above: list[tuple[int, float]] = []
    widest = 0.0
    for at, (line, depth) in enumerate(zip(rows, depths)):
        x, y, label = 8 + depth * 9.0, 6 + at * ROW, line.strip()
        width = len(label) * LETTER + 12
        widest = max(widest, x + width)
        while above and above[-1][0] >= depth:
            above.pop()
        if above:
            over = 8 + above[-1][0] * 9.0 + 6
            parts.append(f'<path d="M{over:.1f},{above[-1][1] + ROW - 4:.1f}V{y + 9:.1f}H{x:.1f}"/>')
        above.append((depth, y))
        parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{ROW - 4}" rx="4"/>')
        parts.append(f'<text x="{x + 6:.1f}" y="{y + 13:.1f}">{escape(label)}</text>')
    return _svg(widest + 8, len(rows) * ROW + 12, parts)


def lanes(bars: Sequence[Bar], until: float) -> str:
    """Bars over a common axis of time from 0 to `until`, in s; lanes in the order of their first bars."""
    names = list(dict.fromkeys(bar.lane for bar in bars))
    left = 16 + max((len(name) for name in names), default=0) * LETTER
    scale = 640.0 / max(until, 1e-9)
    parts = [f'<path d="M{left:.1f},{len(names) * ROW + 8:.1f}h640"/>']
    for at, name in enumerate(names):
        parts.append(f'<text x="8" y="{at * ROW + 20:.1f}">{escape(name)}</text>')
    for bar in bars:
        x, y = left + bar.start * scale, names.index(bar.lane) * ROW + 6
        width = max((bar.end - bar.start) * scale, 2.0)
        tip = f"{bar.label}: {bar.ending}, {bar.start:.2f} s to {bar.end:.2f} s"
        parts.append(
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{ROW - 4}" rx="3" style="fill:'
            f'{COLOURS[bar.ending]}"><title>{escape(tip)}</title></rect>'
        )
    for share in (0.0, 0.5, 1.0):
        x, y = left + 640 * share, len(names) * ROW + 22
        parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="middle">{until * share:.1f} s</text>')
    return _svg(left + 680, len(names) * ROW + 32, parts)


def _svg(width: float, height: float, parts: Iterable[str]) -> str:
    style = "rect{fill:#eef2f7;stroke:#8a93a3}path{fill:none;stroke:#8a93a3}text{font:12px ui-monospace,monospace}"
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}><style>{style}</style>{"".join(parts)}</svg>'
