"""A sweep on many processes, by Dask: sectors of azimuth are tasks, and the target goes to each worker once.

The workers are processes of this machine; of a cluster write Client("address of its scheduler") in their place.
"""
import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from dask.distributed import Client, LocalCluster

import raytube as rt

SIDE, GHZ = 0.15, 10.0  # metres


def boxes():
    """Two boxes of different heights that touch: neither a mirror plane nor a convex body."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float)
    faces = np.array([[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    high = corners * [SIDE, SIDE, 2 * SIDE]
    low = corners * [SIDE, 2 * SIDE, SIDE] + [SIDE, 0, 0]
    return rt.Target(np.vstack([high, low]), np.vstack([faces, faces + 8]), unit="m")


def amplitudes(target, azimuths):
    """S of one sector: on one thread, as there are as many workers as cores."""
    return rt.solve(target, GHZ, rt.monostatic(theta_deg=80, phi_deg=azimuths), edges={"order": 1}, threads=1).S


def main():
    target, azimuths = boxes(), np.arange(0.0, 360.0, 1.0)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        on_workers = client.scatter(target, broadcast=True)
        tasks = [client.submit(amplitudes, on_workers, sector) for sector in np.split(azimuths, 12)]
        S = xr.concat(client.gather(tasks), "look")
    sigma = 10 * np.log10(4 * np.pi * abs(S.isel(frequency=0)) ** 2)

    figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
    for channel in ("vv", "hh"):
        ax.plot(azimuths, sigma.sel(receive=channel[0], transmit=channel[1]), label=channel)
    ax.set(title=f"Two boxes at {GHZ:g} GHz, elevation 10°", xlabel="azimuth (degrees)", ylabel="σ (dBsm)", xlim=(0, 360))
    ax.grid(alpha=0.3)
    ax.legend()
    figure.savefig("dask_sweep.png", dpi=150)
    once = rt.solve(target, GHZ, rt.monostatic(theta_deg=80, phi_deg=azimuths), edges={"order": 1})
    print(f"{len(tasks)} sectors, {S.sizes['look']} looks; off one solve of all by {abs(S.values - once.S.values).max():.1e} m")


if __name__ == "__main__":
    main()
