"""Mistakes on the command line: options and words of every command as its help lists them, and wrong files for each."""

import random
import re
import subprocess

import file_inputs
from judge import Input

AT = "commands"  # the folder of these inputs; `prepare` fills it
SMALL = ["--set", "lobes.count=3", "--set", "lobes.most_added=0", "-q"]
# The words of each command beside the option that is tried; a case that is not there where it would compute for long.
RIGHT = {
    "run": ["run", "cases/ding-2010", *SMALL, "--out", "new"], "check": ["check", "cases/ding-2010"],
    "lobes": ["lobes", "tip.csv", "--tool", "tool.toml", "--quantity", "accelerance", "--unit", "m/s^2/N", *SMALL, "--out", "new"],
    "robot": ["robot", "nowhere", "--out", "new"], "postures": ["postures", "nowhere", "--out", "new"],
    "calibrate": ["calibrate", "nowhere", "--out", "new"], "validate": ["validate", "nowhere", "-q"],
    "coefficients": ["coefficients", "forces.csv", "--teeth", "2"],
    "simulate": ["simulate", "nowhere", "--out", "new"],
    "fit": ["fit", "tip.csv", "--quantity", "accelerance", "--unit", "m/s^2/N", "-o", "new"],
    "reduce": ["reduce", "nowhere", "-o", "new"], "inspect": ["inspect", "nowhere.mat"],
    "sweep": ["sweep", "cases/ding-2010", "tool.teeth=2,3", *SMALL, "--out", "new"], "merge": ["merge", "nowhere", "-o", "new"],
    "init": ["init", "new"], "compare": ["compare", "results", "results"], "report": ["report", "results"],
    "animate": ["animate", "nowhere"], "completion": ["completion", "bash"], "man": ["man"], "schema": ["schema"], "doctor": ["doctor"],
}
FORCES = """feed_per_tooth_mm,depth_mm,force_feed_n,force_normal_n,force_axis_n
0.025,3,-40.72,62.28,56.76
0.05,3,-60.58,106.83,70.06
0.1,3,-76.33,173.99,88.17
"""
NUMBERS = ("", "nan", "inf", "-1", "1e300", "1.5", "many", "99999999999999999999", "3 furlong", "1,2")
OTHERS = ("", "unheard_of", "nan", "\x1b[31m", "w" * 5000)
POINTS = ("", "5000 rpm", "5000, 1", "0 rpm, 1 mm", "-5000 rpm, 1 mm", "5000 rpm, -1 mm", "nan rpm, 1 mm", "5000 rpm, inf mm",
          "5000 rpm, 1 kg", "5000 rpm, 1 mm, 2", "1e300 rpm, 1 mm", "5000 rpm; 1 mm", "1 mm, 5000 rpm", ", ", "w" * 5000)
SETTINGS = ("tool.teeth", "=", "=3", "tool.teeth=", "tool..teeth=3", ".teeth=3", "tool.=3", "tool=3", "tool.teeth.x=3", "unheard.of=3",
            "tool.modes=3", "tool.modes[0]=3", "tool.modes[9].stiffness=3", "tool.modes[-1].stiffness=3", "tool.modes[].stiffness=3",
            "tool.modes[0.stiffness=3", "tool.modes[1e9].stiffness=3", "tool[0].teeth=3", "tool teeth=3", "\x1b=3", "tool.teeth=3\n[a]\nb=3",
            "tool.teeth=3]", "tool.teeth=[", "tool.teeth={", 'tool.teeth="', "tool.teeth='''", "w" * 5000 + "=3", "tool.teeth=#", "tool.teeth==3")
GRIDS = ("tool.teeth", "tool.teeth=", "tool.teeth=1:2", "tool.teeth=1:9:0", "tool.teeth=9:1:1", "tool.teeth=1:9:-1", "tool.teeth=1:2:3:4",
         "tool.teeth=nan:2:1", "tool.teeth=1:1e300:1", "tool.teeth=1:2:1e-300", "tool.teeth=,", "tool.teeth=2,,3", "tool.teeth=2,0", "tool.teeth=0:2:1", "unheard.of=1,2",
         "tool.diameter=1 mm:2 kg:1 mm")


