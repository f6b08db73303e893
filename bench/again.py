"""The default case run again after a change of the cutting data: what the first run kept must not be computed twice."""

import json
import pathlib
import statistics
import sys
import tempfile

import fem
import processes

CASE = fem.ROOT / "cases" / "barrios-2019"
PROGRAM = fem.ROOT / "build" / "release" / "app" / "thinwall"


def add_command(commands):
    parser = commands.add_parser("again", description=__doc__, help="the default case again after a change of the cut")
    parser.add_argument("--repeat", type=fem.positive(int), default=9, metavar="N", help="runs, each with another Kt (9)")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.set_defaults(run=run)


def timed(folder, *words):
    finished = processes.run([PROGRAM, "run", CASE, "--out", folder / "out", "-q", *words], 600.0, folder,
                             processes.environment())
    if finished.failure:
        sys.exit(f"bench/run again: {finished.failure}")
    return finished


def run(arguments):
    if not PROGRAM.exists():
        sys.exit("bench/run again: the program is not built; call ./thinwall --version first")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        first = timed(folder)
        again = [timed(folder, "--set", f"cutting.Kt={2230 + 10 * i} N/mm^2") for i in range(arguments.repeat)]
        summary = json.loads((folder / "out" / "summary.json").read_text())
        size = (folder / "out" / "report.html").stat().st_size
    figures = {
        "first_wall_s": first.wall_s,
        "again_wall_s": statistics.median(r.wall_s for r in again),
        "again_best_wall_s": min(r.wall_s for r in again),
        "again_cpu_s": statistics.median(r.cpu_s for r in again),
        "last_timings_s": summary["timings_s"],
        "report_bytes": size,
    }
    print(f"first run                        {figures['first_wall_s']:6.2f} s")
    print(f"again, another Kt (median of {arguments.repeat})  {figures['again_wall_s']:6.2f} s   best {figures['again_best_wall_s']:.2f} s"
          f"   processor {figures['again_cpu_s']:.2f} s")
    print("  " + "  ".join(f"{stage} {seconds:.3f}" for stage, seconds in summary["timings_s"].items()))
    print(f"report.html                      {size / 1e6:6.2f} MB")
    if arguments.out:
        arguments.out.write_text(json.dumps(figures, indent=2) + "\n")
    return 0
