#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""Draws figures for papers from the CSV files of results."""

import argparse
import csv
import sys
from pathlib import Path
from statistics import median

try:
    import matplotlib
except ModuleNotFoundError:
    matplotlib = None

COLOURS = {"base": "#0072b2", "sep": "#009e73", "dead-reckoning": "#d98200"}
WORST = "worst"  # the task of limits.csv that stands for the worst of all
CRITERIA = {
    "vibration_mm": ("vibration above 20 Hz, mm", "log"),
    "stiffness_ratio": ("stiffness at 1 Hz, of that in one shared world", "linear"),
    "force_vibration_n": ("force vibration above 20 Hz, N", "log"),
}


def number(text):
    """The value of a cell; None where it is empty."""
    return float(text) if text else None


def distinct(rows, *keys):
    """What the rows have in these columns, in the order in which it comes."""
    return list(dict.fromkeys(tuple(row[key] for key in keys) for row in rows))


def having(rows, **values):
    return [row for row in rows if all(row[key] == value for key, value in values.items())]


def colour_of(name):
    return COLOURS.get(name, "#8a5aa8")


def unit_of(rows):
    return {"percent": "%", "of_100": "of 100"}.get(rows[0]["unit"], rows[0]["unit"])


def draw_table1(plot, rows):
    """Mean, standard deviation and largest distance of the copies, beside the paper."""
    figure, all_axes = plot.subplots(1, 3, figsize=(7.2, 2.6), layout="constrained")
    for axes, quantity in zip(all_axes, ["mean", "std", "max"]):
        for place, row in enumerate(rows):
            colour = colour_of(row["algorithm"])
            paper = number(row[f"paper_{quantity}_mm"])
            if paper is not None:
                axes.bar(place - 0.2, paper, 0.38, fill=False, edgecolor=colour, linestyle="--")
            axes.bar(place + 0.2, number(row[f"{quantity}_mm"]), 0.38, color=colour)
        axes.set_xticks(range(len(rows)), [row["algorithm"] for row in rows], rotation=20)
        axes.set_ylabel(f"{quantity}, mm")
    figure.suptitle("dashed: the paper; filled: this run", fontsize="small")
    yield "table1", figure


def draw_limits(plot, rows):
    """The limits of each impairment: the worst of the tasks, with 95 % intervals."""
    for (impairment,) in distinct(rows, "impairment"):
        worst = having(rows, impairment=impairment, task=WORST)
        if not worst:
            continue
        figure, axes = plot.subplots(figsize=(3.5, 2.6))
        for place, row in enumerate(worst):
            limit, colour = number(row["limit"]), colour_of(row["algorithm"])
            low, high = number(row["ci_low"]), number(row["ci_high"])
            paper = number(row["paper_limit"])
            if paper is not None:
                axes.bar(place - 0.2, paper, 0.38, fill=False, edgecolor=colour, linestyle="--")
            axes.bar(place + 0.2, limit, 0.38, color=colour)
            if low is not None and high is not None:
                ends = [[max(0.0, limit - low)], [max(0.0, high - limit)]]
                axes.errorbar(place + 0.2, limit, yerr=ends, color="black", capsize=3)
            if row["bound"] == ">":
                axes.annotate(f"> {limit:g}", (place + 0.2, limit), ha="center", va="bottom")
        axes.set_xticks(range(len(worst)), [row["algorithm"] for row in worst])
        axes.set_ylabel(f"limit of {impairment}, {unit_of(worst)}")
        yield f"limit-{impairment}", figure


def draw_curves(plot, rows):
    """What each criterion is at each level: a point for a seed, a line through the medians."""
    counted = having(rows, counts="true")
    for impairment, task in distinct(counted, "impairment", "task"):
        here = having(counted, impairment=impairment, task=task)
        for column, (name, scale) in CRITERIA.items():
            known = [row for row in here if row[column]]
            if not known:
                continue
            figure, axes = plot.subplots(figsize=(3.5, 2.6))
            for (algorithm,) in distinct(known, "algorithm"):
                levels = {}
                for row in having(known, algorithm=algorithm):
                    levels.setdefault(number(row["level"]), []).append(number(row[column]))
                levels = dict(sorted(levels.items()))
                colour = colour_of(algorithm)
                axes.plot(list(levels), [median(all) for all in levels.values()], color=colour,
                          label=algorithm)
                for level, values in levels.items():
                    axes.plot([level] * len(values), values, ".", color=colour, markersize=3)
            axes.set(xlabel=f"{impairment}, {unit_of(here)}", ylabel=name, yscale=scale, title=task)
            axes.legend(fontsize="x-small")
            yield f"curve-{impairment}-{task}-{column}", figure


def draw_trajectories(plot, rows):
    """Where each side has the cube, a panel for each algorithm."""
    names = [name for (name,) in distinct(rows, "algorithm")]
    figure, all_axes = plot.subplots(len(names), 1, figsize=(7.2, 1.9 * len(names)), sharex=True,
                                     sharey=True, squeeze=False, layout="constrained")
    for axes, name in zip(all_axes[:, 0], names):
        own = having(rows, algorithm=name)
        times = [number(row["time_s"]) for row in own]
        for side, colour in [("l", "#0072b2"), ("r", "#d98200")]:
            values = [number(row[f"cube_{side}_mm"]) for row in own]
            axes.plot(times, values, color=colour, linewidth=0.8, label=f"cube at {side.upper()}")
        axes.set(ylabel="x, mm", title=name)
    all_axes[0, 0].legend(fontsize="x-small", loc="upper right")
    all_axes[-1, 0].set_xlabel("time, s")
    yield "fig7", figure


