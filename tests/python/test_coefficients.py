"""Cutting coefficients of forces that follow from known ones."""

import numpy as np
import pytest

import thinwall

K = {"K_t": 7.5e8, "K_r": 2.4e8, "K_a": -1.1e8, "K_te": 18e3, "K_re": 22e3, "K_ae": 3e3}
TEETH, DEPTH = 2, 2e-3


def forces(feed, angle, runout):
    """The forces of straight teeth in a slot on the tool, and the angles' rows: feed, normal, axis."""
    total = np.zeros((angle.size, 3))
    for tooth in range(TEETH):
        phi = (angle - tooth * np.pi) % (2.0 * np.pi)
        other = (tooth + 1) % TEETH
        h = np.minimum(feed * np.sin(phi) + runout[tooth] - runout[other], 2.0 * feed * np.sin(phi))
        cuts = (phi < np.pi) & (h > 0.0)
        t = np.array([np.cos(phi), -np.sin(phi), 0.0 * phi]).T
        r = np.array([np.sin(phi), np.cos(phi), 0.0 * phi]).T
        for axis, chip, edge in ((-t, "K_t", "K_te"), (-r, "K_r", "K_re"), (np.array([0.0, 0.0, 1.0]), "K_a", "K_ae")):
            total += (DEPTH * np.where(cuts, K[chip] * h + K[edge], 0.0))[:, None] * axis
    return total


ANGLE = 2.0 * np.pi * (np.arange(90) + 0.5) / 90
FEEDS = (4e-5, 8e-5)


def test_forces_over_the_angle_give_coefficients_and_runout():
    runout = (5e-6, -5e-6)
    force = np.vstack([forces(feed, ANGLE, runout) for feed in FEEDS])
    fit = thinwall.edge_force_coefficients(TEETH, 0.01, np.repeat(FEEDS, ANGLE.size), DEPTH, np.tile(ANGLE, 2), force)
    assert fit["converged"]
    for name, value in K.items():
        assert np.isclose(fit[name][0], value, rtol=1e-8)
    assert np.allclose([offset[0] for offset in fit["runout_m"]], runout, rtol=1e-8)


def test_mean_forces_give_coefficients():
    fine = 2.0 * np.pi * (np.arange(20000) + 0.5) / 20000
    means = [forces(feed, fine, (0.0, 0.0)).mean(axis=0) for feed in FEEDS]
    fit = thinwall.mean_force_coefficients(TEETH, FEEDS, DEPTH, means)
    for name, value in K.items():
        assert np.isclose(fit[name][0], value, rtol=1e-6)
    with pytest.raises(thinwall.InputError, match="twice the feed per tooth"):
        thinwall.mean_force_coefficients(TEETH, FEEDS[0], DEPTH, [means[0], means[0]])
    with pytest.raises(thinwall.InputError, match="depth_m has 3 values"):
        thinwall.mean_force_coefficients(TEETH, FEEDS, [DEPTH] * 3, means)
