"""bench/run fem: ten modes of the CFCF plate 450 x 100 x 6 mm, the same mesh for thinwall, CalculiX and SLEPc."""

import argparse
import functools
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import peers
import processes

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Name: edge of the tetrahedra asked of TetGen, in m. The name is about the number of DOFs.
SIZES = {"40k": 0.0125, "170k": 0.0062, "420k": 0.0042, "1M": 0.0031}
BYTES_A_DOF = 10_000  # what the programs take at most, about
STAGES = ["read", "assembly", "ordering", "factor", "eigen"]


def names_of(allowed):
    def split(text):
        names = [name for name in text.split(",") if name]
        unknown = [name for name in names if name not in allowed]
        if unknown:
            raise argparse.ArgumentTypeError(f"{unknown[0]} is none of {', '.join(allowed)}")
        return names

    return split


def positive(kind):
    def convert(text):
        value = kind(text)
        if not 0 < value < math.inf:
            raise argparse.ArgumentTypeError(f"{text} is not positive")
        return value

    return convert


def add_command(commands):
    parser = commands.add_parser("fem", help="mesh to modes, beside CalculiX and SLEPc with MUMPS", description=__doc__)
    parser.add_argument("--sizes", type=names_of(SIZES), default=list(SIZES), metavar="LIST",
                        help="of 40k,170k,420k,1M")
    parser.add_argument("--peers", type=names_of(["ccx", "slepc"]), default=["ccx", "slepc"], metavar="LIST",
                        help="of ccx,slepc; '' for none")
    parser.add_argument("--craig-bampton", type=names_of(SIZES), default=[], metavar="LIST",
                        help="sizes at which 30 modes are timed beside a reduction to 30 interface DOFs and 30 modes")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.add_argument("--repeat", type=positive(int), metavar="N",
                        help="runs of each program, the median is shown (3, and 1 from 420k on)")
    parser.add_argument("--modes", type=positive(int), default=10, metavar="N")
    parser.add_argument("--threads", type=positive(int), default=2, metavar="N", help="of every program")
    parser.add_argument("--time-limit", type=positive(float), default=600.0, metavar="S",
                        help="of one run, seconds (600)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "bench", metavar="DIR")
    parser.add_argument("--work", type=pathlib.Path, metavar="DIR", help="keep meshes, matrices and outputs here")
    parser.set_defaults(run=run)


def build(folder, target="bench_fem"):
    """Configures and builds the programs of a command; the output is shown only if it fails."""
    print(f"building in {folder}", file=sys.stderr)
    configure = ["cmake", "-S", ROOT, "--preset", "bench", "-B", folder]
    for command in (configure, ["cmake", "--build", folder, "--target", target]):
        done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True)
        if done.returncode != 0:
            print(done.stdout[-8000:], file=sys.stderr)
            raise SystemExit(f"bench/run: {' '.join(map(str, command))} failed")
    return folder / "bench"


def make_mesh(programs, folder, element_size_m, settings):
    command = [programs / "plate_mesh", element_size_m, settings.modes, "plate.inp"]
    done = processes.run(command, settings.time_limit, folder, processes.environment())
    if done.failure:
        raise SystemExit(f"bench/run: no mesh of {element_size_m} m: {done.failure}")
    return json.loads(done.last_line)


def medians_in_turn(runs, repeat):
    """For each of `runs` (a function that gives a row) the run with the median total. They take turns, for a shared
    machine's speed wanders from minute to minute; one that fails is not repeated."""
    rows = [[] for _ in runs]
    for _ in range(repeat):
        for once, found in zip(runs, rows):
            if not found or "failure" not in found[-1]:
                found.append(once())
    return [median_of(found) for found in rows]


def median_of(rows):
    if "failure" in rows[-1]:
        return rows[-1]
    middle = statistics.median_low(row["total_s"] for row in rows)
    row = next(row for row in rows if row["total_s"] == middle)
    return {**row, "repeats": len(rows), "fastest_total_s": min(row["total_s"] for row in rows)}


def measure(programs, folder, name, settings, wanted):
    """All programs on one mesh."""
    mesh = make_mesh(programs, folder, SIZES[name], settings)
    repeat = settings.repeat or (3 if mesh["dofs"] < 400_000 else 1)
    runs = [lambda: peers.thinwall(programs, folder, settings)]
    rows = []
    if "ccx" in wanted:
        runs.append(lambda: peers.ccx(folder, settings))
    if "slepc" in wanted:
        failure = peers.write_matrices(programs, folder, settings)
        if failure:
            rows.append({"program": "slepc", "failure": f"no matrices: {failure}"})
        else:
            runs += [functools.partial(peers.slepc, programs, folder, settings, *variant)
                     for variant in peers.SLEPC_VARIANTS]

    def with_pages(once):
        processes.bring_pages(BYTES_A_DOF * mesh["dofs"])
        return once()

    rows = medians_in_turn([functools.partial(with_pages, once) for once in runs], repeat) + rows
    for row in rows:
        show(name, mesh, row, None if row is rows[0] else rows[0])
    result = {"size": name, "element_size_m": SIZES[name], "mesh": mesh, "runs": rows, "ratios": ratios(rows)}
    if name in settings.craig_bampton:
        result["craig_bampton"] = peers.craig_bampton(programs, folder, settings)
        show_craig_bampton(name, result["craig_bampton"])
    return result


