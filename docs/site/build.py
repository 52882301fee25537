#!/usr/bin/python3
"""Builds the site: the public headers through Doxygen, the examples' figures, the pages through Sphinx. Warnings are errors.

    build.py FOLDER [PYTHON [DRAWN]]    the site is in FOLDER/html; exit code 1 on a warning, 77 where a program or a package is missing

PYTHON is the folder that holds the package raytube. Without one that this Python imports, the pages about it are left out. DRAWN holds a folder
for each example that has been run, with its figure and what it printed; the others are run.
"""
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

sys.dont_write_bytecode = True
from headers import ROOT, public_headers  # noqa: E402

SITE = Path(__file__).resolve().parent
PROGRAMS = ("doxygen", "sphinx-build")
PACKAGES = ("sphinx", "myst_parser", "furo", "breathe", "numpydoc", "matplotlib", "pandas")
QUIET = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1",  # nothing is left among the sources
         "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.argv[2:3]))}
NAMESPACE = "raytube"
DOXYGEN = """
PROJECT_NAME = {name}
OUTPUT_DIRECTORY = {folder}
INPUT = {headers}
STRIP_FROM_PATH = {root}/src
INPUT_FILTER = "{python} {site}/comments.py"
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
SORT_MEMBER_DOCS = NO
QUIET = YES
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def missing():
    return [program for program in PROGRAMS if not shutil.which(program)] + \
           [package for package in PACKAGES if not importlib.util.find_spec(package)]


def without_namespace(xml):
    """Moves what the namespace declares to the headers it is declared in: shown with each of them, it would be declared many times."""
    namespace = ElementTree.parse(xml / f"namespace{NAMESPACE}.xml")
    for file in sorted(xml.glob("*_8h.xml")):
        header = ElementTree.parse(file)
        compound = header.find("compounddef")
        for inner in compound.findall("innernamespace"):
            compound.remove(inner)
        location = compound.find("location").get("file")
        for section in namespace.iter("sectiondef"):
            here = [member for member in section.findall("memberdef") if member.find("location").get("file") == location]
            for member in here:
                member.find("name").text = f"{NAMESPACE}::{member.find('name').text}"
            if here:
                ElementTree.SubElement(compound, "sectiondef", kind=section.get("kind")).extend(here)
        header.write(file, encoding="utf-8", xml_declaration=True)


def undocumented_values(xml):
    """Values of enumerations without a word: Doxygen 1.9 warns of every other name, but not of these."""
    for file in sorted(xml.glob("*.xml")):
        for enumeration in ElementTree.parse(file).iterfind(".//memberdef[@kind='enum']"):
            for value in enumeration.iterfind("enumvalue") if enumeration.get("prot") == "public" else ():
                if value.find("*/para") is None:
                    yield f"{enumeration.findtext('name')}::{value.findtext('name')}"


def read_headers(folder):
    headers = " ".join(f'"{ROOT}/src/{header}"' for header in public_headers())
    options = DOXYGEN.format(name=NAMESPACE, folder=folder, headers=headers, root=ROOT, python=sys.executable, site=SITE)
    shutil.rmtree(folder / "xml", ignore_errors=True)
    subprocess.run(["doxygen", "-"], input=options, text=True, check=True)
    silent = sorted(set(undocumented_values(folder / "xml")))
    if silent:
        raise SystemExit(f"not documented: {', '.join(silent)}")
    without_namespace(folder / "xml")


def draw_examples(figures):
    """What docs/site/gallery.py shows: each example leaves its figure in the folder it is run in."""
    shutil.rmtree(figures, ignore_errors=True)
    figures.mkdir()
    for example in sorted(ROOT.glob("examples/python/*.py")):
        drawn = [Path(folder, example.stem, f"{example.stem}.{ending}") for folder in sys.argv[3:4] for ending in ("png", "txt")]
        if drawn and all(file.is_file() for file in drawn):
            for file in drawn:
                shutil.copy(file, figures)
            continue
        with open(figures / f"{example.stem}.txt", "w", encoding="utf-8") as printed:
            subprocess.run([sys.executable, example], cwd=figures, env={**QUIET, "MPLBACKEND": "agg"}, stdout=printed, check=True)


def has_package():
    return subprocess.run([sys.executable, "-c", "import raytube, mpi4py, distributed"], env=QUIET, stderr=subprocess.DEVNULL).returncode == 0


def write_pages(folder, *tags):
    """Afresh: pages that are kept from the last time do not repeat their warnings."""
    shutil.rmtree(folder / "html", ignore_errors=True)
    subprocess.run(["sphinx-build", "-q", "-E", "-W", "--keep-going", "-c", SITE, "-d", folder / "doctrees",
                    "-D", f"breathe_projects.{NAMESPACE}={folder}/xml", "-D", f"gallery_figures={folder}/figures", *tags, ROOT,
                    folder / "html"],
                   env=QUIET, check=True)


def main():
    if missing():
        print(f"the site needs {', '.join(missing())}")
        return 77
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    try:
        read_headers(folder)
        if has_package():
            draw_examples(folder / "figures")
            write_pages(folder, "-t", "package")
        else:
            write_pages(folder)
    except subprocess.CalledProcessError as failed:
        return failed.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
