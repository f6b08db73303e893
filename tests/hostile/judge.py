"""One input of the program, how it is run, and what is wrong with how the program answers."""

import dataclasses
import math
import os
import signal
import subprocess
import unicodedata

CODES = {0: "done", 2: "usage", 3: "invalid case", 4: "unreadable data", 5: "numerical failure", 6: "expectation missed"}
CRASH_WORDS = ("internal error", "terminate called", "Sanitizer", "runtime error:", "Assertion", "std::", "bad_alloc")
MOST_SECONDS = 2.0  # of the processor, all threads together, for what is refused
# The time of the processor that `check` may take for what it accepts: it computes modes for two seconds at most, and then
# rows of the part alone and of the supported part, each for study::forecast_limit_s of 2.5 s.
MOST_FORECAST_SECONDS = MOST_SECONDS + 2.0 + 2 * 2.5
MOST_WAIT = 60      # s, after which a program is said to hang; far from what any input takes
LONGEST_LINE = 600  # bytes: docs/conventions.md, exit codes
MOST_LINES = 21     # problems of a case that are shown, and the line that counts the others


@dataclasses.dataclass
class Input:
    """Words for the program, run in the folder `at`, with files that are made for it and removed after it."""

    name: str
    words: list
    at: str = "."
    files: dict = dataclasses.field(default_factory=dict)  # path below `at`: bytes, or a function that makes it
    named: tuple = ()      # one of these stands in a line of the message
    refused: bool = False  # nothing but a refusal is right
    codes: tuple = (3,)    # of a refusal
    right: bool = False    # nothing is wrong with it


@dataclasses.dataclass
class Answer:
    code: int
    out: str
    err: bytes
    seconds: float
    hung: bool = False
    written: list = dataclasses.field(default_factory=list)

    @property
    def lines(self):
        return self.err.decode("utf-8", "replace").splitlines()

    @property
    def problems(self):
        return [line for line in self.lines if line.startswith("thinwall: ")]


def paths_in(folder):
    """All paths below a folder, with size and time of change of files."""
    found = {}
    for path in folder.rglob("*"):
        state = path.lstat()
        found[path.relative_to(folder).as_posix()] = (state.st_size, state.st_mtime_ns) if not path.is_dir() else None
    return found


def ended(process):
    """Code, seconds of the processor, and whether the process had to be killed."""
    def kill(*_):
        process.kill()
        kill.called = True
    kill.called = False
    before = signal.signal(signal.SIGALRM, kill)
    signal.alarm(MOST_WAIT)
    _, status, used = os.wait4(process.pid, 0)
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_utime + used.ru_stime, kill.called


def answer_to(program, given, scratch):
    """Runs the program on an input; `scratch` has the folders that inputs are run in, and is left as it was."""
    folder = scratch / given.at
    at_first = paths_in(folder).keys()
    for name, content in given.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if callable(content):
            content(path)
        else:
            path.write_bytes(content)
    before = paths_in(folder)
    with open(scratch / "out", "w+b") as out, open(scratch / "err", "w+b") as err:
        process = subprocess.Popen([program, *given.words], stdin=subprocess.DEVNULL, stdout=out, stderr=err, cwd=folder,
                                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        code, seconds, hung = ended(process)
        out.seek(0)
        err.seek(0)
        after = paths_in(folder)
        answer = Answer(code, out.read().decode("utf-8", "replace"), err.read(), seconds, hung,
                        sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name)))
    remove(folder, after.keys() - at_first)
    return answer


def remove(folder, names):
    """Files and folders go, the deepest first."""
    for name in sorted(names, key=len, reverse=True):
        path = folder / name
        path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()


def wrong_lines(answer):
    """What is wrong with the form of the message."""
    found = []
    if any(word in answer.err.decode("utf-8", "replace") for word in CRASH_WORDS):
        found.append("speaks of the inside of the program")
    if not answer.problems or answer.lines[0] != answer.problems[0]:
        found.append("does not begin with a line of its own")
    if len(answer.problems) > MOST_LINES:
        found.append(f"{len(answer.problems)} lines of problems")
    if any(not line.startswith(("thinwall: ", "  ")) for line in answer.lines):
        found.append("has lines that are neither a problem nor its place")
    if any(len(line) > LONGEST_LINE for line in answer.err.split(b"\n")):
        found.append(f"a line of more than {LONGEST_LINE} bytes")
    if any(byte < 32 and byte not in b"\t\n" or byte == 127 for byte in answer.err):
        found.append("control characters")
    if any(unicodedata.category(letter) in ("Cc", "Cf") and letter not in "\t\n" for letter in answer.err.decode("utf-8", "replace")):
        found.append("characters that are not seen")
    try:
        answer.err.decode("utf-8")
    except UnicodeDecodeError:
        found.append("is not UTF-8")
    return found


def wrong_with(given, answer):
    """Everything that is wrong with the answer to an input."""
    checked = given.words[:1] == ["check"]
    found = ["hangs"] if answer.hung else []
    if answer.code not in CODES:
        return found + [f"exit code {answer.code}"]
    if answer.code != 0 and given.right:
        return found + ["refused: " + answer.lines[0]]
    if answer.code == 0 and given.refused:
        found.append("accepted")
    most = MOST_SECONDS if answer.code != 0 else MOST_FORECAST_SECONDS if checked else math.inf
    if answer.seconds > most:
        found.append(f"{answer.seconds:.1f} s of the processor")
    if answer.code in (0, 6):
        return found + (["writes " + ", ".join(answer.written[:3])] if answer.written and checked else [])
    if answer.code not in given.codes:
        found.append(f"exit code {answer.code} in place of {' or '.join(map(str, given.codes))}")
    if answer.written:
        found.append("writes " + ", ".join(answer.written[:3]))
    if given.named and not any(name in line for name in given.named for line in answer.problems):
        found.append("names none of " + ", ".join(given.named))
    return found + wrong_lines(answer)
