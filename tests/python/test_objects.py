"""Objects as users meet them in a session: they show what they are, travel to other processes, and take one value where
a list is expected."""

import copy
import pathlib
import pickle

import numpy as np
import pytest
import thinwall

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASE = ROOT / "cases" / "cantilever-wall"
STEEL = thinwall.Material(210e9, 0.3, 7850.0)
TOOL = thinwall.oscillators([(922.0, 0.011, 1.34e6, d) for d in "xy"], "tip")
CUT = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=600e6, K_r=200e6, radial_depth_m=0.001, helices_rad=0.5)
LINES = thinwall.receptances(TOOL, [800.0, 900.0, 1000.0])
CHART = thinwall.lobes(TOOL, CUT, [5000.0, 9000.0])
WALL = thinwall.box_mesh((0.05, 0.01, 0.03), 0.02)
CONTACT = thinwall.Contact("tip", "P", "x", 2e6, turns="z")
TURNED = thinwall.Response(LINES.frequency_hz, LINES.H, LINES.responses)


def joined():
    other = thinwall.receptances(thinwall.oscillators([(500.0, 0.02, 1e6, "x")], "P"), [800.0, 900.0, 1000.0])
    return thinwall.couple([LINES, other], thinwall.Contact("tip", "P", "x", 2e6))


SHOWN = [
    (STEEL, "Material(youngs_modulus_Pa=2.1e+11, poisson_ratio=0.3, density_kg_m3=7850)"),
    (thinwall.Plane((0, 0, 0.5), (0, 0, 1)), "Plane(point=(0, 0, 0.5), normal=(0, 0, 1))"),
    (thinwall.Block((0, 0, 0), (1, 2, 3)), "Block(min=(0, 0, 0), max=(1, 2, 3))"),
    (thinwall.Ball((0, 1, 0), 0.25), "Ball(centre=(0, 1, 0), radius=0.25)"),
    (thinwall.Point("P", (0, 0, 0.03), "x", region=thinwall.Ball((0, 1, 0), 0.25)), "<Point P at (0, 0, 0.03) m, 1 DOFs>"),
    (CONTACT, "<Contact of tip with P along 2 directions>"),
    (TOOL, "<SpatialModel of 2 coordinates, 2 DOFs: tip.x, tip.y>"),
    (thinwall.to_modal(TOOL), "<ModalModel of 4 poles, 2 DOFs: tip.x, tip.y>"),
    (LINES, "<Response at 3 lines, 800 to 1000 Hz; 2 responses: tip.x, tip.y; 2 forces: tip.x, tip.y>"),
    (joined(), "<CoupledResponse, well_conditioned, 3 lines, 3 DOFs: tip.x, tip.y, P.x>"),
    (CUT, "<MillingProcess of 2 teeth, diameter 10 mm, K_t 600 MPa, arc "),
    (CHART, "<Lobes at 2 speeds, least depth "),
    (thinwall.multiplier(TOOL, CUT, 5000.0, 1e-4), "<Multiplier of modulus "),
    (WALL, f"<Mesh of {len(WALL.tets)} tetrahedra of order 1, {len(WALL.vertices)} corners>"),
    (thinwall.Case.load(CASE, "lobes.count=9"), "<Case cantilever-wall: "),
]


def same(a, b):
    """True if all members that can be read are equal to the last bit."""
    for name in (name for name in dir(a) if not name.startswith("_")):
        left, right = getattr(a, name), getattr(b, name)
        if not callable(left) and not isinstance(left, thinwall.Response) and not np.array_equal(left, right):
            return False
    return type(a) is type(b) and repr(a) == repr(b)


@pytest.mark.parametrize(("thing", "words"), SHOWN, ids=lambda value: type(value).__name__)
def test_an_object_shows_what_it_is_and_comes_back_from_a_pickle(thing, words):
    assert repr(thing).startswith(words), repr(thing)
    again = pickle.loads(pickle.dumps(thing))
    assert again is not thing and same(thing, again)
    assert copy.copy(thing) is thing and copy.deepcopy([thing])[0] is thing


