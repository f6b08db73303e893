"""The families of scripted parts: each function leaves a solid, or several that touch, in Gmsh's model, in mm."""

import math

from parts.solids import (box, common, cone, copy, cut, cylinder, fuse, lofted, moved, occ, prism, revolved,
                          sheet_outline, smooth_wire, sphere, stretched, swept, torus, turned)

UP = (0.0, 0.0, 1.0)


def holes_in_rows(length, width, nx, ny):
    """Middles of nx × ny fields."""
    return [((i + 0.5) * length / nx, (j + 0.5) * width / ny) for i in range(nx) for j in range(ny)]


def plate(length, width, thickness, holes=(), radius=5.0, slots=(), slot=(40.0, 6.0)):
    """A plate with round holes and with slots, rectangles with round ends, about the points given."""
    tools = [cylinder(radius, 3 * thickness, (x, y, -thickness)) for x, y in holes]
    for x, y in slots:
        half, r = slot[0] / 2, slot[1] / 2
        tools.append(box(2 * half, 2 * r, 3 * thickness, (x - half, y - r, -thickness)))
        tools += [cylinder(r, 3 * thickness, (x + sign * half, y, -thickness)) for sign in (-1, 1)]
    solid = box(length, width, thickness)
    return cut(solid, *tools) if tools else solid


def ribbed_panel(length, width, skin, rib, height, nx, ny):
    """A skin with nx ribs across and ny ribs along, at even distances."""
    ribs = [box(rib, width, height, ((i + 0.5) * length / nx - rib / 2, 0.0, 0.0)) for i in range(nx)]
    ribs += [box(length, rib, height, (0.0, (j + 0.5) * width / ny - rib / 2, 0.0)) for j in range(ny)]
    return fuse(box(length, width, skin), *ribs)


def isogrid(length, width, skin, rib, height, pitch):
    """A plate from which triangles between ribs in three directions are milled down to the skin; `pitch` is the height
    of the triangles of the ribs' middle lines."""
    side, inset = 2.0 * pitch / math.sqrt(3.0), 1.5 * rib
    pockets = []
    for j in range(math.ceil(width / pitch)):
        for i in range(-1, 2 * math.ceil(length / side) + 1):
            sign = 1 if (i + j) % 2 == 0 else -1
            low = j * pitch if sign > 0 else (j + 1) * pitch
            x, reach = (i + 1) * side / 2, side / 2 - inset / math.sqrt(3.0) * 1.5
            outline = [(x - reach, low + sign * rib / 2), (x + reach, low + sign * rib / 2),
                       (x, low + sign * (rib / 2 + math.sqrt(3.0) * reach))]
            pockets.append(moved(prism(outline[::sign], height), z=skin))
    return cut(box(length, width, height), *pockets)


def tray(length, width, floor, wall, height, nx, ny):
    """A floor, a rim, and ribs between."""
    rim = cut(box(length, width, height), box(length - 2 * wall, width - 2 * wall, height, (wall, wall, floor)))
    ribs = [box(wall, width, height, (i * length / nx - wall / 2, 0.0, 0.0)) for i in range(1, nx)]
    ribs += [box(length, wall, height, (0.0, j * width / ny - wall / 2, 0.0)) for j in range(1, ny)]
    return fuse(rim, *ribs) if ribs else rim


def bracket(width, leg, thickness, gusset=0.0, radius=6.0):
    """Two legs at a right angle, a gusset between them, two holes in each leg."""
    parts = [box(leg, width, thickness), box(thickness, width, leg)]
    if gusset > 0.0:
        rib = prism([(0.0, 0.0), (0.8 * leg, 0.0), (0.0, 0.8 * leg)], gusset)
        parts.append(moved(turned(rib, math.pi / 2, (1.0, 0.0, 0.0)), y=width / 2 + gusset / 2))
    solid = fuse(parts[0], *parts[1:])
    tools = [cylinder(radius, 4 * thickness, (0.7 * leg, y, -thickness)) for y in (0.2 * width, 0.8 * width)]
    tools += [cylinder(radius, 4 * thickness, (-thickness, y, 0.7 * leg), (1.0, 0.0, 0.0))
              for y in (0.2 * width, 0.8 * width)]
    return cut(solid, *tools)


def sheet(corners, thickness, radius, width, holes=()):
    """A bent sheet: its middle line in the plane, its width along z; round holes (x, z, radius) across y."""
    solid = prism(sheet_outline(corners, thickness, radius), width)
    tools = [cylinder(r, 2000.0, (x, -1000.0, z), (0.0, 1.0, 0.0)) for x, z, r in holes]
    return cut(solid, *tools) if tools else solid


