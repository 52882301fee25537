#!/usr/bin/env python3
"""bench/run --quick runs, its report has every section, and the numbers in it that are no times are what theory says.

    smoke_test.py BUILD_FOLDER OUTPUT_FOLDER"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from report_numbers import RANDOM, body_named, curve, exponent, growths

BENCH = pathlib.Path(__file__).resolve().parent
BUILD, OUTPUT = (pathlib.Path(folder).resolve() for folder in sys.argv[1:3])
SECTIONS = ["Asked and measured", "Error against rays and time", "Uniform mode against bare Embree", "Growth",
            "Dihedral of 150 mm, 94 GHz, four looks", "Whole jobs", "Peak memory", "Vehicles"]


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTPUT, ignore_errors=True)
        OUTPUT.mkdir(parents=True)
        subprocess.run([BENCH / "run", "--quick", "--build", BUILD, "-o", OUTPUT], check=True, stdout=subprocess.DEVNULL)
        cls.text = (OUTPUT / "report.md").read_text()
        cls.data = json.loads((OUTPUT / "report.json").read_text())

    def points(self, name, method):
        return body_named(self.data, name)["methods"][method]

    def test_every_section_is_there(self):
        self.assertEqual([line[3:] for line in self.text.splitlines() if line.startswith("## ")], SECTIONS)

    @unittest.skipUnless(shutil.which("gnuplot"), "pictures need gnuplot")
    def test_every_picture_shown_was_drawn(self):
        for name in ("error_rays", "error_time", "growth"):
            self.assertIn(f"(plots/{name}.png)", self.text)
            self.assertTrue((OUTPUT / "plots" / f"{name}.png").read_bytes().startswith(b"\x89PNG"))

    def test_adaptive_tubes_are_exact_on_flat_faces(self):
        for name in ("plate", "dihedral", "trihedral"):
            for point in self.points(name, "adaptive"):
                self.assertLess(point["relative_error"], 1e-12)  # phases of some 100 rad, rounded

    def test_uniform_grid_converges(self):
        for name in ("plate", "dihedral", "trihedral", "sphere", "cylinder", "vehicle"):
            coarse, *_, fine = self.points(name, "uniform")
            self.assertLess(fine["relative_error"], coarse["relative_error"] / 2)  # order 1 at least would be a quarter

    def test_random_rays_obey_their_law(self):
        for name in ("plate", "dihedral", "trihedral", "sphere", "cylinder", "vehicle"):
            coarse, _, fine = self.points(name, RANDOM)
            fall = coarse["relative_error"] / fine["relative_error"]
            law = math.sqrt(fine["samples"] / coarse["samples"])
            # 12 to 36 draws in each error: 30 % either way, and some more for two of them; a bias would end the fall.
            self.assertTrue(law / 2.5 < fall < law * 2.5, f"{name}: {fall} where the law says {law}")

    def test_rays_against_frequency(self):
        (growth,) = growths(self.data, "GHz")
        self.assertAlmostEqual(exponent(curve(growth, "uniform", "rays")), 2.0, delta=0.05)  # whole cells at the lowest frequency
        self.assertEqual(len({rays for _, rays in curve(growth, "adaptive", "rays")}), 1)

    def test_bare_embree_shoots_the_solvers_rays(self):
        for row in self.data["throughput"]:
            self.assertEqual(row["rays"], row["bare_rays"])


unittest.main(argv=sys.argv[:1])
