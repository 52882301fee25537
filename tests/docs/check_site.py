#!/usr/bin/env python3
"""Checks a site made of files: it works as it lies there, without a network.

    check_site.py FOLDER        prints each fault as file: what; exit code 1 if there is any

- every address in a page leads to a file of the site, and to a place of it where it names one;
- nothing is loaded from elsewhere: scripts, styles, pictures. Links that a reader may follow do lead elsewhere.
"""
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

STYLE_ADDRESS = re.compile(r"""(?:@import\s+(?:url\()?|url\()\s*["']?([^"')\s;]+)""")


class Page(HTMLParser):
    """The places that can be linked to, the links, and what is loaded."""

    def __init__(self, text):
        super().__init__()
        self.places, self.links, self.loaded = {""}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places.update(value for key, value in attributes if value and (key == "id" or (tag == "a" and key == "name")))
        if "href" in values and tag == "a":
            self.links.append(values["href"])
        elif "href" in values:
            self.loaded.append(values["href"])
        self.loaded += [values[key] for key in ("src", "srcset", "poster") if values.get(key)]


def is_elsewhere(address):
    return bool(urlsplit(address).scheme or urlsplit(address).netloc)


def dead_end(file, address, pages):
    """Why an address leads nowhere; None if it leads somewhere."""
    parts = urlsplit(address)
    target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    if not target.is_file():
        return f"{address}: there is no such file"
    if parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
        return f"{address}: there is no such place"
    return None


def page_faults(file, pages):
    page = pages[file]
    for address in page.loaded:
        if is_elsewhere(address) and not address.startswith("data:"):
            yield f"{address} is loaded from elsewhere"
    for address in page.links + page.loaded:
        if not is_elsewhere(address):
            yield dead_end(file, address, pages)


def style_faults(file):
    for address in STYLE_ADDRESS.findall(file.read_text(encoding="utf-8")):
        if not address.startswith(("data:", "#")):
            yield f"{address} is loaded from elsewhere" if is_elsewhere(address) else dead_end(file, address, {})


def faults(site):
    site = site.resolve()
    pages = {file: Page(file.read_text(encoding="utf-8")) for file in sorted(site.rglob("*.html"))}
    for name in ("index.html", "search.html", "searchindex.js"):
        if not (site / name).is_file():
            yield f"{name}: there is no such file"
    for file in pages:
        yield from (f"{file.relative_to(site)}: {fault}" for fault in page_faults(file, pages) if fault)
    for file in sorted(site.rglob("*.css")):
        yield from (f"{file.relative_to(site)}: {fault}" for fault in style_faults(file) if fault)


def main():
    site = Path(sys.argv[1])
    found = list(faults(site))
    print("\n".join(found) if found else f"{sum(1 for _ in site.rglob('*.html'))} pages, every address leads somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
