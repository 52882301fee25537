#!/usr/bin/env python3
"""cases/papers/run: the page of the two experiments of rays, and what becomes of it when something goes wrong.

    papers_test.py PROGRAM
"""
import csv
import html
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
RUN = CASES / "papers" / "run"
PROGRAM = "build/raytube"  # the last word of the command line


def run(*words):
    return subprocess.run([sys.executable, RUN, *words], capture_output=True, text=True)


def published():
    with open(CASES / "papers" / "published.csv") as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def hits_of(source):
    return [r["value"] for r in published() if (r["quantity"], r["source"]) == ("hits", source)]


def tables(page):
    """{id: rows of cells, without the head}"""
    found = re.findall(r'<table id="([^"]*)">.*?<tbody>(.*?)</tbody>', page, re.DOTALL)
    return {name: [[html.unescape(c) for c in re.findall(r"<td>(.*?)</td>", row)] for row in re.findall(r"<tr>.*?</tr>", body)]
            for name, body in found}


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name) / "out"
        cls.done = run("--only", "slits,box", "-o", cls.out, PROGRAM)
        cls.page = (cls.out / "index.html").read_text() if cls.done.returncode == 0 else ""
        cls.tables = tables(cls.page)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_has_the_parts_that_were_asked_for_and_no_others(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(set(re.findall(r'<section id="([^"]*)"', self.page)), {"slits", "box"})
        self.assertEqual({name: len(rows) for name, rows in self.tables.items()},
                         {"slits-hits": 24, "slits-order": 1, "slits-seconds": 6, "slits-errors": 6, "box-hits": 20})

    def test_order_of_the_published_comparison_holds(self):
        hits = {row[0][:2]: float(row[4]) for row in self.tables["slits-hits"] if row[1] == "100000"}
        self.assertGreater(hits["S6"], max(hits["S1"], hits["S4"]))
        self.assertGreater(min(hits["S1"], hits["S4"]), hits["S3"])
        self.assertGreater(hits["S3"], hits["S5"])
        self.assertGreater(hits["S5"], hits["S2"])

    def test_published_columns_are_those_of_the_file_and_ratios_follow(self):
        for source in ("S1", "S2", "S3", "S4", "S5", "S6"):
            rows = [row for row in self.tables["slits-hits"] if row[0].startswith(source)]
            self.assertEqual([row[3] for row in rows], hits_of(source))
            for _, _, _, theirs, ours, ratio in rows:  # ours is rounded to 0.005, the ratio to three digits
                if float(theirs) == 0:
                    self.assertEqual(ratio, "–")
                else:
                    self.assertAlmostEqual(float(ratio) * float(theirs), float(ours), delta=0.005 + 0.005 * float(ours))

    def test_holds_its_pictures(self):
        if not shutil.which("gnuplot"):
            self.skipTest("needs gnuplot")
        self.assertEqual(len(re.findall(r'src="data:image/png;base64,', self.page)), 4)
        self.assertNotRegex(self.page, r'(src|href)="(?!data:)')

    def test_direct_hits_are_within_their_bounds(self):
        for row in self.tables["slits-errors"]:
            self.assertLessEqual(abs(float(row[3])), float(row[4]), row[0])

    def test_is_left_as_it_was_by_a_program_that_fails(self):
        failed = run("--only", "slits", "-o", self.out, shutil.which("false"))
        self.assertEqual(failed.returncode, 1)
        self.assertIn("double_slit/case.toml ended with exit code 1", failed.stderr)
        self.assertEqual((self.out / "index.html").read_text(), self.page)

    def test_is_left_as_it_was_by_an_interrupt(self):
        going = subprocess.Popen([sys.executable, RUN, "--only", "truck", "-o", self.out, PROGRAM], start_new_session=True,
                                 stderr=subprocess.PIPE, text=True)
        self.assertTrue(going.stderr.read(1))  # its first word: the truck has been begun
        time.sleep(0.5)
        going.send_signal(signal.SIGINT)
        going.communicate()
        self.assertEqual(going.returncode, 130)
        self.assertEqual((self.out / "index.html").read_text(), self.page)
        self.assertFalse(list(self.out.glob(".*")))


class Refusals(unittest.TestCase):
    def sentence(self, *words):
        done = run(*words)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)
        return done.stderr

    def test_name_the_part_or_the_program(self):
        self.assertIn("no such part; choose among cube, dihedral, truck, slits, box", self.sentence("--only", "cube,car", PROGRAM))
        self.assertIn("no such program", self.sentence(str(CASES / "papers" / "raytube")))


class Readmes(unittest.TestCase):
    """They quote the published values; the file is what they come from."""

    def test_of_the_double_slit(self):
        text = (CASES / "double_slit" / "README.md").read_text()
        for source in ("S1", "S2", "S3", "S4", "S5", "S6"):
            self.assertRegex(text, rf"\| {source} `[a-z-]*` \| {re.escape(' '.join(hits_of(source)))} \|")
        seconds = [r["value"] for r in published() if r["experiment"] == "rays" and r["quantity"] == "seconds"]
        self.assertRegex(text, rf"\| published [^|]*\| {re.escape(' | '.join(seconds))} \|")

    def test_of_the_truck(self):
        text = (CASES / "haul_truck" / "README.md").read_text()
        values = {r["quantity"]: r["value"] for r in published() if r["case"] == "haul_truck"}
        self.assertIn(f"= {int(values['seconds']):,} s |".replace(",", " "), text)
        self.assertIn(f"| {values['megabytes']} MB |", text)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop()
    unittest.main()
