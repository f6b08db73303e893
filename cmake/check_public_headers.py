#!/usr/bin/env python3
"""Checks every <folder>/<folder>.hpp: each header of the folder is included there or named as internal, none is both.

    check_public_headers.py [ROOT]     prints one line a violation; exit 1 if there is any
"""

import pathlib
import re
import sys

FOLDERS = ("core", "dynamics", "linalg", "distributed", "mesh", "fem", "reduction", "robot", "coupling", "regression", "identification", "milling",
           "learning", "posture", "io", "setup", "case", "study")


def violations(root, folder):
    """The faults of a folder's public header, as lines of text."""
    name = f"{folder}/{folder}.hpp"
    text = (root / name).read_text(encoding="utf-8")
    included = set(re.findall(rf'#include "{folder}/(?:\w+/)*(\w+)\.hpp"', text))
    comment = re.search(r"// Internal: ((?:.*\n//)*.*)\.\n", text)
    internal = set(re.findall(r"\w+", comment.group(1).replace("//", " "))) if comment else set()
    present = {header.stem for header in (root / folder).rglob("*.hpp")} - {folder}
    return (
        [f"{name}: {h}.hpp is neither included nor named as internal" for h in sorted(present - included - internal)]
        + [f"{name}: {h}.hpp does not exist" for h in sorted((included | internal) - present)]
        + [f"{name}: {h}.hpp is included and named as internal" for h in sorted(included & internal)]
    )


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = [line for folder in FOLDERS if (root / folder).is_dir() for line in violations(root, folder)]
    print("\n".join(found) if found else "every header is public or internal")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
