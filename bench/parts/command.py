"""bench/run parts: the program on parts from files that nobody here made fit, with a table and a page."""

import pathlib
import re
import tempfile

import fem
import peers
import processes

from parts import outcomes, page, sweep


def add_command(commands):
    parser = commands.add_parser("parts", description=__doc__, help="outcome, seconds and memory for parts from files")
    parser.add_argument("--folder", type=pathlib.Path, metavar="DIR", help="surfaces, STEP files and meshes to run")
    parser.add_argument("--make", type=pathlib.Path, metavar="DIR",
                        help="make the scripted parts that are missing in DIR and run them (takes Gmsh)")
    parser.add_argument("--variants", default="", metavar="LIST", help="of the parts that are made; all if not given")
    parser.add_argument("--only", type=re.compile, default=re.compile(""), metavar="PATTERN",
                        help="in the files' names")
    parser.add_argument("--no-runs", action="store_true", help="only make the parts")
    parser.add_argument("--time", type=fem.positive(float), default=30.0, metavar="S", help="of one run, seconds (30)")
    parser.add_argument("--processor-time", type=fem.positive(float), metavar="S",
                        help="of all processes of one run, seconds (the time on all threads); on a busy machine give "
                             "this and a longer --time")
    parser.add_argument("--memory", type=fem.positive(float), default=6.0, metavar="GB", help="of one run (6)")
    parser.add_argument("--threads", type=fem.positive(int), default=2, metavar="N")
    parser.add_argument("--tolerance", type=fem.positive(float), default=0.01, metavar="X",
                        help="part.mesh.tolerance (0.01)")
    parser.add_argument("--time-budget", type=fem.positive(float), metavar="S",
                        help="part.mesh.time_budget (the program's own); on a busy machine give more, for it is wall time")
    parser.add_argument("--unit", default="mm", metavar="UNIT",
                        help="of files that do not tell it (mm); NAME.inch.ENDING is in inches")
    parser.add_argument("--reference", type=pathlib.Path, metavar="DIR",
                        help="compare with CalculiX on ten-node tetrahedra by Gmsh; what was computed is kept in DIR")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE.json", help="write all figures as JSON")
    parser.add_argument("--page", type=pathlib.Path, metavar="FILE.html", help="write the table as a page")
    parser.add_argument("--program", type=pathlib.Path, default=sweep.PROGRAM, metavar="FILE", help="thinwall itself")
    parser.add_argument("--work", type=pathlib.Path, metavar="DIR", help="keep cases and results here")
    parser.set_defaults(run=run)


def require_peers(settings):
    """Ends with the package that is missing for what was asked."""
    try:
        if settings.make or settings.reference:
            import gmsh  # noqa: F401
            import numpy  # noqa: F401
    except ImportError as error:
        raise SystemExit(f"bench/run parts: {error}; Debian's packages python3-gmsh and python3-numpy bring what "
                         "--make and --reference take, for /usr/bin/python3") from error
    if settings.reference and (missing := peers.absent(None, ["ccx"])):
        raise SystemExit("bench/run parts: " + missing["ccx"])


def made(settings):
    """Makes what is missing of the scripted parts."""
    from parts import catalogue, make

    names = [name for name in settings.variants.split(",") if name] or make.VARIANTS
    unknown = [name for name in names if name not in make.VARIANTS]
    if unknown:
        raise SystemExit(f"bench/run parts: {unknown[0]} is none of {', '.join(make.VARIANTS)}")
    make.make(settings.make, catalogue.PARTS, names, settings.only)


def run(settings):
    if (settings.folder is None) == (settings.make is None):
        raise SystemExit("bench/run parts: give one of --folder, of parts, and --make, for the scripted ones")
    require_peers(settings)
    if settings.make:
        made(settings)
    if settings.no_runs:
        return 0
    if not settings.program.exists():
        raise SystemExit("bench/run parts: the program is not built; call ./thinwall --version first")
    settings.processor_time = settings.processor_time or settings.threads * settings.time
    files = sweep.files_in(settings.folder or settings.make, settings.only)
    if not files:
        raise SystemExit("bench/run parts: no file of a known ending with such a name")
    kept = {"bench": "parts", "machine": processes.machine(), "time_s": settings.time, "memory_gb": settings.memory,
            "processor_time_s": settings.processor_time, "threads": settings.threads, "tolerance": settings.tolerance}
    show_header()
    with tempfile.TemporaryDirectory(prefix="thinwall-bench-") as temporary:
        rows = sweep.run_all(files, settings, (settings.work or pathlib.Path(temporary)).resolve(),
                             lambda rows: keep(rows, kept, settings))
    lines = outcomes.summary_of(rows)
    print("\n" + ", ".join(f"{n} {name}" for name, n in outcomes.counts(rows).items() if n))
    for words, figure, bar, holds in lines:
        print(f"{words:<42}{figure:>8}   {bar:<8}{'' if holds is None or holds else 'missed'}")
    return 0 if all(holds is not False for *_, holds in lines) else 1


def keep(rows, kept, settings):
    """Shows the last row and writes all of them: an interrupted sweep leaves what it has."""
    show(rows[-1])
    if settings.out:
        fem.write_json(settings.out, {**kept, "parts": rows})
    if settings.page:
        page.write(settings.page, kept, rows)


def show_header():
    print(f"{'file':<42} {'outcome':<17}{'wall s':>8}{'CPU s':>8}{'GB':>6}{'DOFs':>8}{'estimate':>10}{'volume':>10}"
          f"{'rigid':>6}{'error':>10}", flush=True)


def show(row):
    line = f"{row['file']:<42} {row['outcome']:<17}{row['wall_s']:>8.1f}{row['processor_s']:>8.1f}"
    line += f"{row['memory_bytes'] / 1e9:>6.2f}"
    if not outcomes.has_answer(row):
        print(f"{line}  {row['message']}", flush=True)
        return
    line += f"{row['dofs']:>8}{in_short(row['estimate'])}{in_short(row['volume_difference'])}{row['rigid_motions']:>6}"
    print(line + in_short(row.get("true_error")), flush=True)


def in_short(value):
    return f"{'-':>10}" if value is None else f"{value:>10.1e}"