def test_what_comes_back_computes_the_same():
    tool, cut, lines, contact = pickle.loads(pickle.dumps((TOOL, CUT, LINES, CONTACT)))
    assert np.array_equal(thinwall.lobes(tool, cut, [7000.0]).limiting_depth_m, thinwall.lobes(TOOL, CUT, 7000.0).limiting_depth_m)
    other = thinwall.oscillators([(500.0, 0.02, 1e6, "x")], "P")
    flexible = thinwall.Contact("tip", "P", "x", 2e6)
    assert np.array_equal(thinwall.couple([tool, other], pickle.loads(pickle.dumps(flexible))).K, thinwall.couple([TOOL, other], flexible).K)
    assert np.array_equal(lines.entry("tip.x", "tip.x"), LINES.entry("tip.x", "tip.x"))
    assert repr(contact) == repr(CONTACT)
    case = pickle.loads(pickle.dumps(thinwall.Case.load(CASE, ["part.thickness=3 mm"])))
    assert case.value("part.thickness") == 0.003


def test_models_of_parts_show_what_they_are_and_say_that_they_cannot_travel():
    part = thinwall.assemble(WALL, STEEL, fixed="z_min", order=1)
    assert repr(part) == f"<Model of {part.K.shape[0]} free rows, {part.mass_kg:.4g} kg, 0 rigid motions>"
    modes = thinwall.modes(part, 2)
    assert repr(modes).startswith("<Modes: 2 from ") and repr(modes).endswith(" Hz>")
    reduced = thinwall.craig_bampton(part, thinwall.Point("P", (0.025, 0.005, 0.03), "y", 0.005), modes=3)
    assert repr(reduced) == f"<CraigBampton of {part.K.shape[0]} free rows to 4 coordinates, 4 DOFs: P.y, mode 1, mode 2, mode 3>"
    assert copy.deepcopy(part) is part
    for each in (part, modes, reduced):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(each)


def test_one_value_stands_where_a_list_is_expected():
    one = thinwall.lobes(TOOL, CUT, 7000.0)
    for speeds in ([7000.0], (7000,), np.array([7000]), np.array(7000.0), np.float64(7000.0), 7000):
        assert np.array_equal(one.limiting_depth_m, thinwall.lobes(TOOL, CUT, speeds).limiting_depth_m)
    assert np.array_equal(thinwall.receptances(TOOL, 900.0).H, LINES.H[1:2])
    assert np.array_equal(thinwall.Response(900.0, 1e-6, "P.x").H, [[[1e-6]]])
    assert thinwall.SpatialModel([[1.0]], [[4.0]], "P.x").dofs == ["P.x"]
    assert thinwall.Case.load(CASE, "part.thickness=3 mm").value("part.thickness") == 0.003
    assert np.array_equal(thinwall.with_modal_damping(TOOL, 0.01, 0.03).C, thinwall.with_modal_damping(TOOL, 0.01, [0.03]).C)
    with pytest.raises(TypeError, match="spindle_speeds_rpm"):
        thinwall.lobes(TOOL, CUT, "fast")
    with pytest.raises(TypeError, match="spindle_speeds_rpm"):
        thinwall.lobes(TOOL, CUT, None)


def test_one_helix_stands_for_all_teeth_as_in_a_case():
    def cut(**angles):
        return thinwall.MillingProcess(teeth=3, diameter_m=0.01, K_t=600e6, K_r=200e6, radial_depth_m=0.001, **angles)

    depth = thinwall.lobes(TOOL, cut(helices_rad=[0.6, 0.6, 0.6]), 7000.0).limiting_depth_m
    for helix in (0.6, [0.6], np.array([0.6])):
        assert np.array_equal(thinwall.lobes(TOOL, cut(helices_rad=helix), 7000.0).limiting_depth_m, depth)
    with pytest.raises(thinwall.InputError, match="2"):
        cut(helices_rad=[0.6, 0.5])
