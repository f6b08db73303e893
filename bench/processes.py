"""Programs under the clock: wall and processor time, peak memory, a time limit, and when each line was printed."""

import contextlib
import dataclasses
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

PERIOD_S = 0.2  # between two looks at the processor time


@dataclasses.dataclass
class Finished:
    """A program that ran. `lines`: (seconds since its start, text) of its standard output."""

    wall_s: float
    cpu_s: float
    peak_memory_bytes: float
    failure: str  # empty if all went well
    lines: list
    exit_code: int = 0  # negative for a signal

    @property
    def last_line(self):
        return self.lines[-1][1] if self.lines else ""


def environment(**changes):
    """The caller's environment without settings of threads, so that each program gets those that it is given here."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("OMP_", "OPENBLAS_", "CCX_", "PETSC_", "SLEPC_"))}
    return {**kept, "LC_ALL": "C", **{k: str(v) for k, v in changes.items()}}


def bring_pages(size_bytes):
    """Has a short-lived process touch so much memory, half of what is free at most. A virtual machine may have handed
    its free memory back to its host, which brings it again at a second a GB: whatever runs first would be charged."""
    size_bytes = int(min(size_bytes, os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_AVPHYS_PAGES") / 2))
    touch = ("import mmap, sys; n = int(sys.argv[1]); m = mmap.mmap(-1, n, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS); "
             "m.madvise(mmap.MADV_HUGEPAGE); m[::4096] = bytes(-(-n // 4096))")
    subprocess.run([sys.executable, "-c", touch, str(size_bytes)], check=False)


def processor_time_s(session):
    """User and system time of all processes of a session and of the children that they have waited for."""
    ticks = 0
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):  # it may just have ended
            fields = stat.read_text().rpartition(")")[2].split()  # from the state on, the third field of proc(5)
            if int(fields[3]) == session:
                ticks += sum(map(int, fields[11:15]))
    return ticks / os.sysconf("SC_CLK_TCK")


def run(command, time_limit_s, folder, env, processor_limit_s=None):
    """Runs to the end or to a limit, of wall time or of the processor time of all its processes; memory is the largest
    of any one process in it (getrusage of the child)."""
    start = time.monotonic()
    errors = pathlib.Path(folder) / "stderr.txt"
    with errors.open("wb") as error_file:
        child = subprocess.Popen([str(word) for word in command], cwd=folder, env=env, stdout=subprocess.PIPE,
                                 stderr=error_file, text=True, errors="replace", start_new_session=True)
        exceeded = threading.Event()

        def stop():
            exceeded.set()
            with contextlib.suppress(ProcessLookupError):  # it may just have ended
                os.killpg(child.pid, signal.SIGKILL)

        ended = threading.Event()
        seen_s = [0.0]

        def watch():
            while not ended.wait(PERIOD_S):
                seen_s[0] = max(seen_s[0], processor_time_s(child.pid))
                if seen_s[0] > processor_limit_s:
                    return stop()

        timer = threading.Timer(time_limit_s, stop)
        timer.start()
        if processor_limit_s is not None:
            threading.Thread(target=watch, daemon=True).start()
        try:
            lines = [(time.monotonic() - start, line.rstrip("\n")) for line in child.stdout]
            _, status, usage = os.wait4(child.pid, 0)
        except BaseException:  # interrupted: nothing goes on behind the user's back
            stop()
            raise
        finally:
            timer.cancel()
            ended.set()
    wall_s = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    child.stdout.close()
    failure = ""
    if exceeded.is_set():
        failure = f"stopped at the limit of {time_limit_s:g} s"
        if processor_limit_s is not None:
            failure += f" or {processor_limit_s:g} s of processor time"
    elif child.returncode != 0:
        said = [line for line in errors.read_text(errors="replace").splitlines() if line.strip()]
        how = f"signal {-child.returncode}" if child.returncode < 0 else f"exit {child.returncode}"
        failure = f"{how}: {said[0].strip() if said else 'no message'}"
    cpu_s = max(seen_s[0], usage.ru_utime + usage.ru_stime)  # a killed process has not waited for its own children
    return Finished(wall_s, cpu_s, 1024.0 * usage.ru_maxrss, failure, lines,
                    child.returncode)


def machine():
    """What the figures were measured on."""
    model = "unknown"
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"processor": model, "cores": len(os.sched_getaffinity(0)), "memory_bytes": memory,
            "load_at_start": os.getloadavg()[0]}
