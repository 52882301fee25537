"""A study of many targets on many processes, by mpi4py.futures: from which size on is a trihedral what geometrical optics says?

Each size is a task of one process with one thread. Alone it works off all of them; on a machine or a cluster:

    mpirun -n 8 python3 -m mpi4py.futures futures_study.py      # one gives the tasks, seven work
"""
import matplotlib.pyplot as plt
import numpy as np
from mpi4py import MPI
from mpi4py.futures import MPICommExecutor

import raytube as rt

GHZ = 3.0
WAVELENGTH = 0.299792458 / GHZ  # metres


def trihedral(leg):
    """Three right triangles on the planes of the axes, open towards (1, 1, 1)."""
    return rt.Target(leg * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), [[0, 1, 2], [0, 2, 3], [0, 3, 1]], unit="m")


def sigma_dbsm(leg):
    """On the axis, by physical optics of up to three bounces."""
    axis = rt.monostatic(theta_deg=np.degrees(np.arccos(3**-0.5)), phi_deg=45)
    return float(rt.solve(trihedral(leg), GHZ, axis, edges={"method": "none"}, threads=1).sigma_dbsm.sel(channel="vv").item())


def main():
    wavelengths = np.arange(3, 30.01, 0.125)
    with MPICommExecutor(MPI.COMM_WORLD) as executor:
        if executor is None:  # of ranks that work
            return
        sigma = np.array(list(executor.map(sigma_dbsm, wavelengths * WAVELENGTH, chunksize=4)))
    optics = 10 * np.log10(4 * np.pi * (wavelengths * WAVELENGTH) ** 4 / 3 / WAVELENGTH**2)
    figure, ax = plt.subplots(figsize=(7, 4), layout="constrained")
    ax.plot(wavelengths, sigma - optics)
    ax.set(title="Trihedral on its axis, one to three bounces", xlabel="leg (wavelengths)", ylabel="σ over 4π a⁴ / 3λ² (dB)", xlim=(3, 30))
    ax.grid(alpha=0.3)
    figure.savefig("futures_study.png", dpi=150)
    for legs in (5, 15, 30):
        print(f"leg of {legs} wavelengths: {(sigma - optics)[wavelengths == legs][0]:.2f} dB from geometrical optics")


if __name__ == "__main__":
    main()
