#!/usr/bin/env python3
"""Runs a small case under injected faults and looks at what they leave: a result folder is of one run always.

    faults_test.py PROGRAM LIBRARY faults        some faults of every kind; every one with THINWALL_SLOW=1
    faults_test.py PROGRAM LIBRARY kills [N]     SIGKILL at N random moments (100), and a run after each
    faults_test.py PROGRAM LIBRARY same          two runs, one and two threads, the same folder twice: the same bytes

Results of a case A lie in the folder, with a note of the user; a run of another case B goes wrong there. Afterwards the
folder has the files of A or of B, all of them, no other, and the note; and the next run of B leaves those of B.
"""

import concurrent.futures
import contextlib
import hashlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

CASE = """
[part]
length = "60 mm"
height = "50 mm"
thickness = "20 mm"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "{size} mm"
order = 1
[[part.supports]]
on = "z_min"
[points.P]
at = [1.0, 0.5, 0.9]
patch_radius = "3 mm"
[modes]
count = 3
[damping]
ratio = 0.01
[response]
from = "1 Hz"
to = "2 kHz"
lines = 20
[robot]
model = "one_mode"
frequency = "30 Hz"
damping_ratio = 0.02
stiffness = "2e6 N/m"
direction = "x"
[[contacts]]
part = "P"
robot = "R"
directions = "x"
[tool]
teeth = 4
diameter = "16 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "1 mm"
Kt = "800 MPa"
Kr = "240 MPa"
spindle_speed = "8000 rpm"
[lobes]
from = "6000 rpm"
to = "12000 rpm"
count = 4
most_added = 0
modes_up_to = "4 kHz"
tolerance = 0.01
[reduction]
modes = 6
"""
NOTES = ("notes.txt", "photos/fixture/first.txt")


def sum_of(data):
    return hashlib.sha256(data).hexdigest()


def without_times(name, data):
    """The bytes of a file without the times of its run, which no two runs share."""
    if name == "summary.json":
        summary = json.loads(data)
        summary.pop("timings_s")
        return json.dumps(summary).encode()
    return b"" if name in ("manifest.json", "report.html") else data


