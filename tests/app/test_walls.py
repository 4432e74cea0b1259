import csv
import itertools
import math
import unittest

import support
from support import HAS_GUI, INVERTED, USAGE, ProgramTest

RING = {"around": 48, "rings": 12, "inner": 0.5, "outer": 4.0}
GROWTH = (RING["outer"] / RING["inner"]) ** (1 / RING["rings"])


def distance(p, a, b):
    """Of a point from a line segment."""
    along = (b[0] - a[0], b[1] - a[1])
    t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)
    t = min(max(t, 0.0), 1.0)
    return math.dist(p, (a[0] + t * along[0], a[1] + t * along[1]))


def first_heights(nodes, elements, wall):
    """By wall node: mean over its wall edges of the distance, from all of the wall, of the corner
    that faces the node."""
    ends = {frozenset(edge) for edge in wall}
    heights = {}
    for corners in elements:
        n = len(corners)
        for k in range(n):
            a, b = corners[k], corners[(k + 1) % n]
            if frozenset((a, b)) not in ends:
                continue
            for node, facing in ((a, corners[k - 1]), (b, corners[(k + 2) % n])):
                heights.setdefault(node, []).append(
                    min(distance(nodes[facing], nodes[c], nodes[d]) for c, d in wall))
    return {node: sum(values) / len(values) for node, values in heights.items()}


def quantile(values, share):
    values = sorted(values)
    place = share * (len(values) - 1)
    low = int(place)
    high = min(low + 1, len(values) - 1)
    return values[low] + (place - low) * (values[high] - values[low])


class Walls(ProgramTest):
    def assert_spread(self, block, values, delta):
        self.assertAlmostEqual(block["min"], min(values), delta=delta)
        self.assertAlmostEqual(block["p05"], quantile(values, 0.05), delta=delta)
        self.assertAlmostEqual(block["median"], quantile(values, 0.5), delta=delta)
        self.assertAlmostEqual(block["p95"], quantile(values, 0.95), delta=delta)
        self.assertAlmostEqual(block["max"], max(values), delta=delta)

    def test_an_o_grid_has_its_analytic_heights_and_growth(self):
        self.ring(quads=True, **RING)
        text = self.winslow("quality", "ring.su2", "--report", "q.json").stdout
        walls = self.json("q.json")["walls"]
        self.assertEqual(walls["nodes"], 48)
        self.assertNotIn("before", walls)
        for value in walls["now"]["first_height"].values():
            self.assertAlmostEqual(value, 0.5 * (GROWTH - 1), delta=1e-12)
        for value in walls["now"]["growth"].values():
            self.assertAlmostEqual(value, GROWTH, delta=1e-9)
        for value in walls["now"]["tilt"].values():
            self.assertAlmostEqual(value, 0, delta=1e-5)
        self.assertEqual([one["markers"] for one in walls["each"]], [["body"]])
        self.assertEqual(walls["units"]["tilt"], "degrees")
        self.assertIn("First height", text)
        self.assertIn("48 wall nodes", text)

    def test_the_report_says_what_the_files_hold(self):
        for name, quads in (("quads", True), ("triangles", False)):
            with self.subTest(cells=name):
                self.ring(quads=quads, **RING)
                self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate",
                             "15", "--targets", "element", "--report", "r.json")
                before, elements, markers = support.read_su2(self.path("ring.su2"))
                after, _, _ = support.read_su2(self.path("out.su2"))
                report = self.json("r.json")
                walls = report["walls"]
                was = first_heights(before, elements, markers["body"])
                now = first_heights(after, elements, markers["body"])
                ratios = {node: now[node] / was[node] for node in was}
                self.assert_spread(walls["before"]["first_height"], was.values(), 1e-12)
                self.assert_spread(walls["now"]["first_height"], now.values(), 1e-12)
                self.assert_spread(walls["first_height_ratio"], ratios.values(), 1e-10)
                off = sum(abs(ratio - 1) > 0.05 for ratio in ratios.values()) / len(ratios)
                self.assertAlmostEqual(walls["first_height_changed"], off, delta=1e-12)
                worst = max(ratios, key=lambda node: abs(math.log(ratios[node])))
                self.assertAlmostEqual(walls["first_height_worst"]["ratio"], ratios[worst],
                                       delta=1e-10)
                node = walls["first_height_worst"]["node"]
                self.assertEqual(tuple(walls["first_height_worst"]["at"]), after[node])
                self.assertEqual(walls["each"][0]["now"]["first_height"],
                                 walls["now"]["first_height"])
                self.winslow("quality", "ring.su2", "--report", "q.json")
                self.assertEqual(report["quality_before"], self.json("q.json")["quality"])

    def test_angles_and_skewness_are_those_of_the_corners(self):
        self.ring(quads=True, **RING)
        self.winslow("quality", "ring.su2", "--report", "q.json")
        report = self.json("q.json")
        half = 180 / RING["around"]  # trapezoids: base angles 90 +- half a sector
        for name, value in (("smallest_angle", 90 - half), ("largest_angle", 90 + half),
                            ("skewness", half / 90)):
            for one in report["quality"][name].values():
                self.assertAlmostEqual(one, value, delta=1e-9)
        self.assertEqual(report["units"]["smallest_angle"], "degrees")