def prepare(program, scratch, root):
    """Fills the folder of these inputs: cases, files, and a result folder that `run` makes."""
    folder = scratch / AT
    (folder / "cases").mkdir(parents=True)
    for name in ("ding-2010", "huynh-2017-support", "posture-map", "hajdu-2020", "cantilever-wall"):
        (folder / "cases" / name).symlink_to(root / "cases" / name)
    for name in ("tip.csv", "tool.toml", "modes.csv"):
        (folder / name).write_bytes((root / "docs/tutorials/tip" / name).read_bytes())
    (folder / "forces.csv").write_text(FORCES)
    subprocess.run([program, "run", "cases/ding-2010", *SMALL, "--out", "results"], cwd=folder, check=False, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def options_of(program, command):
    """(name, what it takes or "") of every option in the help of a command."""
    text = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=True).stdout
    for line in text.partition("Options:")[2].splitlines():
        match = re.match(r"  (?:-\w,)?(--[\w-]+)(?: (\S[^ ]*(?: [a-zA-Z|\[\]\-\d.:]+)*))?", line)
        if match and match[1] not in ("--help", "--version"):
            yield match[1], "" if match[2] is None or match[2].startswith(("Excludes", "Needs")) else match[2]


def values_of(command, option, takes):
    """Values that an option of a command cannot have."""
    if option in ("--out", "--json", "--html", "--page"):
        return ()
    if option == "--set":
        return SETTINGS if command in ("check", "lobes") else SETTINGS[:4]
    if option == "--at":
        return POINTS
    if "INT" in takes or "FLOAT" in takes or takes in ("BYTES", "FREQUENCY", "I/N", "N:INT", "LENGTH"):
        return NUMBERS
    return OTHERS


def without(words, option):
    """The words without an option and its value."""
    names = {"--out": ("--out", "-o")}.get(option, (option,))
    place = next((i for i, word in enumerate(words) if word in names), None)
    return words if place is None or option == "--set" else words[:place] + words[place + 2:]


def options(program):
    """Every option of every command: without its value, with values that it cannot have, and twice."""
    for command, right in RIGHT.items():
        yield Input(f"{command}: an unknown option", [*right, "--unheard-of"], AT, {}, ("--unheard-of",), True, (2,))
        yield Input(f"{command}: an unknown letter", [*right, "-Z"], AT, {}, ("-Z",), True, (2,))
        yield Input(f"{command}: more words than it takes", [*right, *["more"] * 3], AT, {}, (), command not in ("fit", "lobes", "merge", "sweep"),
                    (2, 3, 4))
        for option, takes in options_of(program, command):
            rest = without(right, option)
            if takes:
                yield Input(f"{command}: {option} without its value", [*rest, option], AT, {}, (option,), True, (2,))
            if takes and takes != "...":
                for value in values_of(command, option, takes):
                    if "\0" not in value:
                        yield Input(f"{command}: {option} {value[:60]!r}", [*rest, option, value], AT, {},
                                    (option, value[:40].replace("\x1b", "?") or '""', "nowhere", "the band", *known_keys(value)), False, (2, 3, 4))


def known_keys(setting):
    """The tables that a setting names, as messages may call it: tool.modes of tool.modes[0]=3."""
    table = re.match(r"[a-z]+(?:\.[a-z]+)*", setting.partition("=")[0]) if "=" in setting else None
    return (table.group(),) if table else ()


