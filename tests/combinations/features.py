"""What a case may have, each with a check of its own that holds whatever else the case has."""

import math
from dataclasses import dataclass, field
from typing import Callable

from scene import BASE, WAVELENGTH
from solver import CHANNELS, complex_of, difference, table

FAR = 1e4 * 2 * 1.0**2 / WAVELENGTH  # [m] 10^4 far-field distances of a target within half a metre of the origin
HUNDREDTH_DB = 0.01 * math.log(10) / 20
EXACT = 1e-9  # rounding, of sums of phases of up to 10^2 rad

NEAR = {"radar.range_m": 3.0}
VACUUM = {"eps_r": 1.0}
METAL = {"eps_r": [-1e20, 1e20]}


def part(panel, name=None, **keys):
    """One panel of a material of its own."""
    return {f"target.parts.{panel}": name or panel, **{f"materials.{name or panel}.{key}": v for key, v in keys.items()}}


def off(settings, *prefixes):
    return {key: v for key, v in settings.items() if not key.startswith(prefixes)}


@dataclass
class Feature:
    """`settings` of the case; `check(solver, settings)` says what is wrong, or nothing."""
    name: str
    settings: dict
    check: Callable
    keys: tuple = ()  # those that two such features would both set
    options: tuple = field(default=())


def same(what, solver, one, other, tolerance):
    apart = difference(solver.s(one), solver.s(other))
    return None if apart <= tolerance else f"{what}: {apart:.2g} of the peak apart, {tolerance:.2g} allowed"


def far_limit(solver, settings):
    """A radar so far away is one at infinity."""
    far = {**settings, "radar.range_m": FAR}
    if "receive.theta_deg" in settings:
        far["radar.receive_range_m"] = FAR
    infinite = off(settings, "radar.", "output.power")
    if settings.get("edges.method") == "utd":
        infinite["edges.utd_range_m"] = FAR
    if "radar.turntable_deg" in settings:
        far["radar.turntable_deg"] = [0.0]
    # Two integrals over curved surfaces, one of them good to 2e-3.
    curved = "ball.obj" in settings["target.mesh"]
    return same("far limit", solver, far, infinite, 2e-2 if curved else HUNDREDTH_DB)


def back_again(solver, settings):
    """A receiver at the transmitter is a monostatic radar."""
    beside = {**settings, "receive.theta_deg": settings["look.theta_deg"][:1], "receive.phi_deg": settings["look.phi_deg"][:1],
              "look.theta_deg": settings["look.theta_deg"][:1]}
    if "radar.receive_range_m" in beside:
        beside["radar.receive_range_m"] = beside["radar.range_m"]
    one = {**off(beside, "receive.", "radar.receive"), "look.phi_deg": beside["look.phi_deg"]}
    rows = [[solver.s(case)[0][i] for i in (0, 3)] for case in (beside, one)]
    apart = difference(rows[:1], rows[1:])
    return None if apart <= EXACT else f"receiver at the transmitter: {apart:.2g} of the peak from a monostatic radar"


def turned(solver, settings):
    table_deg = settings["radar.turntable_deg"]
    plain = off(settings, "radar.turntable")
    rows = solver.s(settings)
    for i, angle in enumerate(table_deg):
        there = {**plain, "look.phi_deg": [p - angle for p in plain["look.phi_deg"]]}
        if "receive.phi_deg" in plain:
            there["receive.phi_deg"] = [p - angle for p in plain["receive.phi_deg"]]
        apart = difference(rows[i::len(table_deg)], solver.s(there))
        if apart > 1e-6:
            return f"the target turned by {angle}: {apart:.2g} of the peak from antennas turned back"
    return None


def power(solver, settings):
    out = solver.run(settings)
    gain = 10**(settings["radar.gain_dbi"] / 10)
    for row, level in zip(table(out / "rcs.csv"), table(out / "power.csv"), strict=True):
        ranges = [float(row.get("range_m", settings["radar.range_m"])), float(row.get("rx_range_m", settings["radar.range_m"]))]
        for name, s in zip(CHANNELS, complex_of(row, CHANNELS)):
            watts = 1e-3 * 10**(settings["radar.transmit_power_dbm"] / 10) * gain**2 * WAVELENGTH**2 * abs(s)**2 / (
                (4 * math.pi)**2 * ranges[0]**2 * ranges[1]**2)
            told = float(level[f"power_{name}_dbm"])
            if watts > 0 and abs(10 * math.log10(1e3 * watts) - told) > 0.01:
                return f"power of {name}: {told} dBm, by the radar equation {10 * math.log10(1e3 * watts):.3f}"
    return None


