#!/usr/bin/env python3
"""recipes.py passes sound blocks, skips those that cannot be run with a word, and finds each kind of fault."""
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT = Path(__file__).with_name("recipes.py")
SOUND = {
    "a saved file": ("```toml a.toml\nx = 1\n```\n```sh\ncat a.toml\n```\n```text\nx = 1\n```\n", "run"),
    "rounding at a half": ("```sh\necho 1.25 m\n```\n```text\n1.26 m\n```\n", "run"),
    "the program": ("```sh\nbuild/raytube\n```\n", "run"),
    "a missing module": ("```python\nimport no_such_module\n```\n```text\nnothing\n```\n", "SKIPPED, there is no no_such_module"),
}
FAULTS = {
    "a failing command": ("```sh\nfalse\ntrue\n```\n", "exit code 1"),
    "a failing line of Python": ("```python\nassert False\n```\n", "AssertionError"),
    "another number": ("```sh\necho 1.25 m\n```\n```text\n1.27 m\n```\n", "the page says"),
    "another count": ("```sh\necho 6 rows\n```\n```text\n7 rows\n```\n", "the page says"),
    "another word": ("```sh\necho 1 m\n```\n```text\n1 s\n```\n", "the page says"),
    "a file without a name": ("```toml\nx = 1\n```\n", "wants the name"),
    "an unknown kind": ("```fortran\nend\n```\n", "no block of this kind"),
}


def outcome(text):
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.md"
        page.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, "/bin/true", page], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


def main():
    for kinds, code in ((SOUND, 0), (FAULTS, 1)):
        for kind, (text, word) in kinds.items():
            found = outcome(text)
            assert found[0] == code and word in found[1], (kind, found)
    print("sound blocks pass, every kind of fault is found")


if __name__ == "__main__":
    main()
