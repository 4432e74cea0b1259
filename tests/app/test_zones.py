"""Files of several zones (SU2: NZONE=)."""
import json
import unittest

import support
from support import HAS_GUI, INPUT, INVERTED, USAGE, ProgramTest


class Zones(ProgramTest):
    def setUp(self):
        super().setUp()
        blocks = []
        for number, (inner, names) in enumerate(((0.5, ("body", "far")), (0.7, ("body", "rim")),
                                                 (0.6, ("hub", "shroud"))), 1):
            nodes, elements, markers = support.ring_mesh(inner=inner)
            nodes[100] = (nodes[100][0] + 0.03, nodes[100][1])  # something to smooth
            markers = dict(zip(names, markers.values()))
            support.write_su2(self.path("one.su2"), nodes, elements, markers)
            blocks.append(f"IZONE= {number}\n" + self.path("one.su2").read_text())
        self.path("one.su2").unlink()
        blocks[2] += "FFD_NBOX=   0  % none\n"
        self.path("z.su2").write_text("% three rings\nNZONE= 3\n" + "".join(blocks))
        self.winslow("convert", "z.su2", "z.su2", "--quiet")  # winslow's way to print numbers

    def blocks(self, name):
        """What stands before the first zone, then the zones."""
        head, *zones = self.path(name).read_text().split("IZONE= ")
        return [head, *zones]

    def changed(self, name):
        """Numbers of the zones that differ from those of the source; 0: what is before them."""
        before, after = self.blocks("z.su2"), self.blocks(name)
        self.assertEqual(len(before), len(after))
        return [k for k, (a, b) in enumerate(zip(before, after)) if a != b]

    def test_all_zones_are_smoothed_or_one(self):
        run = self.winslow("smooth", "z.su2", "-o", "o.su2", "--report", "r.json")
        self.assertEqual(self.changed("o.su2"), [1, 2, 3])
        self.assertIn("zone 3: Smooth: converged", run.stdout)
        report = self.json("r.json")
        self.assertEqual([z["zone"] for z in report["zones"]], [1, 2, 3])
        self.assertEqual(report["nodes"], 3 * report["zones"][0]["nodes"])
        self.assertEqual([c["zone"] for c in report["commands"]], [1, 2, 3])
        self.winslow("smooth", "z.su2", "-o", "o.su2", "--zone", "2")
        self.assertEqual(self.changed("o.su2"), [2])

    def test_a_motion_moves_the_zones_that_have_the_marker(self):
        move = ("move", "z.su2", "-o", "o.su2", "--translate", "0.1", "0")
        for markers, zones in ((("body",), [1, 2]), (("shroud",), [3]), (("rim", "shroud"), [2, 3])):
            flags = [word for name in markers for word in ("--marker", name)]
            self.winslow(*move, *flags)
            self.assertEqual(self.changed("o.su2"), zones)
        self.winslow(*move, "--marker", "body", "--zone", "2")
        self.assertEqual(self.changed("o.su2"), [2])
        run = self.winslow(*move, "--marker", "shrod", code=USAGE)
        self.assertIn("did you mean shroud?", run.stderr)
        self.winslow(*move, "--marker", "body", "--zone", "3", code=USAGE)
        run = self.winslow(*move, "--marker", "body", "--zone", "4", code=USAGE)
        self.assertIn("no zone 4 in the file, expected one of 1, 2, 3", run.stderr)

    def test_bodies_of_several_zones_turn_as_one(self):
        """Not given, the pivot is the centre of all of them, where the command before left them."""
        blocks = []
        for number, (name, dx) in enumerate((("left", 0.0), ("right", 20.0)), 1):
            nodes, elements, markers = support.ring_mesh()
            nodes = [(x + dx, y) for x, y in nodes]
            markers = {name: markers["body"], f"far_{name}": markers["farfield"]}
            support.write_su2(self.path("one.su2"), nodes, elements, markers)
            blocks.append(f"IZONE= {number}\n" + self.path("one.su2").read_text())
        self.path("two.su2").write_text("NZONE= 2\n" + "".join(blocks))
        both = {"command": "move", "markers": ["left", "right"]}
        self.path("p.json").write_text(json.dumps({"winslow_recipe": 1, "commands": [
            {**both, "translate": [0.0, 0.5]}, {**both, "rotate": 2}]}))
        run = self.winslow("replay", "p.json", "--input", "two.su2", "-o", "o.su2", "--report",
                           "r.json")
        self.assertEqual(run.stdout.count("turned about (10, 0.5)"), 2)
        commands = self.json("r.json")["commands"]
        self.assertEqual([c["zone"] for c in commands], [1, 1, 2, 2])
        self.assertEqual([c.get("pivot") for c in commands], [None, [10, 0.5], None, [10, 0.5]])
        for zone, dx in ((1, 0.0), (2, 20.0)):
            self.winslow("convert", "o.su2", "z.su2", "--zone", zone, "--quiet")
            after, _, _ = support.read_su2(self.path("z.su2"))
            expected = support.rotated((0.5 + dx, 0.5), 2, (10, 0.5))
            self.assertAlmostEqual(after[0][0], expected[0], delta=1e-12)
            self.assertAlmostEqual(after[0][1], expected[1], delta=1e-12)

    def test_numbers_of_nodes_need_a_zone_where_several_could_be_meant(self):
        self.path("d.csv").write_text("0,0.05,0\n")
        deform = ("deform", "z.su2", "-o", "o.su2", "--displacements", "d.csv", "--marker")
        self.assertIn("--zone N", self.winslow(*deform, "body", code=USAGE).stderr)
        self.winslow(*deform, "body", "--zone", "1")
        self.assertEqual(self.changed("o.su2"), [1])
        self.winslow(*deform, "hub")
        self.assertEqual(self.changed("o.su2"), [3])

    def test_all_or_nothing(self):
        """A zone that comes out inverted keeps the others from being written, too."""
        self.winslow("scramble", "z.su2", "-o", "o.su2", code=INVERTED)
        self.assertNotIn("o.su2", self.files())
        broken = self.path("z.su2").read_text().replace("IZONE= 3\nNDIME= 2", "IZONE= 3\nNDIME= 4")
        self.path("b.su2").write_text(broken)
        run = self.winslow("smooth", "b.su2", "-o", "o.su2", code=INPUT)
        self.assertIn("found NDIME= 4", run.stderr)
        self.winslow("smooth", "b.su2", "-o", "o.su2", "--zone", "1")

    def test_quality_tells_of_every_zone(self):
        run = self.winslow("quality", "z.su2", "--report", "r.json")
        for number in (1, 2, 3):
            self.assertIn(f"zone {number}\n", run.stdout)
        self.assertEqual(len(self.json("r.json")["zones"]), 3)
        run = self.winslow("quality", "z.su2", "--zone", "2", "--report", "r.json")
        self.assertNotIn("zone 1\n", run.stdout)
        self.assertIn("quality", self.json("r.json"))

    def test_convert_keeps_all_zones_or_takes_one_out(self):
        self.winslow("convert", "z.su2", "o.su2")
        self.assertEqual(self.path("o.su2").read_bytes(), self.path("z.su2").read_bytes())
        self.assertIn("--zone N", self.winslow("convert", "z.su2", "o.vtu", code=USAGE).stderr)
        self.winslow("smooth", "z.su2", "-o", "o.vtu", code=USAGE)
        self.assertNotIn("o.vtu", self.files())
        run = self.winslow("convert", "z.su2", "o.vtu", "--zone", "3")
        self.assertEqual(run.stderr.count("zone"), 1)  # FFD_NBOX is not understood
        self.winslow("convert", "z.su2", "o.su2", "--zone", "3")
        self.assertNotIn("ZONE", self.path("o.su2").read_text())
        self.assertEqual(list(support.read_su2(self.path("o.su2"))[2]), ["hub", "shroud"])

    def test_a_recipe_keeps_the_zone(self):
        self.winslow("smooth", "z.su2", "-o", "o.su2", "--zone", "2", "--save-recipe", "r.json")
        self.path("o.su2").unlink()
        self.winslow("replay", "r.json")
        self.assertEqual(self.changed("o.su2"), [2])
        self.winslow("replay", "r.json", "--zone", "3")
        self.assertEqual(self.changed("o.su2"), [3])

    @unittest.skipUnless(HAS_GUI, "without graphics")
    def test_a_picture_shows_one_zone_and_says_that_there_are_more(self):
        run = self.winslow("render", "z.su2", "-o", "p.png")
        self.assertIn("has 3 zones (1, 2, 3); this is zone 1, --zone N opens another", run.stderr)
        self.winslow("render", "z.su2", "-o", "q.png", "--zone", "2")
        self.assertNotEqual(self.path("p.png").read_bytes(), self.path("q.png").read_bytes())
        run = self.winslow("studio", "z.su2", "--headless", "--screenshot", "s.png")
        self.assertIn("--zone N opens another", run.stderr)
        run = self.winslow("studio", "z.su2", "--headless", "--screenshot", "t.png", "--zone", "3")
        self.assertNotIn("--zone N", run.stderr)


if __name__ == "__main__":
    support.main()
