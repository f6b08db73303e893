#!/usr/bin/env python3
"""Every equation that is cited is there, once.

    equations_test.py [ROOT]     prints one line a fault; exit 1 if there is any

Cited as "docs/theory/coupling.md, Eq. 16-18", also over the end of a comment's line, in headers, sources and pages, or as
"(4)" behind a chapter's name in backticks. "Eq. 9" alone, behind an author's year or in a file that names no chapter is another's.
"""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "site"))
import equations  # noqa: E402

CHAPTER = re.compile(r"(?:docs/)?theory/([\w-]+)\.md")
CITED = re.compile(r"(?:docs/)?(?:theory/)?([\w-]+)\.md`?\)?,?[\s/*\"]*(?:Eqs?\.[\s/*]*|\()"
                   r"([A-Z]?\d+[a-z]?(?:(?:-|–|, | to | and )[A-Z]?\d+[a-z]?)*)")


def expanded(numbers):
    """"16-18, 20" as 16, 17, 18, 20."""
    for part in re.split(r", | to | and ", numbers):
        ends = re.split("[-–]", part)
        if len(ends) == 2 and all(end.isdigit() for end in ends):
            yield from map(str, range(int(ends[0]), int(ends[1]) + 1))
        else:
            yield from ends


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    chapters = {path.stem: equations.numbers(path.read_text(encoding="utf-8"))
                for path in sorted((root / "docs/theory").glob("*.md"))}
    faults, cited = [], 0
    for chapter, numbers in chapters.items():
        faults += [f"docs/theory/{chapter}.md: two equations ({number})" for number in sorted(set(numbers))
                   if numbers.count(number) > 1]
    files = [path for pattern in ("*/**/*.hpp", "*/**/*.cpp", "tests/**/*.cpp", "docs/**/*.md", "cases/*/README.md", "*.md")
             for path in sorted(root.glob(pattern)) if "build" not in path.relative_to(root).parts[:1]]
    for path in files:
        text = path.read_text(encoding="utf-8")
        for match in CHAPTER.finditer(text):
            if match.group(1) not in chapters and match.group(1) != "index":
                faults.append(f"{path.relative_to(root)}: there is no docs/theory/{match.group(1)}.md")
        for match in CITED.finditer(text):
            if match.group(1) not in chapters:
                continue
            for number in expanded(match.group(2)):
                cited += 1
                if number not in chapters[match.group(1)]:
                    line = text.count("\n", 0, match.start()) + 1
                    faults.append(f"{path.relative_to(root)}:{line}: docs/theory/{match.group(1)}.md has no equation ({number})")
    print("\n".join(faults), end="\n" if faults else "")
    print(f"{sum(map(len, chapters.values()))} equations in {len([c for c in chapters if chapters[c]])} chapters, cited {cited} times; "
          f"faults: {len(faults)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
