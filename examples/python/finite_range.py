"""A radar at a finite range: nearer than 2 D²/λ the main lobe falls and the nulls fill."""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

SIDE, GHZ = 0.3, 10.0
WAVELENGTH = 299792458.0 / (GHZ * 1e9)
FAR = 2 * SIDE**2 / WAVELENGTH
half = SIDE / 2

corners = [[0, -half, -half], [0, half, -half], [0, half, half], [0, -half, half]]
plate = rt.Target(corners, [[0, 1, 2, 3]], unit="m")  # faces +x
azimuth = np.arange(-20.0, 20.01, 0.1)
cut = rt.monostatic(theta_deg=90, phi_deg=azimuth)


def sigma_at(range_m):
    """Apparent RCS [dBsm]: what a scatterer at the origin would need to return as much."""
    radar = None if np.isinf(range_m) else {"range_m": range_m}
    result = rt.solve(plate, GHZ, cut, radar=radar, edges={"method": "none"})
    return result.sigma_dbsm.sel(channel="vv").values[:, 0]


def fresnel_loss_db(range_m):
    """On the axis: the phase error there and back, k y²/R, averaged along each side."""
    y = (np.arange(2000) + 0.5) / 2000 * half
    return -40 * np.log10(abs(np.mean(np.exp(-2j * np.pi / WAVELENGTH * y**2 / range_m))))


ranges = [np.inf, 2 * FAR, FAR, FAR / 2]
sigma = {range_m: sigma_at(range_m) for range_m in ranges}
peak = sigma[np.inf].max()

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
for range_m in ranges:
    label = "infinite" if np.isinf(range_m) else f"{range_m:.0f} m = {range_m / FAR:g} · 2D²/λ"
    ax.plot(azimuth, sigma[range_m], label=label)
ax.set(title=f"Plate of {SIDE:g} m at {GHZ:g} GHz", xlim=(-20, 20), ylim=(peak - 45, peak + 3))
ax.set(xlabel="azimuth φ (degrees)", ylabel="apparent σ, VV (dBsm)")
ax.grid(alpha=0.3)
ax.legend(title="range", fontsize="small")
figure.savefig("finite_range.png", dpi=150)

for range_m in ranges[1:]:
    loss, fresnel = peak - sigma[range_m][azimuth.size // 2], fresnel_loss_db(range_m)
    print(f"at {range_m:.0f} m the peak loses {loss:.2f} dB, Fresnel integral {fresnel:.2f} dB")
