#!/usr/bin/env python3
"""Makes sections.csv, scattering amplitudes P of perfectly conducting cylinders in two dimensions, with numpy:

    python3 tests/data/sections.py > tests/data/sections.csv
    python3 tests/data/sections.py check                                  # the figures below

Nystrom's method of Kress (1991; Boundary Integral Eqns 1990) with nodes graded towards corners. Soft (E along the axis): combined field
equation; hard (H along it): magnetic field equation, and u = 0 at points inside against resonances (least squares).

Conventions: e^{+jwt}, wavelength 1, u_s = P e^{-jkr} / sqrt(r), look at phi from the x axis, origin as the curves have it, monostatic.

Checked: circles against the series 1e-14. Half as many nodes more change lenses and airfoils by 3e-4 (soft) and 2e-5 (hard) of the peak
at most, at any look by 0.03 dB.
"""
import sys
import numpy as np

K = 2 * np.pi
EULER = 0.5772156649015329


def hankel(x):
    """H0 and H1 of the first kind: power series below 8, above it the trapezoidal rule for K0(-jx), K1(-jx) on the steepest path."""
    low, z = np.minimum(x, 8.0), -1j * np.maximum(x, 8.0)
    v = (np.arange(16) + 0.5) * 0.4
    h0, h1 = np.zeros_like(z), np.zeros_like(z)
    for t in v:
        root = np.sqrt(2 + t * t / z)
        h0 += 0.8 * np.exp(-t * t) / root
        h1 += 0.8 * np.exp(-t * t) * t * t * root
    wave = np.exp(-z) / np.sqrt(z)
    h0, h1 = -2j / np.pi * wave * h0, -2 / np.pi * wave * h1
    q, term = low * low / 4, np.ones_like(low)
    j0, y0, j1, y1 = term.copy(), 0 * low, term.copy(), term.copy()
    harmonic = 0.0
    for m in range(1, 40):
        term = -term * q / m**2
        harmonic += 1 / m
        j0 += term
        y0 -= harmonic * term
        j1 += term / (m + 1)
        y1 += (2 * harmonic + 1 / (m + 1)) * term / (m + 1)
    j1, y1 = j1 * low / 2, y1 * low / 2
    log = np.log(low / 2) + EULER
    y0, y1 = 2 / np.pi * (log * j0 + y0), 2 / np.pi * log * j1 - 2 / (np.pi * low) - y1 / np.pi
    return np.where(x < 8, j0 + 1j * y0, h0), np.where(x < 8, j1 + 1j * y1, h1)


def arc(centre, radius, start, end):
    """Point, first and second derivative of a smooth piece of the outline, at u in 0..1."""
    w = end - start

    def curve(u):
        e = radius * np.stack([np.cos(start + w * u), np.sin(start + w * u)], -1)
        return centre + e, w * e[:, ::-1] * [-1, 1], -w * w * e
    return curve


def line(p, q):
    p, q = np.array(p, float), np.array(q, float)
    return lambda u: (p + (q - p) * u[:, None], (q - p) + 0 * u[:, None], 0 * (q - p) * u[:, None])


def bow(chord, rise):
    """Arc over the x axis from +chord/2 to -chord/2."""
    radius = (chord**2 / 4 + rise**2) / (2 * rise)
    half = np.arcsin(chord / 2 / radius)
    return radius, half, np.array([0, rise - radius])


def lens(chord, thickness):
    radius, half, centre = bow(chord, thickness * chord / 2)
    return [arc(c, radius, a - half, a + half) for c, a in ((centre, np.pi / 2), (-centre, -np.pi / 2))]


def half_lens(chord, thickness):
    radius, half, centre = bow(chord, thickness * chord)
    return [arc(centre, radius, np.pi / 2 - half, np.pi / 2 + half), line((-chord / 2, 0), (chord / 2, 0))]


