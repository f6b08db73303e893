"""Milling in the time domain from Python: against the chart, and the figures of one motion among each other."""

import numpy as np
import pytest
import thinwall

STIFFNESS = 0.03993 * (2 * np.pi * 922.0) ** 2
TOOL = thinwall.oscillators([(922.0, 0.011, STIFFNESS, "x"), (922.0, 0.011, STIFFNESS, "y")], "tip")
CUT = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=6e8, K_r=2e8, radial_depth_m=0.0005)


def test_growth_is_the_multiplier():
    growth = thinwall.simulated_growth(TOOL, CUT, 19000.0, 2e-3)
    assert growth["converged"]
    assert growth["modulus"] == pytest.approx(1.1192846996, abs=1e-8)
    assert growth["modulus"] == pytest.approx(thinwall.multiplier(TOOL, CUT, 19000.0, 2e-3).modulus, rel=1e-5)


def test_vibration_stays_below_the_boundary_and_doubles_its_period_above():
    stable = thinwall.simulate(TOOL, CUT, 11000.0, 1e-3, 1e-4, settling_turns=2000, wall_turns=4)
    assert (stable["status"], stable["motion"]) == ("completed", "periodic")
    assert stable["walls"][0]["mean_m"] == pytest.approx(-6.5416e-6, rel=1e-3)
    chatter = thinwall.simulate(TOOL, CUT, 19000.0, 2e-3, 1e-4, settling_turns=2000, traced_turns=2)
    assert (chatter["motion"], chatter["period"]) == ("period_n", 2)
    assert chatter["peak_to_peak_m"][0] == pytest.approx(144.598e-6, rel=1e-3)
    trace = chatter["trace"]
    assert trace["displacement_m"].shape == (len(trace["time_s"]), 3)
    assert np.ptp(trace["displacement_m"][:, 0]) == pytest.approx(chatter["peak_to_peak_m"][0], rel=1e-2)


def test_exact_paths_shift_the_limit_cycle():
    exact = thinwall.simulate(TOOL, CUT, 19000.0, 2e-3, 1e-4, paths="exact", settling_turns=500)
    assert exact["peak_to_peak_m"][0] == pytest.approx(151.885e-6, rel=2e-3)


def test_what_cannot_be_simulated_is_told():
    with pytest.raises(thinwall.InputError, match="feed per tooth 0 m"):
        thinwall.simulate(TOOL, CUT, 19000.0, 2e-3, 0.0)
    with pytest.raises(thinwall.InputError, match="circular"):
        thinwall.simulate(TOOL, CUT, 19000.0, 2e-3, 1e-4, paths="straight")
    arc = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=6e8, K_r=2e8, arc_rad=(1.0, 2.0))
    with pytest.raises(thinwall.InputError, match="radial_depth_m"):
        thinwall.simulate(TOOL, arc, 19000.0, 2e-3, 1e-4, paths="exact")
