"""What an absorbing coat takes away: a plate with and without it, over frequency.

At broadside that is the plane-wave reflection of the layer, a line of algebra.
"""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

SIDE = 0.3
EPS, MU, MM = 7.5 - 0.5j, 1.6 - 1.1j, 1.5  # time factor exp(+j omega t): losses are negative imaginary

half = SIDE / 2
corners = [[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]]
plate = rt.Target(corners, [[0, 1, 2, 3]], unit="m", parts=["front"])
ghz = np.linspace(4.0, 18.0, 113)
broadside = rt.monostatic(theta_deg=0, phi_deg=0)
coat = {"kind": "coated", "thickness_mm": MM, "eps_r": [EPS.real, -EPS.imag], "mu_r": [MU.real, -MU.imag]}
bare = rt.solve(plate, ghz, broadside, edges={"method": "none"})
coated = rt.solve(plate, ghz, broadside, edges={"method": "none"},
                  materials={"coat": coat}, parts={"front": "coat"})


def reflection_db(ghz):
    """Of a layer on a conductor: its input impedance is Z tanh(j k d), in units of free space."""
    k0 = 2 * np.pi * ghz * 1e9 / 299792458.0
    impedance = np.sqrt(MU / EPS) * np.tanh(1j * k0 * np.sqrt(EPS * MU) * MM * 1e-3)
    return 20 * np.log10(abs((impedance - 1) / (impedance + 1)))


figure, (levels, reduction) = plt.subplots(2, 1, figsize=(7, 6), sharex=True, layout="constrained")
for result, label in ((bare, "perfect conductor"), (coated, f"coated, {MM:g} mm")):
    levels.plot(ghz, result.sigma_dbsm.sel(channel="vv")[0], label=label)
change = (coated.sigma_dbsm - bare.sigma_dbsm).sel(channel="vv").values[0]
reduction.plot(ghz, change, label="raytube")
reduction.plot(ghz, reflection_db(ghz), "k--", linewidth=1, label="reflection of the layer")
levels.set(title=f"Plate of {SIDE:g} m, broadside", ylabel="σ (dBsm)", ylim=(-15, None))
reduction.set(xlabel="frequency (GHz)", ylabel="reduction (dB)", xlim=(ghz[0], ghz[-1]))
for ax in (levels, reduction):
    ax.grid(alpha=0.3)
    ax.legend()
figure.savefig("materials.png", dpi=150)

best = change.argmin()
off = abs(change - reflection_db(ghz)).max()
print(f"best {change[best]:.1f} dB at {ghz[best]:.2f} GHz; off the layer's reflection by {off:.1g} dB")
