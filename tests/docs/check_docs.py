#!/usr/bin/env python3
"""Checks README.md, CONTRIBUTING.md, CHANGELOG.md, docs/ and cases/*/README.md.

    check_docs.py [ROOT]        prints each fault as file:line: what; exit code 1 if there is any

- every relative link leads to a file that exists, and to a heading of it (anchors by GitHub's rules);
- every page of docs/ is reached by links from docs/README.md;
- the files in src/, docs/ and tests/ and the tests (`Suite.Name`) that pages name exist;
- the program on the library's page is that of examples/library, and the page has every case key that the solver's sentences name;
- the scripts on the page of clusters are those of examples/slurm;
- README.md has at most 150 lines; no line outside tables and code is longer than 160 characters.
"""
import re
import sys
from pathlib import Path

README_LINES = 150
LINE_LENGTH = 160

LINK = re.compile(r"\]\(([^()\s]*(?:\([^()\s]*\)[^()\s]*)*)\)")
CODE_SPAN = re.compile(r"`[^`]*`")
PATH = re.compile(r"(?<![\w/.*-])(?:src|docs|tests)/[\w./-]*\w")
STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
SOLVER_ROOMS = ("mesh", "sbr", "utd", "uncertainty", "solve")
CASE_KEY = re.compile(r"\b(?:target|frequency|look|receive|radar|tubes|accuracy|edges|surfaces|output)\.[a-z_]*[a-z]\b")
TEST = re.compile(r"`([A-Z]\w*)\.(\*|[A-Z]\w*…?)`")


def pages(root):
    tops = [root / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    return [p for p in tops if p.exists()] + sorted((root / "docs").rglob("*.md")) + sorted(root.glob("cases/*/README.md"))


def prose(text):
    """(number, line) of the lines that are neither fenced nor indented code."""
    fenced, content = False, 0  # content: column at which the text of the present list item begins
    for number, line in enumerate(text.splitlines(), 1):
        stripped = line.lstrip(" ")
        indent = len(line) - len(stripped)
        if stripped.startswith("```"):
            fenced = not fenced
            continue
        if fenced or not stripped:
            continue
        item = re.match(r" *(?:[-*+]|\d+[.)]) +", line)
        if indent == 0 and not item:
            content = 0
        if indent >= content + 4:
            continue
        if item:
            content = item.end()
        yield number, line


def anchors(path):
    """What GitHub makes of the headings of a page."""
    names = set()
    for _, line in prose(path.read_text(encoding="utf-8")):
        heading = re.match(r"#{1,6} +(.*?) *#*$", line)
        if not heading:
            continue
        text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).replace("`", "")
        slug = "".join(c for c in text.lower().replace(" ", "-") if c.isalnum() or c in "-_")
        name, count = slug, 0
        while name in names:
            count += 1
            name = f"{slug}-{count}"
        names.add(name)
    return names


def links(text):
    for number, line in prose(text):
        for target in LINK.findall(CODE_SPAN.sub("", line)):
            if not re.match(r"[a-z]+:", target):
                yield number, target


def link_faults(path, text):
    for number, target in links(text):
        name, _, anchor = target.partition("#")
        file = (path.parent / name).resolve() if name else path
        if not file.exists():
            yield number, f"link to {target}: there is no such file"
        elif anchor and (file.suffix != ".md" or anchor not in anchors(file)):
            yield number, f"link to {target}: there is no such heading"


def length_faults(text):
    for number, line in prose(text):
        table = line.lstrip().startswith("|")
        unbreakable = max(map(len, line.split())) > LINE_LENGTH - 40  # an address
        if len(line) > LINE_LENGTH and not table and not unbreakable:
            yield number, f"{len(line)} characters; wrap at about 140, at most {LINE_LENGTH}"


def test_names(root):
    pattern = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)")
    return {match for file in (root / "tests").rglob("*.cpp") for match in pattern.findall(file.read_text(encoding="utf-8"))}


def is_test(suite, name, known):
    start = name.rstrip("…*")
    return any(a == suite and (b.startswith(start) if start != name else b == name) for a, b in known)


def name_faults(root, text, known):
    for number, line in enumerate(text.splitlines(), 1):
        for name in PATH.findall(line):
            if not (root / name).exists():
                yield number, f"{name}: there is no such file"
        for suite, name in TEST.findall(line):
            if not is_test(suite, name, known):
                yield number, f"{suite}.{name}: there is no such test"


def unreachable(root):
    reached, waiting = set(), [(root / "docs/README.md").resolve()]
    while waiting:
        page = waiting.pop()
        if page in reached or page.suffix != ".md" or not page.exists():
            continue
        reached.add(page)
        for _, target in links(page.read_text(encoding="utf-8")):
            file = (page.parent / target.partition("#")[0]).resolve()
            if file.is_relative_to((root / "docs").resolve()):
                waiting.append(file)
    return [p for p in sorted((root / "docs").rglob("*.md")) if p.resolve() not in reached]


def example_faults(root):
    """The program of the library's page is the one in examples/, which is built and run by a test."""
    page, example = root / "docs/reference/library.md", root / "examples/library/main.cpp"
    if page.exists() and example.exists():
        code = "".join(f"    {line}" if line.strip() else line for line in example.read_text(encoding="utf-8").splitlines(True)[1:])
        if code not in page.read_text(encoding="utf-8"):
            yield f"docs/reference/library.md:1: its program is not {example.relative_to(root)}"


def script_faults(root):
    """The scripts of the page on clusters are those in examples/, which a test submits."""
    page = root / "docs/guide/clusters.md"
    shown = page.read_text(encoding="utf-8") if page.exists() else ""
    for script in sorted((root / "examples/slurm").glob("*")):
        if f"```bash\n{script.read_text(encoding='utf-8')}```\n" not in shown:
            yield f"docs/guide/clusters.md:1: does not show {script.relative_to(root)} as it is"


def key_faults(root):
    """Who has no case file finds on the library's page what to change when a sentence of the solver names a key."""
    page = root / "docs/reference/library.md"
    known = page.read_text(encoding="utf-8") if page.exists() else ""
    for room in SOLVER_ROOMS:
        for file in sorted((root / "src" / room).rglob("*.cpp")):
            text = re.sub(r"#include.*", "", file.read_text(encoding="utf-8"))
            keys = {key for words in STRING.findall(text) for key in CASE_KEY.findall(words)}
            for key in sorted(key for key in keys if f"`{key}`" not in known):
                yield f"docs/reference/library.md:1: {file.relative_to(root)} names {key}, the page does not"


def faults(root):
    known = test_names(root)
    for path in pages(root):
        text = path.read_text(encoding="utf-8")
        for number, what in [*link_faults(path, text), *length_faults(text), *name_faults(root, text, known)]:
            yield f"{path.relative_to(root)}:{number}: {what}"
    count = len((root / "README.md").read_text(encoding="utf-8").splitlines())
    if count > README_LINES:
        yield f"README.md:{count}: {count} lines; at most {README_LINES}"
    yield from example_faults(root)
    yield from script_faults(root)
    yield from key_faults(root)
    for path in unreachable(root):
        yield f"{path.relative_to(root)}:1: not reached by links from docs/README.md"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    found = list(faults(root))
    print("\n".join(found) if found else f"{len(pages(root))} pages in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
