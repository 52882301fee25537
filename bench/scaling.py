#!/usr/bin/env python3
"""How well a job of many processes shares its looks: measured times of looks, replayed over 1 ... 4096 ranks.

    scaling.py CASE.toml [--program build/raytube] [--looks N] [--set KEY=VALUE]...

One process of one thread computes the case; the processor time of every look is read as it appears in the file of a shard. Then the looks,
as many as they are and repeated until there are N, are dealt out as src/mpi/mpi_team.cpp does; counter and rank 0 serve one after the
other. What a fetch from the counter and a message with a look's bytes take is measured between two ranks of this machine by mpi4py, and
stands against a slow network. Each rank is one thread. Reading the mesh, preparing the target and writing results take as long for any
number of ranks. Not in it: what ranks of one machine take from each other (memory, clock)."""
import argparse
import heapq
import json
import resource
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

RANKS = [4**power for power in range(7)]
LARGEST_CHUNK, CHUNKS_TO_A_RANK = 64, 8  # as in mpi_team.cpp
SLOW = (1e-3, 1e-5, 2e-5)  # [s] a fetch waits until rank 0 looks, which it does every millisecond
RECORD, HEAD = struct.Struct("<QQQ"), len("raytube journal\n")  # key, length, checksum


def processor_seconds(pid):
    return sum(int(task.read_text().split()[0]) for task in Path(f"/proc/{pid}/task").glob("*/schedstat")) * 1e-9


def whole_records(data):
    """Bytes of each record but the first, which holds what the journal belongs to."""
    at, sizes = HEAD, []
    while at + RECORD.size <= len(data):
        size = RECORD.unpack_from(data, at)[1] + RECORD.size
        at += size
        if at <= len(data):
            sizes.append(size)
    return sizes[1:]


def watched(command, shard):
    """(processor seconds so far, bytes of each look so far), whenever looks appear in the file of the shard."""
    run, seen, looks = subprocess.Popen(command), 0, [(0.0, [])]
    while run.poll() is None:
        time.sleep(0.001)
        if shard.exists() and shard.stat().st_size != seen:
            now, data = processor_seconds(run.pid), shard.read_bytes()
            seen, sizes = len(data), whole_records(data)
            if len(sizes) > len(looks[-1][1]):
                looks.append((now, sizes))
    if run.returncode:
        sys.exit(run.returncode)
    return looks


def measured(program, words):
    """Seconds and bytes of each look, and the seconds of what comes before and after them. Looks that appear together share their time."""
    with tempfile.TemporaryDirectory() as folder:
        quiet = ["--threads", "1", "--quiet"]
        looks = watched([program, "run", *words, "--shard", "1/1", "-o", folder, *quiet], Path(folder, "shard_1_of_1.looks"))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([program, "merge", folder, *quiet], check=True)
        constant = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        times = json.loads(Path(folder, "run.json").read_text())["time"]
    looks[0] = (times["read_s"] + times["build_s"], [])
    seconds = []
    for (before, known), (now, sizes) in zip(looks, looks[1:]):
        new = len(sizes) - len(known)
        seconds += [max(now - before, 0.0) / new] * new
    return seconds, looks[-1][1], constant


def replay(seconds, ranks, constant, network):
    """Seconds that so many ranks take. Of the network: how long a fetch lasts, how long it and a message keep rank 0 busy."""
    latency, fetch, message = network
    looks, taken, counter_free, sent, over = len(seconds), 0, 0.0, [], 0.0
    free = [(0.0, rank, 0) for rank in range(ranks)]  # when, who, how much was dealt out when it asked last
    while free:
        now, rank, seen = heapq.heappop(free)
        counter_free = max(counter_free, now) + fetch
        size = min(max((looks - seen) // (CHUNKS_TO_A_RANK * ranks), 1), LARGEST_CHUNK)
        begin, taken = taken, taken + size
        now, end = counter_free - fetch + latency, min(begin + size, looks)
        for look in range(begin, end):
            now += seconds[look]
            if rank:
                sent.append(now)
        over = max(over, now)
        if end < looks:
            heapq.heappush(free, (now, rank, end))
    inbox_free = 0.0
    for when in sorted(sent):
        inbox_free = max(inbox_free, when) + message
    return constant + max(over, inbox_free)


MESSAGES = """
import sys, time
import numpy as np
from mpi4py import MPI
world, size, repeats = MPI.COMM_WORLD, int(sys.argv[1]), 2000
counter = MPI.Win.Allocate(8 if world.rank == 0 else 0, 8, comm=world)
one, before, look = np.ones(1, "i8"), np.zeros(1, "i8"), bytearray(size)
def timed(work):  # the best of five: ranks of a busy machine wait for processors
    return min(once(work) for _ in range(5))
def once(work):
    world.Barrier()
    start = time.perf_counter()
    for _ in range(repeats): work()
    world.Barrier()
    return (time.perf_counter() - start) / repeats
def fetch():
    if world.rank == 0: return
    counter.Fetch_and_op(one, before, 0)
    counter.Flush(0)
counter.Lock_all()
times = [timed(fetch), timed((lambda: world.Recv(look)) if world.rank == 0 else (lambda: world.Send(look, 0)))]
counter.Unlock_all()
counter.Free()
if world.rank == 0: print(*times)
"""


def measured_messages(size):
    try:
        command = ["mpirun", "-n", "2", "--oversubscribe", sys.executable, "-c", MESSAGES, str(size)]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"messages cannot be measured ({error.__class__.__name__}: mpirun, mpi4py?); those of the slow network are taken", file=sys.stderr)
        return SLOW
    fetch, message = map(float, done.stdout.split())
    return fetch, fetch, message


def efficiency(seconds, ranks, constant, network):
    return 100 * (constant + sum(seconds)) / (ranks * replay(seconds, ranks, constant, network))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("case")
    parser.add_argument("--program", default="build/raytube")
    parser.add_argument("--looks", type=int, default=100_000)
    parser.add_argument("--set", action="append", default=[])
    given = parser.parse_args()
    words = [given.case, "--set", "output.plots=false", *(word for item in given.set for word in ("--set", item))]
    few, sizes, constant = measured(given.program, words)
    many = [few[look % len(few)] for look in range(given.looks)]
    network = measured_messages(sum(sizes) // len(sizes))
    print(f"{len(few)} looks of {1e3 * min(few):.2g} ... {1e3 * max(few):.2g} ms, mean {1e3 * sum(few) / len(few):.3g} ms, {sum(sizes) // len(sizes)} "
          f"bytes; beside them {constant:.2g} s; fetch {1e6 * network[0]:.3g} us, message {1e6 * network[2]:.3g} us\n")
    print(f"| ranks | {len(few)} looks | {len(many)} looks | the same, slow network |\n|---|---|---|---|")
    for ranks in RANKS:
        shares = [efficiency(few, ranks, constant, network), efficiency(many, ranks, constant, network), efficiency(many, ranks, constant, SLOW)]
        print(f"| {ranks} | {' | '.join(f'{share:.1f} %' for share in shares)} |")


if __name__ == "__main__":
    main()