def dark_horizon(solver, settings):
    """E along a conducting ground vanishes there: a wave of H from the horizon does not exist above it."""
    grazing = {**settings, "look.theta_deg": [90.0]}
    rows = solver.s(grazing)
    largest = max(abs(s) for row in rows for s in row)
    hidden = max(abs(row[i]) for row in rows for i in (1, 3))
    sampled = "ball.obj" in settings["target.mesh"]  # what curved surfaces reflect onto their images is
    return None if hidden <= (5e-3 if sampled else EXACT) * largest else f"H from the horizon: {hidden / largest:.2g} of V"


def no_ground(solver, settings):
    vacuum = {**settings, "materials.earth.eps_r": 1.0}
    return same("a ground of vacuum", solver, vacuum, off(settings, "ground.", "materials.earth"), EXACT)


def becomes(name, other):
    """The check that the material, set as `other` says, is as good as the wall's other one."""
    def check(solver, settings):
        plain = off(settings, f"materials.{name}.")
        mirror = {**plain, f"materials.{name}.kind": "pec", f"materials.{name}.roughness_rms_mm": 1e-9}
        return same(f"{name} as a conductor", solver, {**plain, **{f"materials.{name}.{k}": v for k, v in other.items()}}, mirror, 1e-5)
    return check


def black(solver, settings):
    plain = off(settings, "materials.foam.")
    vacuum = {**plain, "materials.foam.kind": "dielectric", **{"materials.foam." + k: v for k, v in VACUUM.items()}}
    return same("an absorber and a half-space of vacuum", solver, settings, vacuum, EXACT)


def nothing_there(keys):
    def check(solver, settings):
        plain = off(settings, "materials.window.", "target.parts.window")
        # Waves between and over surfaces, and of edges of materials, end at sheets.
        plain |= {"edges.between": False, "surfaces.waves": False, "edges.materials": "none"}
        ball, grid = "ball.obj" in settings["target.mesh"], "tubes.mode" in settings
        if ball and not grid:
            plain["tubes.curved"] = "always"  # by default a ball beside anything is facets
        there = {**plain, "target.parts.window": "window", "materials.window.kind": "sheet", **keys}
        gone = {**plain, "target.mesh": [m for m in settings["target.mesh"] if m != "window.obj"]}
        # Edges behind a sheet are cut where its outline is found, curved cells where it crosses them.
        # A grid is another one with a sheet on it.
        return same("a sheet of vacuum", solver, there, gone, 2e-2 if ball or grid else 2e-4)
    return check


def no_block(solver, settings):
    plain = off(settings, "materials.wax.", "target.parts.block")
    plain |= {"edges.between": False, "surfaces.waves": False}  # they end at solids
    ball, grid = "ball.obj" in settings["target.mesh"], "tubes.mode" in settings
    if not grid:
        plain["accuracy.tolerance_db"] = 0.01  # of tubes that go on behind it
    if ball and not grid:
        plain["tubes.curved"] = "always"
    there = {**plain, "target.parts.block": "wax", "materials.wax.kind": "solid", "materials.wax.eps_r": 1.0}
    gone = {**plain, "target.mesh": [m for m in settings["target.mesh"] if m != "block.obj"]}
    # A grid is another one with a block beside it.
    return same("a solid of vacuum", solver, there, gone, 2e-2 if ball or grid else 1e-3)


def smooth(solver, settings):
    flat = {**settings, "materials.rock.roughness_rms_mm": 1e-9}
    return same("no roughness", solver, flat, off(settings, "materials.rock.roughness", "output.incoherent"), EXACT)


def convex_as_well(solver, settings):
    # Curved facets of one convex body are the same by default; with others about they reflect, or are counted as facets.
    alone = settings["target.mesh"] == ["ball.obj"] and "ground.height_m" not in settings
    return same("curved by default", solver, settings, off(settings, "tubes.curved"), EXACT if alone else 0.1)


def fine_grid(solver, settings):
    # 0.5 dB of the peak: the staircase of 30 tubes a wavelength along the corner's edges.
    facets = {**off(settings, "tubes.mode", "tubes.per_wavelength"), "tubes.curved": "never"}
    return same("adaptive tubes", solver, settings, facets, 0.06)


def mechanisms_of(solver, settings):
    """The names of the mechanisms that are not zero in every row."""
    rows = table(solver.run(settings, "--parts") / "parts.csv")
    names = [name for name in rows[0] if name.startswith("re_")]
    return {name.split("_", 2)[2] for name in names if any(float(row[name]) != 0.0 for row in rows)}


def one_order(solver, settings):
    return "there is a second order" if "edges_order_2_on" in mechanisms_of(solver, settings) else None


def no_edges(solver, settings):
    other = sorted(name for name in mechanisms_of(solver, settings) if not name.startswith("bounce"))
    return f"edges.method none has {other}" if other else None


