"""The directive that documents the installed headers of a room:

    ```{public-headers} solve
    ```

stands for Breathe's `doxygenfile` of each header of src/solve that src/install.cmake installs. A header that no page shows is a warning.
"""
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.util import logging

from headers import public_headers

logger = logging.getLogger(__name__)


class PublicHeaders(Directive):
    required_arguments = 1  # room

    def run(self):
        room = self.arguments[0]
        headers = [header for header in public_headers() if header.startswith(room + "/")]
        if not headers:
            raise self.error(f"no header of the room {room} is installed")
        return [part for header in headers for part in self.of_header(header)]

    def of_header(self, header):
        """A section of the page: the name of the header, its comment, what it declares."""
        self.state.document.settings.env.shown_headers.add(header)
        section = nodes.section(ids=[nodes.make_id(header)], names=[header])
        section += nodes.title("", "", nodes.literal("", header))
        self.state.document.note_explicit_target(section)
        self.note_label(header, section["ids"][0])
        self.state.nested_parse(StringList(["```{doxygenfile} " + header, "```"]), self.content_offset, section)
        return [section]

    def note_label(self, header, place):
        """Where the comment of another header names this one, Doxygen links to a label of its own making."""
        environment = self.state.document.settings.env
        label = header.rpartition("/")[2].replace("_", "__").replace(".", "_8")
        environment.get_domain("std").anonlabels[label] = environment.docname, place


def begin(app, env, names):
    env.shown_headers = set()


def check_complete(app, env):
    for header in sorted(set(public_headers()) - env.shown_headers):
        logger.warning("src/%s is installed, and no page of docs/reference/cpp shows its room", header)


def setup(app):
    app.add_directive("public-headers", PublicHeaders)
    app.connect("env-before-read-docs", begin)
    app.connect("env-check-consistency", check_complete)
    return {"parallel_read_safe": False}
