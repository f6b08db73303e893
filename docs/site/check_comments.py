#!/usr/bin/env python3
"""Comments of the library and the program begin with the thing they describe, not with What, Where or How.

    check_comments.py [ROOT]     the sources; prints each comment that begins with one of the words below, and their number;
                                 exit 1 if there are more than 20

Such a beginning is a sign that the sentence lacks its subject. Counted are comments on lines of their own (file heads, /// and
//), each by its first line; comments behind code and the continuation of a comment are not.
"""

import pathlib
import re
import sys

FOLDERS = ("core", "dynamics", "linalg", "distributed", "mesh", "fem", "reduction", "robot", "coupling", "regression", "identification",
           "milling", "learning", "posture", "io", "case", "setup", "study", "report", "app", "thinwall", "python")
FIRST_WORDS = re.compile(r"(What|Where|How|Whether|The same|Of the)\b")
COMMENT = re.compile(r"\s*(///?)(?:\s+(.*))?$")
MOST = 20


def first_lines(path):
    """Line number and text of the first line of each comment that has lines of its own."""
    before = None
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = COMMENT.match(line)
        if match and match.group(1) != before:
            yield number, match.group(2) or ""
        before = match.group(1) if match else None


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    comments, found = 0, []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            for number, text in first_lines(path):
                comments += 1
                if FIRST_WORDS.match(text):
                    found.append(f"{path.relative_to(root)}:{number}: {text}")
    print("\n".join(found), end="\n" if found else "")
    print(f"{comments} comments; without a subject: {len(found)}, at most {MOST}")
    return 1 if len(found) > MOST else 0


if __name__ == "__main__":
    sys.exit(main())
