#!/usr/bin/env python3
"""Checks the structure of the sources: no header includes itself through others, at most sixty sources in a folder.

    check_structure.py [ROOT]     prints one line for each violation; exits with 1 if there is any

A folder is counted without its sub-folders.
"""

import collections
import pathlib
import re
import sys

FOLDERS = ("core", "dynamics", "linalg", "distributed", "mesh", "fem", "reduction", "robot", "coupling", "regression", "identification",
           "milling", "learning", "posture", "io", "setup", "case", "study", "report", "app", "python", "bench", "fuzz")
MOST_FILES = 60
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def sources(root):
    """Every header and source of the library and the programs."""
    return [path for folder in FOLDERS for path in sorted((root / folder).rglob("*.[ch]pp"))]


def includes(root):
    """{header: headers of this repository that it includes}."""
    graph = collections.defaultdict(set)
    for path in sources(root):
        if path.suffix == ".hpp":
            graph[path.relative_to(root).as_posix()] = {header for header in INCLUDE.findall(path.read_text(encoding="utf-8"))
                                                        if (root / header).is_file()}
    return graph


def cycle(graph):
    """A list of headers that include each other in a ring, with the first one repeated at the end; None without a ring."""
    done, path = set(), []

    def visit(name):
        if name in path:
            return [*path[path.index(name):], name]
        if name in done:
            return None
        path.append(name)
        found = next((ring for other in sorted(graph.get(name, ())) if (ring := visit(other))), None)
        path.pop()
        done.add(name)
        return found

    return next((ring for name in sorted(graph) if (ring := visit(name))), None)


def violations(root):
    """All violations below root, as lines of text."""
    counts = collections.Counter(path.parent.relative_to(root).as_posix() for path in sources(root))
    found = [f"{folder}/ holds {count} sources; at most {MOST_FILES}" for folder, count in sorted(counts.items())
             if count > MOST_FILES]
    ring = cycle(includes(root))
    if ring:
        found.append("headers that include each other: " + " -> ".join(ring))
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    sys.setrecursionlimit(10000)
    found = violations(root)
    print("\n".join(found) if found else "no header includes itself over others, and no folder is too full")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
