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


def _value_of(action: argparse.Action) -> str:
    """What stands for an option's value in the help: the choices, or its name."""
    return "" if action.nargs == 0 else str(action.metavar or ("|".join(action.choices) if action.choices else action.dest.upper()))


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
        named = {action: " ".join([",".join(action.option_strings), _value_of(action)]).strip() for action in self._actions}
        positionals = [action for action in self._actions if not action.option_strings]
        lines = [self.description or "", f"Usage: {self.prog} [OPTIONS] {' '.join(map(named.__getitem__, positionals))}"]
        for heading, chosen in (("Positionals", positionals), ("Options", [action for action in self._actions if action.option_strings])):
            lines += ["", f"{heading}:", *(f"  {named[action]:<31} {action.help}" if len(named[action]) < 32 else f"  {named[action]}\n{'':34}{action.help}" for action in chosen)]
        return "\n".join([*lines, "", (self.epilog or "").rstrip(), ""])

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        found, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unknown option or argument {unknown[0]}{self._nearest(unknown[0])}")
        return found, unknown

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}; see {self.prog} --help")

    def _nearest(self, word: str) -> str:
        options = [name for action in self._actions for name in action.option_strings]
        near = difflib.get_close_matches(word.split("=")[0], options, 1)
        return f"; did you mean {near[0]}?" if near else ""


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
