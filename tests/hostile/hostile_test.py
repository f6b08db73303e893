#!/usr/bin/env python3
"""Bad input gets one clear line, the right exit code, little time and no file: looks whether that holds.

    hostile_test.py PROGRAM [--show] [--only PART] [--all]

A fixed share of the inputs is run, which takes about 20 s; a larger one of some minutes with THINWALL_SLOW=1, all with
--all (ten minutes), and with --only those whose name holds PART, a regular expression. --show prints each with its exit
code and the first line of the answer. Exit 1 if an answer is wrong, 77 if the module jsonschema is missing.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

try:
    import bases
    import case_inputs
    import command_inputs
    import file_inputs
    import judge
except ImportError as error:
    print(error)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Of these inputs one in so many is run each time; a slow run has the second share.
SHARES = {"keys": (48, 5), "files": (20, 1), "commands": (25, 1)}


def prepared(scratch, cases):
    """A folder for each base, with the case and its data."""
    shutil.copytree(ROOT / "cases" / file_inputs.PLAIN, scratch / (file_inputs.PLAIN + "-bare"))
    (scratch / (file_inputs.PLAIN + "-bare") / "expected.toml").unlink()
    for name, (start, case) in cases.items():
        shutil.copytree(ROOT / "cases" / start, scratch / name)
        if name in bases.ADDED:
            (scratch / name / "case.toml").write_text(bases.toml_of(case), encoding="utf-8")
            for file, text in bases.FILES.items():
                (scratch / name / file).write_text(text, encoding="utf-8")
            for file, original in bases.COPIES.items():
                shutil.copy(ROOT / original, scratch / name / file)


def all_inputs(program, cases, scratch):
    """(input, the shares of its kind) of everything."""
    schema = json.loads(subprocess.run([program, "schema"], capture_output=True, check=True).stdout)
    for name in bases.ADDED:
        yield judge.Input(f"the base {name}", ["check", "."], name, right=True), (1, 1)
    for given in case_inputs.inputs(schema, cases):
        yield given, SHARES["keys"]
    for given in file_inputs.inputs(cases, scratch, ROOT):
        yield given, SHARES["files"]
    for given in command_inputs.inputs(program, scratch, ROOT):
        yield given, SHARES["commands"]


def chosen(given, shares, options):
    """Whether an input is run: by its name, so that the choice is the same everywhere."""
    if options.all or options.only:
        return re.search(options.only, given.name) is not None
    share = shares[1 if os.environ.get("THINWALL_SLOW") is not None else 0]
    return zlib.crc32(given.name.encode("utf-8", "surrogateescape")) % share == 0


def shown(given, answer, found):
    first = answer.problems[0] if answer.problems else (answer.lines or answer.out.splitlines() or [""])[0]
    words = " ".join(os.fsdecode(word) for word in given.words).encode("utf-8", "replace").decode()
    return f"{'WRONG ' if found else ''}{given.name} [{words[:80]!r} in {given.at}] -> {answer.code}: {first[:300]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    counts = {"inputs": 0, "refused": 0, "accepted": 0, "wrong": 0}
    seconds = 0.0
    with tempfile.TemporaryDirectory(prefix="thinwall-hostile-") as place:
        scratch = pathlib.Path(place)
        cases = bases.cases_of(ROOT / "cases")
        prepared(scratch, cases)
        command_inputs.prepare(program, scratch, ROOT)
        for given, shares in all_inputs(program, cases, scratch):
            if not chosen(given, shares, options):
                continue
            answer = judge.answer_to(program, given, scratch)
            found = judge.wrong_with(given, answer)
            seconds += answer.seconds
            counts["inputs"] += 1
            counts["accepted" if answer.code in (0, 6) else "refused"] += 1
            counts["wrong"] += bool(found)
            if options.show or found:
                print(shown(given, answer, found), flush=True)
            if found:
                print("    " + "; ".join(found), flush=True)
    print(", ".join(f"{count} {name}" for name, count in counts.items()) + f"; {seconds:.0f} s of the processor")
    sys.exit(1 if counts["wrong"] else 0)


if __name__ == "__main__":
    main()