def ran(key):
    """That the mechanism is not left out."""
    def check(solver, settings):
        why_not = solver.without(settings, key)
        return f"left out: {why_not}" if why_not else None
    return check


def edges_of_materials(solver, settings):
    apart = difference(solver.s(settings), solver.s({**settings, "edges.materials": "none"}))
    return None if apart > EXACT else "they add nothing"


def reciprocal(solver, settings):
    """Rays are the same there and back."""
    rows = solver.s(settings)
    if "receive.theta_deg" not in settings:
        apart = difference([[row[1]] for row in rows], [[row[2]] for row in rows])
        return None if apart <= EXACT else f"VH and HV differ by {apart:.2g} of the larger"
    back = {**settings}
    for angle in ("theta_deg", "phi_deg"):
        back |= {"look." + angle: settings["receive." + angle], "receive." + angle: settings["look." + angle]}
    if "radar.receive_range_m" in settings:
        back |= {"radar.range_m": settings["radar.receive_range_m"], "radar.receive_range_m": settings["radar.range_m"]}
    if "radar.turntable_deg" in settings:
        return None  # rows of several angles are in another order there
    swapped = [[row[0], row[2], row[1], row[3]] for row in solver.s(back)]
    apart = difference(rows, swapped)
    return None if apart <= 1e-7 else f"transmitter and receiver exchanged: {apart:.2g} of the peak"


SHEET = {"target.mesh": [*BASE["target.mesh"], "window.obj"], "target.parts.window": "window"}
PHYSICS = [
    Feature("range", NEAR, far_limit),
    Feature("pattern", {**NEAR, "radar.beamwidth_deg": 20.0}, far_limit),
    Feature("turntable", {**NEAR, "radar.turntable_deg": [0.0, 7.0]}, turned),
    Feature("power", {**NEAR, "radar.transmit_power_dbm": 10.0, "radar.gain_dbi": 20.0, "output.power_dbm": True}, power),
    Feature("bistatic", {"receive.theta_deg": [58.0], "receive.phi_deg": [17.0]}, back_again),
    Feature("ground, metal", {"ground.height_m": 0.0}, dark_horizon, ("ground",)),
    Feature("ground, medium", {"ground.height_m": 0.0, "ground.material": "earth", "materials.earth.kind": "dielectric",
                               "materials.earth.eps_r": [5.0, 0.3]}, no_ground, ("ground",)),
    Feature("absorber", part("foam", kind="absorber"), black),
    Feature("dielectric", part("glass", kind="dielectric", eps_r=[4.0, 0.1]), becomes("glass", {"kind": "dielectric", **METAL})),
    Feature("coated", part("coat", kind="coated", thickness_mm=3.0, eps_r=[4.0, 0.1]),
            becomes("coat", {"kind": "coated", "thickness_mm": 1e-7, **VACUUM})),
    Feature("rough", part("rock", kind="dielectric", eps_r=[6.0, 0.2], roughness_rms_mm=4.0) | {"output.incoherent": True}, smooth),
    Feature("sheet", {**SHEET, "materials.window.kind": "sheet", "materials.window.thickness_mm": 4.0,
                      "materials.window.eps_r": [3.0, 0.05]},
            nothing_there({"materials.window.thickness_mm": 4.0, "materials.window.eps_r": 1.0}), ("window",)),
    Feature("resistive sheet", {**SHEET, "materials.window.kind": "sheet", "materials.window.resistance_ohm": 300.0},
            nothing_there({"materials.window.resistance_ohm": 1e15}), ("window",)),
    Feature("solid", {"target.mesh": [*BASE["target.mesh"], "block.obj"], "target.parts.block": "wax", "materials.wax.kind": "solid",
                      "materials.wax.eps_r": [2.6, 0.3]}, no_block, ("window",)),
    Feature("curved", {"target.mesh": ["ball.obj"], "tubes.curved": "always"}, convex_as_well),
    Feature("uniform", {"tubes.mode": "uniform", "tubes.per_wavelength": 30}, fine_grid),
    Feature("edges, none", {"edges.method": "none"}, no_edges, ("edges",)),
    Feature("edges, order 1", {"edges.order": 1}, one_order, ("edges",)),
    Feature("edges, utd", {"edges.method": "utd", "edges.utd_range_m": 100.0}, reciprocal, ("edges",)),
    Feature("edges of materials", {**part("coat", kind="coated", thickness_mm=3.0, eps_r=[4.0, 0.1]), "edges.materials": "fringe"},
            edges_of_materials, ("edges",)),
    Feature("interaction", {"edges.between": True}, ran("edges.between")),
    Feature("waves", {"target.mesh": ["ball.obj"], "surfaces.waves": True}, ran("surfaces.waves")),
]
