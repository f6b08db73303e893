#!/usr/bin/env python3
"""The library's headers as Doxygen is to read them, line for line.

    headers_for_doxygen.py FOLDER     writes them below that folder, all in one go: a filter a file would take longer

The remark at its head becomes that of the file; what is named as docs/theory/X.md, Eq. N becomes a link to that equation;
explicit instantiations, which declare nothing new, go; a < before a letter is no HTML; and "Eq. 4" ends no sentence, which
Doxygen would take for the summary.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("core", "dynamics", "linalg", "distributed", "mesh", "fem", "reduction", "robot", "coupling", "regression", "identification", "milling", "learning",
           "posture", "io", "setup", "case", "study")
HEAD = re.compile(r"\A#pragma once\n((?://(?!/).*\n)+)")
INSTANTIATION = re.compile(r"^extern template [^;]*;", re.M)
ABBREVIATION = re.compile(r"\b(Eqs?\.|Fig\.|e\.g\.|i\.e\.|al\.|ch\.) (?=\S)")  # where no sentence ends
COMMENT = re.compile(r"///.*")
NUMBERED = re.compile(r"docs/theory/([\w-]+)\.md(?=,?[\s/]*Eq\.(?:\s|&nbsp;|/)*([A-Z]?\d+[a-z]?))")
PAGE = re.compile(r"(?<![\w/#])docs/([\w/-]+)\.md(?!</a>)")


def escaped(comment):
    """< before a letter, but not in `code` and not of a link."""
    parts = re.split(r"(`[^`]*`)", comment)
    return "".join(part if part.startswith("`") else ABBREVIATION.sub(r"\1&nbsp;", re.sub(r"<(?=[A-Za-z/])", "&lt;", part))
                   for part in parts)


def filtered(text):
    """One header."""
    text = HEAD.sub(lambda match: "/// @file\n" + re.sub(r"(?m)^//", "///", match.group(1)), text, count=1)
    text = INSTANTIATION.sub(lambda match: "\n" * match.group(0).count("\n"), text)
    text = COMMENT.sub(lambda match: escaped(match.group(0)), text)
    text = NUMBERED.sub(r'<a href="../docs/theory/\1.html#eq-\2">docs/theory/\1.md</a>', text)
    return PAGE.sub(r'<a href="../docs/\1.html">docs/\1.md</a>', text)


def main():
    out = pathlib.Path(sys.argv[1])
    for header in (path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.hpp"))):
        copy = out / header.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(filtered(header.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
