#!/usr/bin/env python3
"""Runs what the documentation shows.

    snippets_test.py PROGRAM [PAGE ...]     PROGRAM: the built thinwall; pages: all unless named
    snippets_test.py --pages                the names of all pages

Each page is read from its top in a scratch folder of its own, in which `thinwall`, `./thinwall`, `cases` and `docs` are there. A
remark before a block says what becomes of it:

    <!-- run -->                            its commands, in order; each must end with exit code 0
    <!-- run; exit 6 -->                    ... the last one with this, or with a word behind that which has it
    <!-- run; exit 6; miss first mode -->   ... and only the expectations that are named are missed, with exit code 6
    <!-- run; add --set lobes.count=9 -->   ... with this added to every thinwall run, lobes, reduce, simulate or postures, to be quick
    <!-- run; with docs/tutorials/tip -->   ... with the files of this folder at hand
    <!-- run; as check wall-path -->        ... `thinwall check` in place of `thinwall run` where this case is run (all: no name)
    <!-- printed -->                        every line must be in what the block before printed; "…" stands for anything
    <!-- file: tool.toml -->                becomes this file
    <!-- add to: wall/case.toml -->         is written to the end of it
    <!-- not run: why -->                   commands that are not run, with the reason

A run or a simulation of a shipped case begins with what a run of another test with equal settings has kept, so that a
page waits for it once at most.
A block of commands without one of these is a failure. Every other block that is TOML must name keys that docs/case-file.md
has. A command ends before three blanks or " # ", where its explanation begins.
"""

import fnmatch
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from shared_runs import shared_run  # noqa: E402

LIMIT_S = 900
COMMAND = re.compile(r"(\w+=\S+ )*(\$ )?(\./|((build|bench|cmake|fuzz|docs|\.ci|tests)/)+)?"
                     r"(thinwall|run|cmake|bench_\w+|check_\w+\.\w+|build|python3|apt-get|g\+\+|git|pip|export|cd|paraview)( |$)")
MARK = re.compile(r"^<!-- *(run|printed|file|add to|not run)\b:?(.*?)-->$")


class Block:
    """An indented or fenced block with the remark before it."""

    def __init__(self, page, line, mark, rest, lines):
        self.page, self.line, self.mark, self.rest, self.lines = page, line, mark, rest.strip(), lines

    def text(self):
        return "\n".join(self.lines) + "\n"

    def is_commands(self):
        return any(COMMAND.match(line) for line in self.lines)

    def commands(self):
        for line in self.lines:
            if line.strip() and not line.startswith("#"):
                yield re.split(r"\s{3,}| # ", line)[0].strip().removeprefix("$ ")

    def where(self):
        return f"{self.page}:{self.line}"


def blocks(page):
    """All blocks of a page."""
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    found, mark, rest, i = [], None, "", 0
    while i < len(lines):
        line, start = lines[i], i
        fence = re.match(r"^(```+|~~~+)(.*)$", line)
        marked = MARK.match(line)
        if marked:
            mark, rest = marked.groups()
        elif line.startswith("<!-- run") or line.startswith("<!-- not"):
            raise SystemExit(f"{page}:{i + 1}: a remark that is not understood: {line}")
        elif fence:
            i += 1
            while not lines[i].startswith(fence.group(1)):
                i += 1
            if not fence.group(2).startswith("{"):
                found.append(Block(page, start + 2, mark, rest, lines[start + 1:i]))
            mark, rest = None, ""
        elif line.startswith("    ") and line.strip() and (i == 0 or not lines[i - 1].strip()
                                                           or lines[i - 1].startswith("<!--")):
            while i + 1 < len(lines) and (lines[i + 1].startswith("    ") or
                                          (not lines[i + 1].strip() and any(map(str.strip, lines[i + 1:i + 3]))
                                           and next(filter(str.strip, lines[i + 1:])).startswith("    "))):
                i += 1
            found.append(Block(page, start + 1, mark, rest, [entry[4:] for entry in lines[start:i + 1]]))
            mark, rest = None, ""
        elif line.strip():
            if mark:
                raise SystemExit(f"{page}:{i + 1}: the remark above belongs to no block")
        i += 1
    return found


