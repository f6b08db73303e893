"""Cases and the whole workflow in memory, against the command line on the same case."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import thinwall

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASE = ROOT / "cases" / "barrios-2019"
QUICK = ["part.mesh.tolerance=0.05", "lobes.count=24"]


def test_run_gives_the_figures_of_the_command_line_to_the_last_digit(tmp_path):
    program = os.environ["THINWALL_PROGRAM"]
    words = [word for setting in QUICK for word in ("--set", setting)]
    subprocess.run([program, "run", CASE, "--out", tmp_path, "-q", *words], check=True, capture_output=True)
    by_command = thinwall.read_results(tmp_path)
    stages = []
    computed = thinwall.run(thinwall.Case.load(CASE, QUICK), progress=stages.append)
    assert stages[-1] == "lobes"
    for name, chart in computed.lobes.items():
        table = by_command.lobes[name]
        assert np.array_equal(chart.limiting_depth_m, table["limiting_depth_m"])
        assert np.array_equal(chart.spindle_speed_rpm, table["spindle_speed_rpm"])
    for key in ("part", "reduction", "coupling", "lobes", "contacts", "updating"):
        assert computed.summary[key] == by_command.summary[key], key
    assert set(computed.frf) == {"part", "robot", "coupled_receptance", "coupled_spatial"}


OSCILLATOR = """
tool = { teeth = 2, diameter = "10 mm", length = "20 mm", modes = [
  { frequency = "922 Hz", damping_ratio = 0.011, stiffness = "1.34e6 N/m", direction = "x" },
  { frequency = "922 Hz", damping_ratio = 0.011, stiffness = "1.34e6 N/m", direction = "y" } ] }
cutting = { radial_depth = "0.5 mm", Kt = "600 N/mm^2", Kr = "200 N/mm^2", feed_per_tooth = "0.1 mm" }
lobes = { from = "11000 rpm", to = "19000 rpm", count = 9 }
"""


def test_simulated_points_and_maps_of_a_run_are_those_of_its_summary():
    case = thinwall.Case.parse(
        OSCILLATOR + 'simulation = { at = ["11000 rpm, 1 mm", "19000 rpm, 2 mm"], settling_turns = 1000, map = '
        '{ speeds = 3, depths = 2, deepest = "2 mm", turns = 1200 } }'
    )
    stages = []
    results = thinwall.run(case, progress=stages.append)
    assert stages[-1] == "simulation"
    stable, flip = results.simulations
    assert (stable["motion"], flip["motion"], flip["period"]) == ("periodic", "period_n", 2)
    assert flip["peak_to_peak_m"] == pytest.approx([144.6e-6, 102.5e-6, 0], rel=1e-3)
    assert abs(flip["growth_difference"]) < 1e-6
    assert stable["forced_difference"] < 1e-5
    assert flip["forced_difference"] is None
    for point, told in zip(results.simulations, results.summary["simulation"]["points"]):
        assert point["peak_to_peak_m"] == pytest.approx(told["peak_to_peak_m"], rel=1e-12)
        assert point["multiplier_march"] == pytest.approx(told["growth"]["march_modulus"], rel=1e-12)
    amplitudes = results.amplitude_maps["tool"]
    assert amplitudes["peak_to_peak_m"].shape == (2, 3)
    assert amplitudes["spindle_speed_rpm"] == pytest.approx([11000, 15000, 19000])
    assert amplitudes["peak_to_peak_m"][1, 2] == pytest.approx(144.6e-6, rel=1e-2)
    assert thinwall.run(thinwall.Case.parse(OSCILLATOR)).simulations == []


def test_a_case_with_another_value_is_another_case():
    case = thinwall.Case.load(CASE)
    thinner = case.with_("part.thickness", "5 mm")
    assert thinner.value("part.thickness") == 0.005
    assert case.value("part.thickness") != 0.005
    assert case.with_("part.thickness", 0.005).value("part.thickness") == 0.005
    with pytest.raises(thinwall.InputError, match="part.thickness"):
        case.with_("part.thickness", "5 kg")


def test_check_tells_every_problem_with_its_place_and_computes_nothing():
    assert thinwall.check(CASE) == []
    problems = thinwall.check(CASE, ["part.thickness=-5 mm", "lobes.count=1"])
    assert len(problems) == 2
    assert any("part.thickness" in problem for problem in problems)
    assert any("lobes.count" in problem for problem in problems)


def test_what_the_progress_raises_ends_the_call():
    def stop(stage):
        raise RuntimeError(stage)

    with pytest.raises(RuntimeError):
        thinwall.run(thinwall.Case.load(CASE, QUICK), progress=stop)


def test_a_robot_over_its_postures_is_mapped(tmp_path):
    """Two modes along x and y, 20 e^(0.05 u) and 40 e^(-0.03 u) Hz, at nine postures u."""
    lines = ["posture,u"]
    for i in range(9):
        u = 0.5 * i
        lines.append(f"p{i},{u}")
        rows = [f"{20 * np.exp(0.05 * u)},0.02,0.009,0,0,-0.009,0.001,0,0,-0.001", f"{40 * np.exp(-0.03 * u)},0.03,0.001,0,0,-0.001,0.009,0,0,-0.009"]
        header = "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,L_1Y_im"
        (tmp_path / f"p{i}.csv").write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    (tmp_path / "postures.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    case = thinwall.Case.parse(
        """
robot = { model = "modal_table", carries = "tool", postures = "postures.csv", table = "{posture}.csv", over = ["u"], at = [1.7] }
tool = { teeth = 2, diameter = "10 mm", length = "60 mm" }
cutting = { radial_depth = "5 mm", Kt = "600 N/mm^2", spindle_speed = "700 rpm" }
""",
        tmp_path,
    )
    found = thinwall.study_postures(case, ["map", "next"], grid=5, path=[[3.9]], candidates=[[0.2], [3.8]])
    assert np.allclose(found["map_places"][:, 0], np.linspace(0, 4, 5))
    assert np.allclose(found["map_first_hz"][:, 0], 20 * np.exp(0.05 * found["map_places"][:, 0]), rtol=1e-3)
    assert np.all(found["map_depth_m"][:, 1] <= found["map_depth_m"][:, 2])
    assert found["next"]["at"] == [3.8]
    assert "shared" not in found
    with pytest.raises(thinwall.InputError, match="is no part"):
        thinwall.study_postures(case, "maps")
