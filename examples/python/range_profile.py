"""A range profile: three boxes, their faces and what lies behind these."""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

BOXES = [(-1.2, -0.5, 0.20), (0.3, 0.0, 0.10), (0.9, 0.4, 0.15)]  # x and y of the front face, side [m]


def boxes():
    """All of them as one target; the corners of each are counted in binary, zyx."""
    unit = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]) - [1, 0.5, 0.5]
    box = np.array([[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]])
    vertices = np.vstack([side * unit + [x, y, 0] for x, y, side in BOXES])
    return rt.Target(vertices, np.vstack([box + 8 * i for i in range(len(BOXES))]), unit="m")


# 4 GHz resolve c / 2 B = 4 cm; steps of 25 MHz are unambiguous over c / 2 df = 6 m.
c, f = 299792458.0, np.linspace(8e9, 12e9, 161)
result = rt.solve(boxes(), f / 1e9, rt.monostatic(theta_deg=90, phi_deg=0))
profile = result.range_profile(window="hann", padding=16)
sigma = profile.sigma_dbsm.sel(channel="vv")

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
ax.plot(-profile.range_m, sigma)  # range counts away from the radar
flat = [10 * np.log10(4 * np.pi) + 20 * np.log10(side**2 * f.mean() / c) for _, _, side in BOXES]
ax.plot([x for x, _, _ in BOXES], flat, "k+", markersize=10, label="faces: 4π A² / λ² at 10 GHz")
ax.plot([x - side for x, _, side in BOXES], [-55] * 3, "k|", markersize=10, label="backs of the boxes")
ax.set(title="Three boxes, 8 to 12 GHz, Hann window", xlim=(-2, 2), ylim=(-60, 25))
ax.set(xlabel="distance towards the radar (m)", ylabel="σ, VV (dBsm)")
ax.grid(alpha=0.3)
ax.legend()
figure.savefig("range_profile.png", dpi=150)

for (x, _, _), level in zip(BOXES, flat):
    near = sigma.sel(range_m=slice(-x - 0.04, -x + 0.04))
    print(f"face at {x:.2f} m, {level:.2f} dBsm: peak at {-near.idxmax().item():.3f} m, {near.max().item():.2f} dBsm")
