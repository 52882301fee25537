"""Links of pages to sources, cases and tests lead to a page of the site that shows the file.

On a code host such a link shows the file; MyST would offer it for download. Files that are no text, or long, stay downloads.
"""
from pathlib import Path

from docutils import nodes
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import TextLexer, get_lexer_for_filename
from pygments.util import ClassNotFound
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

FOLDER = "files"
LONGEST = 200_000  # bytes


def text_of(path):
    """Text of a file that can be shown, else None."""
    if path.stat().st_size > LONGEST:
        return None
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return None


class LinksToFiles(SphinxTransform):
    default_priority = 500  # before downloads are collected

    def apply(self, **_):
        for link in list(self.document.findall(addnodes.download_reference)):
            name, path = self.env.relfn2path(link["reftarget"], self.env.docname)
            if text_of(Path(path)) is not None:
                link.replace_self(self.link_to(name, link))

    def link_to(self, name, link):
        self.env.repository_files.add(name)
        up = "../" * self.env.docname.count("/")
        return nodes.reference("", "", *link.children, internal=True, refuri=f"{up}{FOLDER}/{name}.html")


def highlighted(name, text):
    try:
        lexer = get_lexer_for_filename(name)
    except ClassNotFound:
        lexer = TextLexer()
    return highlight(text, lexer, HtmlFormatter(cssclass="highlight", linenos="inline", lineanchors="line"))


def pages_of_files(app):
    for name in sorted(app.env.repository_files):
        body = f"<h1><code>{name}</code></h1>\n{highlighted(name, text_of(Path(app.srcdir, name)))}"
        yield f"{FOLDER}/{name}", {"title": name, "body": body}, "page.html"


def begin(app, env, names):
    env.repository_files = set()


def setup(app):
    app.add_transform(LinksToFiles)
    app.connect("env-before-read-docs", begin)
    app.connect("html-collect-pages", pages_of_files)
    return {"parallel_read_safe": False}
