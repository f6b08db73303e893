#!/usr/bin/env python3
"""`thinwall run --ranks`: the results of one process, and what is said when a part of it is missing or fails.

    ranks_test.py PROGRAM CASE [TEST ...]     exits with 77, "skipped", where thinwall-mpi is not built
"""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(sys.argv[1])
CASE = sys.argv[2]
SMALL = ["part.mesh.element_size=\"12 mm\"", "part.mesh.order=2", "lobes.count=5", "response.lines=50",
         "reduction.up_to=\"6 kHz\"", "modes.count=6"]
LARGE = ["part.mesh.element_size=\"4 mm\"", "part.mesh.order=3"]  # its factor takes seconds


def words(folder, values, ranks=2):
    """The command line of a run into a folder."""
    sets = [word for value in values for word in ("--set", value)]
    return [str(PROGRAM), "run", CASE, *sets, "--out", str(folder), "--ranks", str(ranks), "--progress", "never"]


def run(folder, values=(), ranks=2, **environment):
    """The finished process of a run."""
    return subprocess.run(words(folder, [*SMALL, *values], ranks), capture_output=True, text=True, timeout=300,
                          check=False, env={**os.environ, **environment})


def rank_processes(parent):
    """The numbers of the thinwall-mpi processes below a process."""
    below = {parent}
    found = []
    for entry in sorted((int(p.name) for p in pathlib.Path("/proc").iterdir() if p.name.isdigit())):
        try:
            stat = pathlib.Path(f"/proc/{entry}/stat").read_text(encoding="utf-8")
        except OSError:
            continue
        name = stat[stat.index("(") + 1:stat.rindex(")")]
        if int(stat[stat.rindex(")") + 2:].split()[1]) in below:
            below.add(entry)
            if name == "thinwall-mpi":
                found.append(entry)
    return found


