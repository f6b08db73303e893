#!/usr/bin/env python3
"""A sweep by GNU parallel is the serial one. Skipped (exit code 77) where parallel is not installed.

Usage: parallel_test.py THINWALL CASE
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

KEY = "cutting.radial_depth=0.5 mm:1 mm:0.1 mm"


def main():
    thinwall, case = sys.argv[1:3]
    if shutil.which("parallel") is None:
        print("SKIPPED: GNU parallel is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="a sweep ") as name:  # the blanks are to be quoted twice
        folder = pathlib.Path(name)
        # Without the expectations of the case, which are those of one point.
        case = shutil.copytree(case, folder / "case", ignore=shutil.ignore_patterns("expected.toml"))
        sweep = [thinwall, "sweep", str(case), KEY, "--set", "lobes.count=8", "--threads", "1", "--out"]
        subprocess.run([*sweep, str(folder / "serial"), "-q"], check=True, stdout=subprocess.DEVNULL)
        jobs = folder / "jobs"
        told = subprocess.run([*sweep, str(jobs), "--parallel", "--shards", "2"], check=True, capture_output=True,
                              text=True)
        assert "2 shards" in told.stdout and not list(jobs.glob("*/point.json")), told.stdout
        subprocess.run(["bash", str(jobs / "parallel.sh")], check=True, stdout=subprocess.DEVNULL)
        merged, serial = (path.read_text(encoding="utf-8")
                          for path in (jobs / "merged" / "sweep.csv", folder / "serial" / "sweep.csv"))
        assert merged == serial, merged
        print("equal to the serial sweep")


if __name__ == "__main__":
    main()
