import math

import support
from support import INPUT, USAGE, ProgramTest


class Deform(ProgramTest):
    def body(self, name):
        nodes, _, markers = support.read_su2(self.path(name))
        return {n: nodes[n] for edge in markers["body"] for n in edge}

    def test_sine(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "0.05",
                     "2")
        before, after = self.body("ring.su2"), self.body("out.su2")
        for node, (x, y) in before.items():
            s = x + 0.5  # the body reaches from x = -0.5 to 0.5
            self.assertAlmostEqual(after[node][0], x, delta=1e-12)
            self.assertAlmostEqual(after[node][1], y + 0.05 * math.sin(4 * math.pi * s), delta=1e-12)

    def test_sine_with_a_negative_amplitude_and_direction(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "-0.05",
                     "1", "--direction", "-1", "0")
        before, after = self.body("ring.su2"), self.body("out.su2")
        largest = max(abs(after[n][0] - before[n][0]) for n in before)
        self.assertGreater(largest, 0.045)
        for node in before:
            self.assertAlmostEqual(after[node][1], before[node][1], delta=1e-12)

    def test_fade(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "0.05",
                     "1.5", "--fade", "end", "--fade-length", "0.3")
        before, after = self.body("ring.su2"), self.body("out.su2")
        at_end = max(before, key=lambda n: before[n][0])
        self.assertAlmostEqual(after[at_end][1], before[at_end][1], delta=1e-12)
        moved = max(abs(after[n][1] - before[n][1]) for n in before if before[n][0] < 0)
        self.assertGreater(moved, 0.04)

    def test_displacement_file_by_node(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n0,0.05,-0.02\n5,-0.01,0.03\n")
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "d.csv")
        before, after = self.body("ring.su2"), self.body("out.su2")
        for node in before:
            dx, dy = {0: (0.05, -0.02), 5: (-0.01, 0.03)}.get(node, (0, 0))
            self.assertAlmostEqual(after[node][0] - before[node][0], dx, delta=1e-12)
            self.assertAlmostEqual(after[node][1] - before[node][1], dy, delta=1e-12)

    def test_displacement_file_by_coordinates(self):
        self.ring()
        self.path("d.csv").write_text("x,y,dx,dy\n0.5,0,0.05,-0.02\n")
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "d.csv")
        after = self.body("out.su2")
        self.assertAlmostEqual(after[0][0], 0.55)
        self.assertAlmostEqual(after[0][1], -0.02)

    def test_bad_displacement_files(self):
        self.ring()
        for text, code in (("node,dx,dy\n0,0.05\n", INPUT), ("node,dx,dy\n0,x,0\n", INPUT)):
            self.path("d.csv").write_text(text)
            run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body",
                               "--displacements", "d.csv", code=code)
            self.assertIn("d.csv:2", run.stderr)
        self.path("d.csv").write_text("node,dx,dy\n100,0.05,0\n")  # an interior node
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "d.csv", code=USAGE)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "none.csv", code=INPUT)
        self.assertNotIn("out.su2", self.files())

    def test_exactly_one_shape(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n0,0.05,0\n")
        base = ("deform", "ring.su2", "-o", "out.su2", "--marker", "body")
        self.winslow(*base, code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--displacements", "d.csv", code=USAGE)
        self.winslow(*base, "--displacements", "d.csv", "--fade", "end", code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--fade", "ends", code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--fade", "end", "--fade-length", "0.9",
                     code=USAGE)


if __name__ == "__main__":
    support.main()
