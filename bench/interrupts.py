"""How soon the program ends after an interrupt at a random moment of each shipped case."""

import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

import fem
import processes

PROGRAM = fem.ROOT / "build" / "release" / "app" / "thinwall"
SIGNALS = (signal.SIGINT, signal.SIGTERM)


def add_command(commands):
    parser = commands.add_parser("interrupts", description=__doc__, help="the time from an interrupt to the end of a run")
    parser.add_argument("cases", nargs="*", type=pathlib.Path, metavar="CASE", help="folders of cases (all shipped ones)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as of thinwall run")
    parser.add_argument("--moments", type=fem.positive(int), default=12, metavar="N", help="interrupts a case (12)")
    parser.add_argument("--longest", type=fem.positive(float), default=120.0, metavar="S",
                        help="seconds of a case among which the moments are drawn (120)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the moments (1)")
    parser.add_argument("--bar", type=fem.positive(float), default=0.5, metavar="S", help="the largest time allowed (0.5)")
    parser.set_defaults(run=run)


def started(case, folder, overrides):
    words = [PROGRAM, "run", case, "--out", folder, "--fresh", "-v", "--progress", "never"]
    words += [word for value in overrides for word in ("--set", value)]
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                            env=processes.environment())


def duration(case, overrides, longest):
    """Seconds that the case takes, at most `longest`."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        process = started(case, folder, overrides)
        try:
            process.communicate(timeout=longest)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
        return time.monotonic() - start


def interrupted(case, overrides, moment, number):
    """(seconds from the signal to the end, exit code, stage); no code if the run had ended before."""
    with tempfile.TemporaryDirectory() as folder:
        process = started(case, folder, overrides)
        time.sleep(moment)
        if process.poll() is not None:
            return 0.0, None, ""
        sent = time.monotonic()
        process.send_signal(number)
        log = process.communicate()[1]
        stages = [line.removeprefix("stage: ") for line in log.splitlines() if line.startswith("stage: ")]
        left = [path for path in pathlib.Path(folder).rglob(".*.partial-*")]
        return time.monotonic() - sent, process.returncode, (stages or ["reading"])[-1] + (", files left" if left else "")


def run(arguments):
    if not PROGRAM.exists():
        sys.exit("bench/run interrupts: the program is not built; call ./thinwall --version first")
    draw = random.Random(arguments.seed)
    cases = arguments.cases or sorted(path.parent for path in (fem.ROOT / "cases").glob("*/case.toml"))
    worst = 0.0
    print("case                       runs   latest end after a signal")
    for case in cases:
        whole = duration(case, arguments.set, arguments.longest)
        ends = []
        for i in range(arguments.moments):
            moment = draw.uniform(min(0.05, 0.5 * whole), whole)
            ends.append(interrupted(case, arguments.set, moment, SIGNALS[i % 2]))
        ends = [end for end in ends if end[1] is not None]
        # Before the handlers stand, within the first hundredths of a second, a signal ends the process itself.
        if wrong := [end for end in ends if end[1] not in (0, 130, *(-number for number in SIGNALS))]:
            sys.exit(f"bench/run interrupts: {case.name} ended with code {wrong[0][1]} in the stage {wrong[0][2]}")
        latest = max(ends, default=(0.0, None, "none"))
        worst = max(worst, latest[0])
        print(f"{case.name:25} {whole:5.1f} s   {latest[0]:.2f} s in the stage {latest[2]} ({len(ends)} signals)", flush=True)
    print(f"latest of all             {worst:.2f} s, at most {arguments.bar} is allowed")
    return 0 if worst <= arguments.bar else 1
