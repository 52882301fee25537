#!/usr/bin/env python3
"""The ISAR image of cases/turntable with the car's outline, alone, and for README beside a corner reflector against the method of moments.

    first_page.py ISAR.csv CORNER.csv CORNER_PO.csv FOLDER     isar.csv of the car; rcs.csv of docs/figures/dihedral3.toml, edges on and off;
                                                               writes first_page.png and turntable.png
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
AZIMUTH_DEG = 30.0  # the middle of the car's looks
FEW = (("nose", (-0.74, -1.98), (-1.85, -2.35)), ("wheel", (0.1, -1.38), (1.0, -1.75)), ("wheel", (1.43, 0.95), (1.15, 1.9)),
       ("mirror", (0.6, -1.0), (1.3, -0.75)), ("mirror", (-1.15, -0.03), (-1.9, 0.6)))
ALL = (("nose", (-0.74, -2.05), (-1.6, -2.4)), ("left front wheel", (0.1, -1.4), (0.75, -2.0)), ("left mirror", (0.6, -1.0), (1.1, -0.6)),
       ("left rear wheel", (1.43, 0.9), (0.95, 0.05)), ("silencer", (1.2, 1.3), (1.3, 2.2)), ("right mirror", (-1.15, -0.03), (-1.8, 0.6)),
       ("right front wheel", (-1.4, -1.2), (-1.9, -1.75)), ("right rear wheel", (-0.05, 1.22), (-1.3, 1.5)))


def table(file):
    lines = [line for line in Path(file).read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    names = lines[0].split(",")
    used = [i for i, name in enumerate(names) if name not in ("cut", "kind")]
    values = np.array([[float(line.split(",")[i]) for i in used] for line in lines[1:] if not names[-1] == "cut" or line.endswith(",az_th90")])
    return {names[i]: values[:, column] for column, i in enumerate(used)}


def top_view(file):
    """Corners of the car's triangles across and along the line of sight, the radar below."""
    lines = Path(file).read_text(encoding="utf-8").splitlines()
    count = [int(line.split()[2]) for line in lines if line.startswith("element")]
    body = lines[lines.index("end_header") + 1:]
    x, y = np.array([line.split()[:2] for line in body[:count[0]]], dtype=float).T
    facets = np.array([line.split()[1:] for line in body[count[0]:sum(count)]], dtype=int)
    c, s = np.cos(np.radians(AZIMUTH_DEG)), np.sin(np.radians(AZIMUTH_DEG))
    return np.stack((y * c - x * s, -x * c - y * s), axis=-1)[facets]


def outline(axes, triangles):
    """The border of all triangles together: of a mask drawn from them, as the bodies overlap."""
    cell, low = 0.01, triangles.min(axis=(0, 1)) - 0.1
    x, y = (np.arange(low[i], triangles[..., i].max() + 0.1, cell) for i in (0, 1))
    mask = np.zeros((len(y), len(x)))
    for t in triangles:
        (i0, j0), (i1, j1) = ((t.min(axis=0) - low) / cell).astype(int), ((t.max(axis=0) - low) / cell).astype(int) + 2
        px, py = np.meshgrid(x[i0:i1], y[j0:j1])
        sides = [(b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0]) for a, b in zip(t, np.roll(t, -1, axis=0))]
        mask[j0:j1, i0:i1][np.all(np.array(sides) >= 0, axis=0) | np.all(np.array(sides) <= 0, axis=0)] = 1
    axes.contour(x, y, mask, levels=[0.5], colors="white", linewidths=0.9)


def image(axes, file, labels):
    data = table(file)
    along, across = np.unique(data["range_m"]), np.unique(data["cross_range_m"])
    level = data["sigma_hh_dbsm"].reshape(len(along), len(across))
    drawn = axes.pcolormesh(across, along, level, vmin=-45, vmax=0, cmap="viridis", shading="nearest", rasterized=True)
    outline(axes, top_view(ROOT / "cases/turntable/car.ply"))
    axes.set(aspect="equal", xlabel="cross-range (m)", ylabel="range (m)", xlim=(-2.0, 2.0), ylim=(-2.6, 2.5))
    axes.set_title("ISAR image of a car of 4.4 m, seen from above\nHH, f₀ = 10 GHz, B = 1.5 GHz, 9° of azimuth", fontsize=10)
    axes.annotate("", (0, -2.05), (0, -2.5), arrowprops={"arrowstyle": "-|>", "color": "white", "lw": 1.5})
    axes.text(0.1, -2.45, "radar", color="white", fontsize=9)
    for name, place, text in labels:
        axes.annotate(name, place, text, color="white", fontsize=9, arrowprops={"arrowstyle": "-", "color": "white", "lw": 0.7})
    plt.colorbar(drawn, ax=axes, label="σ (dBsm)", shrink=0.9)


def corner(panels, with_edges, without):
    truth, on, off = (table(f) for f in (ROOT / "tests/data/mom/dihedral3.csv", with_edges, without))
    for axes, pq in zip(panels, ("vv", "hh")):
        axes.plot(truth["phi_deg"], 10 * np.log10(4 * np.pi * (truth[f"re_{pq}"] ** 2 + truth[f"im_{pq}"] ** 2)), color="#b8b8b8", lw=6,
                  label="method of moments")
        axes.plot(off["phi_deg"], off[f"sigma_{pq}_dbsm"], color="#d9480f", lw=1.2, ls="--", label="shooting and bouncing rays alone (PO)")
        axes.plot(on["phi_deg"], on[f"sigma_{pq}_dbsm"], color="#1f5fbf", lw=1.6, label="raytube, default")
        axes.set(xlim=(-60, 60), ylim=(-25, 5), ylabel=f"σ {pq.upper()} (dBsm)")
        axes.xaxis.set_major_locator(plt.MultipleLocator(15))
        axes.grid(color="#dddddd")
    panels[0].set_title("Dihedral corner reflector of 3 λ, 10 GHz, monostatic, θ = 90°", fontsize=10)
    panels[0].tick_params(labelbottom=False)
    panels[1].set_xlabel("φ (deg)")
    panels[1].legend(loc="lower center", fontsize=9, framealpha=1)


def main():
    isar, with_edges, without, folder = sys.argv[1:]
    plt.rcParams["font.size"] = 9.5
    figure = plt.figure(figsize=(12, 6), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=[1, 1.1])
    image(left.subplots(), isar, FEW)
    corner(right.subplots(2, 1), with_edges, without)
    alone = plt.figure(figsize=(7, 7.5), layout="constrained")
    image(alone.subplots(), isar, ALL)
    for drawn, name in ((figure, "first_page"), (alone, "turntable")):
        drawn.savefig(Path(folder) / f"{name}.png", dpi=110, bbox_inches="tight", pad_inches=0.08, metadata={"Software": None})


if __name__ == "__main__":
    main()
