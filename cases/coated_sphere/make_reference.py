#!/usr/bin/env python3
"""Exact series of the coated sphere of this folder: writes reference.csv (needs the Python package mpmath).

    python3 cases/coated_sphere/make_reference.py

A. L. Aden, M. Kerker: Scattering of electromagnetic waves from two concentric spheres. J. Appl. Phys. 22, 1242 (1951), for a core that conducts
perfectly and e^{+j omega t}. The Riccati-Bessel functions themselves, upward from sines and cosines: products of growing and decaying waves in the lossy
coat cancel by up to e^{4 |Im m| k a}, 180 digits at 5 GHz, which is why there are 400."""
import os

from mpmath import mp, mpc, mpf

HERE = os.path.dirname(os.path.abspath(__file__))
C0 = mpf(299792458)
OUTER, THICKNESS = mpf(1), mpf("0.005")  # metres
EPS_R, MU_R = mpc(8, -2), mpc(1.5, -0.5)
LOOK = "37,71"  # any: it is a sphere
HEAD = """# provenance: exact series of a coated sphere (Aden & Kerker 1951), made by make_reference.py
# run: run case.toml
# table: rcs.csv
# compare: --tolerance-db 0.1
# tolerance: curvature changes what a face reflects by some 1/(2ka), 0.1 dB at 2 GHz; the wave that creeps round dies in the coat; the mesh is .002 dB off
"""
mp.dps = 400


def riccati(z, orders):
    """Values and slopes of psi_n = z j_n and eta_n = z y_n, n = 0 ... orders."""
    psi, eta = [mp.sin(z), mp.sin(z) / z - mp.cos(z)], [-mp.cos(z), -mp.cos(z) / z - mp.sin(z)]
    for values in (psi, eta):
        for n in range(1, orders):
            values.append((2 * n + 1) / z * values[n] - values[n - 1])
    slope = lambda values, first: [first] + [values[n - 1] - n / z * values[n] for n in range(1, orders + 1)]
    return psi, slope(psi, mp.cos(z)), eta, slope(eta, mp.sin(z))


def amplitude(core, outer, eps, mu, k):
    """Monostatic S; the phase is that of the centre."""
    index, impedance = mp.sqrt(eps * mu), mp.sqrt(mu / eps)
    orders = int(k * outer + 4 * mp.cbrt(k * outer) + 30)
    psi, psi_slope, eta, eta_slope = riccati(k * outer, orders)
    u, du, v, dv = riccati(index * k * outer, orders)
    at_core = riccati(index * k * core, orders)
    total = 0
    for n in range(1, orders + 1):
        xi, xi_slope = psi[n] - 1j * eta[n], psi_slope[n] - 1j * eta_slope[n]

        def coefficient(on_core, other_on_core, ratio):
            inside, slope = u[n] * other_on_core - on_core * v[n], du[n] * other_on_core - on_core * dv[n]
            return (psi_slope[n] * inside - ratio * slope * psi[n]) / (xi_slope * inside - ratio * slope * xi)

        electric = coefficient(at_core[1][n], at_core[3][n], impedance)
        magnetic = coefficient(at_core[0][n], at_core[2][n], 1 / impedance)
        total += (-1) ** n * (n + mpf(1) / 2) * (electric - magnetic)
    return 1j * total / k


def main():
    rows = []
    for step in range(21):
        hertz = 2000000000 + step * 150000000
        s = amplitude(OUTER - THICKNESS, OUTER, EPS_R, MU_R, 2 * mp.pi * hertz / C0)
        text = f"{mp.nstr(s.real, 12)},{mp.nstr(s.imag, 12)}"
        rows.append(f"{hertz},{LOOK},{LOOK},{text},0,0,0,0,{text}\n")
    with open(os.path.join(HERE, "reference.csv"), "w") as f:
        f.write(HEAD)
        f.write("freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,re_vv,im_vv,re_vh,im_vh,re_hv,im_hv,re_hh,im_hh\n")
        f.writelines(rows)


if __name__ == "__main__":
    main()
