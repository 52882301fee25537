#!/usr/bin/env python3
"""Makes tips.csv, scattering amplitudes of conducting ogives and cone-spheres, with numpy:

    python3 tests/data/tips.py > tests/data/tips.csv
    python3 tests/data/tips.py check                     # the figures below

The method and the conventions of spheroids.py. Sources lie below the surface, at a depth that shrinks with the radius towards a tip, where
they crowd in steps of it (lightning: Gopal and Trefethen, SIAM J. Numer. Anal. 57, 2074, 2019, in two dimensions); so do the points.

Checked: spheres of ka 5, 10 and 20 against Mie's series, 3e-4 dB. More sources, ka 3 and 6: 0.1 dB at ogives, 0.15 at the cone-sphere of 30
degrees, 0.7 in a minimum of that of 15; the tangential E left over is at most 1.4e-2 of the incident one (rms).
"""
import sys
import numpy as np
from spheroids import K, Spheroid, axes, db, field, in_space, mie


def ogive(half_angle):
    """Meridian by arc length, largest radius 1: length, point and normal at s, the distances of its tips and of its joints."""
    r = 1 / (1 - np.cos(half_angle))
    turn = lambda s: s / r - half_angle
    point = lambda s: np.stack([r * (np.cos(turn(s)) - np.cos(half_angle)), -r * np.sin(turn(s))], -1)
    normal = lambda s: np.stack([np.cos(turn(s)), -np.sin(turn(s))], -1)
    return 2 * r * half_angle, point, normal, [0, 2 * r * half_angle], []


def cone_sphere(half_angle):
    """A cone from its tip (z > 0) to the sphere of radius 1 about the origin that it touches."""
    side = 1 / np.tan(half_angle)
    turn = lambda s: np.clip(s - side, 0, None)
    cone = lambda s: np.clip(s - side, None, 0)[..., None] * np.array([np.sin(half_angle), -np.cos(half_angle)])
    normal = lambda s: np.stack([np.cos(half_angle - turn(s)), np.sin(half_angle - turn(s))], -1)
    return side + np.pi / 2 + half_angle, lambda s: normal(s) + cone(s), normal, [0], [side]


def sphere():
    return np.pi, lambda s: np.stack([np.sin(s), np.cos(s)], -1), lambda s: np.stack([np.sin(s), np.cos(s)], -1), [], []


