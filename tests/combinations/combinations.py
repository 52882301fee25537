#!/usr/bin/env python3
"""Every feature with every other, on a small scene: docs/reference/combinations.md is what comes out.

    tests/combinations/combinations.py build/raytube docs/reference/combinations.md [--only NAME] [--every N] [--write]

Each pair runs and passes the checks of both (features.py, products.py), or is refused for a reason that the page gives. Exit code 1 if
the page says otherwise; with --write its tables are made anew. 77 where the package for Python or MPI is missing and all else is right.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from features import PHYSICS
from products import NEEDED, PRODUCTS, missing, pair_checks
from scene import BASE
from solver import Refused, Solver

YES, NOT_A_PAIR, UNKNOWN = "+", ".", "?"
REASONS = {  # as the program words them
    "a": "kind \"solid\"",
    "b": "seen from a finite distance have no one place",
    "c": "pieces of bistatic looks have no one place|its looks are bistatic",
    "d": "materials change with frequency|what a medium reflects changes with angle and frequency",
    "e": 'edges.method "utd" adds up rays|"utd" has no tubes|needs currents, but edges.method|edges.method is "utd"',
    "f": 'edges.method is "none"|need edge currents',
    "g": "see facets|facets are the surface itself",
    "h": "so powers do not add up",
    "i": "do not include the scattering by roughness|incoherent power is not computed",
}


def together(one, other):
    settings = {**BASE, **one.settings, **other.settings}
    meshes = [mesh for feature in (one, other) for mesh in feature.settings.get("target.mesh", [])]
    if "ball.obj" in meshes:
        edges = "edges.between" in settings or "edges.materials" in settings  # the ball has none
        also = [m for m in ("window.obj", "block.obj") if m in meshes] + ["corner.obj"] * edges
        settings["target.mesh"] = ["ball.obj", *also]
    if "radar.range_m" in settings:
        settings.pop("edges.utd_range_m", None)  # the antennas have a range of their own
        if "receive.theta_deg" in settings:
            settings["radar.receive_range_m"] = 4.0
    return settings


def letter_of(sentence):
    for letter, words in REASONS.items():
        if re.search(words, sentence):
            return letter
    return f"no reason known: {sentence}"


def outcome(solver, one, other):
    """YES, the letter of a reason, or what is wrong."""
    if one is not other and set(one.keys) & set(other.keys):
        return NOT_A_PAIR
    settings, wrong = together(one, other), []
    if one in PRODUCTS:
        checks = [("both", *check) for check in pair_checks(one, other)]
    else:
        checks = [(feature.name, feature.check, ()) for feature in ([other] if other in PRODUCTS else [one, other])]
    if missing(one) or missing(other):
        return UNKNOWN
    if not checks:
        return NOT_A_PAIR
    for name, check, options in checks:
        try:
            found = check(solver.with_options(options), settings)
        except Refused as refused:
            return letter_of(str(refused).strip().splitlines()[-1])
        except Exception as e:  # a fault of the program, or of its output
            found = f"{type(e).__name__}: {str(e)[-300:]}"
        if found and found.startswith("left out: "):
            return letter_of(found)
        if found:
            wrong.append(f"{name}: {found}")
    return "; ".join(wrong) or YES


def table(results):
    """Columns by number; each pair once."""
    columns = [*PHYSICS, *PRODUCTS]
    width = max(len(feature.name) for feature in columns) + 3
    lines = [" " * width + " ".join(f"{i:2}" for i in range(1, len(columns) + 1))]
    for i, one in enumerate(columns, 1):
        cells = [results.get((one.name, other.name), "") for other in columns]
        lines.append(f"{i:2} {one.name:{width - 3}}" + " ".join(f"{cell:>2}" for cell in cells).rstrip())
    return "".join("    " + line.rstrip() + "\n" for line in lines)


def cells_of(text):
    """What the page says of each pair."""
    columns = [*PHYSICS, *PRODUCTS]
    width = max(len(feature.name) for feature in columns) + 3
    rows = text[text.index("<!-- begin of the table -->"):text.index("<!-- end of the table -->")].split("\n")[3:]
    return {(one.name, other.name): row[4 + width + 3 * i:][:2].strip() for one, row in zip(columns, rows) for i, other in enumerate(columns)}


def page_with(text, made):
    begin, end = text.index("<!-- begin of the table -->\n"), text.index("<!-- end of the table -->")
    return text[:begin] + "<!-- begin of the table -->\n\n" + made + "\n" + text[end:]


def by_a_python_with_packages():
    """Goes on in Debian's own Python where the first one on the path lacks what the package needs."""
    debian = "/usr/bin/python3"
    able = [p for p in (sys.executable, debian) if os.path.exists(p) and not subprocess.run([p, "-c", NEEDED], capture_output=True).returncode]
    if able and able[0] != sys.executable:
        os.execv(debian, [debian, *sys.argv])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--only", default="", help="pairs of this feature alone; the page is not looked at")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="one pair of N alone; the table in the page is compared with these")
    parser.add_argument("--write", action="store_true", help="the page's table anew")
    args = parser.parse_args()
    by_a_python_with_packages()
    features = [*PHYSICS, *PRODUCTS]
    pairs = [(one, other) for i, one in enumerate(features) for other in features[i:]]
    pairs = [pair for pair in pairs if not args.only or args.only in (pair[0].name, pair[1].name)]
    pairs = pairs[::args.every]
    with tempfile.TemporaryDirectory(prefix="raytube-combinations-") as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        solver = Solver(args.program, folder)
        found = dict(zip(((a.name, b.name) for a, b in pairs), pool.map(lambda pair: outcome(solver, *pair), pairs)))
    wrong = [(pair, said) for pair, said in found.items() if len(said) > 1]
    for (one, other), said in wrong:
        print(f"{one} with {other}: {said}")
    if args.only:
        print("\n".join(f"{a} with {b}: {said}" for (a, b), said in found.items() if len(said) == 1))
    elif args.every > 1:
        said = cells_of(args.page.read_text())
        wrong += [(f"{a} with {b}: the page says {said[a, b]}, found {cell}", cell)
                  for (a, b), cell in found.items() if cell not in (said[a, b], UNKNOWN) and len(cell) == 1]
        print("\n".join(sentence for sentence, _ in wrong if isinstance(sentence, str)))
    elif not wrong and UNKNOWN not in found.values():
        text = args.page.read_text()
        made = page_with(text, table(found))
        if args.write:
            args.page.write_text(made)
        elif made != text:
            print(f"{args.page}: its table is not what comes out; --write renews it")
            wrong = [args.page]
    print(f"{len(found)} pairs: {sum(said == YES for said in found.values())} run and are right, "
          f"{sum(said in REASONS for said in found.values())} are refused for a reason")
    sys.exit(1 if wrong else 77 if UNKNOWN in found.values() else 0)


if __name__ == "__main__":
    main()
