"""One run of thinwall and of each peer from a mesh or matrices to modes, as a row of the table.

A row holds seconds of the stages (what a program does not tell is absent), wall_s and cpu_s of the whole process,
peak_memory_bytes, frequencies_hz; or "failure". `total_s` is what ratios compare: for thinwall and CalculiX the whole
process from the mesh file on, for SLEPc from the loaded matrices on.
"""

import json
import os
import re
import shutil

import processes

# Ranks and ordering of MUMPS (ICNTL(7)): what of all that was tried did best at some size; docs/benchmarks.md.
SLEPC_VARIANTS = [(1, "AMF", 2), (1, "PORD", 4), (2, "AMF", 2), (2, "PORD", 4)]


def thinwall(programs, folder, settings):
    """From plate.inp to modes."""
    command = [programs / "fem_modes", "plate.inp", "--modes", settings.modes, "--threads", settings.threads]
    done = processes.run(command, settings.time_limit, folder, processes.environment())
    row = {"program": "thinwall", **measured(done)}
    if not done.failure:
        row.update(json.loads(done.last_line))
        row.update(total_s=done.wall_s, peak_memory_bytes=done.peak_memory_bytes)
        check_converged(row)
    return row


def craig_bampton(programs, folder, settings, interface_dofs=30, modes=30):
    """What the reduction costs above the modes alone, by the same factor."""
    command = [programs / "fem_modes", "plate.inp", "--threads", settings.threads, "--modes", modes,
               "--craig-bampton", interface_dofs]
    done = processes.run(command, settings.time_limit, folder, processes.environment())
    if done.failure:
        return {"failure": done.failure}
    row = json.loads(done.last_line)
    check_converged(row)
    both_s = row["factorise_s"] + row["modes_s"]
    row.update(above_modes=row["craig_bampton_s"] / row["modes_s"] - 1.0,
               above_factor_and_modes=(row["craig_bampton_s"] - row["modes_s"]) / both_s)
    return row


def write_matrices(programs, folder, settings):
    """K.petsc and M.petsc for SLEPc, not timed. Returns the failure or ''."""
    command = [programs / "fem_modes", "plate.inp", "--threads", settings.threads, "--write-petsc", folder]
    return processes.run(command, settings.time_limit, folder, processes.environment()).failure


def slepc(programs, folder, settings, ranks, ordering, icntl7):
    """From K.petsc and M.petsc to modes."""
    command = [programs / "slepc_modes", folder, "-nodes", "-eps_nev", settings.modes, "-st_mat_mumps_icntl_7", icntl7]
    if ranks > 1:
        as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        command = ["mpirun", *as_root, "--bind-to", "none", "-n", ranks, *command]
    # Serial MUMPS gains from threads in BLAS only; two ranks fill two cores by themselves.
    env = processes.environment(OPENBLAS_NUM_THREADS=max(1, settings.threads // ranks))
    done = processes.run(command, settings.time_limit, folder, env)
    row = {"program": "slepc", **measured(done)}
    if not done.failure:
        row.update(json.loads(done.last_line))
        check_converged(row)
    row["variant"] = f"{ranks} rank{'s' if ranks > 1 else ''}, {ordering}"
    return row


def ccx(folder, settings, job="plate"):
    """CalculiX from the job's .inp to modes; SPOOLES and ARPACK as Debian builds them."""
    # BLAS on one thread: on two, ARPACK's small products make the run two to four times slower.
    env = processes.environment(OMP_NUM_THREADS=settings.threads, CCX_NPROC_EQUATION_SOLVER=settings.threads,
                                CCX_NPROC_STIFFNESS=settings.threads, CCX_NPROC_RESULTS=settings.threads,
                                OPENBLAS_NUM_THREADS=1)
    table = folder / f"{job}.dat"
    table.unlink(missing_ok=True)
    done = processes.run(["stdbuf", "-oL", "ccx", job], settings.time_limit, folder, env)
    row = {"program": "ccx", **measured(done), "peak_memory_bytes": done.peak_memory_bytes}
    if done.failure:
        return row
    row.update(ccx_stages(done))
    row["total_s"] = done.wall_s
    row["frequencies_hz"] = ccx_frequencies(table)
    if len(row["frequencies_hz"]) < settings.modes:
        row["failure"] = f"{len(row['frequencies_hz'])} frequencies in {table.name}, not {settings.modes}"
    return row


def ccx_stages(done):
    """Seconds between the lines by which CalculiX tells what it begins. It orders within its factorisation."""

    def first(text):
        return next((seconds for seconds, line in done.lines if text in line), None)

    begins = ["STEP  ", "Factoring the system", "Calculating the eigenvalues", "U^T*M*U"]
    marks = [0.0, *map(first, begins)]
    names = ["read_s", "assembly_s", "factor_s", "eigen_s"]
    return {name: after - before for name, before, after in zip(names, marks, marks[1:])
            if before is not None and after is not None}


def ccx_frequencies(dat):
    """Hz, from the first table of the .dat file: number, eigenvalue, rad/s, cycles/s, imaginary part."""
    frequencies = []
    text = dat.read_text(errors="replace") if dat.exists() else ""
    table = text.split("E I G E N V A L U E   O U T P U T", 1)[-1].split("P A R T I C I P A T I O N", 1)[0]
    for line in table.splitlines():
        words = line.split()
        if len(words) == 5 and re.fullmatch(r"\d+", words[0]):
            frequencies.append(float(words[3]))
    return frequencies


def measured(done):
    row = {"wall_s": done.wall_s, "cpu_s": done.cpu_s}
    if done.failure:
        row["failure"] = done.failure
    return row


def check_converged(row):
    if not row["converged"]:
        row["failure"] = "the eigen-solver did not converge"


def absent(programs, wanted):
    """What is wanted and cannot run, each with the line that says so."""
    lines = {}
    if "ccx" in wanted and shutil.which("ccx") is None:
        lines["ccx"] = "ccx is absent and left out; Debian's package calculix-ccx brings it"
    if "slepc" in wanted and (not (programs / "slepc_modes").exists() or shutil.which("mpirun") is None):
        lines["slepc"] = ("slepc is absent and left out; Debian's packages slepc-dev, libslepc-real3.18-dev and "
                          "openmpi-bin bring it, MUMPS with it")
    return lines
