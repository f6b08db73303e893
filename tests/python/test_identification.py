"""Modes of receptances whose structure is known."""

import numpy as np
import pytest

import thinwall

TIP = thinwall.oscillators([(120.0, 0.02, 2e6, (0.6, 0.8, 0.0)), (310.0, 0.04, 9e6, "x"), (480.0, 0.015, 2e7, "y")], "tip")
HZ = np.linspace(40.0, 700.0, 900)
EXACT = thinwall.receptances(TIP, HZ)


def noisy(relative):
    """The receptances with noise of real and imaginary part alike, relative to their size."""
    random = np.random.default_rng(4)
    H = EXACT.H
    noise = relative * np.abs(H) * (random.standard_normal(H.shape) + 1j * random.standard_normal(H.shape))
    return thinwall.Response(HZ, H + noise, EXACT.responses, EXACT.forces)


def test_exact_lines_give_the_modes_and_a_model():
    fit = thinwall.fit_modes(EXACT, terms="constant")
    modal = thinwall.to_modal(TIP)
    assert np.allclose(fit["frequency_hz"], modal.frequency_hz, rtol=1e-8)
    assert np.allclose(fit["damping_ratio"], modal.damping_ratio, rtol=1e-7)
    again = thinwall.receptances(fit["model"], HZ)
    assert again.responses == EXACT.responses
    assert np.abs(again.H - EXACT.H).max() < 1e-8 * np.abs(EXACT.H).max()
    assert fit["warnings"] == []


def test_noise_is_told_by_deviations_and_by_chi_square():
    fit = thinwall.fit_modes(noisy(0.01), noise=0.01, terms="none")
    modal = thinwall.to_modal(TIP)
    assert abs(fit["chi2_per_dof"] - 1.0) < 0.06
    assert np.all(np.abs(fit["frequency_hz"] - modal.frequency_hz) < 4.0 * fit["frequency_sd_hz"])
    assert np.all(np.abs(fit["damping_ratio"] - modal.damping_ratio) < 4.0 * fit["damping_ratio_sd"])
    low = thinwall.fit_modes(noisy(0.01), band_hz=(40.0, 200.0))
    assert low["fitted"].frequency_hz[-1] <= 200.0
    assert np.isclose(low["frequency_hz"][0], 120.0, rtol=1e-3)


def test_what_cannot_be_fitted_is_refused():
    for wrong in ({"residues": "round"}, {"terms": "9"}, {"band_hz": [1.0]}, {"noise": -1.0},
                  {"coherence": np.ones(3), "averages": 4}):
        with pytest.raises(thinwall.InputError):
            thinwall.fit_modes(EXACT, **wrong)


def test_poles_are_chosen_by_their_frequencies_from_the_diagram():
    every = thinwall.fit_modes(noisy(0.01), noise=0.01, terms="none", order=20)
    diagram = every["diagram"]
    assert diagram["order"].max() == 20
    assert len({len(column) for column in diagram.values()}) == 1
    stable = diagram["frequency_hz"][diagram["stable"]]
    for hz in every["frequency_hz"]:
        assert np.sum(np.abs(stable / hz - 1.0) < 0.01) > 3
    chosen = thinwall.fit_modes(noisy(0.01), noise=0.01, terms="none", poles_hz=every["frequency_hz"][[0, 2]] * 1.004)
    assert len(chosen["frequency_hz"]) == 2
    assert chosen["chi2_per_dof"] > 2.0
    assert any("chi2" in warning for warning in chosen["warnings"])
