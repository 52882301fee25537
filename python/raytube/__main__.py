"""The commands of the program that show results: ``python3 -m raytube plot | statistics | report | compare``."""

from __future__ import annotations

import importlib
import sys

from raytube._core import InputError

_MODULES = {"plot": "_plot_command", "statistics": "_statistics_command", "report": "_report_command", "compare": "_compare_images_command"}
_DEBIAN = {"matplotlib": "python3-matplotlib", "mpl_toolkits": "python3-matplotlib", "scipy": "python3-scipy",
           "pandas": "python3-pandas", "xarray": "python3-xarray", "netCDF4": "python3-netcdf4", "h5netcdf": "python3-netcdf4",
           "PIL": "python3-pil", "contourpy": "python3-contourpy", "OpenImageIO": "python3-openimageio"}
_BAD_INPUT, _MACHINE, _INTERRUPTED = 2, 3, 130


def main(arguments: list[str]) -> int:
    """Runs a command and returns its exit code; an error is one sentence on stderr.

    Parameters
    ----------
    arguments : list of str
        The command's name and its arguments, as they were typed.

    Returns
    -------
    int
        0 done, 1 a tolerance is exceeded, 2 bad input, 3 the machine lacks something, 130 interrupted.
    """
    if not arguments or arguments[0] not in _MODULES:
        return _complain(f"write one of the commands {', '.join(_MODULES)}", _BAD_INPUT)
    try:
        code: int = importlib.import_module(f"raytube.{_MODULES[arguments[0]]}").main(arguments[1:])
        sys.stdout.flush()
        return code
    except InputError as error:
        return _complain(str(error), _BAD_INPUT)
    except ImportError as missing:
        package = (missing.name or "").split(".")[0]
        remedy = f"install {_DEBIAN[package]}" if package in _DEBIAN else "install it"
        return _complain(f"raytube {arguments[0]} needs the Python package {package or missing}; {remedy} (or use pip)", _MACHINE)
    except KeyboardInterrupt:
        return _complain(f"interrupted; {arguments[0]} wrote nothing", _INTERRUPTED)
    except (OSError, MemoryError) as error:
        return _complain(str(error) or "out of memory", _MACHINE)


def _complain(sentence: str, code: int) -> int:
    sys.stderr.write(f"raytube: {' '.join(sentence.split())}\n")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