def profile(outline, length):
    return prism(outline, length)


def u_outline(width, height, thickness):
    t = thickness
    return [(0, 0), (width, 0), (width, height), (width - t, height), (width - t, t), (t, t), (t, height), (0, height)]


def hat_outline(width, height, flange, thickness):
    t, f, w, h = thickness, flange, width, height
    return [(0, 0), (f + t, 0), (f + t, h - t), (f + w - t, h - t), (f + w - t, 0), (2 * f + w, 0), (2 * f + w, t),
            (f + w, t), (f + w, h), (f, h), (f, t), (0, t)]


def i_outline(width, height, flange, web):
    a, b = (width - web) / 2, (width + web) / 2
    return [(0, 0), (width, 0), (width, flange), (b, flange), (b, height - flange), (width, height - flange),
            (width, height), (0, height), (0, height - flange), (a, height - flange), (a, flange), (0, flange)]


def z_outline(flange, height, thickness):
    t = thickness
    return [(0, 0), (flange, 0), (flange, height - t), (2 * flange - t, height - t), (2 * flange - t, height),
            (flange - t, height), (flange - t, t), (0, t)]


def tube(radius, thickness, length, side_hole=0.0, top_radius=None):
    """A round tube, straight or as a cone, with a hole through one side."""
    top = radius if top_radius is None else top_radius
    if top == radius:
        solid = cut(cylinder(radius, length), cylinder(radius - thickness, 3 * length, (0.0, 0.0, -length)))
    else:
        solid = cut(cone(radius, top, length), cone(radius - thickness, top - thickness, length))
    if side_hole > 0.0:
        solid = cut(solid, cylinder(side_hole, 2 * radius, (0.0, 0.0, length / 2), (1.0, 0.0, 0.0)))
    return solid


def square_tube(width, thickness, length):
    inside = width - 2 * thickness
    return cut(box(width, width, length), box(inside, inside, length, (thickness, thickness, 0.0)))


def elbow(bend_radius, radius, thickness, angle):
    """A bent tube."""
    ring = [(2, occ.addPlaneSurface([occ.addCurveLoop([occ.addCircle(bend_radius, 0.0, 0.0, r)])
                                     for r in (radius, radius - thickness)]))]
    ring = turned(ring, math.pi / 2, (1.0, 0.0, 0.0))
    return [entity for entity in occ.revolve(ring, 0.0, 0.0, 0.0, *UP, angle) if entity[0] == 3]


def section(chord, thickness, twist, z, offset=0.0, points=24):
    """Places of a symmetric, round-nosed blade section (an ellipse), twisted about z."""
    places = []
    for k in range(points):
        angle = 2.0 * math.pi * k / points
        x, y = chord / 2 * math.cos(angle) + offset, thickness / 2 * math.sin(angle)
        places.append((x * math.cos(twist) - y * math.sin(twist), x * math.sin(twist) + y * math.cos(twist), z))
    return places


def blade(chord, thickness, height, twist, tip=0.7, root=(0.0, 0.0, 0.0), sections=5):
    """A twisted blade that becomes narrower and thinner towards its tip; on a block if `root` has an extent."""
    wires = []
    for k in range(sections):
        s = k / (sections - 1)
        size = 1.0 + (tip - 1.0) * s
        wires.append(smooth_wire(section(size * chord, size * thickness, s * twist, s * height)))
    solid = lofted(wires)
    if root[0] > 0.0:
        solid = fuse(box(root[0], root[1], root[2] + 2.0, (-root[0] / 2, -root[1] / 2, -root[2])), solid)
    return solid


def impeller(hub_radius, hub_height, bore, blades, radius, thickness, lean):
    """A hub with a bore and straight blades that lean."""
    wings = []
    for k in range(blades):
        wing = box(radius, thickness, hub_height, (0.0, -thickness / 2, 0.0))
        wings.append(turned(turned(wing, lean, (1.0, 0.0, 0.0), (0.0, 0.0, hub_height / 2)), 2 * math.pi * k / blades))
    body = fuse(cone(hub_radius, 0.6 * hub_radius, hub_height), *wings)
    body = common(body, cylinder(radius, hub_height))
    return cut(body, cylinder(bore, 3 * hub_height, (0.0, 0.0, -hub_height)))


