"""Whole files that are not what they should be: cases, and files of every format that a case or a command reads."""

import os
import random
import re

import case_inputs
from bases import toml_of
from judge import Input

PLAIN = "ding-2010"  # the case whose text is spoiled


def spoiled_cases(text):
    """(name, bytes of a case.toml, whether nothing but a refusal is right)."""
    data = text.encode()
    keys = "".join(f"k{i} = 1\n" for i in range(100_000)).encode()
    return (
        ("empty", b"", True), ("blanks", b"  \n\n", True), ("a comment", b"# nothing", True), ("NUL bytes", b"\0" * 100, True),
        ("a NUL in the text", data.replace(b"teeth = 2", b"teeth = 2\0"), True),
        ("invalid UTF-8", data.replace(b"teeth", b"te\xff\xfeeth"), True),
        ("UTF-16", text.encode("utf-16"), True), ("a mark of byte order", b"\xef\xbb\xbf" + data, False),
        ("ends of lines of Windows", data.replace(b"\n", b"\r\n"), False),
        ("ends of lines of old Macs", data.replace(b"\n", b"\r"), True),
        ("cut in a text", data[:data.index(b"mm\"")], True), ("JSON", b'{"tool": {"teeth": 2}}', True),
        ("a line of a million characters", b"title = \"" + b"a" * 1_000_000 + b"\"\n" + data.split(b"\n", 3)[3], False),
        ("10^5 unknown keys", keys + data, True), ("10^5 unknown tables", re.sub(rb"(k\d+) = 1", rb"[\1]", keys), True),
        ("a key twice", data.replace(b"teeth = 2", b"teeth = 2\nteeth = 2"), True),
        ("a table twice", data + b"\n[tool]\nteeth = 2\n", True),
        ("a table that is a value", data + b"\n[tool.teeth]\na = 1\n", True),
        ("deep brackets", data + b"\na = " + b"[" * 100_000, True), ("deep tables", b"[a" + b".a" * 100_000 + b"]\n", True),
        ("deep inline tables", b"a = " + b"{a=" * 100_000, True), ("random bytes", random.Random(1).randbytes(4000), True),
        ("no end of a text", data + b'\nx = """abc', True), ("a bidirectional mark", data + "\n\u202ea = 1\n".encode(), True),
        ("10^5 entries", data.replace(b"[lobes]", b"[lobes]\ncompare = [" + b"1, " * 100_000 + b"]"), True),
        ("10^4 modes", data + b"\n[[tool.modes]]\nfrequency = \"1 Hz\"\n" * 10_000, True),
    )


def whole_cases(cases):
    """Inputs in place of a case."""
    name = case_inputs.FILE
    for what, data, refused in spoiled_cases(toml_of(cases[PLAIN][1]) + "\n"):
        yield Input(f"a case, {what}", ["check", name], PLAIN, {name: data}, (name, "case"), refused, (3, 4))
    others = (("a folder", lambda path: path.mkdir()), ("a pipe", os.mkfifo), ("a dead link", lambda path: path.symlink_to("nowhere")),
              ("a link to itself", lambda path: path.symlink_to(path.name)), ("a device", lambda path: path.symlink_to("/dev/zero")))
    for what, make in others:
        yield Input(f"a case, {what}", ["check", name], PLAIN, {name: make}, (name,), True, (3, 4))
    yield Input("a case, none", ["check", "nowhere"], PLAIN, {}, ("nowhere",), True)
    yield Input("a case, no name", ["check", ""], PLAIN, {}, ('""', "CASE"), True, (2, 3))
    yield Input("a case, a very long name", ["check", "a" * 5000], PLAIN, {}, ("a" * 40,), True)
    yield Input("a case, control characters in its name", ["check", "a\x1b[2J\nb"], PLAIN, {}, ("a",), True)
    yield Input("a case, not UTF-8 in its name", ["check", b"a\xffb"], PLAIN, {}, ("a",), True)
    for what, make in others[:2]:
        yield Input(f"an expected.toml, {what}", ["check", "."], PLAIN + "-bare", {"expected.toml": make}, ("expected.toml",), False, (3, 4))
    for what, data in (("random bytes", random.Random(2).randbytes(500)), ("an unknown key", b"[[figures]]\na = 1\n"), ("cut", b"[[fig")):
        yield Input(f"an expected.toml, {what}", ["check", "."], PLAIN + "-bare", {"expected.toml": data}, ("expected.toml",), True, (3, 4))


def exchanged(data, pattern, to, every):
    """`data` with every so-manieth match of a pattern exchanged."""
    count = iter(range(1, 1 << 30))
    return re.sub(pattern, lambda match: to if next(count) % every == 0 else match.group(), data)


NUMBER = rb"(?<![\w.])-?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])"