class Ranks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def error_of(self, process, code):
        """The one line that a run which fails prints; it leaves no results."""
        self.assertEqual(process.returncode, code, process.stderr)
        lines = [line for line in process.stderr.splitlines() if line.startswith("thinwall:")]
        self.assertEqual(len(lines), 1, process.stderr)
        self.assertFalse((self.folder / "out" / "summary.json").exists())
        return lines[0]

    def begun(self):
        """A run whose ranks are at work on a large factor."""
        process = subprocess.Popen(words(self.folder / "out", LARGE), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, bufsize=1)
        for line in process.stderr:
            if "rows on 2 ranks" in line:
                break
        else:
            self.fail("the ranks were not asked for a factor")
        return process

    def test_results_are_those_of_one_process(self):
        for ranks in (1, 2):
            process = run(self.folder / str(ranks), ranks=ranks)
            self.assertIn(process.returncode, (0, 6), process.stderr)
            self.assertEqual("rows on 2 ranks" in process.stderr, ranks == 2, process.stderr)
        compared = subprocess.run([str(PROGRAM), "compare", str(self.folder / "1"), str(self.folder / "2"), "--all",
                                   "--tolerance", "1e-7"], capture_output=True, text=True, timeout=60, check=False)
        self.assertIn(compared.returncode, (0, 6), compared.stderr)
        # Between resonances the same absolute differences are larger relative ones, and the crossings behind the first
        # are sought as far as the chart's tolerance only.
        differing = [line for line in compared.stdout.splitlines()
                     if " against " in line and not line.startswith(("frf/", "lobes/part_crossings.csv"))]
        self.assertEqual(differing, [], compared.stdout)

    def test_a_factor_on_disk_gives_the_same_frequencies(self):
        for name, words_of_run in (("memory", []), ("disk", ["--low-memory"])):
            process = subprocess.run([*words(self.folder / name, SMALL, 1), *words_of_run], capture_output=True, text=True,
                                     timeout=300, check=False)
            self.assertIn(process.returncode, (0, 6), process.stderr)
            self.assertEqual("on disk" in process.stderr, name == "disk", process.stderr)
        tables = [(self.folder / name / "modes" / "modes.csv").read_text(encoding="utf-8").splitlines()
                  for name in ("memory", "disk")]
        for one, other in zip(*([line.split(",") for line in table[1:]] for table in tables)):
            self.assertAlmostEqual(float(one[1]) / float(other[1]), 1.0, delta=1e-10)

    def test_a_rank_that_dies_is_one_line(self):
        process = self.begun()
        ranks = rank_processes(process.pid)
        self.assertEqual(len(ranks), 2)
        os.kill(ranks[1], signal.SIGKILL)
        _, errors = process.communicate(timeout=60)
        process.stderr = errors
        line = self.error_of(process, 5)
        self.assertIn("signal 9", line)
        self.assertEqual(rank_processes(process.pid), [])

    def test_an_interruption_ends_program_and_ranks(self):
        process = self.begun()
        ranks = rank_processes(process.pid)
        began = time.monotonic()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        # Half a second on an idle machine; on a loaded one it is "not when the factor is done".
        self.assertLess(time.monotonic() - began, 5.0)
        self.assertEqual(process.returncode, 130)
        deadline = time.monotonic() + 20.0
        while any(pathlib.Path(f"/proc/{rank}/status").exists() for rank in ranks):
            self.assertLess(time.monotonic(), deadline, "ranks are left")
            time.sleep(0.02)

    def test_what_is_missing_is_said_with_what_to_install(self):
        line = self.error_of(run(self.folder / "out", THINWALL_MPI="/nowhere/thinwall-mpi"), 2)
        self.assertIn("thinwall-mpi", line)
        self.assertIn("libmumps-dev", line)
        line = self.error_of(run(self.folder / "out", THINWALL_MPIRUN="no-such-mpirun --flag"), 2)
        self.assertIn("no-such-mpirun", line)
        self.assertIn("openmpi-bin", line)
        line = self.error_of(run(self.folder / "out", THINWALL_MPIRUN="mpirun --no-such-flag"), 2)
        self.assertIn("did not start the ranks", line)
        line = self.error_of(run(self.folder / "out", TMPDIR="/nowhere"), 4)
        self.assertIn("/nowhere", line)

    def test_a_program_that_mpirun_has_started_is_told(self):
        line = self.error_of(run(self.folder / "out", OMPI_COMM_WORLD_SIZE="3"), 2)
        self.assertIn("one of 3", line)
        self.assertIn("start it without", line)
        line = self.error_of(run(self.folder / "out", SLURM_STEP_NUM_TASKS="2"), 2)
        self.assertIn("one of 2", line)
        process = run(self.folder / "out", ranks=1, SLURM_STEP_NUM_TASKS="2")
        self.assertIn(process.returncode, (0, 6), process.stderr)
        self.assertIn("started 2 of this program", process.stderr)
        process = run(self.folder / "one", ranks=1, SLURM_STEP_NUM_TASKS="1")
        self.assertNotIn("of this program", process.stderr)

    def test_more_ranks_than_there_is_memory_for_are_refused(self):
        command = [*words(self.folder / "out", SMALL, ranks=4096), "--memory", "1 GB"]
        line = self.error_of(subprocess.run(command, capture_output=True, text=True, timeout=300, check=False), 5)
        self.assertIn("4096 processes on this machine", line)

    def test_an_mpirun_of_another_kind_is_told(self):
        other = self.folder / "mpirun-of-another-kind"
        other.write_text("#!/bin/sh\n# It starts processes that do not know of each other.\nshift 2\nexec \"$@\"\n",
                         encoding="utf-8")
        other.chmod(0o755)
        line = self.error_of(run(self.folder / "out", THINWALL_MPIRUN=str(other)), 2)
        self.assertIn("processes of 1 rank each", line)


if __name__ == "__main__":
    if not (PROGRAM.parent / "thinwall-mpi").exists():
        print("thinwall-mpi is not built")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
