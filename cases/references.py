#!/usr/bin/env python3
"""Runs the cases and holds the results against what is kept beside them (standard library only).

    cases/references.py check  [--program build/raytube] [NAME ...]     exit 1 if one is further off than its tolerance
    cases/references.py update [--program build/raytube] [NAME ...]     shows what changed, then writes the new results
    cases/references.py bytes  [--program build/raytube] [NAME ...]     exit 1 unless every instruction set that the processor has, and every
                                                                        number of threads, gives the same bytes

NAME is a file's path from this folder without `.csv` (`dihedral/reference`); default all. Of two kinds:
    reference*.csv    computed by other means: says whether a result is right. cases/make_cases.py writes it, `update` leaves it alone
    golden*.csv       a result of raytube itself: says that nothing has changed. `update` writes it
The head of each says where it comes from, what to run, which table to look at, how to compare it (options of `raytube compare`, or `exact`
for the columns it has), and why with that tolerance; `program`, where it is there, is the one to run in raytube's place, which lies beside
it. To add a golden file, write its head and `update` it."""
import argparse
import csv
import functools
import glob
import hashlib
import os
import re
import shlex
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
COLUMNS = "time_s freq_hz theta_deg phi_deg rx_theta_deg rx_phi_deg re_vv im_vv re_vh im_vh re_hv im_hv re_hh im_hh".split()
KEYS = "provenance run table compare tolerance".split()
SOURCE_COLUMNS = "position model rays_asked rays part first_hits all_hits limit_percent exact_percent estimate_percent escaped absorbed cut".split()


def names():
    paths = [path for kind in ("golden", "reference") for path in glob.glob(os.path.join(HERE, "*", kind + "*.csv"))]
    return sorted(os.path.relpath(path, HERE)[:-4] for path in paths)


def head_of(path):
    """The lines `# key: value` at the beginning."""
    with open(path) as f:
        return dict(found.groups() for found in (re.match(r"# (\w+): (.*)", line) for line in f) if found)


def rows_of(path):
    with open(path) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def refuse(sentence):
    print(f"references.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def check_request(chosen, program):
    if not os.access(program, os.X_OK):
        refuse(f"{program}: no such program; build it, or name it by --program")
    known = names()
    for name in chosen:
        if name not in known:
            refuse(f"{name}: not kept; choose among {', '.join(known)}")
        missing = [key for key in KEYS if key not in head_of(os.path.join(HERE, name + ".csv"))]
        if missing:
            refuse(f"cases/{name}.csv: its head lacks `# {missing[0]}: ...`; add the line")
        beside = program_of(program, head_of(os.path.join(HERE, name + ".csv")))
        if not os.access(beside, os.X_OK):
            refuse(f"{beside}: no such program; build it, or name other results than {name}")


def program_of(program, head):
    return os.path.join(os.path.dirname(program), head["program"]) if "program" in head else program


def run(program, folder, head, output, options=()):
    command = [program_of(program, head), *shlex.split(head["run"]), "-o", output, *options]
    if command[1] == "run":
        command += ["--quiet", "--set", "output.plots=false"]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)


def compared(program, result, reference, options):
    """Whether they agree, and what there is to say about it."""
    if not rows_of(reference):
        return False, "it is new\n"
    if options == "exact":
        return compared_as_text(result, reference)
    done = subprocess.run([program, "compare", result, reference, *shlex.split(options)], capture_output=True, text=True)
    return done.returncode == 0, done.stdout + done.stderr


def compared_as_text(result, reference):
    ours, theirs = rows_of(result), rows_of(reference)
    changed = [f"row {i + 1}, {key}: {a[key]}, was {b[key]}\n" for i, (a, b) in enumerate(zip(ours, theirs)) for key in SOURCE_COLUMNS if a[key] != b[key]]
    if len(ours) != len(theirs):
        changed.append(f"{len(ours)} rows, were {len(theirs)}\n")
    return not changed, "".join(changed)


def write(path, head, rows):
    columns = [column for column in (SOURCE_COLUMNS if head["compare"] == "exact" else COLUMNS) if column in rows[0]]
    with open(path, "w") as f:
        f.writelines(f"# {key}: {value}\n" for key, value in head.items())
        f.write(",".join(columns) + "\n")
        f.writelines(",".join(row[column] for column in columns) + "\n" for row in rows)


