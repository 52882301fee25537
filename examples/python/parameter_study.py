"""A parameter study on meshes made of arrays: how well must a dihedral be built?

Each opening is a target of its own; the frequencies come from one trace of each.
"""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

SIDE = 0.15  # metres
GHZ = [10.0, 35.0, 94.0]


def dihedral(opening_deg):
    """Two square faces that meet on the z axis and open towards +x."""
    half = np.radians(opening_deg / 2)
    x, y = SIDE * np.cos(half), SIDE * np.sin(half)
    low = np.array([[0, 0, 0], [x, y, 0], [x, -y, 0]])
    high = low + [0, 0, SIDE]
    return rt.Target(np.vstack([low, high]), [[0, 1, 4, 3], [0, 3, 5, 2]], unit="m")


def theory_db(error_deg, ghz):
    """Two bounces turn a ray by twice the error: both halves of the aperture, 2**.5 SIDE, point apart."""
    wavelength = 0.299792458 / ghz
    return 20 * np.log10(abs(np.sinc(np.radians(error_deg) * 2**0.5 * SIDE / wavelength)))


error = np.linspace(-2.0, 2.0, 161)
on_bisector = rt.monostatic(theta_deg=90, phi_deg=0)
results = [rt.solve(dihedral(90 + degrees), GHZ, on_bisector, edges={"method": "none"})
           for degrees in error]
sigma = np.array([result.sigma_dbsm.sel(channel="vv").values[0] for result in results])  # [error, frequency]
change = sigma - sigma[error.size // 2]

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
for i, ghz in enumerate(GHZ):
    ax.plot(error, change[:, i], label=f"{ghz:g} GHz")
    ax.plot(error, theory_db(error, ghz), "k:", label="theory" if ghz == GHZ[-1] else None)
ax.set(title=f"Dihedral of {1e3 * SIDE:g} mm on its bisector, physical optics")
ax.set(xlabel="opening − 90° (degrees)", ylabel="change of σ, VV (dB)", xlim=(-2, 2), ylim=(-35, 2))
ax.grid(alpha=0.3)
ax.legend()
figure.savefig("parameter_study.png", dpi=150)

right_angle = 10 * np.log10(8 * np.pi * SIDE**4 / (0.299792458 / GHZ[-1]) ** 2)
print(f"right angle, 94 GHz: {sigma[error.size // 2, -1]:.3f} dBsm, 8 pi a^4 / lambda^2 {right_angle:.3f} dBsm")
for degrees in (0.25, 0.5):
    i = np.argmin(abs(error - degrees))
    print(f"{degrees:g} degrees off: {change[i, -1]:.2f} dB, theory {theory_db(degrees, GHZ[-1]):.2f} dB")
