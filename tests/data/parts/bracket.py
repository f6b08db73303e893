# A sheet-metal bracket, 2 mm thick, bent by 90 degrees with an inner radius of 3 mm, with four holes: gmsh's kernel.
import gmsh
gmsh.initialize(); gmsh.option.setNumber("General.Terminal", 0)
o = gmsh.model.occ
t, w, a, b, r = 2.0, 60.0, 70.0, 50.0, 3.0
outer = o.addBox(0, 0, 0, a, w, b)
inner = o.addBox(t, -1, t, a, w + 2, b)
part, _ = o.cut([(3, outer)], [(3, inner)])
o.synchronize()
def edges(x, z):
    e = 1e-3
    return [c[1] for c in gmsh.model.getEntitiesInBoundingBox(x - e, -e, z - e, x + e, w + e, z + e, 1)]
part = o.fillet([part[0][1]], edges(t, t) + edges(0, 0), [r, r + t])
holes = [(3, o.addCylinder(x, y, -1, 0, 0, t + 2, 4.5)) for x in (35, 58) for y in (15, 45)]
holes += [(3, o.addCylinder(-1, 30, 34, t + 2, 0, 0, 8))]
part, _ = o.cut(part, holes)
o.synchronize(); gmsh.write("bracket.step"); gmsh.finalize()
