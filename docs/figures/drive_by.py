#!/usr/bin/env python3
"""The range-Doppler maps of cases/drive_by, of all three looks beside one another.

    drive_by.py RCS.csv PICTURE.png
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import raytube as rt

result = rt.load(sys.argv[1])
figure, panels = plt.subplots(1, 3, figsize=(11.5, 4.2), sharey=True, layout="constrained")
for look, (ax, title) in enumerate(zip(panels, ("it comes, φ = −20°", "it is beside the radar, φ = −90°", "it goes, φ = −160°"))):
    sigma = result.doppler(look, window="hann", padding=4).sigma_dbsm.sel(channel="hh")
    drawn = sigma.plot(ax=ax, x="velocity_m_per_s", vmin=-50, vmax=0, add_colorbar=False, rasterized=True)
    ax.set(title=title, xlabel="velocity towards the radar (m/s)", ylabel="range (m)" if look == 0 else "")
figure.colorbar(drawn, ax=panels, label="σ, HH (dBsm)")
figure.suptitle("Car at 10 m/s, 77 GHz")
figure.savefig(sys.argv[2], dpi=110)
