#!/usr/bin/env python3
"""check_docs.py finds each kind of fault in a small tree, and none in a sound one."""
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from check_docs import anchors, faults  # noqa: E402

SOUND = {
    "README.md": "# Name\n\n[docs](docs/README.md)\n",
    "docs/README.md": "# Docs\n\n[page](guide/page.md#one-step-2--3), [library](reference/library.md), [clusters](guide/clusters.md) and `src/a.h`, `Suite.Name`, `Suite.Na…`, `Suite.*`\n",
    "docs/guide/page.md": "# Page\n\n## One step: `2` – 3\n\n1. item\n   [back](../README.md#docs)\n\nText.\n\n    [no link](in/code.md)\n",
    "src/a.h": "",
    "tests/a_test.cpp": "TEST(Suite, Name) {}\n",
    "examples/library/main.cpp": "// Comment.\nint main() {\n\n}\n",
    "examples/slurm/a.sbatch": "#!/bin/bash\nrun\n",
    "docs/guide/clusters.md": "# Clusters\n\n```bash\n#!/bin/bash\nrun\n```\n",
    "docs/reference/library.md": "# Library\n\n    int main() {\n\n    }\n",
}
FAULTS = {
    "no such file": ("docs/guide/page.md", "[gone](gone.md)\n"),
    "no such heading": ("docs/guide/page.md", "[gone](#gone)\n"),
    "no such file in the sources": ("docs/guide/page.md", "`src/gone.h`\n"),
    "no such test": ("docs/guide/page.md", "`Suite.Other`\n"),
    "characters": ("docs/guide/page.md", "word " * 40 + "\n"),
    "lines": ("README.md", "\n" * 150),
    "its program": ("examples/library/main.cpp", "int other;\n"),
    "does not show": ("examples/slurm/a.sbatch", "other\n"),
    "names tubes.other_key": ("src/solve/b.cpp", 'throw InputError("tubes.other_key must be positive");\n'),
    "not reached": ("docs/guide/other.md", "# Other\n"),
}


def write(root, files):
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        with open(root / name, "a", encoding="utf-8") as out:
            out.write(text)


def found_with(extra):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder).resolve()
        write(root, SOUND)
        write(root, extra)
        return list(faults(root))


def main():
    assert found_with({}) == [], found_with({})
    for kind, (name, text) in FAULTS.items():
        found = found_with({name: "\n" + text})
        assert len(found) == 1 and kind.partition(" in ")[0] in found[0], (kind, found)
    tables_and_code = "\n| " + "word " * 40 + "|\n\n    " + "code " * 40 + "\n\n```\n" + "code " * 40 + "\n```\n"
    assert found_with({"docs/guide/page.md": tables_and_code}) == []
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.md"
        page.write_text("# Twice\n## Twice\n## `a.csv` & more\n", encoding="utf-8")
        assert anchors(page) == {"twice", "twice-1", "acsv--more"}, anchors(page)
    print("every kind of fault is found")


if __name__ == "__main__":
    main()