def lines(plot, rows, of_curve, x, y, scale):
    """One figure of lines, a curve for each value of the columns `of_curve`."""
    figure, axes = plot.subplots(figsize=(5.0, 3.4))
    for values in distinct(rows, *of_curve):
        own = having(rows, **dict(zip(of_curve, values)))
        axes.plot([number(row[x]) for row in own], [number(row[y]) for row in own], marker=".",
                  label=" ".join(values))
    axes.set(xlabel=x, ylabel=y, xscale=scale, yscale=scale)
    axes.legend(fontsize="x-small")
    return figure


def draw_work(plot, rows):
    """What an accuracy costs in time, a figure for each scenario of a bench."""
    for (scenario,) in distinct(rows, "scenario"):
        own = having(rows, scenario=scenario)
        figure = lines(plot, own, ["subject"], "ns_per_simulated_ms", "error", "log")
        figure.axes[0].set(title=scenario, ylabel=own[0]["metric"])
        yield "work-" + "".join(c if c.isalnum() else "-" for c in scenario), figure


def draw_run_time(plot, rows):
    """Error of the figures of Table 1 against run time."""
    of_curve = ["task", "algorithm", "figure", "varied"]
    yield "run-time", lines(plot, rows, of_curve, "wall_s", "error_mm", "log")


def draw_lateness(plot, rows):
    """What share of the datagrams was at most so late."""
    yield "lateness", lines(plot, rows, ["subject"], "later_us", "share_percent", "linear")


# Painters are found by columns, because a file may have been renamed. The first match draws.
PAINTERS = [
    ({"algorithm", "mean_mm", "std_mm", "max_mm", "paper_mean_mm", "verdict"}, draw_table1),
    ({"algorithm", "impairment", "task", "limit", "bound", "paper_limit", "seeds"}, draw_limits),
    ({"algorithm", "impairment", "task", "level", "counts", *CRITERIA}, draw_curves),
    ({"algorithm", "time_s", "cube_l_mm", "cube_r_mm"}, draw_trajectories),
    ({"scenario", "metric", "subject", "error", "ns_per_simulated_ms"}, draw_work),
    ({"varied", "task", "algorithm", "figure", "wall_s", "error_mm"}, draw_run_time),
    ({"subject", "later_us", "share_percent"}, draw_lateness),
]
NOT_LIMITS = {"parameter", "filter_order"}  # repeat the limits for varied settings: not drawn


def painter_of(columns):
    if NOT_LIMITS & set(columns):
        return None
    return next((paint for wanted, paint in PAINTERS if wanted <= set(columns)), None)


def tables_in(path):
    """(file, rows, painter) of each CSV file that can be drawn: the path, or those in it."""
    files = [path] if path.is_file() else sorted(path.glob("*.csv")) + sorted(path.glob("*/*.csv"))
    for file in files:
        with open(file, newline="", encoding="utf-8") as text:
            reader = csv.DictReader(text)
            painter = painter_of(reader.fieldnames or [])
            rows = list(reader) if painter else []
        if rows:
            yield file, rows, painter


def parse(words):
    parser = argparse.ArgumentParser(
        prog="scripts/plot.py",
        description="Draws figures for papers with matplotlib: Table 1, the limits of Figs. 6a and "
        "6b, the curves behind them and the trajectories of Fig. 7 of a result folder, or what "
        "scripts/bench.sh --csv has measured. scripts/setup.sh --figures installs matplotlib.",
        epilog="Exits 0 when the figures are there, 1 when nothing in PATH can be drawn, 2 for a "
        "wrong argument, 3 without matplotlib.")
    parser.add_argument("path", metavar="PATH", type=Path,
                        help="a CSV file, or a folder with such files in it or one level below")
    parser.add_argument("--out", metavar="DIR", type=Path,
                        help="where the figures go (default: plots/ in the folder)")
    parser.add_argument("--format", choices=["pdf", "svg", "png"], default="pdf",
                        help="the kind of the files (default: pdf)")
    options = parser.parse_args(words)
    if not options.path.exists():
        parser.error(f"there is no {options.path}")
    return options


def main(words):
    options = parse(words)
    if matplotlib is None:
        print("plot: matplotlib is missing: scripts/setup.sh --figures installs it",
              file=sys.stderr)
        return 3
    matplotlib.use("agg")
    from matplotlib import pyplot
    folder = options.path if options.path.is_dir() else options.path.parent
    out = options.out or folder / "plots"
    drawn = {}
    for file, rows, painter in tables_in(options.path):
        for name, figure in painter(pyplot, rows):
            if name in drawn:
                print(f"plot: {file} would draw {name} again, as {drawn[name]} did: name one of "
                      "the two", file=sys.stderr)
                return 1
            drawn[name] = file
            out.mkdir(parents=True, exist_ok=True)
            path = out / f"{name}.{options.format}"
            # Without a date, the same numbers give the same file.
            dates = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}
            figure.savefig(path, bbox_inches="tight", metadata=dates[options.format])
            pyplot.close(figure)
            print(path)
    if not drawn:
        print(f"plot: nothing in {options.path} can be drawn: its CSV files have other columns",
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
