#!/usr/bin/env python3
"""The test of the snippets must object to each kind of fault and to nothing else. A shell script stands in for thinwall."""

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import snippets_test  # noqa: E402

FENCE = "```"
STAND_IN = """#!/bin/bash
case $1 in
  fail) exit 3 ;;
  show) cat "$2" ;;
  miss) shift; for name; do echo "  MISS ${name//_/ }    1.0  2.0 ± 0.1"; done; exit 6 ;;
  *) echo "$@" ;;
esac
"""
KEYS = "### `[part]`\n\n| `length` | x |\n\n### `[points.NAME]`\n\n| `at` | x |\n"
PAGES = {  # text: what the failure says; "" if there is none
    "plain": ("Words.\n\n    a = b\n", ""),
    "run": ("<!-- run -->\n\n    ./thinwall run x    and why\n    thinwall run y # and why\n", ""),
    "printed": ("<!-- run -->\n\n    thinwall one   two\n\n<!-- printed -->\n\n    o…e\n", ""),
    "file": ("<!-- file: a/b.txt -->\n\n    some text\n\n<!-- run -->\n\n    thinwall show a/b.txt\n\n<!-- printed -->\n\n    some text\n",
             ""),
    "fence": (f"<!-- run -->\n{FENCE}sh\nthinwall fine\n{FENCE}\n", ""),
    "exit": ("<!-- run; exit 3 -->\n\n    thinwall fail\n", ""),
    "exit of one": ("<!-- run; exit 3 x.toml -->\n\n    thinwall fail x.toml\n    thinwall fine\n", ""),
    "missed": ("<!-- run; exit 6; miss first mode, alone; miss depth -->\n\n    thinwall miss first_mode,_alone depth\n", ""),
    "another is missed": ("<!-- run; exit 6; miss first mode -->\n\n    thinwall miss depth\n", "missed are depth, not first mode"),
    "one more is missed": ("<!-- run; exit 6; miss depth -->\n\n    thinwall miss depth speed\n", "missed are depth; speed, not depth"),
    "one less is missed": ("<!-- run; exit 6; miss depth; miss speed -->\n\n    thinwall miss depth\n", "missed are depth, not"),
    "nothing is named": ("<!-- run; exit 6 -->\n\n    thinwall miss depth\n", "not any that the remark names"),
    "added": ("<!-- run; add --quick -->\n\n    thinwall run x\n\n<!-- printed -->\n\n    run x --quick\n", ""),
    "check": ("<!-- run; as check -->\n\n    thinwall run x\n\n<!-- printed -->\n\n    check x\n", ""),
    "excused": ("<!-- not run: a day -->\n\n    ./thinwall run x\n", ""),
    "keys": ("    [part]\n    length = 3\n\n    [points.P]\n    at = 1\n", ""),
    "not marked": ("    ./thinwall run x\n", "neither run nor excused"),
    "not marked, fenced": (f"{FENCE}sh\nTHINWALL_SLOW=1 ./thinwall test\n{FENCE}\n", "neither run nor excused"),
    "no reason": ("<!-- not run -->\n\n    ./thinwall run x\n", "no reason"),
    "fails": ("<!-- run -->\n\n    thinwall fail\n", "ended with 3, not 0"),
    "does not fail": ("<!-- run; exit 3 -->\n\n    thinwall fine\n", "ended with 0, not 3"),
    "not printed": ("<!-- run -->\n\n    thinwall one\n\n<!-- printed -->\n\n    two\n", "not printed: two"),
    "unknown key": ("    [part]\n    lenght = 3\n", "has no key part.lenght"),
    "unknown key in a file": ("<!-- file: case.toml -->\n\n    [part]\n    lenght = 3\n", "has no key part.lenght"),
    "no TOML": ("    [part]\n    length = three\n", "no TOML"),
    "nothing to add to": ("<!-- add to: x.toml -->\n\n    [part]\n    length = 3\n", "no x.toml to add to"),
    "a remark that is none": ("<!-- runs -->\n\n    thinwall x\n", "not understood"),
    "a remark without a block": ("<!-- run -->\n\nWords.\n", "belongs to no block"),
}


def complaint(root, text):
    """What the test says of a page, "" if nothing."""
    (root / "page.md").write_text(text, encoding="utf-8")
    runner = snippets_test.Runner(root / "stand-in")
    try:
        runner.page("page.md")
    except SystemExit as error:
        return str(error)
    return "\n".join(runner.faults)


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        snippets_test.ROOT = root
        for name in ("docs", "cases"):
            (root / name).mkdir()
        (root / "docs" / "case-file.md").write_text(KEYS, encoding="utf-8")
        (root / "stand-in").write_text(STAND_IN, encoding="utf-8")
        (root / "stand-in").chmod(0o755)
        for name, (text, expected) in PAGES.items():
            said = complaint(root, text)
            if bool(said) != bool(expected) or expected not in said:
                failures += 1
                print(f"FAILED: {name}\n  expected: {expected or 'nothing'}\n  said: {said or 'nothing'}")
    print(f"{failures} expectations failed" if failures else "all expectations hold")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
