"""A bistatic diagram: a plate lit at 45 degrees, the receiver all round.

Physical optics has two lobes of equal height, the mirror direction and the shadow behind the plate;
edges fill in what is between them.
"""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

SIDE, GHZ = 0.3, 10.0
WAVELENGTH = 299792458.0 / (GHZ * 1e9)
half = SIDE / 2

corners = [[0, -half, -half], [0, half, -half], [0, half, half], [0, -half, half]]
plate = rt.Target(corners, [[0, 1, 2, 3]], unit="m")  # faces +x
receiver = np.arange(0.0, 360.1, 0.5)
looks = rt.bistatic(theta_deg=90, phi_deg=45, rx_theta_deg=90, rx_phi_deg=receiver)
result = rt.solve(plate, GHZ, looks, title=f"Plate of {SIDE:g} m at {GHZ:g} GHz, lit from φ = 45°")

figure, ax = plt.subplots(figsize=(6, 6), subplot_kw={"projection": "polar"}, layout="constrained")
result.plot_polar(("vv", "hh"), ax=ax)
lobe = 10 * np.log10(4 * np.pi * (SIDE**2 * np.cos(np.radians(45)) / WAVELENGTH) ** 2)
ax.plot(np.radians([225, 315]), [lobe, lobe], "k+", markersize=12, label="4π (A cos 45° / λ)²")
ax.annotate("transmitter", (np.radians(45), lobe - 30), (np.radians(45), lobe - 8), ha="center",
            arrowprops={"arrowstyle": "->"})
ax.set_rlim(lobe - 50, lobe + 3)
ax.set_rgrids((-20, -10, 0, 10), angle=350)
ax.legend(loc="lower left", bbox_to_anchor=(-0.1, -0.1))
figure.savefig("bistatic.png", dpi=150)

sigma = result.sigma_dbsm.sel(channel="vv").values[:, 0]
mirror, shadow = sigma[receiver == 315.0][0], sigma[receiver == 225.0][0]
print(f"mirror {mirror:.2f} dBsm, shadow {shadow:.2f} dBsm; 4 pi (A cos 45 / lambda)^2 {lobe:.2f} dBsm")