def largest_difference(row, reference):
    """Largest relative difference of the frequencies, or None where one of the two has none."""
    ours, theirs = reference.get("frequencies_hz", []), row.get("frequencies_hz", [])
    if not ours or len(ours) != len(theirs):
        return None
    return max(abs(b / a - 1.0) for a, b in zip(ours, theirs))


def ratios(rows):
    """How many times faster and smaller thinwall is. `matrices_to_modes` compares with the fastest SLEPc run."""
    ours = rows[0]
    if "failure" in ours:
        return {}
    found = {}
    for row in rows[1:]:
        row["largest_frequency_difference"] = largest_difference(row, ours)
    for row in rows[1:]:
        if row["program"] == "ccx" and "failure" not in row:
            found["mesh_file_to_modes_ccx"] = row["total_s"] / ours["total_s"]
            found["memory_ccx"] = row["peak_memory_bytes"] / ours["peak_memory_bytes"]
    slepc = [row for row in rows if row["program"] == "slepc" and "failure" not in row]
    if slepc:
        best = min(slepc, key=lambda row: row["total_s"])
        solve_s = ours["ordering_s"] + ours["factor_s"] + ours["eigen_s"]
        found.update(matrices_to_modes_slepc=best["total_s"] / solve_s, best_slepc=best["variant"],
                     memory_slepc=best["peak_memory_bytes"] / ours["peak_memory_bytes"])
    return found


def show_header():
    print(f"{'size':>5} {'DOFs':>8} {'program':<20}" + "".join(f"{stage + ' s':>11}" for stage in STAGES) +
          f"{'total s':>9}{'wall s':>9}{'CPU s':>9}{'GB':>7}  {'Δf/f'}")


def show(name, mesh, row, reference=None):
    label = row["program"] + (" " + row["variant"] if "variant" in row else "")
    line = f"{name:>5} {mesh['dofs']:>8} {label:<20}"
    if "failure" in row:
        print(line + "  " + row["failure"], flush=True)
        return
    line += "".join(f"{row[stage + '_s']:>11.2f}" if stage + "_s" in row else f"{'-':>11}" for stage in STAGES)
    line += f"{row['total_s']:>9.2f}{row['wall_s']:>9.2f}{row['cpu_s']:>9.2f}{row['peak_memory_bytes'] / 1e9:>7.2f}"
    difference = largest_difference(row, reference) if reference else None
    print(line + ("" if difference is None else f"  {difference:.1e}"), flush=True)


def show_craig_bampton(name, row):
    if "failure" in row:
        print(f"{name:>5} Craig-Bampton: {row['failure']}", flush=True)
        return
    print(f"{name:>5} factor {row['factorise_s']:.2f} s, {row['modes']} modes alone {row['modes_s']:.2f} s, "
          f"Craig-Bampton of {row['interface_dofs']} interface DOFs and {row['modes']} modes "
          f"{row['craig_bampton_s']:.2f} s: {row['above_modes']:+.0%} above the modes, "
          f"{row['above_factor_and_modes']:+.0%} with the factor that both need", flush=True)


def show_ratios(results):
    for result in results:
        found = result["ratios"]
        words = []
        if "mesh_file_to_modes_ccx" in found:
            words.append(f"mesh file to modes {found['mesh_file_to_modes_ccx']:.1f} x faster than ccx, "
                         f"{found['memory_ccx']:.2f} x less memory")
        if "best_slepc" in found:
            words.append(f"matrices to modes {found['matrices_to_modes_slepc']:.1f} x faster than SLEPc + MUMPS "
                         f"({found['best_slepc']}), {found['memory_slepc']:.2f} x less memory")
        if words:
            print(f"{result['size']:>5}: " + "; ".join(words))
    exponent = growth_exponent(results)
    if exponent is not None:
        print(f"thinwall's time grows with DOFs to the power {exponent:.2f}")


def growth_exponent(results):
    """Slope of log time over log DOFs between the smallest and the largest mesh."""
    points = sorted((result["mesh"]["dofs"], result["runs"][0]["total_s"]) for result in results
                    if "failure" not in result["runs"][0])
    if len(points) < 2 or points[0][0] == points[-1][0]:
        return None
    (n, t), (larger_n, longer_t) = points[0], points[-1]
    return math.log(longer_t / t) / math.log(larger_n / n)


def write_json(path, content):
    """In one step."""
    partial = path.with_name(path.name + ".partial")
    partial.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    os.replace(partial, path)


def run(settings):
    machine = processes.machine()
    if machine["load_at_start"] > 0.5:
        print(f"the machine is busy (load {machine['load_at_start']:.1f}): peers on two threads or ranks wait for each "
              "other and look slower than they are", file=sys.stderr)
    programs = build(settings.build.resolve())
    missing = peers.absent(programs, settings.peers)
    print("\n".join(missing.values()) or "all programs are there", file=sys.stderr)
    wanted = [peer for peer in settings.peers if peer not in missing]
    results = []
    show_header()
    with tempfile.TemporaryDirectory(prefix="thinwall-bench-") as temporary:
        for name in settings.sizes:
            folder = (settings.work or pathlib.Path(temporary)).resolve() / name
            folder.mkdir(parents=True, exist_ok=True)
            results.append(measure(programs, folder, name, settings, wanted))
            if settings.out:
                write_json(settings.out, {"bench": "fem", "machine": machine, "threads": settings.threads,
                                          "modes": settings.modes, "absent": missing, "sizes": results})
    show_ratios(results)
    return 1 if any("failure" in result["runs"][0] for result in results) else 0
