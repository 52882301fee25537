"""The tree of pages in the side bar, read from docs/README.md, which lists every page for readers anyway.

Each of its headings of second level becomes a caption, each link of the section to a page an entry by the words of the link. The tree is
added to the front page when that is read; the page itself stays as it is. The front page is written a second time, as index.html.
"""
import posixpath
import re
import shutil
from pathlib import Path

CONTENTS = "docs/README"
SECTION = re.compile(r"^## +(.*)$", re.MULTILINE)
LINK = re.compile(r"\[([^\]]+)\]\(([^()#\s]+)\.md\)")


def place(page):
    """A page that the contents name, as seen from the root."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(CONTENTS), page))


def entry(words, page):
    """One line of a tree: words as a title, page as seen from the root."""
    title = " ".join(words.split())
    return f"{title[0].upper()}{title[1:]} <{place(page)}>"


def sections(text, pages):
    """(caption, entries) of the contents: those among the pages of the site."""
    _, *rest = SECTION.split(text)
    for caption, body in zip(rest[::2], rest[1::2]):
        yield caption, [entry(words, page) for words, page in LINK.findall(body) if place(page) in pages]


def toctree(caption, entries):
    return "\n".join(["```{toctree}", ":hidden:", f":caption: {caption}", "", *entries, "```", ""])


def add_navigation(app, page, source):
    if page == app.config.root_doc:
        contents = Path(app.srcdir, CONTENTS + ".md").read_text(encoding="utf-8")
        trees = [toctree("Contents", [CONTENTS]), *(toctree(*section) for section in sections(contents, app.env.found_docs))]
        source[0] += "\n\n" + "\n".join(trees)


def write_index(app, error):
    if error is None and app.builder.format == "html":
        shutil.copyfile(Path(app.outdir, app.config.root_doc + ".html"), Path(app.outdir, "index.html"))


def setup(app):
    app.connect("source-read", add_navigation)
    app.connect("build-finished", write_index)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
