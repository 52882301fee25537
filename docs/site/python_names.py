"""Every public name of the package raytube is on a page: one that no page shows is a warning, and so is one without a docstring, which
autodoc passes over."""
import importlib
import inspect

from sphinx.util import logging

logger = logging.getLogger(__name__)
PACKAGE = "raytube"


def public_names():
    package = importlib.import_module(PACKAGE)
    for name in sorted(set(package.__all__) - {"__version__"}):
        item = getattr(package, name)
        yield f"{PACKAGE}.{name}"
        if inspect.isclass(item) and not issubclass(item, Exception):
            yield from (f"{PACKAGE}.{name}.{member}" for member in vars(item) if not member.startswith("_"))


def check_complete(app, env):
    if app.tags.has("package"):
        shown = env.get_domain("py").objects
        for name in public_names():
            if name not in shown:
                logger.warning("%s is public, and docs/reference/python.md does not show it or it has no docstring", name)


def setup(app):
    app.connect("env-check-consistency", check_complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
