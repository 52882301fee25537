"""Writes impedance_wedges.csv: the edge wave of wedges with impedance faces at normal incidence.

    /usr/bin/python3 tests/data/impedance_wedges.py > tests/data/impedance_wedges.csv

Maliuzhinets (1958), Sov. Phys. Dokl. 3, 752: u = (1/2 pi j) INT e^{jk rho cos a} s(a + f) da, f the angle from the middle of the
free space, 2 Phi = n pi wide,
    s(a) = Psi(a)/Psi(f') (1/n) cos(f'/n) / (sin(a/n) - sin(f'/n)),
whose edge wave is s(f - pi) - s(f + pi). psi by Gauss-Legendre quadrature of its integral, which converges for |Re z| < 2 Phi +
pi/2; from beyond 2 Phi by psi(z + 2 Phi) / psi(z - 2 Phi) = cot((z + pi/2)/2). The program uses neither.
"""
import numpy as np

x, w = np.polynomial.legendre.leggauss(40)
edges = np.linspace(0.0, 40.0, 161)
s = (edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2).ravel()
w = (np.diff(edges)[:, None] / 2 * w).ravel()


def psi(n, z):
    z = complex(z)
    z = -z if z.real < 0 else z
    phi = n * np.pi / 2
    if z.real > 2 * phi:
        return psi(n, z - 4 * phi) / np.tan((z - 2 * phi + np.pi / 2) / 2)
    low = np.exp(-(np.pi / 2 + 2 * phi) * s)  # 1 / (cosh sinh) = 4 low / ((1 + ..)(1 - ..))
    cosh = 0.5 * (np.exp(z * s - (np.pi / 2 + 2 * phi) * s) + np.exp(-z * s - (np.pi / 2 + 2 * phi) * s)) - low
    return np.exp(-0.5 * np.sum(w * 4 * cosh / (s * (1 + np.exp(-np.pi * s)) * (1 - np.exp(-4 * phi * s)))))


def edge_wave(n, field, z0, zn, source, observer):
    phi, right = n * np.pi / 2, np.pi / 2
    angle = lambda z: np.arcsin(complex(1 / z if field == "soft" else z))
    t0, tn = angle(z0), angle(zn)

    def faces(a):
        return (psi(n, a + phi + right - tn) * psi(n, a + phi - right + tn) * psi(n, a - phi - right + t0) * psi(n, a - phi + right - t0))

    f0, f = source - phi, observer - phi
    spectrum = lambda a: faces(a) / faces(f0) * np.cos(f0 / n) / n / (np.sin(a / n) - np.sin(f0 / n))
    return spectrum(f - np.pi) - spectrum(f + np.pi)


if __name__ == "__main__":
    print("n,field,re_z0,im_z0,re_zn,im_zn,source_deg,observer_deg,re_wave,im_wave")
    for n in (1.5, 1.75, 2.0):
        for field in ("soft", "hard"):
            for z0, zn in ((0.3 + 0.2j, 0.05 + 0.6j), (2.0 - 1.0j, 0.4), (0.02 + 0.01j, 1.0), (0.08 - 0.3j, 0.9 + 0.8j)):
                for source, observer in ((20.0, 33.0), (75.0, 140.0), (100.0, 100.0), (250.0, 40.0), (200.0, 255.0)):
                    wave = edge_wave(n, field, z0, zn, np.radians(source), np.radians(observer))
                    print(n, field, z0.real, np.imag(z0), np.real(zn), np.imag(zn), source, observer, "%.12g" % wave.real, "%.12g" % wave.imag, sep=",")
