"""bench/run accuracy: how wrong seven frequencies are, for how many DOFs and seconds, by each way of meshing."""

import json
import math
import pathlib
import statistics
import sys
import tempfile

import fem
import peers
import processes

CASES = pathlib.Path(__file__).resolve().parent / "cases"
TOLERANCES = [0.005, 0.001, 0.0005]
BRIEF_S = 10.0  # runs that are shorter are repeated
ORDERS = [3, 4, 5, 6]
LEVELS = [0, 1]
REFERENCE_LEVEL = 2  # its order 6 is the reference, but for the pocket
# Beside edges that turn inwards errors fall as order^-4λ, λ = 0.544 (docs/theory/elements.md): the orders 5 and 6 of
# one level tell the limit.
LEFT_BY_ORDER_6 = (5 / 6) ** (4 * 0.544)
EDGE_LEVEL = 1
# Of each part: edges of the tet10 meshes, m. Nested: one layer of tetrahedra of this width, each then cut into 1, 8
# and 27.
PARTS = {
    "plate": {"TetGen": [0.02, 0.0125, 0.0062], "CGAL": [0.0125, 0.004], "nested": 0.012},
    "pocket": {"TetGen": [0.006, 0.0042, 0.0028], "CGAL": [0.004, 0.0017], "nested": 0.008},
    "wall": {"TetGen": [0.008, 0.005, 0.0034], "CGAL": [0.004, 0.002], "nested": 0.008},
    "sector": {"TetGen": [0.008, 0.005, 0.0034], "CGAL": [0.004, 0.002], "nested": 0.008},
}
PIECES = [1, 2, 3]  # of each edge of the nested meshes


def add_command(commands):
    parser = commands.add_parser("accuracy", description=__doc__,
                                 help="error of seven frequencies against DOFs and seconds, beside CalculiX")
    parser.add_argument("--parts", type=fem.names_of(PARTS), default=list(PARTS), metavar="LIST",
                        help="of " + ",".join(PARTS))
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write all figures as JSON")
    parser.add_argument("--repeat", type=fem.positive(int), default=3, metavar="N",
                        help="runs of thinwall with a tolerance, the median is shown (3); longer ones and all others "
                             "run once")
    parser.add_argument("--threads", type=fem.positive(int), default=2, metavar="N", help="of every program")
    parser.add_argument("--time-limit", type=fem.positive(float), default=600.0, metavar="S",
                        help="of one run, seconds (600)")
    parser.add_argument("--build", type=pathlib.Path, default=fem.ROOT / "build" / "bench", metavar="DIR")
    parser.add_argument("--work", type=pathlib.Path, metavar="DIR", help="keep cases, meshes and results here")
    parser.set_defaults(run=run, modes=7)


def by_mesher(programs, folder, case, settings, label, *options):
    """One solution on a mesh of a given kind, in elements of a given order."""
    command = [programs / "accuracy_modes", case, "--threads", settings.threads, *options]
    done = processes.run(command, settings.time_limit, folder, processes.environment())
    if done.failure:
        return {"program": label, "failure": done.failure}
    row = json.loads(done.last_line)
    return {"program": label, **row, "total_s": row["mesh_s"] + row["solve_s"]}


def by_tolerance(programs, folder, case, settings, tolerance):
    """The program as a user runs it: a case that holds a tolerance and no word on meshing."""
    (folder / "case.toml").write_text(case.read_text() + f"\n[part.mesh]\ntolerance = {tolerance}\n")
    command = [programs.parent / "app" / "thinwall", "run", "case.toml", "--out", "results",
               "--threads", settings.threads]
    done = processes.run(command, settings.time_limit, folder, processes.environment())
    row = {"program": f"thinwall, tolerance {tolerance:g}", "tolerance": tolerance, "total_s": done.wall_s}
    if done.failure:
        return {**row, "failure": done.failure}
    summary = json.loads((folder / "results" / "summary.json").read_text())
    return {**row, "dofs": summary["mesh"]["dofs"], "order": summary["mesh"]["order"],
            "estimated_error": summary["mesh"]["error_estimate"]["max_relative_frequency_error"],
            "frequencies_hz": [mode["frequency_hz"] for mode in summary["part"]["modes"]]}


def tet10_meshes(plan):
    """Name and options of the meshes that thinwall and ccx share, coarse to fine."""
    for mesher in ("TetGen", "CGAL"):
        for size_m in plan[mesher]:
            yield f"{mesher} {1e3 * size_m:g} mm", ["--mesher", mesher.lower(), "--size", size_m]
    for pieces in PIECES:
        yield (f"nested {1e3 * plan['nested']:g}/{pieces} mm",
               ["--mesher", "nested", "--size", plan["nested"], "--pieces", pieces])


