"""A regression test: the first run keeps its result, later ones are held to it.

Run it by `pytest regression_test.py`. As a script it draws what the test would see if edges were taken
at first order only. `golden.nc` belongs under version control; delete it to accept a change on purpose.
"""
from pathlib import Path

import numpy as np

import raytube as rt

GOLDEN = Path("golden.nc")
TOLERANCE = 1e-6  # of the largest |S|: far above how compilers round, far below a change of the physics


def solved(**options):
    """A cube of 90 mm at 10 GHz from 20 degrees above, once round a quarter."""
    corners = [[x, y, z] for x in (0, 90) for y in (0, 90) for z in (0, 90)]
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    looks = rt.monostatic(theta_deg=70, phi_deg=np.arange(0, 90.5, 0.5))
    return rt.solve(rt.Target(corners, faces, unit="mm"), ghz=10.0, looks=looks, **options)


def kept():
    if not GOLDEN.exists():
        solved().save(GOLDEN)
    return rt.load(GOLDEN)


def difference(result, golden):
    """Largest |S - S_golden| of each look, as a share of the largest |S_golden|."""
    largest = abs(result.S - golden.S).max(dim=("receive", "transmit")).values[:, 0]
    return largest / float(abs(golden.S).max())


def test_cube_is_what_it_was():
    golden = kept()
    assert difference(solved(), golden).max() <= TOLERANCE


if __name__ == "__main__":
    import matplotlib.pyplot as plt

    golden, same, changed = kept(), solved(), solved(edges={"order": 1})
    figure, (levels, shares) = plt.subplots(2, 1, figsize=(7, 6), sharex=True, layout="constrained")
    golden.plot(ax=levels)
    shares.semilogy(golden.S.phi_deg, difference(changed, golden), "C3", label="edges of first order")
    shares.axhline(TOLERANCE, color="k", linestyle="--", linewidth=1, label="tolerance")
    levels.set(title="golden.nc: cube of 90 mm, 10 GHz, θ = 70°", xlabel="")
    shares.set(xlabel="azimuth φ (degrees)", ylabel="largest |ΔS| / |S|", xlim=(0, 90), ylim=(1e-8, 1))
    shares.grid(alpha=0.3)
    shares.legend()
    figure.savefig("regression_test.png", dpi=150)
    print(f"same solver {difference(same, golden).max():.1g}, edges of first order "
          f"{difference(changed, golden).max():.1g}, tolerance {TOLERANCE:.1g}")
