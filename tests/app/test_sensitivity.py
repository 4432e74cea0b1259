import csv
import math
import random
import unittest

import support
from support import INPUT, USAGE, ProgramTest

TIGHT = ["--tolerance", "1e-12"]


class Sensitivity(ProgramTest):
    def setUp(self):
        super().setUp()
        self.ring(around=24, rings=6)
        self.move(10, "moved.su2")

    def move(self, angle, name, shift=0.1):
        self.winslow("move", "ring.su2", "-o", name, "--marker", "body", "--rotate", repr(angle),
                     "--pivot", "0.3", "0", "--translate", repr(shift), "0.05", *TIGHT)

    def nodes(self, name):
        return support.read_su2(self.path(name))[0]

    def field(self, name):
        with self.path(name).open(newline="") as file:
            return {int(row["node"]): (float(row["dx"]), float(row["dy"]))
                    for row in csv.DictReader(file)}

    def write_field(self, name, field):
        lines = ["node,dx,dy", *(f"{n},{x!r},{y!r}" for n, (x, y) in field.items())]
        self.path(name).write_text("\n".join(lines) + "\n")

    def derivative(self, *more, code=0):
        return self.winslow("sensitivity", "moved.su2", "--reference-mesh", "ring.su2", "--marker",
                            "body", *more, code=code)

    def sum_over(self, name, function):
        return sum(fx * x + fy * y for (fx, fy), (x, y) in zip(function.values(), self.nodes(name)))

    def printed(self, run, name):
        line = next(line for line in run.stdout.splitlines() if name in line)
        return float(line.split()[-1])

    def random_field(self, seed):
        draw = random.Random(seed)
        return {n: (draw.uniform(-1, 1), draw.uniform(-1, 1))
                for n in range(len(self.nodes("ring.su2")))}

    def test_transpose_gives_the_derivatives_that_differences_of_runs_give(self):
        function = self.random_field(1)
        self.write_field("dJdX.csv", function)
        run = self.derivative("--transpose", "dJdX.csv", "-o", "dJdb.csv", "--pivot", "0.3", "0")

        def value(angle, shift):
            self.move(angle, "other.su2", shift)
            return self.sum_over("other.su2", function)

        def printed(name):
            return self.printed(run, name)

        # The pivot of the body as it lies: it was shifted after it had turned.
        self.derivative("--transpose", "dJdX.csv", "-o", "again.csv", "--pivot", "0.4", "0.05")
        step = 1e-3
        by_shift = (value(10, 0.1 + step / 10) - value(10, 0.1 - step / 10)) / (step / 5)
        self.assertAlmostEqual(printed("shift along x"), by_shift, delta=1e-5 * abs(by_shift))
        run = self.derivative("--transpose", "dJdX.csv", "-o", "dJdb.csv", "--pivot", "0.4", "0.05")
        by_angle = (value(10 + step, 0.1) - value(10 - step, 0.1)) / (2 * step)
        self.assertAlmostEqual(printed("per degree"), by_angle, delta=1e-5 * abs(by_angle))
        # The body with the words that moved it.
        run = self.winslow("sensitivity", "moved.su2", "--reference-mesh", "ring.su2", "--transpose",
                           "dJdX.csv", "-o", "dJdb.csv", "--body", "body", "rotate=10",
                           "pivot=0.3,0", "translate=0.1,0.05")
        self.assertAlmostEqual(printed("body: by the angle, per degree"), by_angle,
                               delta=1e-5 * abs(by_angle))
        self.assertAlmostEqual(printed("body: by the shift along x"), by_shift,
                               delta=1e-5 * abs(by_shift))

    def test_derivatives_by_the_numbers_of_a_sine(self):
        function = self.random_field(1)
        self.write_field("dJdX.csv", function)
        shape = ["--direction", "1", "2", "--fade", "both"]

        def deform(name, amplitude, waves):
            self.winslow("deform", "ring.su2", "-o", name, "--marker", "body", "--sine",
                         repr(amplitude), repr(waves), *shape, *TIGHT)
            return self.sum_over(name, function)

        deform("moved.su2", 0.05, 1.3)
        run = self.derivative("--transpose", "dJdX.csv", "-o", "dJdb.csv", "--sine", "0.05", "1.3",
                              *shape)
        step = 1e-4
        by_amplitude = (deform("o.su2", 0.05 + step, 1.3) - deform("o.su2", 0.05 - step, 1.3)) / (2 * step)
        by_waves = (deform("o.su2", 0.05, 1.3 + step) - deform("o.su2", 0.05, 1.3 - step)) / (2 * step)
        self.assertAlmostEqual(self.printed(run, "by the amplitude"), by_amplitude,
                               delta=1e-5 * abs(by_amplitude))
        self.assertAlmostEqual(self.printed(run, "by the number of periods"), by_waves,
                               delta=1e-5 * abs(by_waves))

    def test_held_layers_keep_their_corrections(self):
        self.winslow("layers", "ring.su2", "-o", "layers.su2", "--marker", "body", "--count", "5",
                     "--first", "0.01", "--ratio", "1.3")
        self.winslow("move", "layers.su2", "-o", "moved.su2", "--marker", "body", "--rotate", "20",
                     "--translate", "0.3", "0.1", "--hold-layers", "body", *TIGHT)
        self.write_field("dB.csv", {0: (1, 0)})
        run = self.winslow("sensitivity", "moved.su2", "--reference-mesh", "layers.su2", "--marker",
                           "body", "--hold-layers", "body", "--forward", "dB.csv", "-o", "dX.csv")
        self.assertIn(f"corrections of {5 * 24} heights of layers", run.stdout)
        self.assertNotIn("from the solution of the motion", run.stderr)
        self.assertEqual(self.field("dX.csv")[0], (1, 0))

    def test_forward_and_transpose_are_of_one_matrix(self):
        function, any_of_boundary = self.random_field(1), self.random_field(2)
        self.write_field("dJdX.csv", function)
        self.derivative("--transpose", "dJdX.csv", "-o", "dJdb.csv")
        on_boundary = self.field("dJdb.csv")
        boundary = {n: any_of_boundary[n] for n in on_boundary}
        self.write_field("dB.csv", boundary)
        self.derivative("--forward", "dB.csv", "-o", "dX.csv")
        moved = self.field("dX.csv")
        self.assertEqual(sorted(moved), sorted(function))
        self.assertEqual(len(on_boundary), 48)  # both circles

        def product(a, b):
            return sum(a[n][0] * b[n][0] + a[n][1] * b[n][1] for n in a)
        self.assertAlmostEqual(product(on_boundary, boundary), product(function, moved),
                               delta=1e-10)

    def test_what_is_wrong_is_said(self):
        def error(*more, code=USAGE):
            return " ".join(self.derivative(*more, code=code).stderr.split())

        self.assertIn("nothing to multiply", error("-o", "out.csv"))
        self.write_field("field.csv", {0: (1, 0)})
        run = self.winslow("sensitivity", "moved.su2", "--reference-mesh", "ring.su2", "--transpose",
                           "field.csv", "-o", "out.csv", code=USAGE)
        self.assertIn("nothing moved: name the markers", " ".join(run.stderr.split()))
        self.assertIn("found --body together with --pivot or --axis",
                      error("--transpose", "field.csv", "-o", "out.csv", "--pivot", "0", "0", "--body",
                            "body", "rotate=3"))
        self.assertIn("--sine", error("--forward", "field.csv", "-o", "out.csv", "--sine", "1", "1"))
        self.write_field("field.csv", {0: (1, 0), 999: (1, 0)})
        self.assertIn("field.csv:3: found node 999, expected 0 to",
                      error("--transpose", "field.csv", "-o", "out.csv", code=INPUT))
        self.path("places.csv").write_text("x,y,dx,dy\n0,0,1,1\n")
        self.assertIn("expected the number of a node",
                      error("--forward", "places.csv", "-o", "out.csv", code=INPUT))
        self.write_field("field.csv", {0: (1, 0)})
        self.assertIn("field.csv", error("--forward", "field.csv", "-o", "field.csv"))
        self.assertNotIn("out.csv", self.files())
        # Not all that moved is named.
        run = self.winslow("sensitivity", "moved.su2", "--reference-mesh", "ring.su2", "--marker",
                           "farfield", "--forward", "field.csv", "-o", "out.csv", code=USAGE)
        self.assertIn("of body has moved, and the motion leaves it where it was",
                      " ".join(run.stderr.split()))
        # A mesh that is not the result of a motion of the other one.
        self.ring("other.su2", around=20, rings=6)
        run = self.winslow("sensitivity", "other.su2", "--reference-mesh", "ring.su2", "--marker",
                           "body", "--forward", "field.csv", "-o", "out.csv", code=USAGE)
        self.assertIn("nodes", run.stderr)

    def test_displacements_of_nodes_that_depend_on_the_boundary_are_told(self):
        inside = next(n for n, (x, y) in enumerate(self.nodes("ring.su2"))
                      if 1 < math.hypot(x, y) < 3)
        self.write_field("dB.csv", {0: (1, 0), inside: (1, 0)})
        run = self.derivative("--forward", "dB.csv", "-o", "dX.csv")
        self.assertIn("1 node of dB.csv is not of the boundary", run.stderr)


if __name__ == "__main__":
    unittest.main()