def measure(programs, folder, part, settings, with_ccx):
    """All rows of one part, the reference first."""
    case, plan = CASES / f"{part}.toml", PARTS[part]

    def graded(level, order):
        return by_mesher(programs, folder, case, settings, f"graded, level {level}, order {order}",
                         "--mesher", "graded", "--level", level, "--order", order)

    if part == "pocket":
        reference = beyond_order_6(graded(EDGE_LEVEL, 5), graded(EDGE_LEVEL, 6))
    else:
        reference = graded(REFERENCE_LEVEL, 6)
    if "failure" in reference:
        raise SystemExit(f"bench/run: no reference for {part}: {reference['failure']}")
    rows = []

    def add(row):
        if "failure" not in row:
            row["error"] = largest_error(row["frequencies_hz"], reference["frequencies_hz"])
        rows.append(row)
        show(part, row)

    add(reference)
    for name, options in tet10_meshes(plan):
        row = by_mesher(programs, folder, case, settings, f"{name} tet10", *options, "--write-inp", "part.inp")
        add(row)
        if with_ccx and "failure" not in row:
            ccx = peers.ccx(folder, settings, "part")
            add({**ccx, "program": f"ccx, {name}", "dofs": row["dofs"], "tets": row["tets"]})
    for level in LEVELS:
        for order in ORDERS:
            add(graded(level, order))
    for tolerance in TOLERANCES:
        def once(wanted=tolerance):
            return by_tolerance(programs, folder, case, settings, wanted)

        row = once()
        brief = "failure" not in row and row["total_s"] < BRIEF_S
        add(fem.medians_in_turn([once], settings.repeat)[0] if brief else row)
    result = {"part": part, "rows": rows}
    result["reference_error"] = left_by_edges(result) if part == "pocket" else left_by_levels(result)
    compare_reference(result)
    compare_with_ccx(result)
    return result


def largest_error(frequencies, reference):
    return max(abs(a / b - 1.0) for a, b in zip(frequencies, reference, strict=True))


def of_program(result, word):
    return [row for row in result["rows"] if row["program"].startswith(word) and "failure" not in row]


def extrapolated(rows):
    """Richardson: f = f₀ (1 + c h^p) in each mode, h ~ tetrahedra^(−1/3), by least squares over the rows; p is
    the same for all modes, that with the least sum of squares. Returns f₀ and p."""

    def fitted(p):
        h = [row["tets"] ** (-p / 3.0) for row in rows]
        h_mean = statistics.fmean(h)
        limits, misfit = [], 0.0
        for f in zip(*(row["frequencies_hz"] for row in rows)):
            f_mean = statistics.fmean(f)
            slope = (sum((x - h_mean) * (y - f_mean) for x, y in zip(h, f)) / sum((x - h_mean) ** 2 for x in h))
            limits.append(f_mean - slope * h_mean)
            misfit += sum((f_mean + slope * (x - h_mean) - y) ** 2 for x, y in zip(h, f)) / f_mean**2
        return misfit, p, limits

    _, p, limits = min(fitted(0.05 * k) for k in range(10, 81))
    return limits, p


def beyond_order_6(fifth, sixth):
    """The limit of orders 5, 6, … on one mesh, as a row."""
    for row in (fifth, sixth):
        if "failure" in row:
            return row
    share = LEFT_BY_ORDER_6 / (1.0 - LEFT_BY_ORDER_6)
    limits = [b - share * (a - b) for a, b in zip(fifth["frequencies_hz"], sixth["frequencies_hz"])]
    return {**sixth, "program": sixth["program"] + ", limit", "frequencies_hz": limits}


def left_by_edges(result):
    """The error of the reference: what the limit of level 0 differs from it; 0 if that is not known."""
    rows = of_program(result, "graded, level 0, order 5") + of_program(result, "graded, level 0, order 6")
    if len(rows) < 2:
        return 0.0
    return largest_error(beyond_order_6(*rows)["frequencies_hz"], result["rows"][0]["frequencies_hz"])


def left_by_levels(result):
    """The error of the reference: order 6 on levels 0, 1, 2 goes on like a geometric series; 0 if that is not known."""
    rows = of_program(result, "graded, level 0, order 6") + of_program(result, "graded, level 1, order 6")
    if len(rows) < 2:
        return 0.0
    first, second = (row["error"] for row in rows)
    return second * second / max(first - 2.0 * second, second)


