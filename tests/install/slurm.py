#!/usr/bin/env python3
"""The scripts of examples/slurm in a Slurm of one node: slurm.py PROGRAM SOURCE    exit 77 (skipped) where Slurm or MPI is missing

Slurm's daemons run as the user who starts this, in a scratch folder and on ports of their own, and end with it. What is tried: shards in
a job array, one of its tasks requeued, one of its shards lost and run again; their merging; jobs of two processes by srun and by mpirun.
All of them have to write the bytes of one process."""
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SKIPPED, PATIENCE_S = 77, 50
SHARDS = 8
RESULTS = ["rcs.csv", "channels.csv", "rcs.nc"]
CONFIGURATION = """
ClusterName=raytube
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 RealMemory=100000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
"""
# The third task asks to be requeued as soon as it runs, as Slurm does with the tasks of a node that has died.
REQUEUED = """#!/bin/bash
if [ -z "$SLURM_RESTART_COUNT" ] && [ "$SLURM_ARRAY_TASK_ID" = 3 ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_3"
  sleep 60
fi
. {scripts}/shards.sbatch
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def said(*command, expected=0):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == expected, f"{command} ended with {done.returncode}: {done.stdout}{done.stderr}"
    return (done.stdout + done.stderr).strip()


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


class Slurm:
    def __init__(self, folder):
        self.folder, self.daemons = folder, []
        for name in ("state", "spool"):
            (folder / name).mkdir()
        user = subprocess.check_output(["id", "-un"], text=True).strip()
        (folder / "slurm.conf").write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], ports=free_ports(2), user=user,
                                                                folder=folder))
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")

    def __enter__(self):
        for name in ("slurmctld", "slurmd"):
            with open(self.folder / f"{name}.log", "w") as log:
                self.daemons.append(subprocess.Popen(["setpriv", "--pdeathsig", "TERM", name, "-D"], stdout=log, stderr=log))
        return self

    def __exit__(self, *error):
        subprocess.run(["scancel", "--user", str(os.getuid())], capture_output=True, timeout=10)
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def require_ready(self):
        for _ in range(100):
            if any(daemon.poll() is not None for daemon in self.daemons):
                break
            if "idle" in subprocess.run(["sinfo", "-h", "-o", "%T"], capture_output=True, text=True).stdout:
                return
            time.sleep(0.1)
        last = [(self.folder / f"{name}.log").read_text(errors="replace").strip("\0\n").split("\n")[-1] for name in ("slurmctld", "slurmd")]
        skip(f"Slurm's daemons cannot be started here: {'; '.join(last)}")

    def submit(self, *words):
        return said("sbatch", "--parsable", "--output", self.folder / "job_%j.out", *words)

    def wait(self):
        end = time.monotonic() + PATIENCE_S
        while jobs := said("squeue", "-h", "-o", "%i %T %r"):
            assert time.monotonic() < end, f"still there after {PATIENCE_S} s:\n{jobs}"
            for job, _, reason in (line.split(" ", 2) for line in jobs.splitlines()):
                if reason == "BeginTime":  # requeued: Slurm waits for two minutes
                    said("scontrol", "update", f"JobId={job}", "StartTime=now")
            time.sleep(0.1)

    def printed(self):
        return "".join(f"{path.name}:\n{path.read_text()}" for path in sorted(self.folder.glob("job_*.out")))


def make_case(source, folder):
    case = folder / "case.toml"
    text = (source / "cases/powercube/case.toml").read_text()
    case.write_text(text.replace('mesh = "', f'mesh = "{source}/cases/powercube/') + "\n[output]\nplots = false\nnetcdf = true\n")
    return case


def require_same(once, other):
    different = [name for name in RESULTS if (once / name).read_bytes() != (other / name).read_bytes()]
    assert not different, f"{other.name}: {different} have other bytes than those of one process"


def try_all(slurm, scripts, folder, case):
    requeued = folder / "requeued.sbatch"
    requeued.write_text(REQUEUED.format(scripts=scripts))
    shards = folder / "shards"
    array = slurm.submit(f"--array=1-{SHARDS}", "--requeue", "--open-mode=append", "--cpus-per-task=1", requeued, case, shards)
    slurm.submit(f"--dependency=afterok:{array}", scripts / "merge.sbatch", shards, folder / "by_array")
    slurm.submit("--ntasks=2", scripts / "mpi_srun.sbatch", case, folder / "by_srun")
    slurm.submit("--ntasks=2", scripts / "mpi_mpirun.sbatch", case, folder / "by_mpirun")
    said("raytube", "run", case, "-o", folder / "once", "--quiet")
    slurm.wait()
    assert "REQUEUE" in slurm.printed(), "no task was requeued"
    for name in ("by_array", "by_srun", "by_mpirun"):
        require_same(folder / "once", folder / name)


def try_lost_shard(slurm, scripts, folder, case):
    shards = folder / "shards"
    (shards / f"shard_5_of_{SHARDS}.looks").unlink()
    sentence = said("raytube", "merge", shards, "-o", folder / "again", expected=2)
    assert f"1 of {SHARDS} shards is missing: 5/{SHARDS}" in sentence, sentence
    array = slurm.submit("--array=5", scripts / "shards.sbatch", case, shards, SHARDS)
    slurm.submit(f"--dependency=afterok:{array}", scripts / "merge.sbatch", shards, folder / "again")
    slurm.wait()
    require_same(folder / "once", folder / "again")


def try_without_pmix(folder, case):
    sentence = said("srun", "--ntasks=2", "--mpi=none", "raytube", "run", case, "-o", folder / "none", expected=2)
    ours = [line for line in sentence.splitlines() if not line.startswith("srun:")]
    assert len(ours) == 1 and "srun --mpi=pmix" in ours[0] and not (folder / "none").exists(), sentence


def require_what_it_takes(program):
    if missing := [name for name in ("slurmctld", "slurmd", "sbatch", "mpirun", "setpriv") if not shutil.which(name)]:
        skip(f"{', '.join(missing)} is not there")
    if not (program.parent / "raytube_mpi.so").exists():
        skip("this build has no MPI")
    if os.cpu_count() < 2:
        skip("two processes need two processors")


def set_environment(program):
    """The program and the daemons are found; nothing of a job that this may be part of is left."""
    for name in [name for name in os.environ if name.startswith(("SLURM_", "SBATCH_", "OMPI_", "PMI"))]:
        del os.environ[name]
    os.environ.update(PATH=f"{program.parent}:{os.environ['PATH']}:/usr/sbin", OMPI_ALLOW_RUN_AS_ROOT="1",
                      OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def main(program, source):
    set_environment(program)
    require_what_it_takes(program)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    with tempfile.TemporaryDirectory(prefix="raytube-slurm-", ignore_cleanup_errors=True) as name, Slurm(Path(name)) as slurm:
        slurm.require_ready()
        given = slurm, source / "examples/slurm", Path(name), make_case(source, Path(name))
        try:
            try_all(*given)
            try_lost_shard(*given)
            try_without_pmix(*given[2:])
        except (AssertionError, OSError, subprocess.SubprocessError) as error:
            sys.exit(f"{error}\n{slurm.printed()}")
    return 0


if __name__ == "__main__":
    sys.exit(main(*(Path(argument).resolve() for argument in sys.argv[1:3])))
