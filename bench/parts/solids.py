"""Solids of Open CASCADE's kernel in Gmsh, in mm, each a list of (dimension, tag) as Gmsh's own calls take it."""

import math

import gmsh

occ = gmsh.model.occ


def box(length, width, height, at=(0.0, 0.0, 0.0)):
    return [(3, occ.addBox(*at, length, width, height))]


def cylinder(radius, height, at=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0)):
    return [(3, occ.addCylinder(*at, *(height * component for component in axis), radius))]


def cone(radius, top_radius, height, at=(0.0, 0.0, 0.0)):
    return [(3, occ.addCone(*at, 0.0, 0.0, height, radius, top_radius))]


def sphere(radius, at=(0.0, 0.0, 0.0)):
    return [(3, occ.addSphere(*at, radius))]


def torus(radius, tube_radius):
    return [(3, occ.addTorus(0.0, 0.0, 0.0, radius, tube_radius))]


def cut(solid, *tools):
    """The solid without its tools, faces of one plane joined."""
    return occ.cut(solid, [entity for tool in tools for entity in tool])[0]


def common(solid, other):
    return occ.intersect(solid, other)[0]


def fuse(first, *others):
    return occ.fuse(first, [entity for other in others for entity in other])[0]


def moved(solid, x=0.0, y=0.0, z=0.0):
    occ.translate(solid, x, y, z)
    return solid


def turned(solid, angle, axis=(0.0, 0.0, 1.0), about=(0.0, 0.0, 0.0)):
    occ.rotate(solid, *about, *axis, angle)
    return solid


def copy(solid):
    return occ.copy(solid)


def stretched(solid, x, y, z):
    occ.dilate(solid, 0.0, 0.0, 0.0, x, y, z)
    return solid


def wire(corners):
    """A closed wire of straight lines through points (x, y, z)."""
    points = [occ.addPoint(*corner) for corner in corners]
    lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    return occ.addWire(lines, checkClosed=True)


def smooth_wire(places):
    """A closed spline through points (x, y, z)."""
    points = [occ.addPoint(*place) for place in places]
    return occ.addWire([occ.addBSpline([*points, points[0]])], checkClosed=True)


def prism(outline, height):
    """An outline of corners (x, y), height along z."""
    flat = [(2, occ.addPlaneSurface([wire([(x, y, 0.0) for x, y in outline])]))]
    return [entity for entity in occ.extrude(flat, 0.0, 0.0, height) if entity[0] == 3]


def revolved(outline, angle=2.0 * math.pi):
    """An outline of corners (r, z) about the z axis."""
    flat = [(2, occ.addPlaneSurface([wire([(r, 0.0, z) for r, z in outline])]))]
    return [entity for entity in occ.revolve(flat, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, angle) if entity[0] == 3]


def lofted(wires, ruled=False):
    """A solid through closed wires."""
    return [entity for entity in occ.addThruSections(wires, makeSolid=True, makeRuled=ruled) if entity[0] == 3]


def swept(radius, places):
    """A round wire along a spline through points (x, y, z)."""
    points = [occ.addPoint(*place) for place in places]
    path = occ.addWire([occ.addSpline(points)])
    (x0, y0, z0), (x1, y1, z1) = places[0], places[1]
    disc = occ.addDisk(x0, y0, z0, radius, radius)
    direction = (x1 - x0, y1 - y0, z1 - z0)
    length = math.hypot(*direction)
    tilt = math.acos(direction[2] / length)
    if tilt > 0.0:
        occ.rotate([(2, disc)], x0, y0, z0, -direction[1], direction[0], 0.0, tilt)
    return [entity for entity in occ.addPipe([(2, disc)], path) if entity[0] == 3]


def sheet_outline(corners, thickness, radius, pieces=6):
    """The outline of a sheet that follows corners (x, y) of its middle line, with bends of an inner radius in straight
    pieces: first along the left side, then back along the right."""
    left, right = [], []
    for i, (x, y) in enumerate(corners):
        before = heading(corners[i - 1], corners[i]) if i > 0 else heading(corners[0], corners[1])
        after = heading(corners[i], corners[i + 1]) if i + 1 < len(corners) else before
        turn = math.remainder(after - before, 2.0 * math.pi)
        if abs(turn) < 1e-9:
            for side, sign in ((left, 1.0), (right, -1.0)):
                side.append((x - sign * thickness / 2 * math.sin(before), y + sign * thickness / 2 * math.cos(before)))
            continue
        middle = radius + thickness / 2
        back, sign = middle * math.tan(abs(turn) / 2), math.copysign(1.0, turn)
        cx = x - back * math.cos(before) - sign * middle * math.sin(before)
        cy = y - back * math.sin(before) + sign * middle * math.cos(before)
        for k in range(pieces + 1):
            angle = before + turn * k / pieces
            for side, of_side in ((left, 1.0), (right, -1.0)):
                r = middle - of_side * sign * thickness / 2
                side.append((cx + sign * r * math.sin(angle), cy - sign * r * math.cos(angle)))
    return left + right[::-1]


def heading(start, end):
    return math.atan2(end[1] - start[1], end[0] - start[0])