def airfoil(chord, thickness):
    """Round nose at -chord/2, sharp tail: x = chord (v^2 - 1/2), y ~ v (1 - v^2)."""
    height = thickness * chord / 2 / 0.3849001794597505

    def curve(u):
        v = 1 - 2 * u
        return (np.stack([chord * (v * v - 0.5), height * v * (1 - v * v)], -1),
                -2 * np.stack([2 * chord * v, height * (1 - 3 * v * v)], -1),
                4 * np.stack([2 * chord + 0 * v, -6 * height * v], -1))
    return [curve]


def circle(ka):
    return [arc(np.zeros(2), ka / K, 0, 2 * np.pi)]


def graded(t, p=4):
    """Kress's sigmoid on 0..1 and its derivative."""
    def half(x):
        c = 1 - 2 * x
        v = (1 / p - 0.5) * c**3 - c / p + 0.5
        return v**p, p * v ** (p - 1) * (-6 * (1 / p - 0.5) * c**2 + 2 / p)
    (a, da), (b, db) = half(t), half(1 - t)
    return a / (a + b), (da * b + a * db) / (a + b) ** 2


def amplitudes(pieces, looks, count, corners=True):
    """P, soft and hard, at the angles `looks`; `count` nodes on each piece."""
    n = count * len(pieces)
    u = (np.arange(count) + 0.5) / count
    w, dw = graded(u) if corners else (u, np.ones(count))
    x, d, dd = (np.concatenate(parts) for parts in zip(*(piece(w) for piece in pieces)))
    speed = np.hypot(*d.T)
    curvature = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / speed**3
    normal = np.stack([d[:, 1], -d[:, 0]], -1) / speed[:, None]
    jacobian = speed * np.tile(dw, len(pieces)) * len(pieces) / (2 * np.pi)
    weight = 2 * np.pi / n * jacobian

    # Kernels split as A log(4 sin^2) + B; the weights of the logarithm are exact for trigonometric polynomials.
    t = 2 * np.pi * np.arange(n) / n
    m = np.arange(1, n // 2)
    row = -4 * np.pi / n * (np.cos(np.outer(t, m)) @ (1 / m)) - 4 * np.pi / n**2 * np.cos(n // 2 * t)
    index = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    log = np.log(4 * np.sin(t / 2) ** 2 + (t == 0))[index]
    between = x[:, None] - x
    r = np.linalg.norm(between, axis=-1) + np.eye(n)
    h0, h1 = hankel(K * r)

    def operator(kernel, with_log, diagonal, diagonal_log):
        smooth = kernel - with_log * log
        np.fill_diagonal(smooth, diagonal)
        np.fill_diagonal(with_log, diagonal_log)
        return (row[index] * with_log + 2 * np.pi / n * smooth) * jacobian

    def double_layer(cosine):
        return operator(0.5j * K * h1 / r * cosine, -K / (2 * np.pi) * h1.real / r * cosine, -curvature / (2 * np.pi), 0)

    along_source, along_point = (np.einsum(s, between, normal) for s in ("ijk,jk->ij", "ijk,ik->ij"))
    single = operator(0.5j * h0, -h0.real / (2 * np.pi), 0.5j - EULER / np.pi - np.log(K * jacobian / 2) / np.pi, -1 / (2 * np.pi))

    directions = np.stack([np.cos(looks), np.sin(looks)])
    incident = np.exp(-1j * K * (x @ directions))  # e^{-jwt} in here; directions are those to the source
    slope = -1j * K * (normal @ directions)
    soft = np.eye(n) + double_layer(-along_point) - 1j * K * single
    psi = np.linalg.solve(soft, 2 * (slope - 1j * K) * incident)

    golden = np.arange(n) * (np.sqrt(5) - 1) / 2 % 1
    share = 0.2 + 0.6 * (np.arange(n) * np.sqrt(2) % 1)[:, None]
    inside = share * x + (1 - share) * x[(golden * n).astype(int)]
    depth = np.linalg.norm(inside[:, None] - x, axis=-1)
    inside = inside[depth.min(1) > np.maximum(5 * weight[depth.argmin(1)], 0.02)]
    to_inside = inside[:, None] - x
    depth = np.linalg.norm(to_inside, axis=-1)
    rows = -0.5j * K * hankel(K * depth)[1] / depth * np.einsum("ijk,jk->ij", to_inside, normal) * weight
    scale = np.concatenate([np.sqrt(weight / weight.mean()), np.ones(len(inside))])[:, None]
    hard = np.vstack([np.eye(n) - double_layer(along_source), rows])
    right = 2 * np.vstack([incident, np.exp(-1j * K * (inside @ directions))])
    u = np.linalg.lstsq(hard * scale, right * scale, rcond=1e-13)[0]

    def far_field(current):
        return (-0.25j * np.sqrt(2 / (np.pi * K)) * np.exp(0.25j * np.pi) *
                (current.conj() * weight[:, None] * incident.conj()).sum(0))
    return far_field(-psi), far_field(u * slope)


def series(ka, angle):
    """P of a circle, soft and hard, at `angle` from the direction of incidence."""
    top = int(ka + 6 * ka**0.34 + 15)
    j = np.zeros(top + 40)
    j[-2] = 1e-200
    for m in range(len(j) - 2, 0, -1):
        j[m - 1] = 2 * m / ka * j[m] - j[m + 1]
    j /= j[0] + 2 * j[2::2].sum()
    y = [v.imag for v in (hankel(np.array([ka]))[i][0] for i in (0, 1))]
    for m in range(1, top):
        y.append(2 * m / ka * y[m] - y[m - 1])
    j, h = j[: top + 1], j[: top + 1] - 1j * np.array(y)
    m = np.arange(top)
    dj, dh = (m / ka * f[:-1] - f[1:] for f in (j, h))
    waves = np.where(m == 0, 1, 2) * np.cos(m * angle)
    factor = -np.sqrt(2 / (np.pi * K)) * np.exp(0.25j * np.pi)
    return factor * (waves * j[:-1] / h[:-1]).sum(), factor * (waves * dj / dh).sum()


# Looks: what symmetry leaves. Nodes on each piece.
SECTIONS = {
    "lens_0.1": (lens(5, 0.1), np.arange(0.5, 90), 320), "lens_0.2": (lens(5, 0.2), np.arange(0.5, 90), 320),
    "lens_0.4": (lens(5, 0.4), np.arange(0.5, 90), 320), "half_lens_0.1": (half_lens(5, 0.1), np.arange(-89.5, 90), 320),
    "airfoil_0.15": (airfoil(5, 0.15), np.arange(0.5, 180), 560), "airfoil_0.35": (airfoil(5, 0.35), np.arange(0.5, 180), 560),
    "circle_10": (circle(10), np.array([0.0]), 160), "circle_20": (circle(20), np.array([0.0]), 240),
}


def solved(name, more=1.0):
    pieces, looks, count = SECTIONS[name]
    return amplitudes(pieces, np.radians(looks), int(count * more) // 2 * 2, "circle" not in name)


def check():
    for ka in (10, 20):
        for p, s in zip(solved(f"circle_{ka}"), series(ka, np.pi)):
            print(f"circle of ka {ka} against the series: {abs(p[0] / s - 1):.1e}")
    for name in SECTIONS:
        for p, q, kind in zip(solved(name), solved(name, 1.5), ("soft", "hard")):
            print(f"{name}, {kind}: {abs(p - q).max() / abs(q).max():.1e} of the peak, half as many nodes more; "
                  f"{abs(20 * np.log10(abs(p / q))).max():.1e} dB at most")


if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        check()
        sys.exit()
    print("# made by sections.py; wavelength 1")
    print("section,phi_deg,re_soft,im_soft,re_hard,im_hard")
    for name in SECTIONS:
        for phi, *p in zip(SECTIONS[name][1], *solved(name)):
            print(f"{name},{phi:g}," + ",".join(f"{v:.7g}" for s in p for v in (s.real, s.imag)))
