"""The scripted parts as files: each as STEP and as surfaces of several kinds. Needs Gmsh's Python module."""

import contextlib
import json
import math
import multiprocessing
import os
import sys

import gmsh
import numpy as np

from parts import surfaces

DOUBLE_KINDS = ["off", "ascii.stl", "ply", "obj", "ascii.ply"]  # take turns; a binary STL is in single precision
VARIANTS = ["step", "coarse", "fine", "bad", "single", "inch", "shuffled"]
AWAY_MM = (345.678, -210.9, 55.55)  # of the variant in single precision: away from the origin its digits matter
MILLIMETRES_PER_INCH = 25.4
# Seconds that Gmsh takes for a finely tessellated part are kept down by the frontal mesher; its first triangulation
# alone, without points of its own, is what CAD programs write for a plane.
FRONTAL, BOUNDARY_ONLY = 6, 3


def quietly():
    gmsh.initialize()
    for option, value in (("General.Terminal", 0), ("General.NumThreads", 1), ("Mesh.MeshSizeFromPoints", 0),
                          ("Mesh.MeshSizeExtendFromBoundary", 0)):
        gmsh.option.setNumber(option, value)


def begin(part):
    """The part as Gmsh's current model. Returns its volume, mm³."""
    gmsh.clear()
    gmsh.model.add(part.name)
    part.make()
    gmsh.model.occ.synchronize()
    return sum(gmsh.model.occ.getMass(3, tag) for _, tag in gmsh.model.getEntities(3))


def area():
    return sum(gmsh.model.occ.getMass(2, tag) for _, tag in gmsh.model.getEntities(2))


def mesh_faces(size_mm, turn, plain_planes):
    """Triangles on all faces: edges of a size at most and so many on a full turn (0: as many as the size makes)."""
    mesh = gmsh.model.mesh
    mesh.clear()
    gmsh.option.setNumber("Mesh.MeshSizeMax", size_mm)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5 if turn else 0.0)
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", turn)
    for _, tag in gmsh.model.getEntities(2):
        plain = plain_planes and gmsh.model.getType(2, tag) == "Plane"
        mesh.setAlgorithm(2, tag, BOUNDARY_ONLY if plain else FRONTAL)
    mesh.generate(2)


def boundary(face):
    return [abs(tag) for _, tag in gmsh.model.getBoundary([(2, face)], combined=False, oriented=False)]


def ring(curve):
    """Tags of the nodes of a closed curve, in order from its only vertex."""
    tags, _, parameters = gmsh.model.mesh.getNodes(1, curve)
    vertices = gmsh.model.getBoundary([(1, curve)], combined=False, oriented=False)
    start = gmsh.model.mesh.getNodes(0, vertices[0][1])[0]
    return [int(start[0]), *(int(tag) for tag in tags[np.argsort(parameters)])]


def rings_of(face):
    """The two full circles between which a whole cylinder or cone lies; none for any other face."""
    curves = boundary(face)
    rings = sorted(curve for curve in set(curves) if curves.count(curve) == 1)
    whole = (gmsh.model.getType(2, face) in ("Cylinder", "Cone") and len(curves) == 4 and len(rings) == 2
             and all(gmsh.model.getType(1, curve) == "Circle" for curve in rings))
    return rings if whole else []


def strip(face, place):
    """The triangles of a whole cylinder or cone between two rings of equally many nodes, as long as the face is: what
    CAD programs write. None for any other face."""
    rings = rings_of(face)
    if not rings:
        return None
    first, second = map(ring, rings)
    if len(first) != len(second):
        return None
    n = len(first)

    def way(nodes):
        return place(nodes[1]) - place(nodes[0])

    if way(first) @ way(second) < 0.0:
        second = [second[0], *second[:0:-1]]
    quads = [(first[i], first[(i + 1) % n], second[(i + 1) % n], second[i]) for i in range(n)]
    return [row for a, b, c, d in quads for row in ((a, b, c), (a, c, d))]


def triangles_now(as_strips):
    """The surface of the current mesh: each solid's own, turned outwards, one after another."""
    mesh = gmsh.model.mesh
    tags, xyz, _ = mesh.getNodes()
    index = np.full(int(tags.max()) + 1, -1)
    index[tags.astype(int)] = np.arange(len(tags))
    points = xyz.reshape(-1, 3)
    found, before = [], 0
    for _, solid in gmsh.model.getEntities(3):
        rows = []
        for _, face in gmsh.model.getBoundary([(3, solid)], oriented=False):
            own = strip(face, lambda tag: points[index[tag]]) if as_strips else None
            rows.append(index[np.array(mesh.getElementsByType(2, face)[1] if own is None else own).astype(int)]
                        .reshape(-1, 3))
        part, rows = surfaces.compact(points, np.concatenate(rows))
        found.append((part, surfaces.outward(part, rows) + before))
        before += len(part)
    return np.concatenate([part for part, _ in found]), np.concatenate([rows for _, rows in found])


