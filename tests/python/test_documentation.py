"""The package teaches itself: every public name is documented, annotated and typed, and its examples are true."""
import doctest
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import raytube as rt

PACKAGE = Path(rt.__file__).parent
pytestmark = pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")


def public():
    """Every public name, and every public member of public classes."""
    for name in rt.__all__:
        thing = getattr(rt, name)
        if name == "__version__":
            continue
        yield name, thing
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod)) or hasattr(value, "func")):
                    yield f"{name}.{member}", getattr(value, "__func__", getattr(value, "func", getattr(value, "fget", None) or value))


PUBLIC = dict(public())
FUNCTIONS = {name: thing for name, thing in PUBLIC.items() if inspect.isfunction(thing) and not isinstance(thing, type)}


@pytest.mark.parametrize("name", PUBLIC)
def test_has_a_sentence(name):
    text = inspect.getdoc(PUBLIC[name]) or ""
    assert re.match(r"[A-Z].*", text) and "." in text


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_and_results_are_documented(name):
    signature, text = inspect.signature(FUNCTIONS[name]), inspect.getdoc(FUNCTIONS[name])
    documented = re.split(r"\n(?:Returns|Raises|Warns|Notes|Examples)\n-+\n", text)[0]
    for parameter in signature.parameters:
        if parameter not in ("self", "cls"):
            assert re.search(rf"(^|[ ,*]){parameter}\b.*( :|,|$)", documented, re.MULTILINE), parameter
            assert signature.parameters[parameter].annotation is not inspect.Parameter.empty, parameter
    assert signature.return_annotation is not inspect.Signature.empty
    returns_something = signature.return_annotation not in (None, "None")
    if returns_something and "." not in name:
        assert "\nReturns\n" in text and "\nRaises\n" in text


def test_examples_are_true():
    tried = 0
    for name in ("raytube", "raytube._jobs", "raytube._result", "raytube._target", "raytube._looks", "raytube._comparison"):
        outcome = doctest.testmod(sys.modules[name])
        assert outcome.failed == 0
        tried += outcome.attempted
    assert tried >= 8


def test_import_is_quiet_and_light():
    code = ("import sys, raytube; heavy = {'matplotlib', 'pandas', 'xarray', 'tqdm', 'tables'} & set(sys.modules); "
            "raytube.Target([[0,0,0],[1,0,0],[0,1,0]], [[0,1,2]], 'm'); print(*heavy)")
    done = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr and not done.stdout.strip(), done.stdout + done.stderr


def test_types_come_along():
    assert (PACKAGE / "py.typed").is_file() and (PACKAGE / "_core.pyi").is_file()


def test_the_stub_has_the_names_of_the_module():
    from raytube import _core

    stub = (PACKAGE / "_core.pyi").read_text()
    for name, thing in vars(_core).items():
        if name.startswith("_") or inspect.ismodule(thing):
            continue
        assert re.search(rf"^(class|def) {name}\b", stub, re.MULTILINE), name
        for member in vars(thing) if inspect.isclass(thing) and name != "InputError" else ():
            assert member.startswith("_") or re.search(rf"^    (def )?{member}[:(]", stub, re.MULTILINE), f"{name}.{member}"


def test_types_are_sound():
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--config-file", Path(__file__).with_name("mypy.ini"), "--cache-dir=/dev/null", "-p", "raytube"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=PACKAGE.parent)
    assert done.returncode == 0, done.stdout + done.stderr
