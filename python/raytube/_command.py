"""What the commands of the package share: their command line, and files that appear whole or not at all."""

from __future__ import annotations

import argparse
import difflib
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from raytube._core import InputError


class Parser(argparse.ArgumentParser):
    """A command line that complains as the program does: one sentence, the nearest known name, and where help is.

    Parameters
    ----------
    command : str
        Name of the command, as in ``raytube plot``.
    description, examples : str
        Shown above and below the options.
    """

    def __init__(self, command: str, description: str, examples: str) -> None:
        super().__init__(prog=f"raytube {command}", description=description, epilog=examples, allow_abbrev=False, add_help=False)
        self.add_argument("-h", "--help", action="help", help="Print this help message and exit")

    def format_help(self) -> str:
        """Laid out as the program's own: names in a column of 34 characters, sentences beside them."""
        parts: dict[str, list[str]] = {"Positionals": [], "Options": []}
        names = []
        for action in self._actions:
            value = "" if action.nargs == 0 else str(action.metavar or ("|".join(action.choices) if action.choices else action.dest.upper()))
            name = " ".join([",".join(action.option_strings), value]).strip()
            names += [] if action.option_strings else [name]
            line = f"  {name:<31} {action.help}" if len(name) < 32 else f"  {name}\n{'':34}{action.help}"
            parts["Options" if action.option_strings else "Positionals"].append(line)
        lines = [self.description or "", f"Usage: {self.prog} [OPTIONS] {' '.join(names)}"]
        for heading, entries in parts.items():
            lines += ["", f"{heading}:", *entries]
        return "\n".join([*lines, "", (self.epilog or "").rstrip(), ""])

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            options = [name for action in self._actions for name in action.option_strings]
            near = difflib.get_close_matches(unknown[0].split("=")[0], options, 1)
            self.error(f"unknown option or argument {unknown[0]}" + (f"; did you mean {near[0]}?" if near else ""))
        return found, unknown

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}; see {self.prog} --help")


@contextmanager
def new_files(folder: Path) -> Iterator[Path]:
    """A folder for new files: once all are written they are moved into `folder`, and in case of an error none is.

    Parameters
    ----------
    folder : Path
        Made if it is not there.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".raytube-", dir=folder) as beside:
        yield Path(beside)
        for file in sorted(Path(beside).iterdir()):
            os.replace(file, folder / file.name)
