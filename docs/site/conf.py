"""Sphinx builds the site from the pages as they stand in the repository: the root of its sources is the root of the repository."""
import re
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
import package_pages  # noqa: E402

project = "raytube"
version = release = re.search(r"project\(raytube VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

extensions = ["myst_parser", "breathe", "navigation", "offline", "public_headers", "repository_files", "gallery",
              "sphinx.ext.autodoc", "sphinx.ext.autosummary", "numpydoc", "package_pages"]
root_doc = "README"
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**.md", "cases/*/README.md", "bench/report.md",
                    "tests/data/*/README.md"]
exclude_patterns = ["build*", "out", "src", ".git", "**/out"]
if not tags.has("package"):  # noqa: F821
    exclude_patterns += package_pages.PAGES

myst_heading_anchors = 6  # by the rules of code hosts, so that links to headings hold in both places
highlight_language = "none"

breathe_default_project = "raytube"
breathe_default_members = ("members",)
breathe_show_include = False

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings have the types
autosummary_generate = False
default_role = "autolink"  # docstrings write names of the package and of parameters in the same way
numpydoc_show_class_members = False

nitpicky = True
nitpick_ignore = [("cpp:identifier", name) for name in (
    "dvec2", "dvec3", "glm", "glm::dmat3", "glm::uvec2",  # GLM's
    "Scene", "CurrentMap", "Mechanism", "BandScene", "CornerWaves", "RowEvidence", "Omission", "raytube", "Made",  # declared in a public header, defined in another one
)]

html_theme = "furo"
html_title = f"raytube {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False


def setup(app):
    for name in ("csv", "off"):  # languages of code blocks that have no colours
        app.add_lexer(name, TextLexer)
