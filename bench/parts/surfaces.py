"""Triangulated surfaces as plain arrays: their volume, badly made variants of them, and files.

A surface is a pair (points, triangles): n × 3 numbers and m × 3 indices, corners anticlockwise seen from outside.
"""

import collections
import struct

import numpy as np


def volume(points, triangles):
    """Enclosed by the triangles, from outward normals (the divergence theorem over tetrahedra to the origin)."""
    a, b, c = (points[triangles[:, k]] - points.mean(axis=0) for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def edge_uses(triangles):
    """How many triangles use each edge."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(edges, axis=0, return_counts=True)[1]


def is_closed(triangles):
    """True if every edge lies between two triangles that run along it in opposite directions."""
    ways = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return bool(np.all(edge_uses(triangles) == 2)) and len(np.unique(ways, axis=0)) == len(ways)


def compact(points, triangles):
    """Without points that no triangle uses."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    return points[used], renumbered.reshape(-1, 3)


def outward(points, triangles):
    """Triangles turned to agree with their neighbours, and then outwards: the surface is closed and in one piece."""
    along = collections.defaultdict(list)
    rows = [tuple(map(int, row)) for row in triangles]
    for t, row in enumerate(rows):
        for k in range(3):
            a, b = row[k], row[(k + 1) % 3]
            along[min(a, b), max(a, b)].append((t, a < b))
    turned, waiting = {0: False}, [0]
    while waiting:
        t = waiting.pop()
        row = rows[t]
        for k in range(3):
            a, b = row[k], row[(k + 1) % 3]
            for other, way in along[min(a, b), max(a, b)]:
                if other not in turned:
                    turned[other] = turned[t] ^ (way == (a < b))
                    waiting.append(other)
    result = np.array([row[::-1] if turned.get(t, False) else row for t, row in enumerate(rows)])
    return result[:, ::-1] if volume(points, result) < 0.0 else result


def shuffled(points, triangles, seed):
    """Points and triangles in random order, each triangle beginning at a random corner."""
    draw = np.random.default_rng(seed)
    order = draw.permutation(len(points))
    place = np.empty(len(points), int)
    place[order] = np.arange(len(points))
    first = draw.integers(0, 3, len(triangles))
    rolled = np.stack([triangles[np.arange(len(triangles)), (first + k) % 3] for k in range(3)], axis=1)
    return points[order], place[rolled][draw.permutation(len(triangles))]


def smallest_angles(points, triangles):
    """Of each triangle, in degrees."""
    corners = points[triangles]
    angles = []
    for k in range(3):
        u, v = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        angles.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), np.einsum("ij,ij->i", u, v)))
    return np.degrees(np.min(angles, axis=0))


def badly_triangulated(points, triangles, seed, splits=0.5, flips=0.5, least_degrees=0.05):
    """The surface with slivers: edges are divided near one end (`splits` of their number), and edges inside plane
    regions flipped where that makes the longer diagonal (`flips` of them are tried). No triangle that is made has an
    angle below `least_degrees`; nothing moves."""
    draw = np.random.default_rng(seed)
    xyz, faces = [np.array(p, float) for p in points], [list(map(int, row)) for row in triangles]
    by_edge = {}
    for t, row in enumerate(faces):
        for k in range(3):
            by_edge[row[k], row[(k + 1) % 3]] = t
    edges = [edge for edge in by_edge if edge[0] < edge[1]]
    for edge in [edges[i] for i in draw.permutation(len(edges))[:int(flips * len(edges))]]:
        flip(xyz, faces, by_edge, edge, least_degrees)
    edges = [edge for edge in by_edge if edge[0] < edge[1]]
    for edge in [edges[i] for i in draw.permutation(len(edges))[:int(splits * len(edges))]]:
        split(xyz, faces, by_edge, edge, draw.uniform(0.02, 0.98), least_degrees)
    return np.array(xyz), np.array(faces)


def angle_of(xyz, row):
    return float(smallest_angles(np.array([xyz[i] for i in row]), np.array([[0, 1, 2]]))[0])


def normal(xyz, row):
    across = np.cross(xyz[row[1]] - xyz[row[0]], xyz[row[2]] - xyz[row[0]])
    return across / max(np.linalg.norm(across), 1e-300)


def third(row, edge):
    return next(corner for corner in row if corner not in edge)


def put(faces, by_edge, t, row):
    """Makes `row` the triangle t."""
    if t == len(faces):
        faces.append(row)
    faces[t] = row
    for k in range(3):
        by_edge[row[k], row[(k + 1) % 3]] = t


