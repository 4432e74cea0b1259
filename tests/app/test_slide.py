import math

import support
from support import INVERTED, USAGE, ProgramTest


class Slide(ProgramTest):
    def test_a_far_field_slides_on_its_circle_and_a_recipe_does_the_same(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "30",
                           "--slide", "farfield", "--report", "r.json", "--save-recipe", "p.json")
        self.assertIn("24 nodes of the boundary slide", run.stdout)
        before, elements, markers = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        for node in {n for edge in markers["farfield"] for n in edge}:
            self.assertAlmostEqual(math.hypot(*after[node]), 4, delta=1e-12)
            self.assertGreater(math.dist(after[node], before[node]), 1)
        sliding = self.json("r.json")["commands"][0]["sliding"]
        self.assertEqual(sliding, [{"marker": "farfield", "on": "circle of radius 4", "nodes": 24,
                                    "spacing": "free"}])
        self.assertEqual(self.json("p.json")["commands"][0]["smooth"]["slide"]["markers"],
                         ["farfield"])
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("out.su2").read_bytes())

    def test_single_nodes_are_held_or_slide_though_they_are_corners(self):
        self.ring()
        before, _, markers = support.read_su2(self.path("ring.su2"))
        rim = sorted({n for edge in markers["farfield"] for n in edge})
        held, kink = rim[2], rim[-3]
        common = ["--slide", "farfield", "--feature-angle", "5", "--targets", "element"]
        self.winslow("smooth", "ring.su2", "-o", "out.su2", *common, code=USAGE)  # corners all
        names = [word for node in rim[4:9] + [kink] for word in ("--smooth-node", str(node))]
        run = self.winslow("smooth", "ring.su2", "-o", "out.su2", *common, *names, "--report",
                           "r.json", "--save-recipe", "p.json")
        self.assertIn("6 nodes of the boundary slide", run.stdout)
        slide = self.json("p.json")["commands"][0]["smooth"]["slide"]
        self.assertEqual(slide["smooth_nodes"], rim[4:9] + [kink])
        self.assertNotIn("hold_nodes", slide)
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("out.su2").read_bytes())

        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "20",
                           "--slide", "farfield", "--hold-node", str(held), "--hold-node",
                           str(kink), "--report", "r.json")
        self.assertIn("2 named nodes held", run.stdout)
        self.assertEqual(self.json("r.json")["commands"][0]["held_nodes"], 2)
        after, _, _ = support.read_su2(self.path("out.su2"))
        moved = [n for n in rim if after[n] != before[n]]
        self.assertEqual(moved, [n for n in rim if n not in (held, kink)])
        for arguments, words in ((["--hold-node", "9999"], "9999"),
                                 (["--hold-node", "-1"], "0 or more"),
                                 (["--smooth-node", "9999"], "9999"),
                                 (["--smooth-node", str(rim[0])], "no marker slides")):
            run = self.winslow("smooth", "ring.su2", "-o", "none.su2", *arguments, code=USAGE)
            self.assertIn(words, run.stderr)
            self.assertFalse(self.path("none.su2").exists())

    def test_what_cannot_slide_or_be_paired_is_a_usage_error_that_names_it(self):
        self.ring()
        for arguments, words in ((["--slide", "lid"], "lid"),
                                 (["--slide", "body"], "the motion takes its nodes"),
                                 (["--periodic", "body", "farfield"], "are not periodic"),
                                 (["--slide", "farfield", "--formulation", "pointwise"], "slide:")):
            run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate",
                               "5", *arguments, code=USAGE)
            self.assertIn(words, run.stderr)
            self.assertFalse(self.path("out.su2").exists())

    def test_a_floor_gives_way_to_a_gate_unless_it_is_fixed(self):
        nodes, elements, markers = channel_with_gate()
        support.write_su2(self.path("gate.su2"), nodes, elements, markers)
        arguments = ["move", "gate.su2", "-o", "out.su2", "--marker", "gate", "--translate", "1", "0"]
        run = self.winslow(*arguments, "--report", "r.json", "--save-recipe", "p.json")
        self.assertIn("floor gives way to gate (--fixed NAME holds it)", run.stdout)
        command = self.json("r.json")["commands"][0]
        self.assertEqual([(part["marker"], part["gives_way"]) for part in command["sliding"]],
                         [("floor", True), ("floor", True)])
        self.assertEqual([(foot["body"], foot["markers"], foot["nodes"], foot["held_by"])
                          for foot in command["footholds"]], [("gate", ["floor"], 1, None)] * 2)
        after, _, _ = support.read_su2(self.path("out.su2"))
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        for node in {n for edge in markers["floor"] for n in edge}:
            self.assertEqual(after[node][1], 0)
        slide = self.json("p.json")["commands"][0]["smooth"]["slide"]
        self.assertEqual((slide["markers"], slide["fixed"]), ([], []))
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("out.su2").read_bytes())
        self.path("out.su2").unlink()

        run = self.winslow(*arguments, "--fixed", "floor", "--save-recipe", "p.json",
                           code=INVERTED)
        self.assertIn("gate shares 2 nodes with floor, which stays (--fixed floor)", run.stderr)
        self.assertEqual(self.json("p.json")["commands"][0]["smooth"]["slide"]["fixed"], ["floor"])
        off = arguments[:-1] + ["0.1"]
        for more, words in (([], "gate shares 1 node with floor (straight line), and the motion "
                                 "takes them off it"),
                            (["--fixed", "lid"], "lid"), (["--fixed", "gate"], "and to move")):
            run = self.winslow(*off, *more, code=USAGE)
            self.assertIn(words, run.stderr)
        self.assertFalse(self.path("out.su2").exists())

    def test_spacing_is_held_as_asked_and_a_recipe_does_the_same(self):
        self.ring()
        slid = {}
        for spacing in ("free", "held"):
            run = self.winslow("move", "ring.su2", "-o", spacing + ".su2", "--marker", "body",
                               "--translate", "0.3", "0.2", "--slide", "farfield",
                               "--slide-spacing", spacing, "--report", "r.json",
                               "--save-recipe", "p.json")
            self.assertEqual("spacing of 24 held" in run.stdout, spacing == "held")
            part = self.json("r.json")["commands"][0]["sliding"][0]
            self.assertEqual((part["nodes"], part["spacing"]), (24, spacing))
            nodes, _, markers = support.read_su2(self.path(spacing + ".su2"))
            angles = [abs(math.remainder(math.atan2(*nodes[a]) - math.atan2(*nodes[b]), math.tau))
                      for a, b in markers["farfield"]]
            slid[spacing] = max(angles) / min(angles)
        self.assertAlmostEqual(slid["held"], 1, delta=1e-11)
        self.assertGreater(slid["free"], 1.02)
        self.assertEqual(self.json("p.json")["commands"][0]["smooth"]["slide"]["spacing"], "held")
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("held.su2").read_bytes())
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "5",
                           "--slide", "farfield", "--hold-spacing", "lid", code=USAGE)
        self.assertIn("does not slide", run.stderr)

    def test_corners_of_a_passage_slide_along_its_inlet_and_outlet(self):
        nodes, elements, markers = passage()
        support.write_su2(self.path("passage.su2"), nodes, elements, markers)
        arguments = ["move", "passage.su2", "-o", "out.su2", "--marker", "blade", "--translate",
                     "0", "0.5", "--periodic", "lower", "upper", "--slide", "inflow"]
        run = self.winslow(*arguments, "--slide", "outflow", "--report", "r.json")
        self.assertIn("2 corners of theirs slide", run.stdout)
        self.assertEqual(self.json("r.json")["commands"][0]["periodic"][0]["corners"], 2)
        after, _, _ = support.read_su2(self.path("out.su2"))
        for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)):
            node = nodes.index((x, y))
            self.assertEqual(after[node][0], x)
            self.assertGreater(after[node][1], y + 0.1)
        for x in (0.0, 1.0):
            self.assertAlmostEqual(after[nodes.index((x, 1.0))][1],
                                   after[nodes.index((x, 0.0))][1] + 1, delta=1e-13)

    def test_sides_of_a_passage_move_together_until_the_blade_is_where_it_is_to_be(self):
        nodes, elements, markers = passage()
        support.write_su2(self.path("passage.su2"), nodes, elements, markers)
        self.winslow("move", "passage.su2", "-o", "out.su2", "--marker", "blade", "--translate",
                     "0", "0.5", "--periodic", "lower", "upper", "--report", "r.json")
        after, _, _ = support.read_su2(self.path("out.su2"))
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        pairs = self.json("r.json")["commands"][0]["periodic"]
        self.assertEqual(pairs[0]["by"], "translation by (0, 1)")
        lower = {n for edge in markers["lower"] for n in edge}
        upper = {n for edge in markers["upper"] for n in edge}
        for node in lower:
            image = min(upper, key=lambda n: math.dist(nodes[n], (nodes[node][0],
                                                                  nodes[node][1] + 1)))
            self.assertAlmostEqual(after[image][0], after[node][0], delta=1e-13)
            self.assertAlmostEqual(after[image][1], after[node][1] + 1, delta=1e-13)
        self.assertGreater(max(after[n][1] for n in lower), 0.1)  # they gave way


