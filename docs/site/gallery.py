"""The directive that shows an example of examples/python:

    ```{example} sweep
    ```

stands for the figure that examples/python/sweep.py leaves as sweep.png in the folder it is run in, its text, and what it prints. build.py
runs every example in the folder `gallery_figures` and keeps there what it prints as sweep.txt.
"""
import os
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive

EXAMPLES = "examples/python"


def block(file, language):
    text = file.read_text(encoding="utf-8").rstrip()
    return nodes.literal_block(text, text, language=language)


class Example(Directive):
    required_arguments = 1  # name, without .py

    def run(self):
        environment = self.state.document.settings.env
        name = self.arguments[0]
        script = Path(environment.srcdir, EXAMPLES, f"{name}.py")
        figures = Path(environment.config.gallery_figures)
        if not script.is_file():
            raise self.error(f"there is no example {EXAMPLES}/{name}.py")
        environment.note_dependency(str(script))
        return [self.picture(figures / f"{name}.png", environment), block(script, "python"), block(figures / f"{name}.txt", "none")]

    def picture(self, figure, environment):
        page = Path(environment.doc2path(environment.docname)).parent
        return nodes.image("", uri=os.path.relpath(figure, page), alt=f"what {figure.stem}.py draws")


def setup(app):
    app.add_config_value("gallery_figures", "", "env", [str])
    app.add_directive("example", Example)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
