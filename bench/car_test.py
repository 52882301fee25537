#!/usr/bin/env python3
"""The car of bench/car.py is a set of closed bodies that face outward, and its shell is smooth but at the wheel arches."""
import collections
import math
import sys
import unittest

sys.dont_write_bytecode = True
import car

BODIES = 8


def minus(a, b):
    return [s - t for s, t in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(s * t for s, t in zip(a, b))


def normal(corners):
    across = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
    return [t / math.hypot(*across) for t in across]


def sides(triangle):
    return zip(triangle, triangle[1:] + triangle[:1])


class Car(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = car.car(car.FACETS)
        cls.corners = [[cls.mesh.points[i] for i in triangle] for triangle in cls.mesh.triangles]
        cls.beside = {side: i for i, triangle in enumerate(cls.mesh.triangles) for side in sides(triangle)}

    def bodies(self):
        """Indices of the triangles of each body, by walking over shared sides."""
        left = set(range(len(self.mesh.triangles)))
        while left:
            body, waiting = [], [left.pop()]
            while waiting:
                body.append(waiting.pop())
                near = {self.beside[b, a] for a, b in sides(self.mesh.triangles[body[-1]])} & left
                left -= near
                waiting += near
            yield body

    def test_every_side_is_shared_by_two_triangles_that_face_alike(self):
        uses = collections.Counter(side for triangle in self.mesh.triangles for side in sides(triangle))
        self.assertEqual(set(uses.values()), {1})
        self.assertEqual(set(uses), {(b, a) for a, b in uses})

    def test_no_two_points_coincide(self):
        self.assertEqual(len(set(self.mesh.points)), len(self.mesh.points))

    def test_every_body_faces_outward(self):
        volumes = [sum(dot(a, cross(b, c)) for a, b, c in (self.corners[i] for i in body)) / 6.0 for body in self.bodies()]
        self.assertEqual(len(volumes), BODIES)
        self.assertGreater(min(volumes), 0.0)

    def test_the_shell_is_smooth_but_at_the_wheel_arches(self):
        shell = max(self.bodies(), key=len)
        normals = {i: normal(self.corners[i]) for i in shell}
        for i in shell:
            for a, b in sides(self.mesh.triangles[i]):
                x, _, z = self.mesh.points[a]
                if min(math.hypot(x - axle, z - car.WHEEL_RADIUS) for axle in car.AXLES) > 0.65:  # recess and a facet beside it
                    self.assertGreater(dot(normals[i], normals[self.beside[b, a]]), math.cos(math.radians(15.0)))  # of a wedge

    def test_trim_is_blocks_outside_the_shell(self):
        trimmed = car.car(car.FACETS, 50)
        added = trimmed.triangles[len(self.mesh.triangles):]
        self.assertEqual(len(added), 50 * 48)
        self.assertEqual(trimmed.triangles[:len(self.mesh.triangles)], self.mesh.triangles)
        blocks = collections.Counter(tuple(round(t, 3) for t in trimmed.points[i]) for triangle in added for i in triangle)
        self.assertEqual(len(blocks), 50 * 26)  # no two coincide

    def test_number_of_facets_is_about_the_one_asked_for(self):
        for facets in (5000, 10000):
            # Cuts are rounded to even numbers, 16 at the least: by 6 % at most in each of two directions.
            self.assertAlmostEqual(len(car.car(facets).triangles) / facets, 1.0, delta=0.13)


unittest.main()
