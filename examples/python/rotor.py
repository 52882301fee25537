"""Micro-Doppler: the spectrogram of a rotor with two blades, and what kinematics say about it."""
import matplotlib.pyplot as plt
import numpy as np

import raytube as rt

ROOT, TIP, CHORD, PITCH = 0.25, 1.0, 0.06, np.radians(30)  # blades [m], how far they are pitched
REV_PER_MIN, THETA_DEG, GHZ = 300.0, 60.0, 10.0


def blade(sign):
    """A plate along +x or -x that turns about z towards its face."""
    chord = CHORD / 2 * np.array([0, -sign * np.sin(PITCH), np.cos(PITCH)])
    return np.array([[sign * r, 0, 0] + side * chord for r, side in ((ROOT, -1), (TIP, -1), (TIP, 1), (ROOT, 1))])


rotor = rt.Target(np.vstack([blade(1), blade(-1)]), [[0, 1, 2, 3], [4, 5, 6, 7]], unit="m")
motion = rt.Motion(interval=2e-4, count=1000).body("rotor", axis=(0, 0, 1), rev_per_min=REV_PER_MIN)
result = rt.solve(rotor, GHZ, rt.monostatic(THETA_DEG, 0), motion=motion)
spectrogram = result.spectrogram(length=24, overlap=0.9)

figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
spectrogram.sigma_dbsm.sel(channel="hh").plot(ax=ax, x="time_s", vmin=-50, vmax=0, cbar_kwargs={"label": "σ, HH (dBsm)"})
turn = 2 * np.pi * REV_PER_MIN / 60 * spectrogram.time_s
fastest = 2 * np.pi * REV_PER_MIN / 60 * TIP * np.sin(np.radians(THETA_DEG))
for sign in (-1, 1):
    ax.plot(spectrogram.time_s, sign * fastest * np.sin(turn), "w:", linewidth=1)
ax.set(title="Two blades, 300 rev/min, 10 GHz; dotted: the tips", xlabel="time (s)", ylabel="velocity towards the radar (m/s)")
figure.savefig("rotor.png", dpi=150)

flashes = spectrogram.sigma_dbsm.sel(channel="hh").max("velocity_m_per_s")
first = flashes.time_s[flashes.sel(time_s=slice(0, 0.1)).argmax().item()].item()
print(f"first flash at {first:.3f} s, a quarter of a turn is {15 / REV_PER_MIN:.3f} s")
print(f"tips at up to {fastest:.1f} m/s, {2 * fastest * GHZ / 0.299792458:.0f} Hz")