class Tipped(Spheroid):
    """A body of revolution of largest radius a."""

    def __init__(self, meridian, a, density=1.3, depth=0.25):
        length, point, normal, tips, joints = meridian
        length *= a
        at = lambda f, s: f(s / a)

        def sunk(s):
            d = np.minimum(depth, 0.3 * a + 0 * s)
            for tip in tips:
                d = np.minimum(d, np.where(abs(s - tip * a) < 1.5 * a, 0.4 * a * at(point, s)[..., 0], d))
            for joint in joints:
                d = np.minimum(d, 0.02 + 0.5 * abs(s - joint * a))
            return d

        nodes = self.nodes(sunk, length, density, tips)
        checks = np.sort(np.concatenate([nodes[:-1] + (i + 0.5) / 2 * np.diff(nodes) for i in range(2)]))
        middle = (nodes[1:] + nodes[:-1]) / 2
        self.count = len(middle)
        outer, n = a * at(point, checks), at(normal, checks)
        inner, n_in = a * at(point, middle) - sunk(middle)[:, None] * at(normal, middle), at(normal, middle)
        self.weight = np.sqrt(np.repeat(np.diff(nodes), 2) / 2 * outer[:, 0])
        self.weight /= np.sqrt((self.weight**2).mean())
        gap = (1 - inner[:, 0] / (a * at(point, middle)[:, 0])).min()
        self.modes = int(K * a) + 12
        slots = max(2 * self.modes + 2, int(13 / gap))
        angle = 2 * np.pi * np.arange(slots) / slots
        phi = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], -1)
        along = lambda v: np.stack([v[:, 1], -v[:, 0]], -1)
        self.points = in_space(outer, angle)
        t = in_space(along(n), angle)
        self.tangents = np.stack([t, np.broadcast_to(phi, t.shape)])
        self.positions = in_space(inner, angle)
        t = in_space(along(n_in), angle)
        self.electric = np.stack([t, np.broadcast_to(phi, t.shape)])
        self.magnetic = np.cross(in_space(n_in, angle), self.electric)
        blocks = np.empty((self.modes + 1, 2, len(checks), 2, self.count), complex)
        for q in range(len(checks)):
            e = field(self.points[q, 0] - self.positions, self.electric, self.magnetic)
            for c in range(2):
                blocks[:, c, q] = np.moveaxis(self.in_modes(e @ self.tangents[c, q, 0]), -1, 0) * self.weight[q]
        self.matrices = blocks.reshape(self.modes + 1, 2 * len(checks), 2 * self.count)

    @staticmethod
    def nodes(sunk, length, density, tips):
        """Ends of intervals as long as the depth over the density, from 0.0005 wavelengths beside a tip on."""
        found = [5e-4 if tips else 0.0]
        end = length - (5e-4 if len(tips) > 1 else 0.0)
        while found[-1] < end:
            ahead = 0.5 * sunk(found[-1]) / density
            found.append(found[-1] + min(sunk(found[-1] + ahead), sunk(found[-1] + 2 * ahead)) / density)
        found = np.array(found)
        return found * (end / found[-1]) if not tips else found[0] + (found - found[0]) * ((end - found[0]) / (found[-1] - found[0]))

    def amplitudes(self, thetas, receive=None):
        waves, weights = [], []
        for t, u in zip(thetas, thetas if receive is None else receive):
            (s, *es), (r, *er) = axes(t), axes(u)
            for e, f in zip(es, er):
                incident = (self.tangents @ e) * np.exp(1j * K * (self.points @ s)) * self.weight[:, None]
                waves.append(self.in_modes(incident.conj()).conj().reshape(-1, self.modes + 1) / incident.shape[-1])
                far = (self.electric @ f - self.magnetic @ np.cross(f, r)) * np.exp(1j * K * (self.positions @ r))
                weights.append(self.in_modes(far).reshape(-1, self.modes + 1))
        return self.solve(np.stack(waves, -1), np.stack(weights, -1))


BODIES = {"ogive 22.6": ogive(np.radians(22.6)), "ogive 40": ogive(np.radians(40)),
          "cone-sphere 15": cone_sphere(np.radians(15)), "cone-sphere 30": cone_sphere(np.radians(30))}
KA = (3, 6, 12, 20)
THETAS = np.arange(0, 181, 5)


def check():
    for x in (5, 10, 20):
        found, left = Tipped(sphere(), x / K).amplitudes(np.radians([0, 37, 90]))
        print(f"sphere, ka {x}: {db(K * found, mie(x)):.1e} dB from Mie's series; {left:.1e} of E left", flush=True)
    for name, body in BODIES.items():
        for ka in (3, 6):
            coarse, left = Tipped(body, ka / K).amplitudes(np.radians(THETAS))
            fine, less = Tipped(body, ka / K, 1.7).amplitudes(np.radians(THETAS))
            print(f"{name}, ka {ka}: {db(coarse, fine):.1e} dB from finer; {left:.1e}, {less:.1e} of E left", flush=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["check"]:
        check()
        sys.exit()
    print("# made by tips.py; wavelength 1, ka: largest radius")
    print("body,ka,theta_deg,re_vv,im_vv,re_hh,im_hh")
    for ka in KA:
        for name, body in BODIES.items():
            found, left = Tipped(body, ka / K).amplitudes(np.radians(THETAS))
            print(name, ka, left, file=sys.stderr, flush=True)
            for theta, s in zip(THETAS, found):
                print(f"{name},{ka},{theta}," + ",".join(f"{v:.5g}" for p in s for v in (p.real, p.imag)), flush=True)
