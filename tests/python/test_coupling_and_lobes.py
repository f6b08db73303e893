"""Components joined and cut: closed forms of one mode, both routes, the two ways into the chart."""

import numpy as np
import pytest
import thinwall

STIFFNESS, RATIO, HZ = 2e7, 0.03, 600.0
TOOL = [(HZ, RATIO, STIFFNESS, "x")]
# Four teeth in a full slot: the sum of sin² over the two in the cut is one, of sin cos none, so that the force against
# the motion along the feed is K_r w whatever the angle.
SLOT = thinwall.MillingProcess(teeth=4, diameter_m=0.012, K_t=600e6, K_r=200e6, radial_depth_m=0.012, direction="up")
LEAST_M = 2 * STIFFNESS * RATIO * (1 + RATIO) / 200e6  # −1 / (2 K_r min Re G)


def one_mode(hz):
    """Receptance of the tool."""
    r = np.asarray(hz) / HZ
    return 1 / (STIFFNESS * (1 - r**2 + 2j * RATIO * r))


def measured(step=2.5):
    hz = np.arange(step, 1500.0, step)
    return thinwall.Response(hz, one_mode(hz), ["tip.x"])


def test_two_oscillators_that_move_as_one():
    part = thinwall.oscillators([(100.0, 0.01, 1e6, "x")], "P")
    robot = thinwall.oscillators([(30.0, 0.02, 2e6, "x")], "R")
    both = thinwall.couple([part, robot], [thinwall.Contact("P", "R", "x")])
    masses = 1e6 / (2 * np.pi * 100.0) ** 2 + 2e6 / (2 * np.pi * 30.0) ** 2
    (hz,) = thinwall.to_modal(both).frequency_hz
    assert hz == pytest.approx(np.sqrt(3e6 / masses) / (2 * np.pi), rel=1e-9)


def test_both_routes_agree_through_a_spring_with_a_damper():
    part = thinwall.oscillators([(100.0, 0.01, 1e6, "x"), (170.0, 0.02, 3e6, "z")], "P")
    robot = thinwall.oscillators([(30.0, 0.02, 2e6, "x"), (45.0, 0.03, 2e6, "z")], "R")
    contact = thinwall.Contact("P", "R", "xz", stiffness=5e5, damping=20.0)
    hz = np.linspace(5.0, 250.0, 300)
    spatial = thinwall.receptances(thinwall.couple([part, robot], [contact]), hz)
    coupled = thinwall.couple([thinwall.receptances(c, hz) for c in (part, robot)], [contact])
    assert coupled.status == "well_conditioned" and np.all(coupled.kernel_condition < 1e3)
    assert thinwall.route_difference(spatial, coupled.response) < 1e-11
    # By hand along x: H = H_P − H_P (H_P + H_R + 1/Z)⁻¹ H_P.
    w = 2 * np.pi * hz

    def alone(f, ratio, k):
        return 1 / (k * (1 - (hz / f) ** 2 + 2j * ratio * hz / f))

    H_P, H_R = alone(100.0, 0.01, 1e6), alone(30.0, 0.02, 2e6)
    expected = H_P - H_P**2 / (H_P + H_R + 1 / (5e5 + 20j * w))
    assert coupled.response.entry("P.x", "P.x") == pytest.approx(expected, rel=1e-10)


def test_a_response_comes_back_as_it_went_in():
    H = np.arange(24).reshape(2, 3, 4) * (1 + 2j)
    rows, columns = ["A.x", "A.y", "B.rz"], ["A.x", "C.z", "C.(0.6,0.8,0)", "D.x"]
    response = thinwall.Response([1.0, 2.0], H, rows, columns)
    assert np.array_equal(response.H, H)
    assert response.responses == rows and response.forces == columns
    assert np.array_equal(response.entry("B.rz", "C.z"), H[:, 2, 1])


