"""One run of the program on a file, under limits, as a row of the table."""

import json
import shutil

import fem
import processes

from parts import outcomes, reference

PROGRAM = fem.ROOT / "build" / "release" / "app" / "thinwall"
ENDINGS = (".stl", ".off", ".obj", ".ply", ".3mf", ".glb", ".gltf", ".step", ".stp", ".msh", ".inp", ".vtu")
OWN_UNIT = (".3mf", ".glb", ".gltf", ".step", ".stp")
YOUNG_PA, POISSON, DENSITY_KG_M3 = 70e9, 0.33, 2700.0
ADDRESSES_PER_BYTE = 1.3
MODES = 12


def files_in(folder, pattern):
    """Parts in a folder: coarse tessellations first, for they tell most in least time, then STEP; small before large."""
    found = [path for path in sorted(folder.iterdir()) if path.suffix.lower() in ENDINGS and pattern.search(path.name)]
    return sorted(found, key=lambda path: (".coarse." not in path.name, path.suffix != ".step", path.stat().st_size))


def unit_of(path, given):
    """Of the file: inches if its name says so (PART.inch.stl), else the one given; none where the format knows it."""
    if path.suffix.lower() in OWN_UNIT:
        return None
    return "inch" if ".inch." in path.name else given


def case_text(path, unit, tolerance, time_budget=None):
    """A free part of aluminium, twelve elastic modes."""
    lines = ["[part]", f"file = {json.dumps(str(path))}"]
    if unit:
        lines.append(f'unit = "{unit}"')
    lines += ["[part.material]", f'youngs_modulus = "{YOUNG_PA:g} Pa"', f"poisson_ratio = {POISSON:g}",
              f'density = "{DENSITY_KG_M3:g} kg/m^3"', "[part.mesh]", f"tolerance = {tolerance!r}"]
    if time_budget:
        lines.append(f'time_budget = "{time_budget:g} s"')
    lines += ["[modes]", f"count = {MODES}"]
    return "\n".join([*lines, ""])


def limited(command, settings):
    """The command told of its memory, and with a bound on the address space of each of its processes somewhat above,
    for addresses are taken that memory is never behind."""
    return ["prlimit", f"--as={ADDRESSES_PER_BYTE * settings.memory * 1e9:.0f}", *command, "--memory",
            f"{settings.memory:g} GB"]


def row_of(path, settings, folder):
    """Runs the program on a file in a folder of its own, which is made anew."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "case.toml").write_text(case_text(path.resolve(), unit_of(path, settings.unit), settings.tolerance,
                                                  settings.time_budget))
    command = [settings.program.resolve(), "run", "case.toml", "--out", "results", "--threads", settings.threads]
    done = processes.run(limited(command, settings), settings.time, folder, processes.environment(),
                         settings.processor_time)
    summary_file, log = folder / "results" / "summary.json", folder / "results" / "run.log"
    summary = json.loads(summary_file.read_text()) if summary_file.exists() else None
    message = last_message(done, folder)
    timed_out = done.failure.startswith("stopped at the limit")
    told = log.read_text(errors="replace").splitlines() if log.exists() else []
    row = {"file": path.name, "outcome": outcomes.outcome(done.exit_code, timed_out, message, summary),
           "wall_s": done.wall_s, "processor_s": done.cpu_s, "memory_bytes": done.peak_memory_bytes,
           "above_memory": done.peak_memory_bytes > settings.memory * 1e9, "message": message,
           "first_answer_s": outcomes.seconds_to_first_answer(told), "log": told[-40:]}
    if outcomes.has_answer(row):
        row.update(outcomes.figures(summary), message="")
        row["volume_m3"] = summary["part"]["mass_kg"] / DENSITY_KG_M3
    return row


def last_message(done, folder):
    """What the program said of a failure: the line of its error, or the last one of all."""
    if not done.failure:
        return ""
    said = [line.strip() for line in (folder / "stderr.txt").read_text(errors="replace").splitlines() if line.strip()]
    errors = [line for line in said if "error" in line.lower()]
    return (errors or said or [done.failure])[-1 if not errors else 0]


def known_volumes(folder):
    """What the maker of the files says that they enclose, m³ by name; nothing of files from elsewhere."""
    record = folder / "volumes.json"
    return json.loads(record.read_text()) if record.exists() else {}


def compare(row, path, volumes, settings):
    """Adds what the row's answer differs by from the file's own volume, where its maker told it, and from CalculiX. A
    tessellation is compared with the STEP file of the part, its own distance from which, by volume, is none of the
    program's errors."""
    if path.name in volumes:
        row["volume_difference"] = row["volume_m3"] / volumes[path.name] - 1.0
    step = path.with_name(path.name.split(".")[0] + ".step")
    if settings.reference is None or not step.exists():
        return
    known = reference.reference_of(step, settings.reference, settings, (YOUNG_PA, POISSON, DENSITY_KG_M3), MODES)
    if known is None:
        return
    own = volumes.get(path.name, known["volume_m3"])
    outcomes.compare(row, {**known, "error": known["error"] + abs(own / known["volume_m3"] - 1.0)})


def run_all(files, settings, folder, add):
    """A row for each file; `add` takes all rows whenever there is one more."""
    rows = []
    for path in files:
        row = row_of(path, settings, folder / path.name)
        if outcomes.has_answer(row):
            compare(row, path, known_volumes(path.parent), settings)
        rows.append(row)
        add(rows)
        if settings.work is None:
            shutil.rmtree(folder)
    return rows
