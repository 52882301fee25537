"""The directive that shows an example of examples/python:

    ```{example} sweep
    ```

stands for the text of examples/python/sweep.py and the figure that it leaves as sweep.png in the folder it is run in. build.py runs
every example in the folder `gallery_figures`.
"""
import os
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive

EXAMPLES = "examples/python"


class Example(Directive):
    required_arguments = 1  # name, without .py

    def run(self):
        environment = self.state.document.settings.env
        name = self.arguments[0]
        script = Path(environment.srcdir, EXAMPLES, f"{name}.py")
        figure = Path(environment.config.gallery_figures, f"{name}.png")
        if not script.is_file():
            raise self.error(f"there is no example {EXAMPLES}/{name}.py")
        environment.note_dependency(str(script))
        text = script.read_text(encoding="utf-8")
        shown = nodes.literal_block(text, text, language="python")
        return [shown, self.picture(figure, environment)] if figure.is_file() else [shown]

    def picture(self, figure, environment):
        page = Path(environment.doc2path(environment.docname)).parent
        return nodes.image("", uri=os.path.relpath(figure, page), alt=f"what {figure.stem}.py draws")


def setup(app):
    app.add_config_value("gallery_figures", "", "env", [str])
    app.add_directive("example", Example)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
