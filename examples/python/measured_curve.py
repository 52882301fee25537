"""A computed curve beside one from elsewhere: the measures that people quote, and the difference.

The curve is that of a dihedral of three wavelengths by the method of moments (tests/data/mom). A table
from a chamber is read in the same way; `free_scale=True` fits one complex factor, the calibration.
"""
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas

import raytube as rt

DATA = Path(__file__).resolve().parents[2] / "tests/data/mom"

measured = pandas.read_csv(DATA / "dihedral3.csv")
target = rt.Target.load(DATA / "dihedral3.stl", unit="m")
result = rt.solve(target, measured.freq_hz[0] / 1e9, rt.looks(measured.theta_deg, measured.phi_deg))
comparison = rt.compare(result, DATA / "dihedral3.csv", only={"phi_deg": (-45, 45)})

figure, (levels, differences) = plt.subplots(2, 1, figsize=(7, 6), height_ratios=(2, 1), sharex=True,
                                             layout="constrained")
for channel, colour in (("vv", "C0"), ("hh", "C1")):
    S = measured[f"re_{channel}"] + 1j * measured[f"im_{channel}"]
    reference = 10 * np.log10(4 * np.pi * abs(S) ** 2)
    sigma = result.sigma_dbsm.sel(channel=channel).values[:, 0]
    levels.plot(measured.phi_deg, reference, "k:", label="method of moments" if channel == "vv" else None)
    levels.plot(measured.phi_deg, sigma, colour, label=f"raytube, {channel.upper()}")
    rms = comparison.channels[channel]["rms_db"]
    differences.plot(measured.phi_deg, sigma - reference, colour,
                     label=f"{channel.upper()}: rms {rms:.2f} dB")
levels.set(title="Dihedral of three wavelengths, 10 GHz", ylabel="σ (dBsm)")
differences.axvspan(-45, 45, color="grey", alpha=0.1, linewidth=0)
differences.set(xlabel="azimuth φ (degrees)", ylabel="difference (dB)", xlim=(-60, 60))
for ax in (levels, differences):
    ax.grid(alpha=0.3)
    ax.legend(loc="lower center" if ax is levels else "upper center", fontsize="small")
figure.savefig("measured_curve.png", dpi=150)

print(comparison)
for channel in ("vv", "hh"):
    measures = comparison.channels[channel]
    print(f"{channel}: rms {measures['rms_db']:.2f} dB, correlation {measures['correlation']:.4f}")
