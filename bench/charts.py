"""The drawn line of charts against the boundary between their points: rows of their own at speeds that no chart knows."""

import bisect
import csv
import json
import math
import pathlib
import random
import sys
import tempfile

import fem
import processes

PROGRAM = fem.ROOT / "build" / "release" / "app" / "thinwall"
QUICK = "part.mesh.tolerance=0.05"
MORE = "lobes.most_added=600"
CASES = (  # a shipped case and what is set in it
    ("ding-2010", ()),
    ("ding-2010", ("cutting.radial_depth=5 mm",)),
    ("ding-2010", ("cutting.mode=up", "lobes.count=20", MORE)),
    ("ding-2010", ("tool.teeth=3", "lobes.count=40", MORE)),
    ("ding-2010", ("lobes.from=1000 rpm", "lobes.to=8000 rpm", "lobes.count=30", MORE)),
    ("barrios-2019", ()),
    ("barrios-2019", ("cutting.radial_depth=2 mm", QUICK)),
    ("barrios-2019", ("tool.teeth=2", QUICK)),
    ("barrios-2019", ("lobes.from=3000 rpm", "lobes.to=9000 rpm", QUICK, MORE)),
    ("barrios-2019", ("lobes.count=12", QUICK, MORE)),
    ("cantilever-wall", (QUICK,)),
    ("cantilever-wall", (QUICK, "lobes.count=25", MORE)),
    ("cantilever-wall", (QUICK, "part.thickness=3 mm", "lobes.count=60", MORE)),
    ("cantilever-wall", (QUICK, "cutting.mode=up", "lobes.count=60", MORE)),
    ("huynh-2017", ()),
    ("pocketed-rib", ("part.mesh.tolerance=0.1", "lobes.count=100", MORE)),
    ("tool-swap", ()),
    ("tool-swap", ("lobes.tolerance=0.03", MORE)),
    ("wall-path", (QUICK,)),
)


def add_command(commands):
    parser = commands.add_parser("charts", description=__doc__, help="drawn lines against the boundary between their points")
    parser.add_argument("--points", type=fem.positive(int), default=60, metavar="N", help="speeds looked at a chart (60)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the speeds (1)")
    parser.add_argument("--only", default="", metavar="NAMES", help="cases, with commas between; all of them otherwise")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.set_defaults(run=run)


def started(case, out, settings):
    words = [PROGRAM, "run", fem.ROOT / "cases" / case, "--out", out, "-q"]
    words += [word for setting in settings for word in ("--set", setting)]
    done = processes.run(words, 1800.0, out.parent, processes.environment())
    if done.failure and not (out / "summary.json").exists():
        sys.exit(f"bench/run charts: {case} with {', '.join(settings) or 'nothing set'}: {done.failure}")
    return json.loads((out / "summary.json").read_text())["lobes"]


def rows(out, chart):
    """Speeds in rpm, depths in m and the relative error estimates of the rows."""
    with open(out / "lobes" / f"{chart['name']}.csv", encoding="utf-8") as file:
        table = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [[float(row[name]) for row in table]
            for name in ("spindle_speed_rpm", "limiting_depth_m", "error_estimate_relative")]


def line_at(speeds, depths, speed):
    i = min(max(bisect.bisect_right(speeds, speed), 1), len(speeds) - 1)
    share = (speed - speeds[i - 1]) / (speeds[i] - speeds[i - 1])
    return depths[i - 1] + share * (depths[i] - depths[i - 1])


def errors_of(chart, first, second):
    """Of the line at each further speed, less what the row there may itself be off by, relative to the depth there."""
    speeds, depths, _ = rows(first, chart)
    found = []
    for speed, depth, error in zip(*rows(second, chart)):
        if math.isfinite(depth) and depth > 0.0:
            found.append((max(0.0, abs(line_at(speeds, depths, speed) / depth - 1.0) - error), speed))
    return found


def looked_at(case, settings, folder, arguments):
    """Of each chart of a case: what it states, the largest error between its points, where, and how many miss the bar."""
    first, second = folder / "first", folder / "second"
    charts = started(case, first, settings)
    speeds = [speed for chart in charts for speed in rows(first, chart)[0]]
    draw = random.Random(arguments.seed)
    low, high = min(speeds), max(speeds)
    step = (high - low) / arguments.points
    # Two ends inside the range, so that the even speeds between them are none of the chart's.
    ends = (low + draw.random() * step, high - draw.random() * step)
    dense = [f"lobes.from={ends[0]!r} rpm", f"lobes.to={ends[1]!r} rpm", f"lobes.count={arguments.points}",
             "lobes.most_added=0"]
    kept = [setting for setting in settings if not setting.startswith(("lobes.from", "lobes.to", "lobes.count", "lobes.most"))]
    started(case, second, [*kept, *dense])
    for chart in charts:
        found = errors_of(chart, first, second)
        line = chart["line"]
        stated = line["tolerance"]
        if not line["met"]:  # null: the points do not tell
            stated = math.inf if line["error_estimate_relative"] is None else line["error_estimate_relative"]
        bar = stated + 0.01
        worst, speed = max(found, default=(0.0, 0.0))
        yield {"case": case, "set": list(settings), "chart": chart["name"], "speeds": len(rows(first, chart)[0]),
               "stated": stated if math.isfinite(stated) else None, "worst": worst, "at_rpm": speed, "points": len(found),
               "beyond": sum(error > bar for error, _ in found)}


def percent(stated):
    return "no error" if stated is None else f"{100 * stated:.2g} %"


def run(arguments):
    if not PROGRAM.exists():
        sys.exit("bench/run charts: the program is not built; call ./thinwall --version first")
    wanted = [name for name in arguments.only.split(",") if name]
    table = []
    for case, settings in CASES:
        if wanted and case not in wanted:
            continue
        with tempfile.TemporaryDirectory() as name:
            for row in looked_at(case, settings, pathlib.Path(name), arguments):
                table.append(row)
                print(f"{row['case']:22s} {row['chart']:12s} {row['speeds']:4d} speeds, states {percent(row['stated'])}, "
                      f"worst {100 * row['worst']:.3g} % at {row['at_rpm']:.0f} rpm, {row['beyond']} of {row['points']} beyond"
                      f"   {' '.join(settings)}", flush=True)
    within = sum(row["beyond"] == 0 for row in table)
    print(f"{within} of {len(table)} charts are within what they state and 1 % of the depth at all speeds looked at")
    if arguments.out:
        arguments.out.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    return 0 if within == len(table) else 1