def wrong_files(program, scratch, root):
    """Commands that read files, with files that are not theirs."""
    noise = random.Random(3).randbytes(2000)
    readers = {
        "lobes": lambda file: ["lobes", file, "--tool", "tool.toml", "--quantity", "accelerance", "--unit", "m/s^2/N", *SMALL, "--out", "new"],
        "lobes --tool": lambda file: ["lobes", "modes.csv", "--tool", file, "--out", "new", "-q"],
        "fit": lambda file: ["fit", file, "--quantity", "accelerance", "--unit", "m/s^2/N", "-o", "new"],
        "fit --geometry": lambda file: ["fit", "tip.csv", "--quantity", "accelerance", "--unit", "m/s^2/N", "--geometry", file, "-o", "new"],
        "fit --swap": lambda file: ["fit", "tip.csv", "--quantity", "accelerance", "--unit", "m/s^2/N", "--swap", file, "-o", "new"],
        "inspect": lambda file: ["inspect", file],
        "inspect --stiffness": lambda file: ["inspect", "--stiffness", file, "--unit", "mm", "--mass-unit", "t"],
        "coefficients": lambda file: ["coefficients", file, "--teeth", "2"],
        "compare": lambda file: ["compare", file, "results"], "merge": lambda file: ["merge", file, "-o", "new"],
        "report": lambda file: ["report", file], "animate": lambda file: ["animate", file],
        "run": lambda file: ["run", file, "--out", "new"],
        "reduce": lambda file: ["reduce", file, "-o", "new"], "simulate": lambda file: ["simulate", file, "--out", "new"],
        "robot": lambda file: ["robot", file, "--out", "new"], "postures": lambda file: ["postures", file, "--out", "new"],
        "calibrate": lambda file: ["calibrate", file, "--out", "new"], "validate": lambda file: ["validate", file],
    }
    for name, words in readers.items():
        endings = ("csv", "uff", "mat", "frf", "lvm", "toml") if name in ("lobes", "fit", "inspect") else ("toml",)
        for ending in endings:
            file = f"hostile.{ending}"
            for what, data in (("empty", b""), ("random bytes", noise), ("text", b"once upon a time\n"), ("one line", b"1,2,3\n")):
                yield Input(f"{name} FILE: {ending}, {what}", words(file), AT, {file: data}, (file, "hostile"), True, (2, 3, 4, 6))
            yield Input(f"{name} FILE: {ending}, a folder", words(file), AT, {file: lambda path: path.mkdir()}, (file,), True, (2, 3, 4, 6))
        yield Input(f"{name} FILE: none", words("nowhere"), AT, {}, ("nowhere",), True, (2, 3, 4))
        yield Input(f"{name} FILE: no name", words(""), AT, {}, (), True, (2, 3, 4))
    for name, ending in (("fit", "csv"), ("lobes", "csv"), ("coefficients", "csv")):
        source = "forces.csv" if name == "coefficients" else "tip.csv"
        for what, data, refused in file_inputs.spoiled((scratch / AT / source).read_bytes()):
            yield Input(f"{name}: {source}, {what}", readers[name](f"hostile.{ending}"), AT, {f"hostile.{ending}": data},
                        (f"hostile.{ending}", *(() if refused else ("tool.measured", "K_t", "test "))), refused, (3, 4, 5))
    for seed in ("uff/ascii_complex_double_even_with_coherence", "uff/binary_double_uneven_big", "mat4/complex", "csv/cutpro.frf"):
        ending = {"u": "uff", "m": "mat", "c": "frf"}[seed[0]]
        for what, data, refused in file_inputs.spoiled(file_inputs.original(root, seed)):
            for name in ("fit", "inspect") if ending == "uff" else ("fit",):
                yield Input(f"{name}: {seed}, {what}", readers[name](f"hostile.{ending}"), AT, {f"hostile.{ending}": data},
                            (f"hostile.{ending}",), refused, (3, 4, 5, 6))


