"""Periodic pairs that the mesh file names: --periodic-from-file, and what quality says of them."""

import math
import pathlib

import support
from support import INPUT, USAGE, ProgramTest

DATA = pathlib.Path(__file__).resolve().parents[1] / "data"


class PeriodicFromFile(ProgramTest):
    def test_quality_lists_what_the_file_names(self):
        run = self.winslow("quality", DATA / "periodic_41.msh", "--report", "q.json")
        self.assertIn('"lower" and "upper": 3 pairs of nodes, translation by (0, 1)', run.stdout)
        self.assertEqual(self.json("q.json")["periodic_in_file"],
                         [{"markers": ["lower", "upper"], "pairs": 3, "halo": False,
                           "by": "translation by (0, 1)"}])
        text = (DATA / "periodic_41.msh").read_text().replace("\n1 3 7\n", "\n0 3 7\n")
        self.path("part.msh").write_text(text)
        run = self.winslow("quality", "part.msh", "--report", "q.json")
        self.assertIn("cannot be used, part.msh:119: found marker", run.stdout)
        self.assertIn("periodic in part only", self.json("q.json")["periodic_in_file"][0]["fault"])
        run = self.winslow("smooth", "part.msh", "-o", "out.msh", "--periodic-from-file",
                           code=USAGE)
        self.assertIn("part.msh:119: found marker \"lower\" periodic in part only", run.stderr)
        self.ring()
        self.assertNotIn("Periodic", self.winslow("quality", "ring.su2").stdout)

    def test_pairs_of_a_gmsh_file_do_what_named_ones_do(self):
        mesh = DATA / "periodic_41.msh"
        run = self.winslow("smooth", mesh, "-o", "a.msh", "--periodic-from-file", "--save-recipe",
                           "p.json", "--report", "r.json")
        self.assertIn("1 periodic pairs by translation by (0, 1)", run.stdout)
        self.winslow("smooth", mesh, "-o", "b.msh", "--periodic", "lower", "upper")
        self.assertEqual(self.path("a.msh").read_bytes(), self.path("b.msh").read_bytes())
        self.assertNotEqual(self.path("a.msh").read_bytes(), mesh.read_bytes())
        self.assertIn("$Periodic", self.path("a.msh").read_text())
        slide = self.json("p.json")["commands"][0]["smooth"]["slide"]
        self.assertIs(slide["periodic_from_file"], True)
        self.winslow("replay", "p.json", "-o", "c.msh")
        self.assertEqual(self.path("a.msh").read_bytes(), self.path("c.msh").read_bytes())
        periodic = self.json("r.json")["commands"][0]["periodic"]
        self.assertEqual(periodic[0]["markers"], ["lower", "upper"])

    def test_a_file_that_names_none_is_refused(self):
        self.ring()
        run = self.winslow("smooth", "ring.su2", "-o", "out.su2", "--periodic-from-file",
                           code=USAGE)
        self.assertIn("ring.su2: found no periodic pairs in the file, expected $Periodic",
                      run.stderr)
        self.assertFalse(self.path("out.su2").exists())

    def test_halo_nodes_of_su2_stay_copies_of_nodes_of_the_interior(self):
        pairs = self.halo()
        run = self.winslow("move", "halo.su2", "-o", "out.su2", "--marker", "blade", "--translate",
                           "0", "0.25", "--periodic-from-file", "--report", "r.json")
        self.assertIn("9 periodic pairs by translation by (0, -1), 9 halo nodes by translation by "
                      "(0, 1)", run.stdout)
        before, elements, _ = self.without_lists("halo.su2")
        after, _, _ = self.without_lists("out.su2")
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        moved = 0
        for sender, image in pairs:
            moved = max(moved, math.dist(before[image], after[image]))
            for k in (0, 1):
                self.assertAlmostEqual(after[image][k] - after[sender][k],
                                       before[image][k] - before[sender][k], delta=1e-13)
        self.assertGreater(moved, 0.02)
        self.assertNotIn("no longer match", run.stderr)
        tail = self.path("halo.su2").read_text()
        tail = tail[tail.index("MARKER_TAG= SEND_RECEIVE"):]
        self.assertTrue(self.path("out.su2").read_text().endswith(tail))
        # Without, the copies stay where they were, and that is said.
        run = self.winslow("move", "halo.su2", "-o", "stale.su2", "--marker", "blade",
                           "--translate", "0", "0.25")
        self.assertIn("the halo nodes beyond", run.stderr)

    def test_of_several_zones_those_with_pairs_have_them(self):
        self.halo()
        support.write_su2(self.path("ring.su2"), *support.ring_mesh())
        self.path("both.su2").write_text("NZONE= 2\nIZONE= 1\n" + self.path("halo.su2").read_text()
                                         + "IZONE= 2\n" + self.path("ring.su2").read_text())
        self.winslow("smooth", "both.su2", "-o", "out.su2", "--periodic-from-file", "--report",
                     "r.json")
        commands = self.json("r.json")["commands"]
        self.assertEqual([len(c["periodic"]) for c in commands], [2, 0])

    def test_a_bad_section_is_an_input_error(self):
        text = (DATA / "periodic_22.msh").read_text().replace("Affine 1", "Affine x")
        self.path("bad.msh").write_text(text)
        run = self.winslow("quality", "bad.msh", code=INPUT)
        self.assertIn("bad.msh:", run.stderr)
        self.assertIn("found 'x', expected value of an affine transform 1 of 16", run.stderr)

    def without_lists(self, name):
        text = self.path(name).read_text()
        self.path("plain.su2").write_text(text[:text.index("MARKER_TAG= SEND_RECEIVE")])
        return support.read_su2(self.path("plain.su2"))

    def halo(self, n=10):
        """halo.su2: passage() as SU2_MSH left such files, with a row of elements above "upper".
        Returns (sender, image) of all points in its lists."""
        number, nodes, elements = {}, [], []

        def node(i, j):
            if (i, j) not in number:
                number[i, j] = len(nodes)
                nodes.append((i / n, j / n))
            return number[i, j]

        solid = {(i, j) for i in range(4, 6) for j in range(4, 6)}
        for j in range(n + 1):
            for i in range(n):
                if (i, j) not in solid:
                    a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
                    elements += [(a, b, c), (a, c, d)]
        blade = [(4, 4), (4, 5), (4, 6), (5, 6), (6, 6), (6, 5), (6, 4), (5, 4), (4, 4)]
        markers = {"lower": [(node(i, 0), node(i + 1, 0)) for i in range(n)],
                   "upper": [(node(i, n), node(i + 1, n)) for i in range(n)],
                   "inflow": [(node(0, j + 1), node(0, j)) for j in range(n + 1)],
                   "outflow": [(node(n, j), node(n, j + 1)) for j in range(n + 1)],
                   "blade": [(node(*a), node(*b)) for a, b in zip(blade, blade[1:])]}
        support.write_su2(self.path("halo.su2"), nodes, elements, markers)
        lists = []
        for sign in (1, -1):
            rows = (n, 1) if sign > 0 else (0, n + 1)
            lists += ["MARKER_TAG= SEND_RECEIVE", f"MARKER_ELEMS= {2 * n + 2}", f"SEND_TO= {sign}"]
            lists += [f"1 {node(i, j)} {k + 1}" for k, j in enumerate(rows) for i in range(n + 1)]
        for index, shift in enumerate((0, 1, -1)):
            lists += ["NPERIODIC= 3"] if index == 0 else []
            lists += [f"PERIODIC_INDEX= {index}", "0 0 0", "0 0 0", f"0 {shift} 0"]
        text = self.path("halo.su2").read_text()
        text = text.replace(f"NMARK= {len(markers)}", f"NMARK= {len(markers) + 2}")
        self.path("halo.su2").write_text(text + "\n".join(lists) + "\n")
        return ([(node(i, n), node(i, 0)) for i in range(n + 1)]
                + [(node(i, 1), node(i, n + 1)) for i in range(n + 1)])


if __name__ == "__main__":
    support.main()
