#!/usr/bin/env python3
"""A run that tests share is made once for a program and the files of the cases. A shell script stands in for thinwall."""

import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import snippets_test  # noqa: E402  (it names the folder of shared_runs, too)
from shared_runs import shared_run  # noqa: E402

STAND_IN = """#!/bin/bash
mkdir -p "$4/cache" && cat "$2/case.toml" > "$4/seen" && echo run >> "$(dirname "$0")/runs"
"""


def main():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name in ("app", "page", "docs", "cases/wall", "cases/other"):
            (root / name).mkdir(parents=True)
        program = root / "app" / "thinwall"
        program.write_text(STAND_IN, encoding="utf-8")
        program.chmod(0o755)
        os.chdir(root / "app")

        def seen_after(change, named=program, settings=()):
            """What the run saw of its case, and how many runs were made so far."""
            (root / "cases" / change[0]).write_text(change[1], encoding="utf-8")
            results, code = shared_run(named, root, "wall", settings)
            assert code == 0, code
            return (results / "seen").read_text(encoding="utf-8"), len((root / "app" / "runs").read_text("utf-8").split())

        assert seen_after(("wall/case.toml", "a")) == ("a", 1)
        assert seen_after(("wall/case.toml", "a")) == ("a", 1), "nothing has changed"
        assert seen_after(("wall/case.toml", "b")) == ("b", 2), "the case has changed, in as many letters"
        assert seen_after(("other/table.csv", "1")) == ("b", 3), "a case may read the files of another"
        assert seen_after(("wall/README.md", "Words.")) == ("b", 3), "no run reads a page"
        assert seen_after(("wall/case.toml", "b"), pathlib.Path("thinwall")) == ("b", 3), "the same program"
        assert seen_after(("wall/case.toml", "b"), pathlib.Path("thinwall"), ["x=1"]) == ("b", 4), "named from its folder"

        snippets_test.ROOT = root
        (root / "docs" / "case-file.md").write_text("### `[part]`\n", encoding="utf-8")
        runner = snippets_test.Runner(program)
        for command, expected in (("simulate", ["cache"]), ("run", ["cache", "seen"])):
            runner.bring_kept_results(f"thinwall {command} cases/wall --out {command}", root / "page")
            assert sorted(path.name for path in (root / "page" / command).iterdir()) == expected, command
    print("all expectations hold")


if __name__ == "__main__":
    main()
