"""The examples and the snippets of the docs run, and print what they should."""

import json
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(script, *words, folder=None):
    """What a script prints, run by itself without a screen."""
    environment = os.environ | {"MPLBACKEND": "Agg"}
    done = subprocess.run(
        [sys.executable, "-W", "ignore:.*non-GUI.*", script, *words],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def number(pattern, text):
    found = re.search(pattern, text)
    assert found, f"{pattern} is not in\n{text}"
    return float(found.group(1))


def test_plate_to_lobes():
    text = run(ROOT / "examples/python/plate_to_lobes.py")
    # A clamped-free plate strip, 3.516/(2π) √(E h²/(12 ρ (1 − ν²)))/L²; the wall is twice as wide as high only.
    assert number(r"\[ *([\d.]+)", text) == pytest.approx(475.0, rel=0.02)
    alone = number(r"alone +least depth +([\d.]+)", text)
    assert number(r"with the robot +least depth +([\d.]+)", text) > 2 * alone


def test_lobes_from_frf():
    text = run(ROOT / "examples/python/lobes_from_frf.py")
    closed = number(r"closed form ([\d.]+) mm", text)
    assert closed == pytest.approx(6.18, rel=1e-3)  # 2 k ζ (1 + ζ) / K_r
    assert number(r"least depth ([\d.]+) mm", text) == pytest.approx(closed, rel=5e-3)
    assert number(r"peak at ([\d.]+) Hz", text) == pytest.approx(600.0, rel=1e-3)


# Settings that make a case quick. If a page of the docs adds the same ones in this order, one run serves both.
COARSE = {
    "barrios-2019-measured": ("part.mesh.tolerance=0.05",),
    "cantilever-wall": ("part.mesh.tolerance=0.05", "lobes.count=10"),
    "huynh-2017": ("lobes.count=5",),
    "huynh-2017-support": ("lobes.count=3",),
    "irb6660-measured": (
        "part.mesh.tolerance=0.05",
        "lobes.count=3",
        "response.to=6 kHz",
        "response.lines=2999",
        "reduction.up_to=10 kHz",
    ),
    "posture-map": ("lobes.count=20",),
    "pocketed-rib": ("part.mesh.tolerance=0.1", "part.mesh.order=3", "lobes.count=10"),
}


SHARED = {  # one script for two cases
    "bondarenko-2012-b": "bondarenko-2012-bc",
    "bondarenko-2012-c": "bondarenko-2012-bc",
    "insperger-mann-2003-up": "insperger-mann-2003",
    "insperger-mann-2003-down": "insperger-mann-2003",
    "ji-liu-2024-x": "ji-liu-2024",
    "ji-liu-2024-y": "ji-liu-2024",
}


def script_of(case):
    return ROOT / f"examples/python/{SHARED.get(case, case).replace('-', '_')}.py"


def example(run_case, case):
    """What the script of a case prints."""
    results = run_case(case, *COARSE.get(case, ()))
    return run(script_of(case), str(results.folder))


def test_every_case_has_a_script_in_cells():
    for case in ROOT.glob("cases/*/case.toml"):
        text = script_of(case.parent.name).read_text(encoding="utf-8")
        assert text.startswith("# %% [markdown]\n# # ") and text.count("\n# %%\n") >= 3
        assert f'"results/{case.parent.name}"' in text and "plt.show()" in text


def equal_to_the_program(text):
    """The scripts couple what the program coupled, from files that hold every digit."""
    return number(r"equal to ([\d.e+-]+)", text) < 1e-9


def test_barrios_2019(run_case):
    text = example(run_case, "barrios-2019")
    assert equal_to_the_program(text)
    assert number(r"part +([\d.]+) Hz", text) == pytest.approx(212.0, rel=0.01)  # published


def test_barrios_2019_measured(run_case):
    text = example(run_case, "barrios-2019-measured")
    assert equal_to_the_program(text)
    assert number(r"contact inf N/m: ([\d.]+) %", text) == pytest.approx(99.96, abs=0.01)  # published
    falls = [number(rf"contact {stiffness} N/m: ([\d.]+) %", text) for stiffness in (r"1e\+05", r"1e\+06", r"1e\+07", "inf")]
    assert falls == sorted(falls)


def test_cantilever_wall(run_case):
    text = example(run_case, "cantilever-wall")
    program, module, half = (
        [float(hz) for hz in re.search(rf"{name} +\[ *([\d. ]+)\]", text).group(1).split()]
        for name in ("by the program", "by the module", "half the wall")
    )
    # A clamped-free plate strip has 475.0 Hz; Rayleigh-Ritz: both meshes are of elements that converge from above.
    assert program[0] == pytest.approx(475.0, rel=0.02) and module == pytest.approx(program, rel=2e-3)
    assert half == pytest.approx([hz / 2 for hz in module], rel=0.01)  # of a thin plate in proportion to the thickness
    assert number(r"at corner +([\d.]+)", text) > number(r"at P +([\d.]+)", text)


def test_ding_2010(run_case):
    text = example(run_case, "ding-2010")
    assert number(r"direct +off by +([\d.]+) %", text) < 0.02  # twice the tolerance of 1e-4
    assert number(r"direct .*, +(\d+) flips", text) > 0
    assert number(r"zeroth_order .*, +(\d+) flips", text) == 0  # an average force has no flips


def test_hajdu_2020(run_case):
    text = example(run_case, "hajdu-2020")
    assert number(r"tap test: (\d+) of 58 right", text) / 58 == pytest.approx(0.74, abs=0.06)  # published: 87 of 118


@pytest.mark.parametrize(("half", "right"), [("up", 24), ("down", 17)])
def test_insperger_mann_2003(run_case, half, right):
    text = example(run_case, f"insperger-mann-2003-{half}")
    assert number(r"(\d+) of \d+ right", text) >= right  # together the published 41
    assert text.count("boundary") == number(r"\d+ of (\d+) right", text) - number(r"(\d+) of \d+ right", text)


@pytest.mark.parametrize("feed", ["x", "y"])
def test_ji_liu_2024(run_case, feed):
    text = example(run_case, f"ji-liu-2024-{feed}")
    # The geometric mean of the four published K_t, and the larger deviation of the logarithms of K_t and K_r.
    tangential = np.log([600.46, 767.01, 951.365, 1319.41])
    radial = np.log([180.96, 168.8, 262.597, 788.83])
    assert number(r"K_t ([\d.]+) N/mm", text) == pytest.approx(np.exp(tangential.mean()), rel=1e-3)
    spread = max(tangential.std(ddof=1), radial.std(ddof=1))
    assert number(r"spread ([\d.]+)", text) == pytest.approx(spread, abs=6e-3)


def test_huynh_2017(run_case):
    text = example(run_case, "huynh-2017")
    assert number(r"mode +([\d.]+) Hz", text) == pytest.approx(19.7036, abs=1e-4)  # independent (expected.toml)
    assert number(r"at the published speed .* ([\d.]+) times", text) > 1  # no chatter is reported


def test_bondarenko_2012_a(run_case):
    text = example(run_case, "bondarenko-2012-a")
    assert number(r"mean force (-?[\d.]+),", text) == pytest.approx(-39.452, rel=2e-3)  # independent
    assert number(r"normal ([\d.]+) N", text) == pytest.approx(143.854, rel=2e-3)  # independent


@pytest.mark.parametrize(("case", "end", "overshoot"), [("bondarenko-2012-b", -0.1315, 29.2), ("bondarenko-2012-c", -0.1315, 71.4)])
def test_bondarenko_2012(run_case, case, end, overshoot):
    text = example(run_case, case)
    assert number(r"from the trace: ends at (-?[\d.]+) mm", text) == pytest.approx(end, rel=1e-3)  # independent
    assert number(r"from the trace: .* ([\d.]+) %", text) == pytest.approx(overshoot, abs=1.5)  # independent


def test_huynh_2017_support(run_case):
    text = example(run_case, "huynh-2017-support")
    assert equal_to_the_program(text)
    stiffness = [float(value) for value in re.findall(r"([\d.]+) N/um along x", text)]
    assert stiffness == stiffness[::-1] and stiffness[0] < stiffness[len(stiffness) // 2]  # turned to either side by one angle
    depth = r" +the whole path allows ([\d.]+) mm"
    assert number("supported" + depth, text) > number("part" + depth, text)


def test_irb6660_measured(run_case):
    text = example(run_case, "irb6660-measured")
    assert equal_to_the_program(text)
    depths = [[float(mm) for mm in row.split()] for row in re.findall(r"\[ *([\d. ]+)\] mm", text)]
    shares = [a / b for a, b in zip(*depths)]
    assert all(0.93 < share < 1.05 for share in shares)  # recorded: −2 to +6 % without cross terms
    assert shares[0] != 1  # at 6000 rpm they change nothing that is printed


def test_lei_2022(run_case):
    text = example(run_case, "lei-2022")
    means = [float(percent) for percent in re.findall(r"(?:frequency|damping) ([\d.]+) %", text)]
    assert means == [1.21, 2.54, 0.31, 2.79]  # from the printed values, summed by hand
    assert number(r"within ([\d.]+) %", text) < 0.1  # the rounding of a frequency of 8.19 Hz
    assert 1.0 < number(r"10800 rpm: limit ([\d.]+) mm", text) < 2.0  # the trials


def test_posture_map(run_case):
    text = example(run_case, "posture-map")
    assert number(r"mode +([\d.]+) Hz", text) == pytest.approx(8.7512, rel=0.005)  # the truth at that posture
    assert number(r"chatter at ([\d.]+) Hz", text) < 200  # a mode of the arm; those of the spindle lie above 700 Hz


def test_pocketed_rib(run_case):
    text = example(run_case, "pocketed-rib")
    assert number(r"walls from ([\d.]+) mm", text) == pytest.approx(1.5, abs=0.01)  # the floor
    ratios = [float(percent) for percent in re.findall(r"damping ([\d.]+) %", text)]
    assert len(ratios) >= 3 and ratios == pytest.approx([0.6] * len(ratios), rel=0.05)  # what was put in


def test_tool_swap(run_case):
    text = example(run_case, "tool-swap")
    assert number(r"least depth ([\d.]+) mm", text) == pytest.approx(6.965, rel=0.01)  # that of the assembled machine
    flips = [float(waves) for waves in re.findall(r"flip +([\d.]+) waves", text)]
    assert len(flips) > 0 and all(waves % 1 == 0.5 for waves in flips)
    assert len(re.findall(r"hopf +[\d.]+ waves", text)) > 10


def test_the_own_speed_of_a_case_beside_a_nose_has_the_estimate_of_its_row(run_case):
    # The nose of a flip lobe is at 18593 rpm; a chart that is narrow and coarse has the own speed among its rows.
    settings = ["cutting.spindle_speed=18592.5 rpm", "lobes.from=18500 rpm", "lobes.to=18700 rpm", "lobes.count=9"]
    folder = run_case("tool-swap", *settings).folder
    own = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["lobes"][0]["at_case_speed"]
    table = [line.split(",") for line in (folder / "lobes/tool.csv").read_text(encoding="utf-8").splitlines()]
    row = next(line for line in table if line[0] == "18592.5")
    assert own["status"] == row[5] == "data_insufficient"
    assert own["error_estimate_relative"] == pytest.approx(float(row[4]), rel=1e-9)


def test_wall_path(run_case):
    text = example(run_case, "wall-path")
    assert equal_to_the_program(text)
    depth = r" +weakest.* the whole path up to ([\d.]+) mm"
    assert number("supported" + depth, text) > 10 * number("part" + depth, text)
    assert number(r"alone, ([\d.]+) at best", text) < 0.05 * number(r"softest at P: ([\d.]+)", text)


def snippets(document):
    """The python blocks of a Markdown file as one script, each in its place."""
    text = (ROOT / document).read_text(encoding="utf-8")
    return "\n".join(re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL))


def test_the_docs_snippets(run_case, tmp_path):
    (tmp_path / "results").mkdir()
    (tmp_path / "results/barrios-2019").symlink_to(run_case("barrios-2019").folder)
    (tmp_path / "tip.csv").symlink_to(ROOT / "examples/data/tip.csv")
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    script = tmp_path / "snippets.py"
    script.write_text(snippets("docs/python.md"), encoding="utf-8")
    assert script.read_text(encoding="utf-8").count("thinwall.") > 10
    run(script, folder=tmp_path)
