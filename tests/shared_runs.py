"""Runs of shipped cases that several tests begin with, each made once for a built program: by the first test that asks."""

import fcntl
import hashlib
import pathlib
import shutil
import subprocess


def digest_of_cases(root):
    """Of what a run can read below root/cases: the files of all cases, since one may read those of another."""
    digest = hashlib.sha256()
    for file in sorted((root / "cases").rglob("*")):
        if file.is_file() and file.suffix != ".md":
            digest.update(f"{file.relative_to(root)}\n{file.stat().st_size}\n".encode() + file.read_bytes())
    return digest.hexdigest()


def shared_run(program, root, case, settings=()):
    """The folder of results of `thinwall run cases/CASE --set SETTING …` below the build folder, to be read and copied only,
    and the exit code of that run. Another test that asks at the same time waits; it runs again once the program was built anew
    or a case was changed. The case is named as the pages name it, from its repository's root: what is kept of files goes by
    their names, too."""
    program = program.resolve()  # it runs in another folder
    built = program.stat()
    key = hashlib.sha256("\n".join([case, *settings]).encode()).hexdigest()[:12]
    place = program.parents[1] / "tests" / "runs" / f"{case}-{key}"
    place.mkdir(parents=True, exist_ok=True)
    folder, verdict = place / "results", place / "exit_code"
    wanted = f"{built.st_mtime_ns} {built.st_size} {digest_of_cases(root)}"
    with open(place / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        known = verdict.read_text(encoding="utf-8").split("\n") if verdict.is_file() else []
        if known[:1] != [wanted]:
            shutil.rmtree(folder, ignore_errors=True)
            words = [word for setting in settings for word in ("--set", setting)]
            done = subprocess.run([program, "run", f"cases/{case}", "--out", folder, "-q", *words], cwd=root,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
            known = [wanted, str(done.returncode)]
            verdict.write_text("\n".join(known), encoding="utf-8")
    return folder, int(known[1])
