"""What a table measures, what cannot move, and what holds a motion."""

import gzip
import math
import unittest

from support import ASSETS, DONE, ProgramTest, write_su2

HELD = 7


def row(text, label, which=0):
    """The numbers of the line of a table that begins with the label; `which`: of several such lines."""
    lines = [line for line in text.split("\n") if line.startswith(label)]
    return [float(word) for word in lines[which][len(label):].split()]


def tetrahedra(path):
    """Nodes and tetrahedra of an SU2 file."""
    lines = gzip.open(path, "rt").read().split("\n")
    first = next(k for k, line in enumerate(lines) if line.startswith("NELEM="))
    elements = [tuple(map(int, line.split()[1:5])) for line in lines[first + 1:first + 1 + int(lines[first][6:])]]
    first = next(k for k, line in enumerate(lines) if line.startswith("NPOIN="))
    count = int(lines[first].split()[1])
    return [tuple(map(float, line.split()[:3])) for line in lines[first + 1:first + 1 + count]], elements


def scaled_jacobian(points):
    """sqrt 2 times six volumes over the largest product of three edges at a corner."""
    def minus(a, b):
        return [p - q for p, q in zip(a, b)]

    a, b, c, d = points
    u, v, w = minus(b, a), minus(c, a), minus(d, a)
    six = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
    largest = max(math.prod(math.dist(p, q) for q in points if q is not p) for p in points)
    return math.sqrt(2) * six / largest


class Table(ProgramTest):
    def test_statistics_are_over_all_elements_and_those_that_can_move_apart(self):
        wing = ASSETS / "coarse" / "wing.su2.gz"
        nodes, elements = tetrahedra(wing)
        sines = [abs(scaled_jacobian([nodes[n] for n in e])) for e in elements]
        faces = {}
        for e in elements:
            for k in range(4):
                face = tuple(sorted(e[:k] + e[k + 1:]))
                faces[face] = faces.get(face, 0) + 1
        boundary = {n for face, count in faces.items() if count == 1 for n in face}
        movable = [s for s, e in zip(sines, elements) if not boundary.issuperset(e)]
        run = self.winslow("quality", wing, "--report", "r.json")
        for k, expected in enumerate((sines, movable)):
            found = row(run.stdout, "Scaled Jacobian", k)
            for value, wanted in zip(found, (min(expected), sum(expected) / len(expected), max(expected))):
                self.assertAlmostEqual(value, wanted, delta=6e-4)
        self.assertIn(f"{len(sines) - len(movable)} elements have all nodes on the boundary and cannot move; without "
                      "them:", run.stdout)
        report = self.json("r.json")
        self.assertAlmostEqual(report["quality"]["normalized_jacobian"]["min"], min(sines), places=9)
        self.assertAlmostEqual(report["quality_movable"]["normalized_jacobian"]["min"], min(movable), places=9)
        self.winslow("quality", wing, "--csv", "t.csv")
        names, values = [line.split(",") for line in self.path("t.csv").read_text().strip().split("\n")]
        self.assertAlmostEqual(float(values[names.index("normalized_jacobian_min")]), min(sines), places=9)

    def test_a_mesh_of_which_nothing_can_move_is_measured(self):
        self.path("one.vtk").write_text(
            "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n"
            "0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n")
        run = self.winslow("quality", "one.vtk", "--report", "r.json")
        self.assertAlmostEqual(row(run.stdout, "Scaled Jacobian")[0], 1 / math.sqrt(2), delta=6e-4)
        self.assertIn("1 element has all nodes on the boundary and cannot move: smoothing changes nothing", run.stdout)
        self.assertIsNone(self.json("r.json")["quality_movable"]["normalized_jacobian"]["min"])


class Held(ProgramTest):
    """A strip of squares one high: no node is inside."""

    def strip(self, name="strip.su2", rows=1):
        nodes = [(i, j) for j in range(rows + 1) for i in range(5)]
        elements = [(5 * j + i, 5 * j + i + 1, 5 * j + i + 6, 5 * j + i + 5) for j in range(rows) for i in range(4)]
        top = 5 * rows
        markers = {"floor": [(i, i + 1) for i in range(4)], "lid": [(top + i + 1, top + i) for i in range(4)],
                   "in": [(5 * j + 5, 5 * j) for j in range(rows)],
                   "out": [(5 * j + 4, 5 * j + 9) for j in range(rows)]}
        write_su2(self.path(name), nodes, elements, markers)
        return name

    def test_a_motion_that_no_other_node_follows_has_a_status_and_says_what_holds_the_nodes(self):
        run = self.winslow("move", self.strip(), "-o", "out.su2", "--marker", "lid", "--translate", 0, 0.1, code=HELD)
        self.assertIn("winslow: no node but those of lid moved: the other 5 are held by floor (5), in (1), out (1); "
                      "--slide floor lets its nodes move along it", run.stderr)
        self.assertTrue(self.path("out.su2").exists())
        quiet = self.winslow("move", "strip.su2", "-o", "out.su2", "--marker", "lid", "--translate", 0, 0.1, "-q",
                             code=HELD)
        self.assertIn("no node but those of lid moved", quiet.stderr)

    def test_a_step_of_a_sweep_that_no_other_node_follows_is_named(self):
        run = self.winslow("sweep", self.strip(), "-o", "{step}.su2", "--marker", "lid", "--translate", "0", "0,0.1",
                           "--results", "r.csv", code=HELD)
        self.assertIn("step 2 is held: no node but those of lid moved: the other 5 are held by floor (5)", run.stderr)
        self.assertIn("1 of 2 steps are done", run.stderr)
        rows = [line.split(",")[1] for line in self.path("r.csv").read_text().strip().split("\n")]
        self.assertEqual(rows, ["status", "done", "held"])
        self.assertTrue(self.path("2.su2").exists())

    def test_where_nodes_follow_or_nothing_is_asked_the_status_is_0(self):
        self.winslow("move", self.strip("two.su2", 2), "-o", "out.su2", "--marker", "lid", "--translate", 0, 0.1)
        self.winslow("move", self.strip(), "-o", "out.su2", "--marker", "lid", "--translate", 0, 0)
        self.winslow("move", "strip.su2", "-o", "out.su2", "--marker", "lid", "--translate", 0, 0.1, "--no-smooth")
        everything = [word for name in ("lid", "floor", "in", "out") for word in ("--marker", name)]
        self.winslow("move", "strip.su2", "-o", "out.su2", *everything, "--translate", 0, 0.1)
        self.assertEqual(self.winslow("smooth", "strip.su2", "-o", "out.su2").returncode, DONE)


if __name__ == "__main__":
    unittest.main()
