# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The figure of a study as SVG: the answers and the fitted curves, and below them a row for each
participant with the threshold and its interval, and one with the mean."""

from __future__ import annotations

from typing import Any, Callable, Sequence
from xml.sax.saxutils import escape

from hapnet.study.psychometric import Curve

WIDTH, LEFT, RIGHT = 640, 64, 28
TOP, BOTTOM = 40, 364  # of the curves
ROWS_TOP, AXIS = 376, 50  # where the rows begin; height of the axis below them
ROW, ROWS_MAX = 14.0, 320.0  # height of a row, and of all of them
COLOURS = ("#0072b2", "#d98200", "#009e73", "#8a5aa8", "#b03a2e", "#566573")
MEAN_COLOUR = "#222"
POINTS = 120
TITLE_MAX = 72  # letters that fit
SPREAD = 16.0  # px, by which the dots of all participants at a level lie apart at most


def svg(result: dict[str, Any], levels: tuple[float, float], share: str) -> str:
    """`result`: as analyse.analysed() makes it. `levels`: the range of x. `share`: what y is."""
    low, high = levels
    rows, at, title = result["participants"], result["at"], result["title"]
    each = min(ROW, ROWS_MAX / (len(rows) + 1))
    bottom = ROWS_TOP + each * (len(rows) + 1) + 4
    height = round(bottom + AXIS)

    def x(level: float) -> float:
        return LEFT + (min(max(level, low), high) - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    short = title if len(title) <= TITLE_MAX else title[:TITLE_MAX - 1] + "…"
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        f'width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="12">',
        f"<title>{escape(title)}</title>",
        f'<rect width="{WIDTH}" height="{height}" fill="white"/>',
        f'<text x="{LEFT}" y="24" font-size="15">{escape(short)}</text>',
        *_axes(levels, x, bottom, at),
    ]
    for i, row in enumerate(rows):
        aside = (i - (len(rows) - 1) / 2) * min(5.0, SPREAD / len(rows))
        parts += [f'<g stroke="{_colour(i)}" fill="{_colour(i)}">',
                  f'<title>participant {row["participant"]}</title>',
                  *_answers(row, levels, x, aside), "</g>"]
    names = [str(row["participant"]) for row in rows] + ["mean"]
    for i, row in enumerate([*rows, {"bound": "=", **result["all"]}]):
        colour = _colour(i) if i < len(rows) else MEAN_COLOUR
        place = ROWS_TOP + each * (i + 0.5)
        # Where rows are lower than letters, the mean alone is named.
        name = names[i] if each >= 10.0 or i == len(rows) else ""
        parts += _threshold(row, name, colour, levels, x, place)
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{height - 12}" text-anchor="middle">'
                 f'{escape(result["factor"])}, {escape(result["unit"])}</text>'
                 f'<text transform="translate(16 {(BOTTOM + TOP) / 2}) rotate(-90)" '
                 f'text-anchor="middle">{escape(share)}</text></svg>\n')
    return "\n".join(parts)


def _colour(i: int) -> str:
    return COLOURS[i % len(COLOURS)]


def _y(part: float) -> float:
    return BOTTOM - part * (BOTTOM - TOP)


def _axes(levels: tuple[float, float], x: Callable[[float], float], bottom: float,
          at: float) -> list[str]:
    low, high = levels
    parts = []
    for i in range(5):
        part, level = i / 4, low + i / 4 * (high - low)
        parts.append(f'<path d="M{LEFT} {_y(part):.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                     f'<path d="M{x(level):.1f} {TOP}V{bottom:.1f}" stroke="#eee"/>'
                     f'<text x="{LEFT - 14}" y="{_y(part) + 4:.1f}" text-anchor="end">'
                     f"{part:.2f}</text>"
                     f'<text x="{x(level):.1f}" y="{bottom + 16:.1f}" text-anchor="middle">'
                     f"{level:.4g}</text>")
    parts.append(f'<path d="M{LEFT} {_y(at):.1f}H{WIDTH - RIGHT}" stroke="#777" '
                 'stroke-dasharray="4 4"/>')
    return parts


def _answers(row: dict[str, Any], levels: tuple[float, float], x: Callable[[float], float],
             aside: float) -> list[str]:
    """A participant's answers, as dots whose area grows with their number, and the curve."""
    parts = []
    for count in row["levels"]:
        radius = 1.5 + 0.6 * min(count["of"], 40) ** 0.5
        parts.append(f'<circle cx="{x(count["level"]) + aside:.1f}" '
                     f'cy="{_y(count["noticed"] / count["of"]):.1f}" r="{radius:.1f}"'
                     ' fill-opacity="0.4" stroke="none"/>')
    curve = row["curve"]
    if curve is not None:
        fitted = Curve(curve["location"], curve["scale"], curve["early"], curve["late"],
                       curve["core"])
        low, high = levels
        places = [low + i / POINTS * (high - low) for i in range(POINTS + 1)]
        line = " ".join(f"{x(one):.1f},{_y(fitted.share_at(one)):.1f}" for one in places)
        parts.append(f'<polyline points="{line}" fill="none" stroke-width="1.2"/>')
    return parts


def _threshold(row: dict[str, Any], name: str, colour: str, levels: Sequence[float],
               x: Callable[[float], float], place: float) -> list[str]:
    """A row: the name, the interval, and the threshold as a dot. Where the threshold lies beyond
    the levels, an arrow at their end stands for it."""
    parts = [f'<g stroke="{colour}" fill="{colour}">']
    if name:
        parts.append(f'<text x="{LEFT - 14}" y="{place + 4:.1f}" font-size="10" stroke="none" '
                     f'text-anchor="end">{name}</text>')
    if row["threshold"] is not None:
        ends = row["ci_low"], row["ci_high"]
        if row["bound"] != "=" or ends != (None, None):
            begin, end = (x(levels[i] if one is None else one) for i, one in enumerate(ends))
            parts.append(f'<path d="M{begin:.1f} {place:.1f}H{end:.1f}" stroke-width="2" '
                         'stroke-opacity="0.5"/>')
        middle = x(row["threshold"])
        if row["bound"] == "=":
            parts.append(f'<circle cx="{middle:.1f}" cy="{place:.1f}" r="2.5"/>')
        else:
            tip = 7 if row["bound"] == ">" else -7
            parts.append(f'<path d="M{middle:.1f} {place - 4:.1f}l{tip} 4l{-tip} 4z"/>')
    return [*parts, "</g>"]
