"""``raytube report``: one page of HTML from the results of a run."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from raytube import _command, _report
from raytube._core import InputError
from raytube._tables import result_file

_DESCRIPTION = """One page of HTML from the results of a run, for any browser, without a network.

The page shows what the run has written. Nothing is solved again, but for the looks whose return is shown on the target in space."""
_EXAMPLES = """examples:
  raytube report out                            out/report.html
  raytube report out/rcs.nc -o turntable.html   from a netCDF file
  raytube report out --looks 0,180              shows where the return of these two looks comes from"""


def main(arguments: list[str]) -> int:
    """Writes the page; see ``raytube report --help``."""
    parser = _command.Parser("report", _DESCRIPTION, _EXAMPLES)
    parser.add_argument("result", metavar="DIR|RESULT.csv|.nc", help="Folder of a run, or its rcs.csv or netCDF file")
    parser.add_argument("-o", "--output", metavar="FILE.html", help="The page; default report.html beside the result")
    parser.add_argument("--looks", metavar="I,...", help="Looks whose return is shown in space, counted from 0; default those of "
                                                         "output.image_look, or else the strongest")
    parser.add_argument("-q", "--quiet", action="store_true", help="Print no summary")
    asked = parser.parse_args(arguments)
    looks = _looks(asked.looks)
    file = result_file(asked.result)
    page = _page_file(asked.output, file)
    text = _report.page(_report.data_of(file, looks), _libraries())
    with _command.new_files(page.parent) as folder:
        (folder / page.name).write_text(text, encoding="utf-8")
    if not asked.quiet:
        print(f"report             {page}: {os.path.getsize(page) * 1e-6:.1f} MB, opens in any browser")
    return 0


def _looks(text: str | None) -> list[int]:
    words = [] if text is None else text.split(",")
    if not all(word.strip().isdecimal() and word.isascii() for word in words):
        raise InputError(f"--looks {text}: give numbers of looks with commas between them, for example 0,180")
    return [int(word) for word in words]


def _page_file(output: str | None, result: Path) -> Path:
    if output is None:
        return result.absolute().parent / "report.html"
    page = Path(output).absolute()
    if page.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"-o {output}: a report is a page of HTML; give a file name that ends in .html")
    if page.is_dir():
        raise InputError(f"-o {output}: is a folder; give the name of a file in it")
    return page


def _libraries() -> str:
    """three.js and its OrbitControls; empty, with a sentence on stderr, where they are not installed."""
    folders = [*filter(None, [os.environ.get("RAYTUBE_THREE_JS")]), "/usr/share/javascript/three", "/usr/local/share/javascript/three",
               "/usr/share/nodejs/three"]
    for folder in map(Path, folders):
        controls = folder / "examples/js/controls/OrbitControls.js"
        for library in (folder / "three.min.js", folder / "build/three.min.js"):
            if library.is_file() and controls.is_file():
                return library.read_text(encoding="utf-8") + "\n" + controls.read_text(encoding="utf-8")
    sys.stderr.write("raytube: warning: three.js with examples/js/controls/OrbitControls.js is not installed, so the report has no view in "
                     "space; install libjs-three, or name its folder in RAYTUBE_THREE_JS\n")
    return ""
