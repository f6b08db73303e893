"""Runs of the program that the tests read; THINWALL_PROGRAM names it, ctest sets it."""

import os
import pathlib
import subprocess

import pytest
import thinwall

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session", name="run_case")
def runner(tmp_path_factory):
    """A function from the name of a case, and what is set in it to be quick, to its results; each runs once. What is set
    may cost an expectation of the case (exit code 6)."""
    program, known = os.environ.get("THINWALL_PROGRAM"), {}

    def run(case, *settings):
        if program is None:
            pytest.skip("THINWALL_PROGRAM does not name the program")
        if (case, settings) not in known:
            folder = tmp_path_factory.mktemp(case)
            words = [word for setting in settings for word in ("--set", setting)]
            done = subprocess.run([program, "run", ROOT / "cases" / case, "--out", folder, "-q", *words], check=False)
            assert done.returncode in ((0, 6) if settings else (0,))
            known[case, settings] = thinwall.read_results(folder)
        return known[case, settings]

    return run
