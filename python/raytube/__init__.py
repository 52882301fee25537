"""Radar cross-sections of triangle meshes: deterministic shooting and bouncing rays with edges, complex and polarimetric.

A target is built once and solved as often as you like; every keyword is a key of a case file, and a wrong one is refused with the
program's own sentence.

>>> import raytube as rt
>>> plate = rt.Target([[0, 0, 0], [.3, 0, 0], [.3, .3, 0], [0, .3, 0]], [[0, 1, 2, 3]], unit="m")
>>> result = rt.solve(plate, ghz=10.0, looks=rt.monostatic(theta_deg=[0, 10, 20], phi_deg=0))
>>> result.S.shape                       # complex amplitudes in metres: look, frequency, receive, transmit
(3, 1, 2, 2)
>>> round(float(result.sigma_dbsm.sel(channel="vv").max()), 1)
20.5

Conventions: time factor exp(+j omega t); theta from +z and phi from +x point from the target towards the radar [deg]; V is theta-hat and H
is phi-hat of the transmitter's and of the receiver's own direction; ``vh`` is receive V, transmit H; ``sigma = 4 pi |S|^2``; the phase
reference is the origin of the mesh's coordinates.

Target, monostatic, bistatic, looks, Motion, solve: pose a problem and solve it. Result, load: its result. run, check, converge, image, trace: as the
commands of the program, for a case file or a target. compare: two results from any source; statistics: how sigma is distributed in one.
centres: where on the target the return of a look comes from. read_radar_explorer: results from the Radar Explorer Toolkit.
"""

from raytube import _processor as _processor  # first: refuses processors that the rest cannot run on
from raytube._core import InputError, __version__
from raytube._jobs import CheckReport, Convergence, centres, check, converge, image, run, solve, trace
from raytube._comparison import Comparison, compare
from raytube._looks import Looks, bistatic, looks, monostatic
from raytube._motion import Motion
from raytube._radar_explorer import read_radar_explorer
from raytube._result import RaytubeWarning, Result, load
from raytube._statistics import Statistics, statistics
from raytube._target import Target

__all__ = ["CheckReport", "Comparison", "Convergence", "InputError", "Looks", "Motion", "RaytubeWarning", "Result", "Statistics", "Target", "bistatic", "check",
           "centres", "compare", "converge", "image", "load", "looks", "monostatic", "read_radar_explorer", "run", "solve", "statistics", "trace", "__version__"]
InputError.__doc__ = """Bad input: one sentence that says what is wrong, where, and how to fix it. A ValueError."""
InputError.__module__ = "raytube"
