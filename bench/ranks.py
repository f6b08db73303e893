"""Factor and ten modes of plates of order 2 by one process on two threads, and by one and two ranks of one thread."""

import json
import pathlib
import tempfile

import fem
import processes

WIDTHS_M = {"110k": 0.064, "250k": 0.146, "430k": 0.25, "500k": 0.292, "1M": 0.6, "2M": 1.18, "3M": 1.8}
ENGINES = {  # ranks, threads, factor on disk
    "one process, 2 threads": (0, 2, 0),
    "1 rank": (1, 1, 0),
    "2 ranks": (2, 2, 0),
    "2 ranks, on disk": (2, 2, 1),
}


def add_command(commands):
    parser = commands.add_parser("ranks", description=__doc__, help="--ranks and --low-memory beside one process")
    parser.add_argument("--sizes", type=fem.names_of(WIDTHS_M), default=["110k", "430k"], metavar="LIST",
                        help=f"of {','.join(WIDTHS_M)} (110k,430k)")
    parser.add_argument("--time-limit", type=fem.positive(float), default=3600.0, metavar="S", help="of a run (3600 s)")
    parser.add_argument("--build", type=pathlib.Path, default=fem.ROOT / "build" / "bench", metavar="DIR")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.set_defaults(run=run)


def row(programs, folder, size, engine, settings):
    """One run, as what the program prints and the times of all its processes; or with "failure"."""
    words = [programs / "bench_ranks", WIDTHS_M[size], *ENGINES[engine]]
    environment = processes.environment(THINWALL_MPI=programs.parent / "app" / "thinwall-mpi")
    done = processes.run(words, settings.time_limit, folder, environment)
    found = {"size": size, "engine": engine, "wall_s": done.wall_s, "cpu_s": done.cpu_s}
    return {**found, "failure": done.failure} if done.failure else {**found, **json.loads(done.last_line)}


def show(found):
    """A line of the table."""
    begin = f"{found['size']:>5} {found['engine']:<24}"
    if "failure" in found:
        print(begin + found["failure"], flush=True)
        return
    memory = "".join(f"{found[key] / 1e9:9.2f}" if key in found else f"{'-':>9}"
                     for key in ("rank_forecast_bytes", "rank_peak_bytes", "own_peak_bytes"))
    print(f"{begin}{found['dofs']:>9}{found['factor_s']:9.1f}{found['eigen_s']:9.1f}{found['wall_s']:9.1f}"
          f"{found['cpu_s']:9.1f}{memory}{found['worst_residual']:10.1e}", flush=True)


def run(settings):
    programs = fem.build(settings.build.resolve(), "bench_ranks")
    print(f"{'size':>5} {'engine':<24}{'DOFs':>9}{'factor s':>9}{'eigen s':>9}{'wall s':>9}{'CPU s':>9}"
          f"{'said GB':>9}{'rank GB':>9}{'own GB':>9}{'residual':>10}")
    rows = []
    with tempfile.TemporaryDirectory(prefix="thinwall-bench-") as folder:
        for size in settings.sizes:
            for engine in ENGINES:
                rows.append(row(programs, folder, size, engine, settings))
                show(rows[-1])
                if settings.out:
                    fem.write_json(settings.out, {"bench": "ranks", "machine": processes.machine(), "runs": rows})
    return 1 if any("failure" in found for found in rows) else 0
