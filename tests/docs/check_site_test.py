#!/usr/bin/env python3
"""check_site.py finds each kind of fault in a small site, and none in a sound one."""
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from check_site import faults  # noqa: E402

SOUND = {
    "index.html": '<link rel="stylesheet" href="style.css"><h1 id="top">Site</h1><a href="a%20b/page.html#end">page</a> '
                  '<a href="https://elsewhere.invalid/">elsewhere</a> <a href="#top">top</a> <img src="data:image/png;base64,AA==">',
    "a b/page.html": '<p id="end"><a href="../index.html">back</a> <script src="../searchindex.js"></script>',
    "search.html": "",
    "searchindex.js": "",
    "style.css": "@import url(searchindex.js); p { background: url('searchindex.js'); }",
}
FAULTS = {
    "no such file": ("index.html", '<a href="gone.html">'),
    "no such place": ("index.html", '<a href="a b/page.html#gone">'),
    "no such picture": ("a b/page.html", '<img src="gone.png">'),
    "loaded from elsewhere": ("index.html", '<script src="https://elsewhere.invalid/a.js"></script>'),
    "loaded from elsewhere, style": ("index.html", '<link rel="stylesheet" href="//elsewhere.invalid/a.css">'),
    "loaded from elsewhere by a style": ("style.css", '@import "https://elsewhere.invalid/a.css";'),
    "no such file in a style": ("style.css", "p { background: url(gone.png); }"),
}


def found_with(extra):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in [*SOUND.items(), *extra]:
            file = Path(folder, name)
            file.parent.mkdir(exist_ok=True)
            with open(file, "a", encoding="utf-8") as out:
                out.write(text)
        return list(faults(Path(folder)))


def main():
    assert found_with([]) == [], found_with([])
    for kind, fault in FAULTS.items():
        found = found_with([fault])
        assert len(found) == 1, (kind, found)
    print("every kind of fault is found")


if __name__ == "__main__":
    main()