def known_keys():
    """Of docs/case-file.md: "part.mesh.tolerance" and so on, NAME and lists as *."""
    table, keys = "", set()
    for line in (ROOT / "docs/case-file.md").read_text(encoding="utf-8").splitlines():
        heading = re.match(r"^### `\[+([\w.]+)\]+`", line)
        if line.startswith("##"):
            table = heading.group(1).replace("NAME", "*") + "." if heading else ""
        row = re.match(r"^\| `(\w+)` \|", line)
        if row:
            keys.add(table + row.group(1))
    return keys


def keys_of(value, path=""):
    """The dotted keys of parsed TOML."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from keys_of(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list) and value and all(isinstance(entry, dict) for entry in value):
        for entry in value:
            yield from keys_of(entry, path)
    else:
        yield path


def parsed(block):
    """The TOML texts of a block: as a whole, else what empty lines part; nothing if it is no TOML."""
    for texts in ([block.text()], block.text().split("\n\n")):
        try:
            values = [tomllib.loads(text) for text in texts]
            return values if any(isinstance(entry, (dict, list)) for value in values for entry in value.values()) else []
        except tomllib.TOMLDecodeError:
            continue
    return None if re.search(r"(?m)^\[+[a-z_.]+\]+( |$)", block.text()) else []


class Runner:
    """Runs the blocks of one page after the other."""

    def __init__(self, program):
        self.program, self.keys = pathlib.Path(program).resolve(), known_keys()
        self.faults, self.counts, self.slowest = [], {"commands": 0, "printed": 0, "files": 0, "toml": 0, "not run": 0}, []

    def fault(self, block, text):
        self.faults.append(f"{block.where()}: {text}")
        print(f"FAILED {self.faults[-1]}", flush=True)

    def page(self, page):
        with tempfile.TemporaryDirectory(prefix="thinwall-docs-") as folder:
            folder = pathlib.Path(folder)
            for name in ("cases", "docs"):
                (folder / name).symlink_to(ROOT / name)
            for place in (folder / "thinwall", folder / ".bin" / "thinwall"):
                place.parent.mkdir(exist_ok=True)
                place.symlink_to(self.program)
            output = ""
            for block in blocks(page):
                output = self.block(block, folder, output)

    def block(self, block, folder, output):
        if block.mark == "run":
            return self.run(block, folder)
        if block.mark == "printed":
            self.compare(block, output)
        elif block.mark in ("file", "add to"):
            path = folder / block.rest
            path.parent.mkdir(parents=True, exist_ok=True)
            if block.mark == "add to" and not path.is_file():
                self.fault(block, f"there is no {block.rest} to add to")
            with open(path, "a" if block.mark == "add to" else "w", encoding="utf-8") as file:
                file.write(block.text())
            self.counts["files"] += 1
        elif block.mark == "not run":
            self.counts["not run"] += 1
            if not block.rest:
                self.fault(block, "not run, and no reason is given")
        elif block.is_commands():
            self.fault(block, "commands that are neither run nor excused")
        if block.mark in (None, "file", "add to"):
            self.check_keys(block)
        return output

    def check_keys(self, block):
        texts = parsed(block)
        if texts is None:
            self.fault(block, "this is no TOML")
            return
        self.counts["toml"] += bool(texts)
        for key in (key for text in texts for key in keys_of(text)):
            if not any(fnmatch.fnmatchcase(key, known) for known in self.keys):
                self.fault(block, f"docs/case-file.md has no key {key}")

    def run(self, block, folder):
        wishes = [wish.strip() for wish in block.rest.split(";") if wish.strip()]
        exits = [wish.split()[1:] for wish in wishes if wish.startswith("exit ")]
        checked = next((wish.split()[2:] for wish in wishes if wish.startswith("as check")), None)
        added = " ".join(wish[4:] for wish in wishes if wish.startswith("add "))
        missed = [wish[5:].strip() for wish in wishes if wish.startswith("miss ")]
        for wish in wishes:
            if wish.startswith("with "):
                shutil.copytree(ROOT / wish[5:], folder, dirs_exist_ok=True)
        commands, output = list(block.commands()), ""
        for number, command in enumerate(commands):
            if checked is not None and (not checked or any(word in command for word in checked)):
                command = command.replace("thinwall run ", "thinwall check ")
            if added and "--help" not in command and re.search(r"thinwall (run|lobes|reduce|simulate|postures) ", command):
                command += f" {added}"
            expected = next((int(code) for code, *words in exits if any(word in command for word in words)
                             or not words and number == len(commands) - 1), 0)
            start = time.monotonic()
            self.bring_kept_results(command, folder)
            code, text = self.call(command, folder)
            took = time.monotonic() - start
            print(f"{block.where()}: {command}  ({took:.1f} s)", flush=True)
            self.slowest.append((took, command))
            self.counts["commands"] += 1
            if code != expected:
                self.fault(block, f"{command}\n  ended with {code}, not {expected}\n" + text[-3000:])
            elif code == 6:
                self.check_missed(block, missed, text)
            output += text
        return output

    def bring_kept_results(self, command, folder):
        """Copies the results of a run with equal settings to where this command would write, if there are none yet; of
        them a simulation needs what is kept for the next run only."""
        begin = re.match(r"(\./)?thinwall (run|simulate) cases/[\w-]+( |$)", command)
        if not begin:
            return
        words = shlex.split(command)
        case = words[2].removeprefix("cases/")
        settings = [value for word, value in zip(words, words[1:]) if word == "--set"]
        out = folder / next((value for word, value in zip(words, words[1:]) if word == "--out"), f"results/{case}")
        if not out.exists():
            kept, code = shared_run(self.program, ROOT, case, settings)
            if code in (0, 6):
                part = "cache" if begin[2] == "simulate" else "."
                shutil.copytree(kept / part, out / part)

    def check_missed(self, block, named, output):
        """The expectations that do not hold are those that the remark names: any other one would go unnoticed."""
        lines = re.findall(r"(?m)^ *MISS +(.+?) {2,}", output)
        if not named or sorted(lines) != sorted(named):
            self.fault(block, f"missed are {'; '.join(lines) or 'none'}, not {'; '.join(named) or 'any that the remark names'}")

    def call(self, command, folder):
        """Exit code and output of a command, with its children ended if it takes too long."""
        environment = os.environ | {"PATH": f"{folder / '.bin'}:{os.environ['PATH']}", "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}
        with subprocess.Popen(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True) as process:
            try:
                out, _ = process.communicate(timeout=LIMIT_S)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return -1, f"took more than {LIMIT_S} s"
        return process.returncode, out.decode("utf-8", errors="replace")

    def compare(self, block, output):
        """Every line of the block in the output, in order, blanks alike."""
        lines = [" ".join(line.split()) for line in output.splitlines()]
        at = 0
        for wanted in (" ".join(line.split()) for line in block.lines if line.strip(" …")):
            pattern = re.compile(".*".join(map(re.escape, wanted.split("…"))) + "$")
            found = next((i for i in range(at, len(lines)) if pattern.match(lines[i])), None)
            if found is None:
                self.fault(block, f"not printed: {wanted}\n  printed was:\n" + output[-3000:])
                return
            at = found + 1
            self.counts["printed"] += 1


def pages():
    """All pages that show commands or cases. Blocks of the theory are equations."""
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md")),
             *sorted((ROOT / "cases").glob("*/README.md"))]
    return [path.relative_to(ROOT).as_posix() for path in found if path.parent != ROOT / "docs/theory"]


def main():
    if sys.argv[1:] == ["--pages"]:
        print("\n".join(pages()))
        return 0
    start = time.monotonic()
    runner = Runner(sys.argv[1])
    chosen = sys.argv[2:] or pages()
    for page in chosen:
        runner.page(page)
    counts = runner.counts
    print("slowest: " + "; ".join(f"{command} {took:.0f} s" for took, command in sorted(runner.slowest, reverse=True)[:3]))
    print(f"{len(chosen)} pages: {counts['commands']} commands run, {counts['printed']} printed lines and {counts['files']} files, "
          f"{counts['toml']} blocks of TOML with known keys, {counts['not run']} blocks not run, with reasons; "
          f"{len(runner.faults)} failures; {time.monotonic() - start:.0f} s")
    return 1 if runner.faults else 0


if __name__ == "__main__":
    sys.exit(main())