def spoiled(data):
    """(name, bytes, whether nothing but a refusal is right) of a file of data."""
    source = random.Random(len(data))
    yield "empty", b"", True
    yield "a half", data[:len(data) // 2], False
    yield "random bytes", source.randbytes(3000), True
    yield "nan", numbers_as(data, b"nan"), False
    yield "one byte", data[:1], True
    yield "nine tenths", data[:len(data) * 9 // 10], False
    yield "1e300", numbers_as(data, b"1e300"), False
    yield "-1", numbers_as(data, b"-1"), False
    yield "99999999999", numbers_as(data, b"99999999999"), False
    yield "zeros", bytes(len(data)), True
    yield "a heading and random bytes", data[:40] + source.randbytes(3000), False
    yield "twice", data + data, False
    yield "a long line", b"1" * 2_000_000, True
    yield "ends of lines of Windows", data.replace(b"\n", b"\r\n"), False
    yield "a mark of byte order", b"\xef\xbb\xbf" + data, False


def numbers_as(data, text):
    """A text with every third number exchanged; of binary data a quarter in the middle, whose bits are all ones: nan."""
    if b"\0" in data:
        start, width = len(data) // 2, max(len(data) // 4, 1)
        return data[:start] + (b"\xff" if text != b"-1" else b"\x7f") * width + data[start + width:]
    return exchanged(data, NUMBER, text, 3)


CORPUS = "fuzz/corpus/"
# The endings that a key takes, and files of each, which are spoiled.
SURFACES = {"stl": ["stl/binary", "stl/text"], "off": ["off/tetrahedron"], "obj": ["obj/cube_with_normals"],
            "ply": ["ply/binary_little", "ply/text"], "3mf": ["three_mf/packed"], "glb": ["gltf/binary"],
            "gltf": ["gltf/embedded"], "step": ["/tests/data/parts/bracket.step"]}
MESHES = {"msh": ["gmsh/hex8_41_binary", "gmsh/tet4_1"], "inp": ["inp/tets_sets_materials", "inp/hex20"],
          "vtu": ["vtu/ascii", "vtu/appended_raw_zlib"]}
MATRICES = {"mtx": ["matrix_market/symmetric", "abaqus_matrix/upper"], "sti": ["triplets/ccx"], "bdf": ["dmig/small"],
            "op2": ["op2/single_big"], "op4": ["op4/dense_little", "op4/sparse_text"], "mat": ["mat4/full"],
            "nc": ["superelement/scipy_cdf1"]}
RESPONSES = {"csv": ["/docs/tutorials/tip/tip.csv", "csv/coherence"], "frf": ["csv/cutpro.frf"],
             "uff": ["uff/ascii_accelerance_in_inches", "uff/binary_double_even_little"], "unv": ["uff/geometry"],
             "mat": ["mat4/complex"], "lvm": ["/docs/tutorials/tip/tip.csv"]}
# (base, path of a key that names a file, what it takes); without originals those that the base has there.
KEYS = (
    ("surface", ("part", "file"), SURFACES), ("meshed", ("part", "file"), MESHES),
    ("matrices", ("part", "matrices", "stiffness"), MATRICES), ("matrices", ("part", "matrices", "mass"), {}),
    ("matrices", ("part", "matrices", "dofs"), {}), ("matrices", ("part", "matrices", "dofs"), {"dof": ["ccx_dof/three"]}),
    ("matrices", ("part", "matrices", "positions"), {}),
    ("matrices", ("part", "matrices", "positions"), {"inp": ["inp/hex20"]}),
    ("tip", ("tool", "measured", 0, "file"), RESPONSES), ("held-measured", ("part", "measured", 0, "file"), {}),
    ("hajdu-2020", ("observed", 0, "file"), {}), ("irb6660-measured", ("robot", "table"), {}),
    ("posture-map", ("robot", "postures"), {}), ("described", ("robot", "urdf"), {}), ("described", ("robot", "joints"), {}),
    ("pressed", ("contacts", 0, "table"), {}), ("identified", ("contacts", 0, "measured", 0, "file"), {}),
    ("damped", ("damping", "from_frf", "file"), {}), ("tool-swap", ("tool", "swap", "measured", 0, "file"), {}),
)


def at(case, path):
    for part in path:
        case = case[part]
    return case


def original(root, name):
    """A file of the repository, or a seed of the fuzzing."""
    return (root / (name[1:] if name.startswith("/") else CORPUS + name)).read_bytes()


def originals(cases, scratch, root):
    """(base, path, ending, name, bytes) of every file that is spoiled."""
    for base, path, endings in KEYS:
        case = cases[base][1]
        if not endings:
            name = at(case, path)
            yield base, path, name.rpartition(".")[2], name, (scratch / base / name).read_bytes()
        for ending, names in endings.items():
            for name in names:
                yield base, path, ending, name, original(root, name)


def data_files(cases, scratch, root):
    """Inputs whose case names a file that is not right; the case itself stays as it is."""
    for base, path, ending, name, data in originals(cases, scratch, root):
        key = case_inputs.dotted(path)
        file = f"hostile-data.{ending}"
        case = toml_of(case_inputs.with_value(cases[base][1], path, file)).encode()
        for what, bytes_of, refused in spoiled(data):
            yield Input(f"{key}, {ending} of {name.lstrip('/')}: {what}", ["check", case_inputs.FILE], base,
                        {case_inputs.FILE: case, file: bytes_of}, (file, key, *(() if refused else (path[0], "k.mtx", "m.mtx"))), refused, (3, 4))
        for what, make in (("a folder", lambda path: path.mkdir()), ("a pipe", os.mkfifo), ("a device", lambda path: path.symlink_to("/dev/zero")),
                           ("a link to itself", lambda path: path.symlink_to(path.name))):
            yield Input(f"{key}, {ending} of {name.lstrip('/')}: {what}", ["check", case_inputs.FILE], base,
                        {case_inputs.FILE: case, file: make}, (file, key), True, (3, 4))
        yield Input(f"{key}, {ending} of {name.lstrip('/')}: no such file", ["check", case_inputs.FILE], base,
                    {case_inputs.FILE: case}, (key,), True, (3,))


def inputs(cases, scratch, root):
    yield from whole_cases(cases)
    yield from data_files(cases, scratch, root)