def spoiled_results(scratch):
    """Result folders of which a file is not right."""
    for file in ("summary.json", "manifest.json"):
        if not (scratch / AT / "results" / file).is_file():
            continue
        for what, data, _ in file_inputs.spoiled((scratch / AT / "results" / file).read_bytes()):
            for words in (["compare", "broken", "results"], ["report", "broken"], ["animate", "broken"]):
                yield Input(f"{words[0]}: {file}, {what}", words, AT, {f"broken/{file}": data},
                            ("broken",), False, (3, 4, 6))


def others(scratch):
    """What is wrong with the line as a whole, and with where results go."""
    for words in (["unheard-of"], ["RUN"], ["run"], ["run", "cases/ding-2010", "cases/ding-2010"], ["--set", "a=3"], ["-Z"], ["--"],
                  ["check", "--", "--set"], ["\x1b[31m"], [b"\xff"], ["w" * 5000], ["check", "cases/ding-2010", b"--\xff"],
                  ["run", "cases/ding-2010", "-q", "-v"], ["init", "--template", "unheard_of"], ["init", "results"], ["completion", "tcsh"],
                  ["schema", "unheard_of"], ["man", "more"], ["sweep", "cases/ding-2010"], ["merge", "nothing"], ["compare", "results"],
                  ["inspect"], ["inspect", "a", "--stiffness", "b"], ["coefficients", "forces.csv"], ["lobes", "tip.csv"],
                  ["lobes", "tip.csv", "--tool", "tool.toml"], ["lobes", "q=tip.csv", "--tool", "tool.toml"],
                  ["fit", "P.x/Q=tip.csv"], ["fit", "=tip.csv"], ["fit", "x="], ["animate", "results", "--mode", "99999"]):
        yield Input(f"the line {words!r}"[:80], words, AT, {}, (), True, (2, 3, 4))
    places = (("a file", "tip.csv"), ("below a file", "tip.csv/new"), ("no name", ""), ("a name too long", "w" * 5000), ("a device", "/dev/null"),
              ("the system's", "/proc/new"), ("a NUL device below", "/dev/null/new"))
    outs = {"run": "--out", "lobes": "--out", "fit": "-o", "sweep": "--out", "report": "--out"}
    for name, option in outs.items():
        for what, place in places[1 if name == "report" else 0:]:  # a file that is there is written anew
            yield Input(f"{name}: {option} is {what}", [*without(RIGHT[name], "--out"), option, place], AT, {},
                        (place[:40] or option, option), True, (2, 3, 4))
    yield Input("reduce: ranks of no case", ["reduce", "nowhere", "--ranks", "2", "-o", "new"], AT, {}, ("nowhere",), True, (3,))
    yield Input("sweep: a file that is not TOML", ["sweep", "hostile.toml", "tool.teeth=2,3", "--out", "new"], AT,
                {"hostile.toml": b"once upon a time\n"}, ("hostile.toml",), True, (3,))
    frf = ["tip.csv", "--quantity", "accelerance", "-o", "new"]
    for option, words in (("--unit", ["fit", *frf, "--unit", "furlong"]), ("--unit", ["fit", *frf, "--unit", "m/N"]),
                          ("--frequency-unit", ["fit", *frf, "--unit", "m/s^2/N", "--frequency-unit", "parsec"]),
                          ("--from", ["fit", *frf, "--unit", "m/s^2/N", "--from", "parsec"]),
                          ("--from", ["fit", *frf, "--unit", "m/s^2/N", "--from", "1e300"]),
                          ("--of", ["animate", "results", "--of", "nothing"]),
                          ("--template", ["init", "new", "--template", "unheard_of"])):
        yield Input(f"{words[0]}: {option} {words[-1]} is told by the option", words, AT, {}, (option,), True, (2, 3))
    for grid in GRIDS:
        yield Input(f"sweep: {grid}", ["sweep", "cases/ding-2010", grid, *SMALL, "--out", "new"], AT, {},
                    (grid, grid.partition("=")[0]), True, (2, 3))


def inputs(program, scratch, root):
    yield from others(scratch)
    yield from options(program)
    yield from wrong_files(program, scratch, root)
    yield from spoiled_results(scratch)
