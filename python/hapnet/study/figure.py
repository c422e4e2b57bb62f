# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The figure of a study as SVG: the answers, the fitted curves, the thresholds."""

from __future__ import annotations

from typing import Any, Sequence
from xml.sax.saxutils import escape

from hapnet.study.psychometric import Curve

WIDTH, HEIGHT = 640, 420
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 40, 56
COLOURS = ("#0072b2", "#d98200", "#009e73", "#8a5aa8", "#b03a2e", "#566573")
POINTS = 120


def svg(title: str, factor: str, unit: str, rows: Sequence[dict[str, Any]],
        levels: tuple[float, float], at: float, share: str) -> str:
    """`rows`: as in analyse.Result.rows, of one participant each. `levels`: the range of x.
    `share`: what y is."""
    low, high = levels

    def x(level: float) -> float:
        return LEFT + (level - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(part: float) -> float:
        return HEIGHT - BOTTOM - part * (HEIGHT - TOP - BOTTOM)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
        f"<title>{escape(title)}</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<text x="{LEFT}" y="24" font-size="15">{escape(title)}</text>',
    ]
    for i in range(5):
        part, level = i / 4, low + i / 4 * (high - low)
        parts.append(f'<path d="M{LEFT} {y(part):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                     f'<text x="{LEFT - 8}" y="{y(part) + 4:.1f}" text-anchor="end">'
                     f"{part:.2f}</text>"
                     f'<text x="{x(level):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">'
                     f"{level:g}</text>")
    parts.append(f'<path d="M{LEFT} {y(at):.1f}H{WIDTH - RIGHT}" stroke="#777" '
                 'stroke-dasharray="4 4"/>')
    for i, row in enumerate(rows):
        parts += _one(row, COLOURS[i % len(COLOURS)], low, high, x, y, at)
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 16}" text-anchor="middle">'
                 f"{escape(factor)}, {escape(unit)}</text>"
                 f'<text transform="translate(16 {(HEIGHT - BOTTOM + TOP) / 2}) rotate(-90)" '
                 f'text-anchor="middle">{escape(share)}</text></svg>\n')
    return "\n".join(parts)


def _one(row: dict[str, Any], colour: str, low: float, high: float, x: Any, y: Any,
         at: float) -> list[str]:
    """A participant: answers as dots as large as their number, the curve, the threshold with its
    interval."""
    parts = [f'<g stroke="{colour}" fill="{colour}">',
             f'<title>participant {row["participant"]}</title>']
    for count in row["levels"]:
        radius = 1.5 + min(count["of"], 40) ** 0.5
        place = x(count["level"]), y(count["noticed"] / count["of"])
        parts.append(f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="{radius:.1f}"'
                     ' fill-opacity="0.25" stroke="none"/>')
    curve = row["curve"]
    if curve is not None:
        fitted = Curve(curve["location"], curve["scale"], curve["early"], curve["late"],
                       curve["core"])
        places = [low + i / POINTS * (high - low) for i in range(POINTS + 1)]
        line = " ".join(f"{x(one):.1f},{y(fitted.share_at(one)):.1f}" for one in places)
        parts.append(f'<polyline points="{line}" fill="none" stroke-width="1.2"/>')
    if row["threshold"] is not None and row["bound"] == "=":
        ends = [low if row["ci_low"] is None else row["ci_low"],
                high if row["ci_high"] is None else row["ci_high"]]
        begin, end = x(max(low, ends[0])), x(min(high, ends[1]))
        parts.append(f'<path d="M{begin:.1f} {y(at):.1f}H{end:.1f}"'
                     ' stroke-width="3" stroke-opacity="0.45"/>'
                     f'<circle cx="{x(row["threshold"]):.1f}" cy="{y(at):.1f}" r="3"/>')
    parts.append("</g>")
    return parts
