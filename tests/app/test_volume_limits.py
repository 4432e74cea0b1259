"""`--min-quality` of volume meshes: a motion ends before its limits, by every metric of the report."""
import json
import math
import unittest

import support
from support import DONE, INVERTED, USAGE, ProgramTest
from volume_meshes import box_mesh, write_box

MOVE = ("--marker", "body", "--rotate", "60", "--axis", "1", "1", "2", "--translate", ".1", "0", ".1")
LEAST = {"normalized_jacobian": "Scaled Jacobian", "smallest_solid_angle": "Smallest solid angle",
         "volume_ratio": "Volume ratio"}
LARGEST = {"aspect_ratio": "Aspect ratio", "condition_number": "Condition number",
           "largest_solid_angle": "Largest solid angle", "non_orthogonality": "Non-orthogonality",
           "skewness": "Skewness", "cell_aspect_ratio": "Cell aspect ratio"}


def scaled_jacobian(corners):
    """Of a tetrahedron: 1 for the regular one."""
    worst = float("inf")
    for k in range(4):
        edges = [[b - a for a, b in zip(corners[k], corners[i])] for i in range(4) if i != k]
        (a, b, c), (d, e, f), (g, h, i) = edges
        determinant = abs(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
        worst = min(worst, determinant / math.prod(math.hypot(*edge) for edge in edges))
    return math.sqrt(2) * worst


class VolumeLimits(ProgramTest):
    def setUp(self):
        super().setUp()
        write_box(self.path("box.su2"))

    def move(self, *args, code=DONE, mesh="box.su2"):
        run = self.winslow("move", mesh, "-o", "out.su2", *MOVE, *args, "--report", "r.json", code=code)
        return run, self.json("r.json") if code != USAGE else None

    def extreme(self, metric, mesh):
        """The worst value of a metric in a mesh, by the table or by OpenFOAM's measures."""
        self.winslow("quality", mesh, "--report", "q.json")
        report, end = self.json("q.json"), "min" if metric in LEAST else "max"
        name = "aspect_ratio" if metric == "cell_aspect_ratio" else metric
        return report["quality"][metric][end] if metric in report["quality"] else report["openfoam"][name][end]

    def test_a_motion_ends_before_the_limit_of_any_metric(self):
        self.move()
        self.path("out.su2").rename(self.path("whole.su2"))
        for metric, label in (LEAST | LARGEST).items():
            with self.subTest(metric=metric):
                start = self.extreme(metric, "box.su2")
                limit = (start + self.extreme(metric, "whole.su2")) / 2
                self.path("out.su2").unlink(missing_ok=True)
                run, ended = self.move("--min-quality", f"{metric}={limit}", code=INVERTED)
                self.assertFalse(self.path("out.su2").exists())
                self.assertGreater(ended["fraction_reached"], .05)
                self.assertLess(ended["fraction_reached"], 1)
                self.assertIn(label, ended["commands"][0]["limited_by"])
                self.move("--min-quality", f"{metric}={limit}", "--accept-partial", code=INVERTED)
                got = self.extreme(metric, "out.su2")
                if metric in LEAST:
                    self.assertGreaterEqual(got, limit)
                    self.assertIn(f"{label} would be less than", run.stderr)
                else:
                    self.assertLessEqual(got, limit)
                    self.assertIn(f"{label} would be more than", run.stderr)
                self.assertLess(abs(got - limit), .15 * abs(start - limit))  # and not long before

    def test_elements_that_cannot_move_break_no_limit_unless_the_motion_makes_them_worse(self):
        nodes, cells, markers = box_mesh()
        corner = nodes.index((1, 0, 0))
        around = [cell for cell in cells if corner in cell]
        on_boundary = {n for faces in markers.values() for face in faces for n in face}
        self.assertEqual(len(around), 2)
        self.assertTrue(all(n in on_boundary for cell in around for n in cell))
        nodes = write_box(self.path("flat.su2"), (corner, (.83, .01, .01)))[0]
        limit = .5 * self.move(mesh="flat.su2")[1]["quality_movable"]["normalized_jacobian"]["min"]
        flat = min(scaled_jacobian([nodes[n] for n in cell]) for cell in around)
        self.assertLess(flat, limit)
        self.assertEqual(self.move("--min-quality", f"normalized_jacobian={limit}",
                                   mesh="flat.su2")[1]["fraction_reached"], 1)
        run, report = self.move("--min-quality", "normalized_jacobian=.99", mesh="flat.su2", code=INVERTED)
        self.assertEqual(report["fraction_reached"], 0)

    def test_limits_that_hold_change_nothing_and_stand_in_recipes(self):
        self.move("--min-quality", "smallest_solid_angle=.001", "--min-quality", "aspect_ratio=100",
                  "--save-recipe", "recipe.json")
        command = json.loads(self.path("recipe.json").read_text())["commands"][0]
        self.assertEqual(command["min_quality"], {"smallest_solid_angle": .001, "aspect_ratio": 100})
        self.winslow("replay", "recipe.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("out.su2").read_bytes())

    def test_limits_to_what_elements_do_not_have_are_refused(self):
        for limit in ("largest_angle=150", "smallest_angle=1"):
            run = self.move("--min-quality", limit, code=USAGE)[0]
            self.assertIn(f"found {limit.split('=')[0]}, which volume elements do not have", run.stderr)
            self.assertIn("smallest_solid_angle", run.stderr)
        self.assertIn("not reported", self.move("--min-quality", "volume=1", code=USAGE)[0].stderr)
        self.assertIn("unknown metric 'beauty'", self.move("--min-quality", "beauty=1", code=USAGE)[0].stderr)
        run = self.winslow("move", self.ring(), "-o", "out.su2", "--marker", "body", "--rotate", 9,
                           "--min-quality", "non_orthogonality=70", code=USAGE)
        self.assertIn("which plane elements do not have, expected one of: normalized_jacobian", run.stderr)
        self.assertNotIn("out.su2", self.files())


if __name__ == "__main__":
    support.main()