def treat(name, program, update):
    """True if all is well."""
    path = os.path.join(HERE, name + ".csv")
    if update and not os.path.basename(name).startswith("golden"):
        print(f"{name}: left alone; it is computed by other means (cases/make_cases.py), and `check` compares with it", flush=True)
        return True
    head = head_of(path)
    with tempfile.TemporaryDirectory() as output:
        run(program, os.path.dirname(path), head, output)
        result = os.path.join(output, head["table"])
        same, text = compared(program, result, path, head["compare"])
        print(f"{name}: {'agrees' if same else 'DIFFERS'} ({head['compare']})" + ("" if same else "\n" + text), flush=True)
        renew = update and not same
        if renew:
            write(path, head, rows_of(result))
        return same or renew


def bytes_of(path):
    """Of sources.csv without its last column, seconds."""
    with open(path) as f:
        lines = [line.rpartition(",")[0] if path.endswith("sources.csv") else line for line in f]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


@functools.cache
def instruction_sets(program):
    """Those of three that this processor has; says which it has not."""
    found = []
    for name in ("sse2", "avx2", "avx512"):
        asked = subprocess.run([program, "run", "no case", "--instruction-set", name], capture_output=True, text=True)
        if "this processor has none wider" in asked.stderr:
            print(f"{name}: left out, this processor does not have it", flush=True)
        else:
            found.append(name)
    return found


def treat_builds(name, program, other):
    """True if the other program's table is this one's, but for roundings of another compilation."""
    path = os.path.join(HERE, name + ".csv")
    head = head_of(path)
    options = "exact" if head["compare"] == "exact" else "--tolerance-relative 1e-13"
    with tempfile.TemporaryDirectory() as ours, tempfile.TemporaryDirectory() as theirs:
        run(program, os.path.dirname(path), head, ours)
        run(other, os.path.dirname(path), head, theirs)
        same, text = compared(program, os.path.join(ours, head["table"]), os.path.join(theirs, head["table"]), options)
    print(f"{name}: {'agrees' if same else 'DIFFERS'} ({options})" + ("" if same else "\n" + text), flush=True)
    return same


def treat_bytes(name, program):
    """True if the table is the same for all instruction sets times three numbers of threads."""
    path = os.path.join(HERE, name + ".csv")
    head = head_of(path)
    found = {}
    for instruction_set in instruction_sets(program) if "program" not in head else [None]:  # raytube alone chooses
        for threads in ("1", "2", "7"):
            with tempfile.TemporaryDirectory() as output:
                chosen = ("--instruction-set", instruction_set) if instruction_set else ()
                run(program, os.path.dirname(path), head, output, (*chosen, "--threads", threads))
                found.setdefault(bytes_of(os.path.join(output, head["table"])), []).append(f"{instruction_set} x {threads}")
    print(f"{name}: " + ("the same bytes" if len(found) == 1 else "DIFFERS: " + "; ".join(map(str, found.values()))), flush=True)
    return len(found) == 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["check", "update", "bytes", "builds"])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--program", default=os.path.join(HERE, "..", "build", "raytube"))
    parser.add_argument("--other", help="the other build's program, for `builds`")
    chosen = parser.parse_intermixed_args()
    program = os.path.abspath(chosen.program)
    if (chosen.what == "builds") != (chosen.other is not None):
        refuse("`builds`, and nothing else, takes --other PROGRAM")
    if chosen.other and not os.access(chosen.other, os.X_OK):
        refuse(f"{chosen.other}: no such program; build it first")
    chosen.names = [name.removesuffix(".csv") for name in chosen.names] or names()
    check_request(chosen.names, program)
    actions = {
        "check": lambda name: treat(name, program, False),
        "update": lambda name: treat(name, program, True),
        "bytes": lambda name: treat_bytes(name, program),
        "builds": lambda name: treat_builds(name, program, os.path.abspath(chosen.other)),
    }
    results = [actions[chosen.what](name) for name in chosen.names]
    sys.exit(0 if all(results) else 1)


if __name__ == "__main__":
    main()