def link(distance, first, second, width, bore=0.5, pocket=0.0):
    """A robot-like link: two round ends, a tapered web between, bores through both, a pocket in the web from above."""
    web = prism([(0.0, -first), (distance, -second), (distance, second), (0.0, first)], width)
    solid = fuse(cylinder(first, width), cylinder(second, width, (distance, 0.0, 0.0)), web)
    tools = [cylinder(bore * first, 3 * width, (0.0, 0.0, -width)),
             cylinder(bore * second, 3 * width, (distance, 0.0, -width))]
    if pocket > 0.0:
        w = 0.75 * min(first, second)
        tools.append(box(distance - 1.2 * (first + second), 2 * w, width, (1.2 * first, -w, pocket)))
    return cut(solid, *tools)


def forearm(radius, thickness, length, flange):
    """A hollow cone between two flanges with bolt holes."""
    body = fuse(cone(radius, 0.7 * radius, length), cylinder(radius + flange, 8.0),
                cylinder(0.7 * radius + flange, 8.0, (0.0, 0.0, length - 8.0)))
    body = cut(body, cone(radius - thickness, 0.7 * radius - thickness, length))
    bolts = [cylinder(3.0, 20.0, ((radius + flange / 2) * math.cos(k * math.pi / 3),
                                  (radius + flange / 2) * math.sin(k * math.pi / 3), -5.0)) for k in range(6)]
    return cut(body, *bolts)


def ball(radius):
    return sphere(radius)


def bowl(radius, thickness):
    """Half a hollow sphere."""
    half = cut(sphere(radius), box(3 * radius, 3 * radius, 2 * radius, (-1.5 * radius, -1.5 * radius, 0.0)))
    return cut(half, sphere(radius - thickness))


def ellipsoid(x, y, z):
    return stretched(sphere(1.0), x, y, z)


def ring(radius, tube_radius):
    return torus(radius, tube_radius)


def lens(radius, distance):
    """What two balls have in common: its rim has no thickness."""
    return common(sphere(radius), sphere(radius, (0.0, 0.0, distance)))


def gear(teeth, module, thickness, bore, web=0.0):
    """A spur gear with straight flanks and a bore; with a thinner web inside its rim."""
    pitch = module * teeth / 2
    outline = []
    for k in range(teeth):
        for share, r in ((0.22, pitch - 1.25 * module), (0.34, pitch + module), (0.66, pitch + module),
                         (0.78, pitch - 1.25 * module)):
            angle = 2 * math.pi * (k + share) / teeth
            outline.append((r * math.cos(angle), r * math.sin(angle)))
    solid = cut(prism(outline, thickness), cylinder(bore, 3 * thickness, (0.0, 0.0, -thickness)))
    if web > 0.0:
        inner, outer, deep = 1.8 * bore, pitch - 3.5 * module, (thickness - web) / 2
        groove = cut(cylinder(outer, deep), cylinder(inner, deep))
        solid = cut(solid, copy(groove), moved(groove, z=thickness - deep))
    return solid


def rack(teeth, module, width, back):
    """A toothed bar."""
    p = math.pi * module
    flanks = [(k * p + share * p, y) for k in range(teeth)
              for share, y in ((0.14, 0.0), (0.3, 2.2 * module), (0.7, 2.2 * module), (0.86, 0.0))]
    return prism([(0.0, 0.0), (0.0, -back), (teeth * p, -back), (teeth * p, 0.0), *flanks[::-1]], width)


def grooved_rod(radius, depth, pitch, ridges, plain):
    """A rod with rings of triangular section, like a thread without a lead."""
    outline = [(0.0, 0.0), (radius, 0.0), (radius, plain)]
    for k in range(ridges):
        outline += [(radius - depth, plain + (k + 0.5) * pitch), (radius, plain + (k + 1.0) * pitch)]
    end = plain + ridges * pitch + plain
    return revolved([*outline, (radius, end), (0.0, end)])


def threaded_rod(radius, depth, lead, turns, places=8):
    """A round thread of one start: a circle beside the axis that turns as it rises."""
    wires = []
    for k in range(turns * places + 1):
        angle = 2 * math.pi * k / places
        x, y, z = depth / 2 * math.cos(angle), depth / 2 * math.sin(angle), lead * k / places
        wires.append(occ.addWire([occ.addCircle(x, y, z, radius - depth / 2)]))
    return lofted(wires)