def coarse(part):
    mesh_faces(1e3, part.turn, True)
    for _, curve in gmsh.model.getEntities(1):  # a straight edge stays whole, beside a curved face, too
        if gmsh.model.getType(1, curve) == "Line" and between_ruled(curve):
            gmsh.model.mesh.setTransfiniteCurve(curve, 2)
    mesh_faces(1e3, part.turn, True)
    return triangles_now(True)


def between_ruled(curve):
    """True if the faces beside the curve are plane or whole cylinders and cones between circles."""
    faces, _ = gmsh.model.getAdjacencies(1, curve)
    return all(gmsh.model.getType(2, face) in ("Plane", "Cylinder") or rings_of(face) for face in faces)


def fine(part):
    mesh_faces(math.sqrt(4.0 * area() / (math.sqrt(3.0) * part.fine)), 0, False)
    return triangles_now(False)


def variant(part, name, kept):
    """Points and triangles of a variant, mm; `kept` has the tessellations that several share."""
    base = "fine" if name in ("fine", "shuffled") else "coarse"
    if base not in kept:
        begin(part)  # anew, for what was asked of the edges by one tessellation stays for the next
        kept[base] = (fine if base == "fine" else coarse)(part)
    points, triangles = kept[base]
    seed = sum(map(ord, part.name))
    if name == "bad":
        return surfaces.badly_triangulated(points, triangles, seed)
    if name == "shuffled":
        return surfaces.shuffled(points, triangles, seed)
    if name == "single":
        return points + AWAY_MM, triangles
    if name == "inch":
        return points / MILLIMETRES_PER_INCH, triangles
    return points, triangles


def file_name(part, name, turn):
    """The file of a variant; the kinds of files take turns."""
    if name == "step":
        return f"{part.name}.step"
    kinds = {"single": "stl", "inch": "ascii.stl"}
    return f"{part.name}.{name}.{kinds.get(name, DOUBLE_KINDS[turn % len(DOUBLE_KINDS)])}"


def make(folder, parts, names, only):
    """Writes the files that are not there yet, and what each encloses into volumes.json (m³). Each part is made in a
    process of its own, for Gmsh aborts on some errors: such a part is told and left out."""
    folder.mkdir(parents=True, exist_ok=True)
    for i, part in enumerate(parts):
        files = {name: folder / file_name(part, name, i + VARIANTS.index(name)) for name in names}
        files = {name: path for name, path in files.items() if only.search(path.name) and not path.exists()}
        if not files:
            continue
        child = multiprocessing.get_context("fork").Process(target=make_part, args=(part, files, folder))
        child.start()
        child.join()
        if child.exitcode != 0:
            missing = ", ".join(path.name for path in files.values() if not path.exists())
            print(f"bench/run parts: Gmsh gave up on {part.name}; left out: {missing}", file=sys.stderr)


def make_part(part, files, folder):
    """The files of one part. What each encloses is recorded before it is there, since it then stays as it is."""
    quietly()
    exact, kept = begin(part), {}
    for name, path in files.items():
        if name == "step":
            record(folder, path.name, exact)
            write_step(path)
            continue
        points, triangles = variant(part, name, kept)
        if not surfaces.is_closed(triangles):
            print(f"bench/run parts: {path.name} is not closed and left out", file=sys.stderr)
            continue
        inside = surfaces.volume(points, triangles) * (MILLIMETRES_PER_INCH**3 if name == "inch" else 1.0)
        record(folder, path.name, inside)
        surfaces.write(path, points, triangles, 7 if name == "inch" else 17)
        print(f"{path.name}: {len(triangles)} triangles, volume {inside / exact - 1.0:+.2%}", file=sys.stderr)
    gmsh.finalize()


def record(folder, name, volume_mm3):
    """Adds what a file encloses to volumes.json."""
    path = folder / "volumes.json"
    volumes = json.loads(path.read_text()) if path.exists() else {}
    path.write_text(json.dumps({**volumes, name: 1e-9 * volume_mm3}, indent=1, sort_keys=True) + "\n")


@contextlib.contextmanager
def silence():
    """Open CASCADE prints a banner for every file that it writes, from C++."""
    before, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(before, 1)
        os.close(before)
        os.close(nowhere)


def write_step(path):
    with silence():
        gmsh.write(str(path))

