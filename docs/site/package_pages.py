"""Pages about the package raytube, which can be made only where it has been built (build.py gives the tag `package`).

- Without it links to them are plain words.
- With it every public name is on a page: one that no page shows is a warning, and so is one without a docstring, which autodoc passes over.
"""
import importlib
import inspect
from pathlib import PurePosixPath

from sphinx.util import logging

logger = logging.getLogger(__name__)
PACKAGE = "raytube"
PAGES = ("docs/guide/gallery.md", "docs/reference/python.md")


def words_of_link(app, env, link, words):
    name = PurePosixPath(link["reftarget"].partition("#")[0]).name
    return words if not app.tags.has("package") and name in {PurePosixPath(page).name for page in PAGES} else None


def public_names():
    package = importlib.import_module(PACKAGE)
    for name in sorted(set(package.__all__) - {"__version__"}):
        item = getattr(package, name)
        yield f"{PACKAGE}.{name}"
        if inspect.isclass(item) and not issubclass(item, Exception):
            yield from (f"{PACKAGE}.{name}.{member}" for member in vars(item) if not member.startswith("_"))


def shown_signature(app, what, name, item, options, arguments, returned):
    """Only targets are made by calling their class; of the others, which functions return, arguments would mislead."""
    return ("", None) if what == "class" and name != f"{PACKAGE}.Target" else None


def check_complete(app, env):
    if app.tags.has("package"):
        shown = env.get_domain("py").objects
        for name in public_names():
            if name not in shown:
                logger.warning("%s is public, and docs/reference/python.md does not show it or it has no docstring", name)


def setup(app):
    app.connect("missing-reference", words_of_link)
    app.connect("autodoc-process-signature", shown_signature)
    app.connect("env-check-consistency", check_complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
