"""bench/run equal-error: seconds to frequencies of one and the same error, by thinwall from a STEP file and by Gmsh's
ten-node tetrahedra of that file with CalculiX.

thinwall runs at a tolerance, and once more at a fifth of it: what the two differ by, or the second one's own estimate
if that is more, is the error that the peers have to reach. Their meshes double in number until they do; between the
last two, time is taken as a power of the error. Processor time throughout, each program on one thread, so that a busy
machine and the number of its processors do not matter.
"""

import math
import multiprocessing
import pathlib
import re
import statistics
import tempfile
import time
import types

import fem
import peers
import processes

from parts import outcomes, reference, sweep

FIRST_TETS, MOST_TETS, GROWTH = 1000, 200_000, 2.0
FINER = 0.2  # of the tolerance, for the frequencies that errors are measured against
THIN = 0.03  # wall thickness 2 V/A over the diagonal of the part
OWN_LIMIT_S = 200.0
BARS = {"thin": 10.0, "all": 2.0}


def add_command(commands):
    parser = commands.add_parser("equal-error", description=__doc__.split("\n\n")[0],
                                 help="seconds to frequencies as exact as those of Gmsh and CalculiX")
    parser.add_argument("--make", type=pathlib.Path, required=True, metavar="DIR",
                        help="make the scripted parts that are missing in DIR and run their STEP files")
    parser.add_argument("--only", type=re.compile, default=re.compile(""), metavar="PATTERN",
                        help="in the files' names")
    parser.add_argument("--tolerance", type=fem.positive(float), default=0.01, metavar="X", help="of thinwall (0.01)")
    parser.add_argument("--time", type=fem.positive(float), default=300.0, metavar="S",
                        help="of processor time after which no larger mesh of the peers is tried (300)")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE.json", help="write all figures as JSON")
    parser.add_argument("--program", type=pathlib.Path, default=sweep.PROGRAM, metavar="FILE", help="thinwall itself")
    parser.set_defaults(run=run)


def run(settings):
    try:
        import gmsh  # noqa: F401
        from parts import catalogue, make
    except ImportError as error:
        raise SystemExit(f"bench/run equal-error: {error}; Debian's packages python3-gmsh and python3-numpy bring what "
                         "it takes, for /usr/bin/python3") from error
    if missing := peers.absent(None, ["ccx"]):
        raise SystemExit("bench/run equal-error: " + missing["ccx"])
    make.make(settings.make, catalogue.PARTS, ["step"], settings.only)
    files = [path for path in sorted(settings.make.glob("*.step")) if settings.only.search(path.name)]
    if not files:
        raise SystemExit("bench/run equal-error: no part with such a name")
    print(f"{'part':<24}{'error':>9}{'own s':>8}{'peers s':>9}{'ratio':>7}{'2V/A/d':>8}", flush=True)
    rows = []
    with tempfile.TemporaryDirectory(prefix="thinwall-bench-") as folder:
        for path in files:
            rows.append(row_of(path, settings, pathlib.Path(folder)))
            show(rows[-1])
            if settings.out:
                fem.write_json(settings.out, {"bench": "equal-error", "machine": processes.machine(), "parts": rows})
    return 0 if all(show_median(rows, name) for name in BARS) else 1


def row_of(path, settings, folder):
    """One part: the error, the seconds of both, and every mesh of the peers."""
    name = path.stem
    own = own_run(path, settings, settings.tolerance, folder / "own")
    finer = own_run(path, settings, FINER * settings.tolerance, folder / "finer")
    if not (outcomes.has_answer(own) and outcomes.has_answer(finer)):
        return {"part": name, "failure": own["message"] or finer["message"] or "no answer"}
    wanted = max(outcomes.largest_error(own["frequencies_hz"], finer["frequencies_hz"]), finer["estimate"])
    row = {"part": name, "error": wanted, "own_s": own["processor_s"], "thinness": in_child(thinness_of, path),
           "meshes": []}
    tets = FIRST_TETS
    while tets <= MOST_TETS:
        mesh = peer_run(path, tets, folder, finer["frequencies_hz"])
        row["meshes"].append(mesh)
        if "failure" in mesh or mesh["error"] <= wanted or mesh["seconds"] > settings.time:
            break
        tets *= GROWTH
    points = [(mesh["seconds"], mesh["error"]) for mesh in row["meshes"] if "failure" not in mesh]
    if not points:
        return {**row, "failure": row["meshes"][-1]["failure"]}
    row["peers_s"], row["reached"] = seconds_at(points, wanted)
    return row


