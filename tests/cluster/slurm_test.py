#!/usr/bin/env python3
"""A sweep on a real Slurm, which this test starts on this machine with a configuration and folders of its own.

Forty points in four shards: two tasks are killed and the node is restarted, and the table is that of a serial sweep
all the same. A shard that is killed twice is told by `thinwall merge`. As root, with slurm-wlm and munge installed;
else skipped (exit code 77). Usage: slurm_test.py THINWALL CASE
"""

import contextlib
import csv
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

POINTS, SHARDS = 40, 4
KEY = "cutting.radial_depth=0.5 mm:4.4 mm:0.1 mm"
PATIENCE_S = 900.0


def skip(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(77)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(what, condition):
    """Waits until the condition holds, which never depends on how fast the machine is."""
    until = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        if time.monotonic() > until:
            sys.exit(f"FAILED: waited {PATIENCE_S:.0f} s for {what}")
        time.sleep(0.1)
    return found


def processes(*words, of=None):
    """Numbers of the processes whose command line has one of the words, and whose environment the folder `of`."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        with contextlib.suppress(OSError):
            line = entry.joinpath("cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            if any(word in line for word in words) and str(of).encode() in entry.joinpath("environ").read_bytes():
                found.append(int(entry.name))
    return found


def kill(numbers):
    for number in numbers:
        with contextlib.suppress(ProcessLookupError):
            os.kill(number, signal.SIGKILL)


class Slurm:
    """Controller, daemon and munge of one machine, in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.seen = {}  # jobs that wait after a restart, and since when
        for name in ("state", "spool"):
            (folder / name).mkdir()
        self.host = host = socket.gethostname().split(".")[0]
        self.conf = folder / "slurm.conf"
        self.conf.write_text(f"""
ClusterName=thinwall
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=1
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
KillWait=1
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = dict(os.environ, SLURM_CONF=str(self.conf))

    def run(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)

    def daemon(self, *command):
        return subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start_node(self, *options):
        self.node = self.daemon("slurmd", "-D", "-f", str(self.conf), *options)

    def start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.munge = self.daemon(
            "munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
            f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
            f"--seed-file={self.folder}/munged.seed")
        wait_for("munge", (self.folder / "munge.socket").exists)
        self.controller = self.daemon("slurmctld", "-D", "-f", str(self.conf))
        self.start_node()
        wait_for("the node", lambda: "idle" in self.run("sinfo", "-h", "-o", "%t").stdout)

    def restart_node(self):
        """The node with all that runs on it is lost, and begins anew; returns how many shards ran."""
        self.node.kill()
        self.node.wait()
        kill(processes("slurmstepd", of=self.folder))  # first, so that nobody reports how the jobs have ended
        shards = processes(" --shard ", of=self.folder)
        kill(processes("slurm_script", of=self.folder) + shards)
        time.sleep(2.0)  # the controller compares whole seconds: the node must begin after it answered last
        self.start_node("-b")
        wait_for("the loss of the node", lambda: "down" in self.run("sinfo", "-h", "-o", "%t").stdout)
        # With -b a daemon says at each of its reports that the machine has booted just now, and a second report would
        # be a second loss of the node: from here on another daemon reports without it.
        self.node.kill()
        self.node.wait()
        self.start_node()
        self.run("scontrol", "update", f"nodename={self.host}", "state=resume")
        return len(shards)

    def jobs(self):
        """The jobs that are not over; those that wait after a restart are told not to, eight seconds later: one that
        begins within the second of its end has the credential that was revoked then, and is lost, and on a loaded
        machine that end comes some seconds after the queue shows the job as waiting."""
        queue = self.run("squeue", "-h", "-r", "-o", "%i %t %r")
        lines = queue.stdout.splitlines() if queue.returncode == 0 else ["? ? the controller does not answer"]
        for line in lines:
            number, state, reason = line.split(maxsplit=2)
            if state == "PD" and "held" in reason.lower():
                self.release(number)
            if state != "PD" or reason != "BeginTime":
                continue
            if time.monotonic() - self.seen.setdefault(number, time.monotonic()) > 8.0:
                self.run("scontrol", "update", f"jobid={number}", "StartTime=now")
                del self.seen[number]
        return lines

    def release(self, number):
        """Does what Slurm leaves to its administrator: on a loaded machine a job may begin on the daemon that is about
        to be stopped, so that the next one is asked for a job that runs already. The job is held and the node drained
        then ("Duplicate jobid"), until somebody says that the first run is over, or soon will be."""
        self.run("scontrol", "update", f"nodename={self.host}", "state=resume")
        self.run("scontrol", "release", number)

    def waits(self, shard):
        """True if the job of a shard is in the queue and does not run."""
        return str(shard) in self.run("squeue", "-h", "-r", "-t", "PD", "-o", "%K").stdout.split()

    def stop(self):
        for process in (self.node, self.controller, self.munge):
            process.kill()
            process.wait()
        kill(processes("slurmstepd", "slurm_script", "--shard", of=self.folder))


def sweep(thinwall, case, out, *more):
    return [thinwall, "sweep", str(case), KEY, "--set", "lobes.count=150", "--out", str(out), "--threads", "1", *more]


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def computed(folder, shard):
    """Points of a shard that are there."""
    return [n for n in range(1, POINTS + 1)
            if n % SHARDS == shard % SHARDS and (folder / f"{n:03d}" / "point.json").exists()]


def test_forty_points(slurm, thinwall, case, folder):
    serial, cluster = folder / "serial", folder / "cluster"
    subprocess.run(sweep(thinwall, case, serial, "-q"), check=True, stdout=subprocess.DEVNULL)
    told = slurm.run(*sweep(thinwall, case, cluster, "--slurm", "--submit", "--shards", str(SHARDS)))
    assert told.returncode == 0, told.stderr
    # Two shards at a time: the first two are killed, and wait until nobody would be killed twice; then the node is lost.
    for shard in (1, 2):
        wait_for(f"a point of shard {shard}", lambda s=shard: computed(cluster, s))
        running = processes(f"--shard {shard}/{SHARDS}", of=folder)
        assert running, f"shard {shard} has ended before it could be killed"
        kill(running)
        # A node that is lost before the queue has the job again ends its next run, too, and for good.
        wait_for(f"shard {shard} in the queue again", lambda s=shard: slurm.waits(s))
    wait_for("shard 3 or 4", lambda: processes(f"--shard 3/{SHARDS}", f"--shard 4/{SHARDS}", of=folder))
    assert slurm.restart_node() > 0, "nothing ran on the node that was restarted"
    wait_for("the end of all jobs", lambda: not slurm.jobs())
    merged = rows(cluster / "merged" / "sweep.csv")
    assert len(merged) == POINTS + 1, len(merged)
    for found, wanted in zip(merged, rows(serial / "sweep.csv"), strict=True):
        assert found == wanted, f"a row of the cluster is not that of the serial sweep: {found} in place of {wanted}"
    print(f"{POINTS} of {POINTS} rows, equal to the serial sweep")


def test_killed_twice(slurm, thinwall, case, folder):
    out = folder / "given-up"
    told = slurm.run(*sweep(thinwall, case, out, "--slurm", "--submit", "--shards", "1"))
    assert told.returncode == 0, told.stderr
    for _ in range(2):
        kill(wait_for("the shard", lambda: slurm.jobs() and processes("--shard 1/1", of=folder)))
        time.sleep(0.5)
    wait_for("the end of all jobs", lambda: not slurm.jobs())
    assert (out / "shards" / "1.killed").exists()
    merged = subprocess.run([thinwall, "merge", str(out), "-o", str(folder / "table")], capture_output=True, text=True,
                            check=False)
    assert merged.returncode == 5, merged.returncode
    assert "shard 1 was killed twice" in merged.stdout and "missing" in merged.stdout, merged.stdout
    print("a shard that was killed twice is told")


def main():
    thinwall, case = sys.argv[1:3]
    if os.geteuid() != 0:
        skip("Slurm's daemon is started by root only")
    for program in ("slurmctld", "slurmd", "munged", "sbatch"):
        if shutil.which(program) is None:
            skip(f"{program} is not installed (Debian: slurm-wlm)")
    with tempfile.TemporaryDirectory(prefix="slurm", dir="/tmp") as name:
        folder = pathlib.Path(name)
        slurm = Slurm(folder)
        try:
            slurm.start()
            # Without the expectations of the case, which are those of one point.
            case = shutil.copytree(case, folder / "case", ignore=shutil.ignore_patterns("expected.toml"))
            test_forty_points(slurm, thinwall, case, folder)
            test_killed_twice(slurm, thinwall, case, folder)
        except SystemExit:
            print(slurm.run("sinfo", "-R").stdout, slurm.run("squeue", "-r").stdout)
            raise
        finally:
            slurm.stop()


if __name__ == "__main__":
    main()