def stretched(nodes, around, first, growth):
    """The nodes of a ring mesh, its first ring of cells that high, each of the others by a factor
    higher than the one before, as far as the far field allows."""
    rings = len(nodes) // around
    radii = [math.hypot(*nodes[0])]
    for j in range(1, rings):
        radii.append(radii[-1] + first * growth ** (j - 1))
    radii[-1] = max(radii[-1], math.hypot(*nodes[-1]))
    return [(x * radii[k // around] / math.hypot(x, y), y * radii[k // around] / math.hypot(x, y))
            for k, (x, y) in enumerate(nodes)]


class Warnings(ProgramTest):
    MOVE = ("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "10")

    def test_heights_that_change_are_said_with_figures_and_place(self):
        # Regular elements are as high as they are wide, whatever they were before.
        nodes, elements, markers = support.ring_mesh(**RING)
        support.write_su2(self.path("ring.su2"), stretched(nodes, RING["around"], 0.005, 1.5),
                          elements, markers)
        run = self.winslow(*self.MOVE, "--targets", "element", "--report", "r.json")
        walls = self.json("r.json")["walls"]
        self.assertGreater(walls["first_height_changed"], 0.05)
        worst = walls["first_height_worst"]
        self.assertIn("first heights changed by more than 5 %", run.stderr)
        self.assertIn(f"to {worst['ratio']:.3g} times", run.stderr)
        self.assertIn(f"at ({worst['at'][0]:.6g}, {worst['at'][1]:.6g})", run.stderr)
        self.assertIn("--targets", run.stderr)
        self.assertEqual(len([line for line in run.stderr.splitlines() if line]), 1)
        self.assertEqual(["winslow: warning: " + text for text in self.json("r.json")["warnings"]],
                         run.stderr.splitlines())
        self.assertEqual(self.winslow(*self.MOVE, "--targets", "element", "--quiet").stderr, "")

    def test_a_far_field_that_shears_the_mesh_is_to_slide_first(self):
        self.ring(**RING)
        move = ("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "200")
        run = self.winslow(*move, "--targets", "element")
        self.assertIn("the smallest sine fell", run.stderr)
        self.assertIn("; --slide farfield lets its nodes move along it, ", run.stderr)
        run = self.winslow(*move, "--targets", "element", "--slide", "farfield")
        self.assertEqual(run.stderr, "")

    def test_nothing_is_said_where_heights_are_kept(self):
        nodes, elements, markers = support.ring_mesh(quads=True, **RING)
        support.write_su2(self.path("ring.su2"), stretched(nodes, RING["around"], 0.005, 1.5),
                          elements, markers)
        run = self.winslow(*self.MOVE, "--targets", "rest", "--report", "r.json")
        self.assertLess(self.json("r.json")["walls"]["first_height_changed"], 0.05)
        self.assertEqual(run.stderr, "")
        self.assertEqual(self.json("r.json")["warnings"], [])

    def test_heights_that_were_asked_for_are_no_damage(self):
        self.ring(quads=False, **RING)
        run = self.winslow("layers", "ring.su2", "-o", "out.su2", "--marker", "body", "--count",
                           "3", "--first", "0.01", "--ratio", "1.2")
        self.assertNotIn("first heights", run.stderr)
        self.assertIn("wall nodes", run.stdout)
        self.assertNotIn("first height changed", run.stdout)


# Planes of a grid in space: a cubic body from .4 to .6 with a layer of .02 around it.
PLANES = (0, 0.2, 0.38, 0.4, 0.6, 0.62, 0.8, 1)
LAYER = 0.02


def write_body_with_a_layer(path):
    """Hexahedra in [0, 1]^3 around a cube; markers body and far. Returns the places of the nodes."""
    n = len(PLANES)
    number = lambda i, j, k: (k * n + j) * n + i
    nodes = [(x, y, z) for z in PLANES for y in PLANES for x in PLANES]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    sides = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 5), (0, 4, 7, 3))
    cells, count = [], {}
    for place in itertools.product(range(n - 1), repeat=3):
        if place == (3, 3, 3):
            continue
        cell = [number(*(p + c for p, c in zip(place, corner))) for corner in corners]
        cells.append(cell)
        for side in sides:
            face = [cell[c] for c in side]
            count.setdefault(tuple(sorted(face)), []).append(face)
    markers = {"body": [], "far": []}
    for faces in count.values():
        if len(faces) == 1:
            middle = [sum(nodes[c][axis] for c in faces[0]) / 4 for axis in range(3)]
            markers["body" if all(0 < m < 1 for m in middle) else "far"].append(faces[0])
    lines = ["NDIME= 3", f"NELEM= {len(cells)}"] + ["12 " + " ".join(map(str, c)) for c in cells]
    lines += [f"NPOIN= {len(nodes)}"] + [" ".join(map(repr, p)) for p in nodes] + ["NMARK= 2"]
    for name, faces in markers.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        lines += ["9 " + " ".join(map(str, f)) for f in faces]
    path.write_text("\n".join(lines) + "\n")
    return nodes


class WallsInSpace(ProgramTest):
    MOVE = ("move", "body.su2", "-o", "out.su2", "--marker", "body", "--rotate", "10", "--axis", "0",
            "0", "1")

    def setUp(self):
        super().setUp()
        self.nodes = write_body_with_a_layer(self.path("body.su2"))

    def test_a_body_has_its_heights_and_growth(self):
        text = self.winslow("quality", "body.su2", "--report", "q.json", "--csv", "q.csv").stdout
        walls = self.json("q.json")["walls"]
        self.assertEqual(walls["nodes"], 8)
        for value in walls["now"]["first_height"].values():
            self.assertAlmostEqual(value, LAYER, delta=1e-12)
        # Columns of .02, .18 and .2 over each of six faces.
        self.assertAlmostEqual(walls["now"]["growth"]["max"], 9, delta=1e-9)
        self.assertAlmostEqual(walls["now"]["growth"]["min"], 0.2 / 0.18, delta=1e-9)
        self.assertAlmostEqual(walls["now"]["size_ratio"]["max"], 10 ** (1 / 3), delta=1e-9)
        self.assertEqual([one["markers"] for one in walls["each"]], [["body"]])
        self.assertIn("First height", text)
        self.assertIn("8 wall nodes", text)
        with open(self.path("q.csv"), newline="") as file:
            row = next(csv.DictReader(file))
        self.assertAlmostEqual(float(row["first_height_median"]), LAYER, delta=1e-12)
        worst = self.json("q.json")["worst"]["first_height"][0]
        self.assertEqual(len(worst["centre"]), 3)

    def test_a_motion_that_keeps_heights_says_nothing_of_them(self):
        run = self.winslow(*self.MOVE, "--report", "r.json")
        walls = self.json("r.json")["walls"]
        self.assertLess(walls["first_height_changed"], 0.05)
        self.assertIn("First height / before", run.stdout)
        self.assertNotIn("first heights", run.stderr)

    def test_heights_that_change_are_said_with_figures_and_place(self):
        run = self.winslow(*self.MOVE, "--targets", "element", "--report", "r.json")
        walls = self.json("r.json")["walls"]
        self.assertEqual(walls["first_height_changed"], 1)
        worst = walls["first_height_worst"]
        place = self.nodes[worst["node"]]
        self.assertTrue(all(p in (0.4, 0.6) for p in place))
        # About the middle of the body.
        turned = support.rotated((place[0] - 0.5, place[1] - 0.5), 10)
        for a, b in zip(worst["at"], (turned[0] + 0.5, turned[1] + 0.5, place[2])):
            self.assertAlmostEqual(a, b, delta=1e-9)
        self.assertIn("first heights changed by more than 5 % at 100 % of the wall nodes", run.stderr)
        self.assertIn(f"to {worst['ratio']:.3g} times", run.stderr)
        self.assertIn("at (" + ", ".join(f"{p:.6g}" for p in worst["at"]) + ")", run.stderr)
        self.assertIn("--targets keep", run.stderr)

    def test_a_sweep_has_a_column_of_heights(self):
        self.winslow("sweep", "body.su2", "-o", "s_{step}.su2", "--marker", "body", "--rotate", "5,10",
                     "--axis", "0", "0", "1", "--results", "s.csv")
        with open(self.path("s.csv"), newline="") as file:
            for row in csv.DictReader(file):
                self.assertAlmostEqual(float(row["first_height_ratio_median"]), 1, delta=0.05)

    @unittest.skipUnless(HAS_GUI, "built without pictures")
    def test_pictures_are_coloured_by_heights(self):
        self.winslow(*self.MOVE)
        self.winslow("render", "out.su2", "-o", "p.svg", "--color", "first_height")
        self.assertIn("First height", self.path("p.svg").read_text())
        run = self.winslow("render", "out.su2", "-o", "p.svg", "--color", "first_height_ratio",
                           code=USAGE)
        self.assertIn("--before", run.stderr)


class Limits(ProgramTest):
    MOVE = ("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "170", "--targets",
            "element")

    def sine(self, report):
        return report["quality"]["normalized_jacobian"]["min"]

    def test_a_motion_ends_before_the_limit(self):
        self.ring()
        self.winslow(*self.MOVE, "--report", "all.json")
        self.path("out.su2").unlink()
        start = self.json("all.json")["quality_before"]["normalized_jacobian"]["min"]
        limit = 0.5 * (start + self.sine(self.json("all.json")))
        run = self.winslow(*self.MOVE, "--min-quality", f"normalized_jacobian={limit}",
                           "--report", "r.json", code=INVERTED)
        report = self.json("r.json")
        self.assertGreater(report["fraction_reached"], 0.05)
        self.assertLess(report["fraction_reached"], 1)
        self.assertGreaterEqual(self.sine(report), limit)
        self.assertLess(self.sine(report), limit + 0.1 * (start - limit))  # and not long before
        self.assertIn("Normalized Jacobian would be less than", run.stderr)
        self.assertIn(f"followed to {100 * report['fraction_reached']:.6g} %", run.stderr)
        self.assertIn("Normalized Jacobian", report["commands"][0]["limited_by"])
        self.assertNotIn("out.su2", self.files())
        self.winslow(*self.MOVE, "--min-quality", f"normalized_jacobian={limit}",
                     "--accept-partial", "--save-recipe", "recipe.json", code=INVERTED)
        before, _, _ = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        turned = support.rotated(before[0], 170 * report["fraction_reached"])
        self.assertLess(math.dist(after[0], turned), 1e-9)
        self.winslow("replay", "recipe.json", "-o", "again.su2", "--accept-partial", code=INVERTED)
        self.assertEqual(support.read_su2(self.path("again.su2"))[0], after)

    def test_a_limit_that_is_kept_leads_to_the_same_mesh(self):
        self.ring()
        self.winslow(*self.MOVE, "--report", "all.json")
        self.winslow("move", "ring.su2", "-o", "limited.su2", *self.MOVE[4:], "--min-quality",
                     "skewness=0.999", "--min-quality", "smallest_angle=0.1", "--report", "r.json")
        self.assertEqual(self.json("r.json")["fraction_reached"], 1)
        self.assertIsNone(self.json("r.json")["commands"][0]["limited_by"])
        for a, b in zip(support.read_su2(self.path("limited.su2"))[0],
                        support.read_su2(self.path("out.su2"))[0]):
            self.assertLess(math.dist(a, b), 1e-7)  # solutions, reached by other steps

    def test_a_mesh_that_is_worse_already_goes_nowhere(self):
        self.ring()
        self.winslow(*self.MOVE, "--min-quality", "largest_angle=61", "--report", "r.json",
                     code=INVERTED)
        self.assertEqual(self.json("r.json")["fraction_reached"], 0)

    def test_limits_that_make_no_sense(self):
        self.ring()
        for limit in ("beauty=1", "skewness", "skewness=much", "area=1"):
            with self.subTest(limit=limit):
                run = self.winslow(*self.MOVE, "--min-quality", limit, code=USAGE)
                self.assertIn(limit.split("=")[0], run.stderr)
        self.winslow(*self.MOVE, "--min-quality", "skewness=0.9", "--increments", "4", code=USAGE)
        self.winslow(*self.MOVE, "--min-quality", "skewness=0.9", "--direct", code=USAGE)


if __name__ == "__main__":
    support.main()