def own_run(path, settings, tolerance, folder):
    limits = types.SimpleNamespace(program=settings.program, unit=None, tolerance=tolerance, time_budget=OWN_LIMIT_S,
                                   threads=1, memory=12.0, time=10.0 * OWN_LIMIT_S, processor_time=OWN_LIMIT_S)
    return sweep.row_of(path, limits, folder)


def peer_run(path, tets, folder, frequencies_hz):
    """About so many ten-node tetrahedra by Gmsh, one mesh as a user makes it, and CalculiX."""
    job = folder / f"{path.stem}-{tets:.0f}.inp"
    made = in_child(make_job, path, job, tets)
    if made is None:
        return {"failure": "Gmsh gave up"}
    limits = types.SimpleNamespace(threads=1, time_limit=reference.TIME_LIMIT_S, modes=sweep.MODES + 6)
    solved = peers.ccx(folder, limits, job.stem)
    for leftover in folder.glob(f"{job.stem}.*"):
        leftover.unlink()
    if "failure" in solved:
        return {"failure": solved["failure"]}
    return {"tets": made["tets"], "mesh_s": made["seconds"], "seconds": made["seconds"] + solved["cpu_s"],
            "error": outcomes.largest_error(solved["frequencies_hz"][6:], frequencies_hz)}


def make_job(path, job, tets):
    begin = time.process_time()
    material = sweep.YOUNG_PA, sweep.POISSON, sweep.DENSITY_KG_M3
    _, made = reference.write_job(path, job, tets, material, sweep.MODES + 6, trials=1)
    return {"tets": made, "seconds": time.process_time() - begin}


def thinness_of(path):
    """Twice the volume over the surface, over the diagonal of the box around the part."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.importShapes(str(path))
    gmsh.model.occ.synchronize()
    volume, area = (sum(gmsh.model.occ.getMass(d, tag) for _, tag in gmsh.model.getEntities(d)) for d in (3, 2))
    box = gmsh.model.getBoundingBox(-1, -1)
    gmsh.finalize()
    return 2.0 * volume / area / math.dist(box[:3], box[3:])


def in_child(function, *arguments):
    """What a function returns in a process of its own, since Gmsh keeps its memory and may end by a signal; None if it
    does not return."""
    here, there = multiprocessing.Pipe()
    child = multiprocessing.get_context("fork").Process(target=lambda: there.send(function(*arguments)))
    child.start()
    there.close()
    try:
        return here.recv()
    except EOFError:
        return None
    finally:
        child.join()


def seconds_at(points, error):
    """The seconds at which meshes (seconds, error), coarse to fine, reach an error, and True; or those of the last one
    and False if none does. The first mesh that reaches it ends a stretch on which seconds are a power of the error."""
    for before, (seconds, reached) in zip([None, *points], points):
        if reached > error:
            continue
        if before is None or reached <= 0.0:
            return seconds, True
        share = math.log(before[1] / error) / math.log(before[1] / reached)
        return before[0] * (seconds / before[0]) ** share, True
    return points[-1][0], False


def show(row):
    if "failure" in row:
        return print(f"{row['part']:<24}{row['failure']}", flush=True)
    mark = " " if row["reached"] else ">"
    print(f"{row['part']:<24}{row['error']:>9.1e}{row['own_s']:>8.1f}{mark}{row['peers_s']:>8.1f}"
          f"{row['peers_s'] / row['own_s']:>7.1f}{row['thinness']:>8.3f}", flush=True)


def show_median(rows, name):
    """The median ratio of the thin parts or of all; those that the peers did not reach count with what they took."""
    ratios = [row["peers_s"] / row["own_s"] for row in rows
              if "failure" not in row and (name == "all" or row["thinness"] < THIN)]
    if not ratios:
        return True
    median = statistics.median(ratios)
    holds = median >= BARS[name]
    print(f"{name}: {len(ratios)} parts, median ratio {median:.1f}, wanted {BARS[name]:g}{'' if holds else ', missed'}")
    return holds
