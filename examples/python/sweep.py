"""An azimuth sweep of a corner reflector, drawn with its error bars.

`error_db` tells how exact each number is, `model_db` what the theory may have left out of it.
"""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

CASES = Path(__file__).resolve().parents[2] / "cases"
LEG, GHZ = 1.5, 3.0  # metres

corner = rt.Target.load(CASES / "trihedral/trihedral.off", unit="m")  # faces on the planes of the axes
azimuth = np.arange(0.0, 90.01, 0.5)
looks = rt.monostatic(theta_deg=54.7356, phi_deg=azimuth)  # along the axis of the corner at 45 degrees
result = rt.solve(corner, GHZ, looks, title=f"Trihedral of {LEG:g} m, {GHZ:g} GHz, elevation 35.3°")

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
result.plot(("vv", "hh"), ax=ax)
sigma = result.sigma_dbsm.sel(channel="vv").isel(frequency=0).values
bars = np.hypot(result.error_db, result.model_db).sel(channel="vv").isel(frequency=0).values
ax.fill_between(azimuth, sigma - bars, sigma + bars, alpha=0.25, linewidth=0, label="VV ± error bars")
ax.set(xlim=(0, 90), ylim=(sigma.max() - 20, sigma.max() + 3))
ax.legend(loc="lower center", ncols=3)
figure.savefig("sweep.png", dpi=150)

print(result)
optics = 10 * np.log10(4 * np.pi * LEG**4 / 3 / (0.299792458 / GHZ) ** 2)
print(f"on the axis {sigma[azimuth == 45.0][0]:.2f} dBsm; geometrical optics {optics:.2f} dBsm")
