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
