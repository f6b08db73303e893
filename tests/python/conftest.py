"""Runs of the program that the tests read; THINWALL_PROGRAM names it, ctest sets it."""

import os
import pathlib
import sys

import pytest
import thinwall

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
from shared_runs import shared_run  # noqa: E402


@pytest.fixture(scope="session", name="run_case")
def runner():
    """A function from the name of a case, and what is set in it to be quick, to its results. What is set may cost an
    expectation of the case (exit code 6)."""
    program = os.environ.get("THINWALL_PROGRAM")

    def run(case, *settings):
        if program is None:
            pytest.skip("THINWALL_PROGRAM does not name the program")
        folder, code = shared_run(pathlib.Path(program), ROOT, case, settings)
        assert code in ((0, 6) if settings else (0,))
        return thinwall.read_results(folder)

    return run
