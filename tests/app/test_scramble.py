import support
from support import INVERTED, ProgramTest


class Scramble(ProgramTest):
    def test_scrambles_the_interior_within_the_bounding_box(self):
        self.ring()
        self.winslow("scramble", "ring.su2", "-o", "out.su2", "--seed", "3", "--allow-inverted",
                     code=INVERTED)
        before, elements, markers = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        boundary = {n for edges in markers.values() for edge in edges for n in edge}
        for node, (x, y) in enumerate(after):
            if node in boundary:
                self.assertEqual(after[node], before[node])
            else:
                self.assertNotEqual(after[node], before[node])
                self.assertLessEqual(max(abs(x), abs(y)), 4)
        self.assertLess(support.smallest_corner_area(after, elements), 0)

    def test_needs_allow_inverted(self):
        self.ring()
        run = self.winslow("scramble", "ring.su2", "-o", "out.su2", code=INVERTED)
        self.assertIn("--allow-inverted", run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_a_seed_names_a_mesh(self):
        self.ring()
        for name, seed in (("a", "7"), ("b", "7"), ("c", "8")):
            self.winslow("scramble", "ring.su2", "-o", f"{name}.su2", "--seed", seed,
                         "--allow-inverted", code=INVERTED)
        read = {name: self.path(f"{name}.su2").read_text() for name in "abc"}
        self.assertEqual(read["a"], read["b"])
        self.assertNotEqual(read["a"], read["c"])

    def test_smoothing_recovers_the_mesh(self):
        self.ring()
        self.winslow("smooth", "ring.su2", "-o", "direct.su2")
        self.winslow("scramble", "ring.su2", "-o", "tangled.su2", "--allow-inverted",
                     code=INVERTED)
        self.winslow("smooth", "tangled.su2", "-o", "recovered.su2", "--max-iterations", "3000")
        a, _, _ = support.read_su2(self.path("direct.su2"))
        b, _, _ = support.read_su2(self.path("recovered.su2"))
        for p, q in zip(a, b):
            self.assertAlmostEqual(p[0], q[0], delta=1e-6)
            self.assertAlmostEqual(p[1], q[1], delta=1e-6)


if __name__ == "__main__":
    support.main()
