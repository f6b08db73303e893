"""Frequencies of a free part by others: ten-node tetrahedra by Gmsh on the exact faces of its STEP file, and CalculiX.

Two sizes of elements are extrapolated to none. What was computed is kept, a JSON file a part.
"""

import json
import types

import peers

SIZES = (20_000, 80_000)  # tetrahedra, about
ORDER = 2.0  # of the error in the size: 4 without edges that turn inwards, about 1.1 beside them
TIME_LIMIT_S = 3600.0
TRIALS = 4  # meshes that are made to hit a number of tetrahedra
# Gmsh numbers the middles of the edges (2, 3) and (1, 3) the other way round than Abaqus and CalculiX.
TO_ABAQUS = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]


def reference_of(step, folder, settings, material, modes):
    """The frequencies in Hz, their own error and the exact volume in m³ of a STEP file; None if some program failed."""
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / f"{step.stem}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    runs = []
    for tets in SIZES:
        job = f"{step.stem}-{tets}"
        volume_m3, made = write_job(step, folder / f"{job}.inp", tets, material, modes + 6)
        limits = types.SimpleNamespace(threads=settings.threads, time_limit=TIME_LIMIT_S, modes=modes + 6)
        run = peers.ccx(folder, limits, job)
        for leftover in folder.glob(f"{job}.*"):
            leftover.unlink()
        if "failure" in run:
            kept.with_suffix(".failed").write_text(run["failure"] + "\n")
            return None
        runs.append({"tets": made, "seconds": run["wall_s"], "frequencies_hz": run["frequencies_hz"][6:]})
    result = {"volume_m3": volume_m3, "runs": runs, **extrapolated(*runs)}
    kept.write_text(json.dumps(result, indent=1) + "\n")
    return result


def extrapolated(coarse, fine):
    """Richardson's limit of two runs, f = f₀ (1 + c h^ORDER) with h ~ tets^(−1/3), and its distance from the finer as
    its error."""
    ratio = (fine["tets"] / coarse["tets"]) ** (ORDER / 3.0)
    limits = [b - (a - b) / (ratio - 1.0) for a, b in zip(coarse["frequencies_hz"], fine["frequencies_hz"])]
    error = max(abs(b / limit - 1.0) for b, limit in zip(fine["frequencies_hz"], limits))
    return {"frequencies_hz": limits, "error": error}


def write_job(step, path, tets, material, modes, trials=TRIALS):
    """The job of CalculiX on about so many tetrahedra. Returns the volume in m³ and the number of tetrahedra."""
    import gmsh

    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.model.occ.importShapes(str(step))
        gmsh.model.occ.synchronize()
        volume_mm3 = sum(gmsh.model.occ.getMass(3, tag) for _, tag in gmsh.model.getEntities(3))
        found = mesh_of(gmsh, volume_mm3, tets, trials)
        gmsh.model.mesh.setOrder(2)
        path.write_text(job_text(gmsh, material, modes))
        return 1e-9 * volume_mm3, found
    finally:
        gmsh.finalize()


def mesh_of(gmsh, volume_mm3, tets, trials):
    """Meshes at sizes that come closer to the number of tetrahedra; the last one stays."""
    size = (8.0 * volume_mm3 / tets) ** (1.0 / 3.0)
    for _ in range(trials):
        gmsh.model.mesh.clear()
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        gmsh.option.setNumber("Mesh.MeshSizeMin", 0.2 * size)
        gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 12)
        gmsh.model.mesh.generate(3)
        found = len(gmsh.model.mesh.getElementsByType(4)[0])
        if 0.7 * tets < found < 1.4 * tets:
            break
        size *= min(2.0, max(0.4, (found / tets) ** 0.4))
    return found


def job_text(gmsh, material, modes):
    """Nodes, elements, material and the step of CalculiX, in metres."""
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    elements, corners = gmsh.model.mesh.getElementsByType(11)
    rows = corners.reshape(-1, 10)[:, TO_ABAQUS].astype(int)
    nodes = [f"{tag},{x:.12g},{y:.12g},{z:.12g}" for tag, (x, y, z) in zip(tags, 1e-3 * xyz.reshape(-1, 3))]
    tets = [f"{i}," + ",".join(map(str, row)) for i, row in enumerate(rows, start=1)]
    young, poisson, density = material
    return "\n".join(["*NODE, NSET=ALL", *nodes, "*ELEMENT, TYPE=C3D10, ELSET=PART", *tets, "*MATERIAL, NAME=M",
                      "*ELASTIC", f"{young:g},{poisson:g}", "*DENSITY", f"{density:g}",
                      "*SOLID SECTION, ELSET=PART, MATERIAL=M", "*STEP", "*FREQUENCY", f"{modes}", "*END STEP", ""])