def compare_reference(result):
    """What ccx, extrapolated to elements of no size, says of the reference."""
    reference = result["rows"][0]["frequencies_hz"]
    for row in of_program(result, "thinwall"):  # whose last resort may be the reference itself
        row["error"] = max(row["error"], result["reference_error"], 1e-9)
    ccx = of_program(result, "ccx, nested")
    if len(ccx) < 3:
        return
    limits, p = extrapolated(ccx)
    result["ccx_extrapolated"] = {"order": p, "frequencies_hz": limits,
                                  "largest_difference": largest_error(limits, reference),
                                  "finest_error": min(row["error"] for row in ccx)}


def seconds_at(error, rows):
    """ccx's seconds at an error, log-log between the neighbouring runs that no other beats in both; beyond the first
    or last of them along the line of least squares through all. Returns them and whether that was needed."""
    best = []
    for row in sorted(rows, key=lambda row: row["total_s"]):
        if not best or row["error"] < best[-1]["error"]:
            best.append(row)
    if len(best) < 2:
        return None, True
    points = [(math.log(row["error"]), math.log(row["total_s"])) for row in best]
    x = math.log(error)
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x1 <= x <= x0:
            return math.exp(y0 + (y1 - y0) * (x - x0) / (x1 - x0)), False
    x_mean, y_mean = (statistics.fmean(values) for values in zip(*points))
    slope = sum((a - x_mean) * (b - y_mean) for a, b in points) / sum((a - x_mean) ** 2 for a, _ in points)
    nearest = min(points, key=lambda point: abs(point[0] - x))
    return math.exp(nearest[1] + slope * (x - nearest[0])), True


def compare_with_ccx(result):
    ccx = of_program(result, "ccx")
    for row in of_program(result, "thinwall"):
        seconds, beyond = seconds_at(row["error"], ccx)
        if seconds is not None:
            row.update(ccx_seconds_at_equal_error=seconds, ccx_extrapolated=beyond,
                       times_faster_than_ccx=seconds / row["total_s"])
            best = min(ccx, key=lambda run: run["error"])
            row["most_accurate_ccx"] = {"error": best["error"], "total_s": best["total_s"]}


def show_header():
    print(f"{'part':<7} {'by':<28}{'DOFs':>8}{'error':>10}{'mesh s':>9}{'solve s':>9}{'total s':>9}")


def show(part, row):
    line = f"{part:<7} {row['program']:<28}"
    if "failure" in row:
        print(line + "  " + row["failure"], flush=True)
        return
    line += f"{row['dofs']:>8}" + (f"{row['error']:>10.1e}" if row["error"] > 0.0 else f"{'reference':>10}")
    line += "".join(f"{row[key]:>9.2f}" if key in row else f"{'-':>9}" for key in ("mesh_s", "solve_s", "total_s"))
    print(line + (f"  estimated {row['estimated_error']:.1e}" if "estimated_error" in row else ""), flush=True)


def show_comparison(result):
    if result["reference_error"] > 0.0:
        print(f"{result['part']:<7} the reference itself is wrong by about {result['reference_error']:.0e}")
    if "ccx_extrapolated" in result:
        found = result["ccx_extrapolated"]
        print(f"{result['part']:<7} ccx extrapolated (order {found['order']:.1f} in h) lies "
              f"{found['largest_difference']:.1e} from the reference, its finest nested mesh "
              f"{found['finest_error']:.1e}")
    for row in of_program(result, "thinwall"):
        if "times_faster_than_ccx" not in row:
            continue
        line = (f"{result['part']:<7} {row['program']}: {row['times_faster_than_ccx']:.0f} x faster than ccx at an "
                f"error of {row['error']:.1e} ({row['total_s']:.2f} s, ccx {row['ccx_seconds_at_equal_error']:.0f} s")
        if row["ccx_extrapolated"]:
            best = row["most_accurate_ccx"]
            line += f" extrapolated; its most accurate run took {best['total_s']:.0f} s for {best['error']:.1e}"
        print(line + ")")
    sys.stdout.flush()


def run(settings):
    machine = processes.machine()
    programs = fem.build(settings.build.resolve(), "bench_accuracy")
    missing = peers.absent(programs, ["ccx"])
    print("\n".join(missing.values()) or "all programs are there", file=sys.stderr)
    results = []
    show_header()
    with tempfile.TemporaryDirectory(prefix="thinwall-bench-") as temporary:
        for part in settings.parts:
            folder = (settings.work or pathlib.Path(temporary)).resolve() / part
            folder.mkdir(parents=True, exist_ok=True)
            results.append(measure(programs, folder, part, settings, not missing))
            show_comparison(results[-1])
            if settings.out:
                fem.write_json(settings.out, {"bench": "accuracy", "machine": machine, "threads": settings.threads,
                                              "absent": missing, "parts": results})
    return 1 if any("tolerance" in row and "failure" in row for result in results for row in result["rows"]) else 0