def flip(xyz, faces, by_edge, edge, least_degrees):
    """Exchanges the diagonal of the two triangles beside an edge, if they lie in one plane and the other is longer."""
    a, b = edge
    if (a, b) not in by_edge or (b, a) not in by_edge:
        return
    left, right = by_edge[a, b], by_edge[b, a]
    c, d = third(faces[left], edge), third(faces[right], edge)
    if (c, d) in by_edge or (d, c) in by_edge or np.linalg.norm(xyz[c] - xyz[d]) < np.linalg.norm(xyz[a] - xyz[b]):
        return
    rows = [[a, d, c], [d, b, c]]
    plane = normal(xyz, faces[left])
    if plane @ normal(xyz, faces[right]) < 1.0 - 1e-12:
        return
    if any(plane @ normal(xyz, row) < 0.5 or angle_of(xyz, row) < least_degrees for row in rows):
        return
    del by_edge[a, b], by_edge[b, a]
    for t, row in zip((left, right), rows):
        put(faces, by_edge, t, row)


def split(xyz, faces, by_edge, edge, share, least_degrees):
    """Divides an edge and the two triangles beside it at a share of its length."""
    a, b = edge
    left, right = by_edge[a, b], by_edge[b, a]
    c, d = third(faces[left], edge), third(faces[right], edge)
    middle = len(xyz)
    xyz.append(xyz[a] + share * (xyz[b] - xyz[a]))
    rows = [[a, middle, c], [middle, b, c], [b, middle, d], [middle, a, d]]
    if any(angle_of(xyz, row) < least_degrees for row in rows):
        xyz.pop()
        return
    del by_edge[a, b], by_edge[b, a]
    for t, row in zip((left, len(faces), right, len(faces) + 1), rows):
        put(faces, by_edge, t, row)


def write(path, points, triangles, digits=17):
    """By the ending: .stl, .ascii.stl, .off, .obj, .ply (binary) or .ascii.ply; texts with so many digits."""
    kind = ".".join(path.name.split(".")[-2:]) if ".ascii." in path.name else path.suffix[1:]
    WRITERS[kind](path, points, triangles, digits)


def write_stl(path, points, triangles, digits):
    del digits
    corners = points[triangles].astype("<f4")
    record = np.zeros(len(triangles), np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")]))
    record["corners"] = corners
    path.write_bytes(b"binary".ljust(80) + struct.pack("<I", len(triangles)) + record.tobytes())


def lines_of(rows, digits, before=""):
    return [before + " ".join(f"{value:.{digits}g}" for value in row) for row in rows]


def write_ascii_stl(path, points, triangles, digits):
    texts = lines_of(points, digits, "      vertex ")
    facets = [["  facet normal 0 0 0", "    outer loop", *(texts[i] for i in row), "    endloop", "  endfacet"]
              for row in triangles]
    path.write_text("\n".join(["solid part", *(line for facet in facets for line in facet), "endsolid part", ""]))


def write_off(path, points, triangles, digits):
    faces = [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(["OFF", f"{len(points)} {len(triangles)} 0", *lines_of(points, digits), *faces, ""]))


def write_obj(path, points, triangles, digits):
    faces = [f"f {a} {b} {c}" for a, b, c in triangles + 1]
    path.write_text("\n".join([*lines_of(points, digits, "v "), *faces, ""]))


def ply_heading(kind, points, triangles, number):
    return "\n".join(["ply", f"format {kind} 1.0", f"element vertex {len(points)}",
                      *(f"property {number} {axis}" for axis in "xyz"), f"element face {len(triangles)}",
                      "property list uchar int vertex_indices", "end_header", ""])


def write_ply(path, points, triangles, digits):
    del digits
    faces = np.zeros(len(triangles), np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    faces["count"], faces["corners"] = 3, triangles
    heading = ply_heading("binary_little_endian", points, triangles, "double")
    path.write_bytes(heading.encode() + points.astype("<f8").tobytes() + faces.tobytes())


def write_ascii_ply(path, points, triangles, digits):
    faces = [f"3 {a} {b} {c}" for a, b, c in triangles]
    text = ply_heading("ascii", points, triangles, "double")
    path.write_text(text + "\n".join([*lines_of(points, digits), *faces, ""]))


WRITERS = {"stl": write_stl, "ascii.stl": write_ascii_stl, "off": write_off, "obj": write_obj, "ply": write_ply,
           "ascii.ply": write_ascii_ply}