def files_in(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def results_in(folder):
    """The files of the results, with all of their bytes: without notes, log and what is kept for the next run."""
    return {name: data for name, data in files_in(folder).items()
            if name not in NOTES and name != "run.log" and not name.startswith("cache/") and ".partial-" not in name}


def fingerprint(results):
    return {name: sum_of(without_times(name, data)) for name, data in results.items()}


def faults_of(results):
    """What keeps the files of a folder from being those of one run, by its own manifest."""
    results = dict(results)
    if "manifest.json" not in results:
        return ["no manifest"]
    listed = {file["name"]: file["sha256"] for file in json.loads(results.pop("manifest.json"))["outputs"]}
    found = [f"{name} is not listed" for name in results if name not in listed]
    found += [f"{name} is missing" for name in listed if name not in results]
    found += [f"{name} is of another run" for name in results
              if name in listed and sum_of(results[name]) != listed[name]]
    return [", ".join(found[:3]) + (f" and {len(found) - 3} more" if len(found) > 3 else "")] if found else []


class Bench:
    """A folder with results of A, cases A and B, and what B leaves undisturbed."""

    def __init__(self, program, library, scratch):
        self.program, self.library, self.scratch = program, library, pathlib.Path(scratch)
        for name, size in (("a", 40), ("b", 30)):
            (self.scratch / name).mkdir()
            (self.scratch / name / "case.toml").write_text(CASE.format(size=size))
        self.first, self.undisturbed = self.scratch / "first", self.scratch / "undisturbed"
        for case, out in (("a", self.first), ("b", self.undisturbed)):
            done = self.run(case, out)
            assert done.returncode == 0, done.stderr
        for note in NOTES:
            (self.first / note).parent.mkdir(parents=True, exist_ok=True)
            (self.first / note).write_text("mine: " + note)
        of_a, of_b = results_in(self.first), results_in(self.undisturbed)
        self.of_a, self.of_b = fingerprint(of_a), fingerprint(of_b)
        assert self.of_a != self.of_b and not faults_of(of_a) and not faults_of(of_b)
        self.rerun = {}

    def command(self, case, out, *more):
        return [self.program, "run", str(self.scratch / case), "--out", str(out), "-q", *more]

    def run(self, case, out, *more, **environment):
        return subprocess.run(self.command(case, out, *more), capture_output=True, text=True, cwd=self.scratch,
                              env={**os.environ, **environment}, check=False)

    def run_within(self, case, out, **environment):
        """From within the folder, which then cannot be exchanged: its files are moved one by one."""
        return subprocess.run(self.command(case, "."), capture_output=True, text=True, cwd=out,
                              env={**os.environ, **environment}, check=False)

    @contextlib.contextmanager
    def folder(self):
        """A copy of the folder with the results of A, alone in a folder of its own, which is gone afterwards."""
        with tempfile.TemporaryDirectory(dir=self.scratch) as place:
            yield pathlib.Path(shutil.copytree(self.first, pathlib.Path(place) / "out"))

    def count(self):
        """How many calls of every kind the undisturbed run makes."""
        file = self.scratch / "counts"
        with self.folder() as out:
            self.run("b", out, LD_PRELOAD=self.library, THINWALL_FAULT_COUNT=str(file))
        return {line.split()[0]: int(line.split()[1]) for line in file.read_text().splitlines()}

    def wrong_after(self, out, done):
        """What is wrong with the folder and the end of the run that left it; a killed one has no `done`."""
        results = results_in(out)
        found = faults_of(results)
        found += [f"{note} is gone" for note in NOTES
                  if not (out / note).is_file() or (out / note).read_text() != "mine: " + note]
        left = fingerprint(results)
        if left not in (self.of_a, self.of_b):
            differing = [name for name in {**left, **self.of_b} if left.get(name) != self.of_b.get(name)]
            told = done is not None and all(pathlib.Path(name).name in done.stderr for name in differing)
            if not told:
                found.append(f"neither of A nor of B: {sorted(differing)[:5]}")
        if done is not None and done.returncode == 0 and left == self.of_a:
            found.append("exit code 0 with the files of A")
        errors = [line for line in (done.stderr if done else "").splitlines() if line.startswith("thinwall: ")]
        if done is not None and done.returncode != 0 and (done.returncode not in (4, 5) or len(errors) != 1):
            found.append(f"exit code {done.returncode}, {len(errors)} lines of errors: {done.stderr[-300:]}")
        return found

    def wrong_with_rerun(self, out):
        """What the next run does not put right; a folder in which one ran already, whatever the log says, is not run in
        again."""
        state = sum_of(repr(sorted((name, sum_of(data)) for name, data in files_in(out.parent).items()
                                   if name != "out/run.log")).encode())
        if state not in self.rerun:
            self.rerun[state] = self.wrong_after_rerun(out)
        return self.rerun[state]

    def wrong_after_rerun(self, out):
        done = self.run("b", out)
        found = [] if done.returncode == 0 else [f"rerun: exit code {done.returncode}: {done.stderr}"]
        results = results_in(out)
        if not found and (fingerprint(results) != self.of_b or faults_of(results)):
            found.append("the rerun leaves another folder")
        return found + [f"left behind: {path}" for path in out.parent.rglob("*") if ".partial-" in path.name]


def sampled(count, slow):
    """All numbers of a call, or some: the last, where results are published, and a few before."""
    if slow and count <= 400:
        return range(1, count + 1)
    few = 60 if slow else 2
    return sorted({1 + round(i * (count - 1) / few) for i in range(few + 1)} | ({max(1, count - 1)} if slow else set()))


def faults(bench, slow):
    """Of every fault to try: its name, and the function that runs B in a folder under it."""
    ways = {"write": ("fail", "short", "kill"), "rename": ("fail", "kill", "fail within"), "unlink": ("fail", "kill")}
    for kind, count in bench.count().items():
        for way in ways.get(kind, ("fail",)):
            how, _, within = way.partition(" ")
            run = bench.run_within if within else bench.run
            moves = range(count - 1, count + 20, 1 if slow else 5)
            for number in moves if within else sampled(count, slow) if count else ():
                environment = {"LD_PRELOAD": bench.library, "THINWALL_FAULT": f"{kind} {number} {how}"}
                yield f"{kind} {number} of {count}, {way}", lambda out, r=run, e=environment: r("b", out, **e)


def wrong_by(bench, run):
    """What a fault leaves wrong."""
    with bench.folder() as out:
        done = run(out)
        return bench.wrong_after(out, None if done.returncode < 0 else done) + bench.wrong_with_rerun(out)


def test_faults(bench):
    all_faults = list(faults(bench, os.environ.get("THINWALL_SLOW") is not None))
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for (name, _), found in zip(all_faults, pool.map(lambda fault: wrong_by(bench, fault[1]), all_faults)):
            wrong += bool(found)
            if found:
                print(f"{name}: " + "; ".join(found), flush=True)
    print(f"{len(all_faults)} faults, {wrong} of them left something wrong")
    return wrong


def test_kills(bench, number):
    start = time.monotonic()
    with bench.folder() as out:
        bench.run("b", out)
    duration = time.monotonic() - start
    wrong, of_b = 0, 0
    for i in range(number):
        with bench.folder() as out:
            process = subprocess.Popen(bench.command("b", out), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                       cwd=bench.scratch)
            # Half of them near the end, where results are published.
            time.sleep(duration * (random.uniform(0.0, 1.1) if i % 2 else random.uniform(0.8, 1.05)))
            process.kill()
            process.wait()
            of_b += fingerprint(results_in(out)) == bench.of_b
            found = bench.wrong_after(out, None) + bench.wrong_with_rerun(out)
        if found:
            wrong += 1
            print(f"kill {i + 1}: " + "; ".join(found), flush=True)
    print(f"{number} kills, {of_b} after the results were there, {wrong} of them left something wrong")
    return wrong


def test_same(bench):
    """Everything but the times is the same, the kept files of two fresh runs included."""
    outs = {}
    for name, more in (("two threads", ["--threads", "2"]), ("again", ["--threads", "2"]), ("one", ["--threads", "1"])):
        outs[name] = bench.scratch / "same" / name
        assert bench.run("b", outs[name], *more).returncode == 0
    wrong = [name for name, out in outs.items() if fingerprint(results_in(out)) != bench.of_b]
    kept = [{name: sum_of(data) for name, data in files_in(out).items() if name.startswith("cache/")}
            for out in outs.values()]
    wrong += ["kept files"] if kept[0] != kept[1] or kept[0] != kept[2] else []
    assert bench.run("b", outs["one"], "--threads", "2").returncode == 0
    wrong += ["the same folder twice"] if fingerprint(results_in(outs["one"])) != bench.of_b else []
    print("differing: " + ", ".join(wrong) if wrong else "the same bytes")
    return len(wrong)


def main():
    program, library, what = sys.argv[1:4]
    with tempfile.TemporaryDirectory(prefix="thinwall-faults-") as scratch:
        bench = Bench(program, library, scratch)
        if what == "faults":
            wrong = test_faults(bench)
        elif what == "kills":
            wrong = test_kills(bench, int(sys.argv[4]) if len(sys.argv) > 4 else 100)
        else:
            wrong = test_same(bench)
    sys.exit(1 if wrong else 0)


main()
