"""The scripted parts by name. `turn` is the number of facets on a full turn of a coarse tessellation, `fine` about that
of all facets of a fine one."""

import dataclasses
import functools
import math

from parts import families as f


@dataclasses.dataclass(frozen=True)
class Part:
    name: str
    family: str
    make: object
    turn: int = 24
    fine: int = 30_000


def part(family, name, make, *arguments, turn=24, fine=30_000, **named):
    return Part(name, family, functools.partial(make, *arguments, **named), turn, fine)


ROWS_8 = f.holes_in_rows(300, 200, 4, 2)
ROWS_500 = f.holes_in_rows(500, 250, 25, 20)

PARTS = [
    part("plates", "plate-eight-holes", f.plate, 300, 200, 12.7, ROWS_8, 10.0, fine=100_000),
    part("plates", "plate-round-holes", f.plate, 300, 200, 12.7, ROWS_8, 10.0, turn=240, fine=300_000),
    part("plates", "plate-bare", f.plate, 240, 160, 5),
    part("plates", "plate-slots", f.plate, 260, 120, 4, slots=f.holes_in_rows(260, 120, 3, 2)),
    part("plates", "plate-holes-and-slots", f.plate, 320, 180, 8, [(20, 20), (300, 20), (300, 160), (20, 160)], 6.0,
         slots=[(100, 90), (220, 90)], slot=(60.0, 14.0)),
    part("plates", "plate-thin", f.plate, 200, 150, 0.8, f.holes_in_rows(200, 150, 2, 2), 8.0),
    part("plates", "plate-thick", f.plate, 120, 100, 40, [(60, 50)], 25.0),
    part("plates", "plate-500-holes", f.plate, 500, 250, 6, ROWS_500, 3.0, turn=16, fine=100_000),
    part("plates", "strip", f.plate, 400, 12, 1.5),
    part("ribbed panels", "panel-one-way", f.ribbed_panel, 300, 200, 2, 3, 20, 6, 0),
    part("ribbed panels", "panel-two-way", f.ribbed_panel, 300, 200, 2, 2, 15, 4, 3),
    part("ribbed panels", "panel-dense", f.ribbed_panel, 400, 300, 1.5, 1.5, 12, 12, 9),
    part("isogrids", "isogrid-coarse", f.isogrid, 200, 150, 2, 3, 12, 60),
    part("isogrids", "isogrid-fine", f.isogrid, 300, 200, 1.5, 2, 10, 40),
    part("trays", "tray-ribs", f.tray, 355, 355, 3.2, 3.2, 30, 4, 4),
    part("trays", "tray-bare", f.tray, 250, 180, 2, 2, 25, 1, 1),
    part("trays", "tray-deep", f.tray, 160, 120, 3, 2, 70, 3, 2),
    part("brackets", "bracket", f.bracket, 60, 80, 5),
    part("brackets", "bracket-gusset", f.bracket, 70, 90, 6, 6.0),
    part("brackets", "bracket-heavy", f.bracket, 80, 100, 16, 20.0, 8.0),
    part("sheets with bends", "sheet-z", f.sheet, [(0, 0), (60, 0), (60, 50), (130, 50)], 1.5, 3.0, 80),
    part("sheets with bends", "sheet-u", f.sheet, [(0, 60), (0, 0), (90, 0), (90, 60)], 1.0, 2.0, 150,
         [(45, 40, 8), (45, 110, 8)]),
    part("sheets with bends", "sheet-hook", f.sheet, [(0, 0), (40, 0), (70, 30), (70, 80), (40, 95)], 2.0, 4.0, 60,
         [(20, 30, 6)]),
    part("sheets with bends", "sheet-corrugated", f.sheet, [(20 * k, 18 * (k % 2)) for k in range(13)], 0.8, 2.0, 120),
    part("profiles", "profile-u", f.profile, f.u_outline(60, 40, 3), 300),
    part("profiles", "profile-hat", f.profile, f.hat_outline(50, 35, 20, 1.5), 400),
    part("profiles", "profile-i", f.profile, f.i_outline(50, 80, 5, 3.5), 350),
    part("profiles", "profile-z", f.profile, f.z_outline(30, 45, 2), 250),
    part("tubes", "tube", f.tube, 30, 2, 200, turn=48),
    part("tubes", "tube-side-hole", f.tube, 40, 3, 160, 12.0, turn=36),
    part("tubes", "tube-thin", f.tube, 50, 0.8, 150, turn=64),
    part("tubes", "tube-cone", f.tube, 60, 2.5, 140, 0.0, 35, turn=48),
    part("tubes", "tube-square", f.square_tube, 40, 2, 300),
    part("tubes", "elbow", f.elbow, 80, 25, 3, math.pi / 2, turn=36),
    part("blades", "blade", f.blade, 60, 5, 120, 0.6),
    part("blades", "blade-root", f.blade, 50, 4, 100, 0.5, 0.6, (56.0, 20.0, 15.0)),
    part("blades", "impeller-6", f.impeller, 25, 30, 8, 6, 60, 2.0, 0.4),
    part("blades", "impeller-12", f.impeller, 35, 25, 10, 12, 80, 1.2, 0.3),
    part("links", "link", f.link, 250, 50, 35, 30),
    part("links", "link-pocket", f.link, 300, 55, 40, 40, 0.55, 6.0),
    part("links", "link-short", f.link, 110, 40, 30, 60),
    part("links", "forearm", f.forearm, 60, 5, 300, 15.0, turn=36),
    part("bodies", "sphere", f.ball, 40, fine=100_000),
    part("bodies", "ellipsoid", f.ellipsoid, 60, 35, 20, fine=50_000),
    part("bodies", "bowl", f.bowl, 60, 2, turn=56),
    part("bodies", "rounded-block", f.rounded_block, 90, 60, 40, 8.0),
    part("tori", "torus", f.ring, 60, 20, fine=50_000),
    part("tori", "torus-slender", f.ring, 80, 5),
    part("gears", "gear-24", f.gear, 24, 3, 20, 12.0),
    part("gears", "gear-60-web", f.gear, 60, 2, 15, 12.0, 5.0),
    part("gears", "rack", f.rack, 25, 2, 15, 8),
    part("threads", "grooved-rod", f.grooved_rod, 8, 1.0, 1.75, 20, 10),
    part("threads", "grooved-rod-long", f.grooved_rod, 6, 0.6, 1.0, 60, 15, turn=20),
    part("threads", "threaded-rod", f.threaded_rod, 10, 2.0, 6.0, 8),
    part("threads", "spring", f.spring, 25, 3, 15, 4),
    part("thin fins", "heat-sink", f.heat_sink, 100, 80, 8, 12, 0.8, 30),
    part("thin fins", "heat-sink-fine", f.heat_sink, 80, 60, 10, 20, 0.4, 25),
    part("walls to nothing", "wedge", f.wedge, 120, 8, 60),
    part("walls to nothing", "spike", f.spike, 20, 90),
    part("walls to nothing", "knife", f.knife, 200, 40, 6),
    part("walls to nothing", "lens", f.lens, 60, 90, turn=40),
    part("touching bodies", "bricks", f.bricks, 3, 2, 2, (40.0, 30.0, 20.0)),
    part("touching bodies", "pins-in-plate", f.pins_in_plate, 120, 80, 10, 3, 2, 8.0),
    part("lattices", "lattice-square", f.lattice, 3, 20, 3.0, fine=60_000),
    part("lattices", "lattice-round", f.lattice, 2, 25, 4.0, True, turn=16),
    part("machined blocks", "block-pockets", f.pocketed_block, 200, 140, 30, 3, 2.5, 4, 3),
    part("machined blocks", "flange", f.flange, 70, 20, 12, 8, 5.0, 25.0),
    part("machined blocks", "flange-thin", f.flange, 100, 30, 4, 12, 4.0),
    part("machined blocks", "housing", f.housing, 140, 100, 60, 4, 20),
]