def channel_with_gate():
    """A channel, 6 by 2, of square cells of 1/4 with a gate on its floor from x = 2 to 2.5."""
    ids, nodes, elements = {}, [], []

    def node(i, j):
        if (i, j) not in ids:
            ids[i, j] = len(nodes)
            nodes.append((i / 4, j / 4))
        return ids[i, j]

    gate = [(i, j) for i in (8, 9) for j in range(3)]
    for i in range(24):
        for j in range(8):
            if (i, j) not in gate:
                elements.append((node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)))
    markers = {"floor": [(ids[i, 0], ids[i + 1, 0]) for i in range(24) if i not in (8, 9)],
               "gate": [(ids[i, j], ids[i, j + 1]) for i in (8, 10) for j in range(3)] +
                       [(ids[i, 3], ids[i + 1, 3]) for i in (8, 9)],
               "rest": [(ids[i, 8], ids[i + 1, 8]) for i in range(24)] +
                       [(ids[i, j], ids[i, j + 1]) for i in (0, 24) for j in range(8)]}
    return nodes, elements, markers


def passage(n=10):
    """A square of n by n cells, of triangles, with a square blade in its middle."""
    number, nodes, elements = {}, [], []

    def node(i, j):
        if (i, j) not in number:
            number[i, j] = len(nodes)
            nodes.append((i / n, j / n))
        return number[i, j]

    solid = {(i, j) for i in range(4, 6) for j in range(4, 6)}
    for j in range(n):
        for i in range(n):
            if (i, j) not in solid:
                a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
                elements += [(a, b, c), (a, c, d)]
    markers = {"lower": [(node(i, 0), node(i + 1, 0)) for i in range(n)],
               "upper": [(node(i + 1, n), node(i, n)) for i in range(n)],
               "inflow": [(node(0, j + 1), node(0, j)) for j in range(n)],
               "outflow": [(node(n, j), node(n, j + 1)) for j in range(n)],
               "blade": [(node(4, 4), node(4, 5)), (node(4, 5), node(4, 6)),
                         (node(4, 6), node(5, 6)), (node(5, 6), node(6, 6)),
                         (node(6, 6), node(6, 5)), (node(6, 5), node(6, 4)),
                         (node(6, 4), node(5, 4)), (node(5, 4), node(4, 4))]}
    return nodes, elements, markers


if __name__ == "__main__":
    support.main()
