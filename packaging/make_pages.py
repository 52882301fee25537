#!/usr/bin/env python3
"""Writes manual pages and completions of the program, all made of its own help.

    make_pages.py PROGRAM CASE.toml DIR     DIR/man/raytube*.1.gz, DIR/bash/raytube, DIR/zsh/_raytube

CASE.toml is any sound case file: the program is asked which keys there are. Equal help gives equal bytes."""
import gzip
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from completions import bash, zsh  # noqa: E402
from man_pages import man_pages  # noqa: E402
from program_help import case_keys, program_and_commands, version  # noqa: E402


def write(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def main(program, case, folder):
    whole, commands = program_and_commands(program)
    keys = case_keys(program, case)
    for name, text in man_pages(whole, commands, version(program)).items():
        write(folder / "man" / f"{name}.gz", gzip.compress(text.encode(), 9, mtime=0))
    write(folder / "bash" / "raytube", bash(whole, commands, keys).encode())
    write(folder / "zsh" / "_raytube", zsh(whole, commands, keys).encode())


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]))
