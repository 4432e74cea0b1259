"""What the tests of the Python package share: meshes, a folder for each test, the program to compare with."""

import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import warnings

import numpy as np

import winslow

ROOT = pathlib.Path(__file__).resolve().parents[2]
ASSETS, DATA = ROOT / "assets", ROOT / "tests" / "data"
PROGRAM = os.environ.get("WINSLOW", "")
# For other programs than the interpreter: these have a sanitizer of their own, or none.
PLAIN = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
HAS_GUI = os.environ.get("WINSLOW_HAS_GUI") == "1"


class PackageTest(unittest.TestCase):
    """Tests in an empty folder of their own; warnings about meshes are quiet unless a test records them."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="winslow-python-"))
        self.addCleanup(shutil.rmtree, self.folder)
        recorded = warnings.catch_warnings()
        recorded.__enter__()
        self.addCleanup(recorded.__exit__, None, None, None)
        warnings.simplefilter("ignore", winslow.MeshWarning)

    def program(self, *arguments, code=0):
        """Runs the program in the folder."""
        if not PROGRAM:
            self.skipTest("the program is not built")
        run = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                             check=False, env=PLAIN)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run

    def assert_same(self, a, b):
        """Two arrays are the same bit for bit."""
        a, b = np.asarray(a), np.asarray(b)
        self.assertEqual((a.shape, a.dtype), (b.shape, b.dtype))
        self.assertEqual(a.tobytes(), b.tobytes())


def ring_arrays(around=24, rings=8, inner=0.5, outer=4.0):
    """Points, triangles, and the edges of `body` and `farfield`, of a ring around the origin."""
    points = []
    for j in range(rings + 1):
        radius = inner * (outer / inner) ** (j / rings)
        points += [(radius * math.cos(2 * math.pi * i / around), radius * math.sin(2 * math.pi * i / around))
                   for i in range(around)]
    cells = []
    for j in range(rings):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            c, d = a + around, b + around
            cells += [(a, c, d), (a, d, b)]
    edges = {name: np.array([(j * around + i, j * around + (i + 1) % around) for i in range(around)])
             for name, j in (("body", 0), ("farfield", rings))}
    return np.array(points), {"triangle": np.array(cells)}, edges


def ring(**options):
    return winslow.Mesh(*ring_arrays(**options))


def cube(n=3):
    """A mesh of n^3 hexahedra of the unit cube, with a marker `bottom` and a marker `others`."""
    axis = np.linspace(0, 1, n + 1)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel()])

    def node(i, j, k):
        return (k * (n + 1) + j) * (n + 1) + i

    cells = [[node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
              node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)]
             for k in range(n) for j in range(n) for i in range(n)]
    bottom, others = [], []
    for a in range(n):
        for b in range(n):
            for side in (0, n):
                (bottom if side == 0 else others).append(
                    [node(a, b, side), node(a + 1, b, side), node(a + 1, b + 1, side), node(a, b + 1, side)])
                others.append([node(a, side, b), node(a + 1, side, b), node(a + 1, side, b + 1), node(a, side, b + 1)])
                others.append([node(side, a, b), node(side, a + 1, b), node(side, a + 1, b + 1), node(side, a, b + 1)])
    return winslow.Mesh(points, {"hexahedron": np.array(cells)},
                        {"bottom": np.array(bottom), "others": np.array(others)})


def main():
    unittest.main(verbosity=2)
