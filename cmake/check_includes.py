#!/usr/bin/env python3
"""Checks every #include of the sources: folders look downwards only, and a library is included only by the folder that owns it.

    check_includes.py [ROOT]     prints one line a violation; exit 1 if there is any
"""

import pathlib
import re
import sys

# The folders that a folder may include, besides itself.
ALLOWED = {
    "core": [],
    "linalg": ["core"],
    "dynamics": ["linalg", "core"],
    "distributed": ["linalg", "core"],
    "mesh": ["core"],
    "fem": ["mesh", "linalg", "dynamics", "core"],
    "reduction": ["linalg", "dynamics", "core"],
    "robot": ["linalg", "dynamics", "core"],
    "coupling": ["linalg", "dynamics", "core"],
    "regression": ["core"],
    "identification": ["linalg", "dynamics", "core"],
    "milling": ["linalg", "dynamics", "core"],
    "learning": ["milling", "linalg", "dynamics", "core"],
    "posture": ["milling", "coupling", "robot", "regression", "identification", "linalg", "dynamics", "core"],
    "io": ["mesh", "dynamics", "core"],
}
NUMERICS = list(ALLOWED)
ALLOWED["setup"] = NUMERICS
ALLOWED["case"] = [*NUMERICS, "setup"]
ALLOWED["study"] = [*NUMERICS, "setup"]
ALLOWED["report"] = [*NUMERICS, "setup", "study"]
LIBRARY_FOLDERS = list(ALLOWED)
ALLOWED["app"] = LIBRARY_FOLDERS
for everything in ("python", "bench", "tests", "fuzz"):
    ALLOWED[everything] = [*LIBRARY_FOLDERS, "app"]
ALLOWED["bench"] = [*ALLOWED["bench"], "tests"]

# Libraries that only some places may include: a pattern of their headers, and these places.
OWNERS = [
    (re.compile(r"^Eigen/(Eigenvalues|Cholesky|Dense|QR|SVD)$"),
     ("core/dense_eigenvalues.hpp", "core/dense_factorisations.hpp")),
    (re.compile(r"^vtk.*\.h$"), ("io/results/vtu.cpp", "io/results/vtp.cpp", "io/results/polyline_vtu.cpp", "tests/io/")),
    (re.compile(r"^matio\.h$"), ("io/matrices/mat_variables.cpp",)),
    (re.compile(r"^pugixml\.hpp$"), ("io/mesh/vtu_reader.cpp", "io/surface/three_mf.cpp")),
    (re.compile(r"^zlib\.h$"), ("io/mesh/vtu_array.cpp", "io/surface/zip_archive.cpp", "io/base64.cpp", "tests/io/zip_bytes.hpp")),
    (re.compile(r"^openssl/"), ("io/manifest.cpp", "io/base64.cpp")),
    (re.compile(r"^(urdf|console_bridge)"), ("io/urdf.cpp",)),
    (re.compile(r"^[A-Za-z]+_?[A-Za-z]*\.hxx$"), ("io/surface/step",)),
    (re.compile(r"^tetgen\.h$"), ("mesh/",)),
    (re.compile(r"^polyclipping/"), ("milling/simulation/part_region.cpp",)),
    (re.compile(r"^nlopt\.h(pp)?$"), ("regression/gaussian_process.cpp",)),
    (re.compile(r"^(suitesparse/)?cholmod\.h$"), ("linalg/", "tests/linalg/")),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')


def violation(root, source, quote, header):
    """The fault of this include, or None."""
    folder = source.parts[0]
    for pattern, owners in OWNERS:
        if pattern.match(header) and not source.as_posix().startswith(owners):
            return f"<{header}> belongs to {' and '.join(owners)}"
    first = header.split("/")[0]
    if quote == "<":
        return f"<{header}> is ours; include it with quotes" if first in ALLOWED and (root / header).is_file() else None
    beside = (root / source).parent / header
    if folder == "tests" and beside.is_file():
        return None
    if not (root / header).is_file():
        return f'"{header}" does not exist; name it from the root'
    if first == folder or first in ALLOWED[folder]:
        return None
    return f"{folder}/ may not include {first}/"


def check(root):
    """All violations below root, as lines of text."""
    found = []
    for folder in ALLOWED:
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            source = path.relative_to(root)
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
                match = INCLUDE.match(line)
                wrong = match and violation(root, source, *match.groups())
                if wrong:
                    found.append(f"{source}:{number}: {wrong}")
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = check(root)
    print("\n".join(found) if found else "every include looks downwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