def spring(radius, wire_radius, lead, turns, places=12):
    """A helical spring of round wire."""
    angles = [2 * math.pi * k / places for k in range(turns * places + 1)]
    return swept(wire_radius, [(radius * math.cos(angle), radius * math.sin(angle), lead * angle / (2 * math.pi))
                               for angle in angles])


def heat_sink(length, width, base, fins, fin, height):
    """Thin fins on a thick base."""
    gap = (width - fin) / (fins - 1)
    return fuse(box(length, width, base), *[box(length, fin, base + height, (0.0, i * gap, 0.0)) for i in range(fins)])


def wedge(length, width, height):
    """A wall that tapers to an edge without thickness."""
    return prism([(0.0, 0.0), (height, -width / 2), (height, width / 2)], length)


def spike(radius, height):
    return cone(radius, 0.0, height)


def knife(length, width, thickness):
    """A rhombic bar, sharp along both edges."""
    return prism([(0.0, 0.0), (width / 2, -thickness / 2), (width, 0.0), (width / 2, thickness / 2)], length)


def bricks(nx, ny, nz, size):
    """Blocks that touch with whole faces, each a body of its own."""
    return [entity for i in range(nx) for j in range(ny) for k in range(nz)
            for entity in box(*size, (i * size[0], j * size[1], k * size[2]))]


def pins_in_plate(length, width, thickness, nx, ny, radius):
    """A plate with round holes and a pin in each that fills it and stands out; each a body of its own."""
    places = holes_in_rows(length, width, nx, ny)
    solid = plate(length, width, thickness, places, radius)
    return solid + [entity for x, y in places for entity in cylinder(radius, 3 * thickness, (x, y, 0.0))]


def lattice(cells, pitch, strut, round_struts=False):
    """Struts along the edges of cells × cells × cells cubes."""
    reach, n = cells * pitch, range(cells + 1)
    struts = []
    for i in n:
        for j in n:
            a, b = i * pitch, j * pitch
            if round_struts:
                struts += [cylinder(strut / 2, reach, (a, b, 0.0)),
                           cylinder(strut / 2, reach, (0.0, a, b), (1.0, 0.0, 0.0)),
                           cylinder(strut / 2, reach, (a, 0.0, b), (0.0, 1.0, 0.0))]
            else:
                h, full = strut / 2, reach + strut
                struts += [box(strut, strut, full, (a - h, b - h, -h)), box(full, strut, strut, (-h, a - h, b - h)),
                           box(strut, full, strut, (a - h, -h, b - h))]
    if round_struts:
        struts += [sphere(0.8 * strut, (i * pitch, j * pitch, k * pitch)) for i in n for j in n for k in n]
    return fuse(struts[0], *struts[1:])


def pocketed_block(length, width, height, floor, wall, nx, ny):
    """A machined block with nx × ny pockets."""
    dx, dy = (length - wall) / nx, (width - wall) / ny
    return cut(box(length, width, height), *[box(dx - wall, dy - wall, height, (wall + i * dx, wall + j * dy, floor))
                                            for i in range(nx) for j in range(ny)])


def flange(radius, bore, thickness, bolts, bolt_radius, neck=0.0):
    """A round flange with a circle of bolt holes and a neck."""
    body = cylinder(radius, thickness)
    if neck > 0.0:
        body = fuse(body, cylinder(1.4 * bore, thickness + neck))
    middle = (radius + 1.4 * bore) / 2
    tools = [cylinder(bolt_radius, 3 * thickness, (middle * math.cos(2 * math.pi * k / bolts),
                                                   middle * math.sin(2 * math.pi * k / bolts), -thickness))
             for k in range(bolts)]
    return cut(body, cylinder(bore, 3 * (thickness + neck), (0.0, 0.0, -thickness)), *tools)


def housing(length, width, height, wall, bore):
    """A box open below, with a bore through the top and one through a side."""
    shell = cut(box(length, width, height), box(length - 2 * wall, width - 2 * wall, height - wall, (wall, wall, 0.0)))
    return cut(shell, cylinder(bore, 3 * wall, (length / 2, width / 2, height - 2 * wall)),
               cylinder(0.6 * bore, 3 * wall, (-wall, width / 2, height / 2), (1.0, 0.0, 0.0)))


def rounded_block(length, width, height, radius):
    """A block with all edges rounded."""
    solid = box(length, width, height)
    occ.synchronize()
    return occ.fillet([solid[0][1]], [tag for _, tag in occ.getEntities(1)], [radius])