@pytest.mark.parametrize("structure", [measured(), thinwall.oscillators(TOOL, "tip")], ids=["samples", "poles"])
def test_least_depth_of_a_slot_with_four_teeth(structure):
    chart = thinwall.lobes(structure, SLOT, np.linspace(3000.0, 9000.0, 121))
    assert chart.rows_not_converged == 0
    # Between the speeds of a fine chart the depth rises a little above its least.
    assert LEAST_M * (1 - 1e-3) < chart.minimum_depth_m < LEAST_M * 1.005
    assert np.all(chart.limiting_depth_m >= LEAST_M * (1 - 1e-3))
    at = np.argmin(chart.limiting_depth_m)
    assert chart.spindle_speed_rpm[at] == chart.at_spindle_speed_rpm
    assert chart.chatter_frequency_hz[at] == pytest.approx(HZ * np.sqrt(1 + 2 * RATIO), rel=0.01)


def test_zeroth_order_is_exact_where_the_cut_does_not_change_with_the_angle():
    tool = thinwall.oscillators(TOOL, "tip")
    speeds = [3500.0, 5200.0, 8000.0]
    exact = thinwall.lobes(tool, SLOT, speeds, depth_limit_m=0.1)
    mean = thinwall.lobes(tool, SLOT, speeds, depth_limit_m=0.1, method="zeroth_order")
    assert mean.limiting_depth_m == pytest.approx(exact.limiting_depth_m, rel=1e-4)


def test_the_multiplier_reaches_the_circle_at_the_limiting_depth():
    tool = thinwall.oscillators([*TOOL, (500.0, 0.02, 1e7, "y")], "tip")
    cut = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=600e6, K_r=200e6, radial_depth_m=0.002)
    row = thinwall.lobes(tool, cut, [5000.0])
    depth = float(row.limiting_depth_m[0])
    assert not row.at_limit[0] and row.status == ["converged"]
    assert thinwall.multiplier(tool, cut, 5000.0, depth).modulus == pytest.approx(1.0, abs=1e-3)
    assert thinwall.multiplier(tool, cut, 5000.0, 0.9 * depth).modulus < 1 < (
        thinwall.multiplier(tool, cut, 5000.0, 1.1 * depth).modulus
    )


def test_an_arc_is_what_a_radial_depth_makes_of_it():
    tool = thinwall.oscillators(TOOL, "tip")
    common = {"teeth": 3, "diameter_m": 0.02, "K_t": 6e8, "K_r": 2e8}
    entry = np.arccos(2 * 0.005 / 0.02 - 1)
    by_depth = thinwall.MillingProcess(**common, radial_depth_m=0.005, direction="down")
    by_arc = thinwall.MillingProcess(**common, arc_rad=(entry, np.pi))
    depths = [thinwall.lobes(tool, cut, [4000.0]).limiting_depth_m[0] for cut in (by_depth, by_arc)]
    assert depths[0] == pytest.approx(depths[1], rel=1e-12)


def test_peaks_of_a_measured_receptance_are_its_modes():
    ((hz, ratio),) = thinwall.identify_modes(np.arange(2.5, 1500.0, 2.5), one_mode(np.arange(2.5, 1500.0, 2.5)))
    assert hz == pytest.approx(HZ, rel=1e-6)
    assert ratio == pytest.approx(RATIO, rel=1e-6)


def test_a_measured_file_is_read_in_its_unit(tmp_path):
    path = tmp_path / "tip.csv"
    lines = [f"{hz},{one_mode(hz).real * 1e6},{one_mode(hz).imag * 1e6}" for hz in (100.0, 200.0, 300.0)]
    path.write_text("\n".join(["frequency_hz,real,imag", *lines]))
    response = thinwall.read_frf(path, "tip.x", quantity="receptance", unit="um/N")
    assert response.entry("tip.x", "tip.x") == pytest.approx(one_mode(np.array([100.0, 200.0, 300.0])), rel=1e-12)
