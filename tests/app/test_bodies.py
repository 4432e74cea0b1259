"""Bodies that move together, each by a motion of its own: --body."""
import math
import re

import support
from support import ASSETS, INVERTED, USAGE, ProgramTest
from test_volume import read_nodes
from volume_meshes import write_box

WING = ASSETS / "coarse" / "three_element.su2"


def nodes_of(edges):
    return {n for edge in edges for n in edge}


class Bodies(ProgramTest):
    def move(self, *words, mesh=WING, code=support.DONE):
        return self.winslow("move", mesh, "-o", "out.su2", *words, code=code)

    def split_ring(self):
        """A ring whose body is of two markers, which share two nodes."""
        nodes, elements, markers = support.ring_mesh()
        body = markers.pop("body")
        markers.update(upper=body[:len(body) // 2], lower=body[len(body) // 2:])
        support.write_su2(self.path("split.su2"), nodes, elements, markers)
        return "split.su2"

    def test_each_body_goes_where_its_own_motion_takes_it(self):
        run = self.move("--body", "slat", "rotate=5", "translate=-.01,-0.02", "--body", "flap",
                        "rotate=-20", "pivot=0.848,-0.036", "--report", "r.json", "--save-recipe",
                        "p.json")
        before, elements, markers = support.read_su2(WING)
        after, elements_after, _ = support.read_su2(self.path("out.su2"))
        self.assertEqual(elements_after, elements)
        slat = [before[n] for n in nodes_of(markers["slat"])]
        centre = [0.5 * (min(p[k] for p in slat) + max(p[k] for p in slat)) for k in range(2)]
        ways = {"slat": (5, centre, (-0.01, -0.02)), "flap": (-20, (0.848, -0.036), (0, 0)),
                "main": (0, (0, 0), (0, 0)), "farfield": (0, (0, 0), (0, 0))}
        for name, way in ways.items():
            for node in nodes_of(markers[name]):
                self.assertLess(math.dist(after[node], support.rotated(before[node], *way)), 1e-12)
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        self.assertIn("slat turned about (0.020", run.stdout)
        self.assertIn("flap turned about (0.848, -0.036)", run.stdout)
        pivots = self.json("r.json")["commands"][0]["pivots"]
        self.assertEqual([p["markers"] for p in pivots], [["slat"], ["flap"]])
        self.assertEqual(pivots[1]["pivot"], [0.848, -0.036])
        # The recipe says the same.
        bodies = self.json("p.json")["commands"][0]["bodies"]
        self.assertEqual(bodies[0], {"markers": ["slat"], "rotate": 5, "translate": [-0.01, -0.02]})
        self.assertEqual(bodies[1], {"markers": ["flap"], "rotate": -20, "pivot": [0.848, -0.036],
                                     "translate": [0, 0]})
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_text(), self.path("out.su2").read_text())

    def test_one_body_is_what_the_options_of_one_body_say(self):
        self.ring()
        self.move("--body", "body,farfield", "rotate=10", "pivot=0.5,-.25", "translate=0.1,0",
                  "--save-recipe", "p.json", mesh="ring.su2")
        listed = self.path("out.su2").read_text()
        self.move("--marker", "body", "--marker", "farfield", "--rotate", "10", "--pivot", "0.5",
                  "-.25", "--translate", "0.1", "0", "--save-recipe", "q.json", mesh="ring.su2")
        self.assertEqual(self.path("out.su2").read_text(), listed)
        self.assertEqual(self.json("p.json")["commands"], self.json("q.json")["commands"])

    def test_the_mesh_may_come_last(self):
        self.ring()
        self.winslow("move", "-o", "out.su2", "--body", "body", "rotate=5", "ring.su2")
        self.assertIn("out.su2", self.files())

    def test_contact_between_moving_bodies_is_looked_for_on_their_common_way(self):
        run = self.move("--body", "main", "translate=0.2,0", "--body", "flap", "translate=-0.2,0",
                        "--report", "r.json", code=INVERTED)
        self.assertIn("main would touch flap at 74.2 % of the way; nothing was written", run.stderr)
        contact = self.json("r.json")["commands"][0]["contact"]
        self.assertEqual({contact["moving"], contact["other"]}, {"main", "flap"})
        self.assertNotIn("out.su2", self.files())
        # Side by side they never meet, however far they go.
        self.move("--body", "main", "translate=0.2,0", "--body", "flap", "translate=0.2,0", "--body",
                  "slat", "translate=0.2,0")

    def test_markers_that_share_nodes_may_not_be_torn_apart(self):
        mesh = self.split_ring()
        run = self.move("--body", "upper", "rotate=5", "--body", "lower", "rotate=-5", mesh=mesh,
                        code=USAGE)
        self.assertRegex(run.stderr, r"the markers upper and lower share node \d+, which their motions "
                         r"take to different places, [\d.e-]+ apart: make them one body")
        self.assertEqual(self.files(), ["split.su2"])
        # Together they are one body.
        self.move("--body", "upper", "rotate=5", "pivot=0,0", "--body", "lower", "rotate=5", "pivot=0,0",
                  mesh=mesh)
        together = support.read_su2(self.path("out.su2"))[0]
        self.move("--body", "upper,lower", "rotate=5", "pivot=0,0", mesh=mesh)
        for a, b in zip(together, support.read_su2(self.path("out.su2"))[0]):
            self.assertLess(math.dist(a, b), 1e-9)

    def test_a_marker_belongs_to_one_body(self):
        self.ring()
        run = self.move("--body", "body", "rotate=5", "--body", "farfield,body", "rotate=5",
                        mesh="ring.su2", code=USAGE)
        self.assertIn("the marker body belongs to two of the bodies", run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_what_is_wrong_is_named(self):
        self.ring()
        keys = "rotate, axis, pivot, translate"
        for words, message in (
                (["--body"], "--body"),
                (["--body", "body"], "--body body: nothing to do: give rotate=DEG, translate=DX,DY, or both"),
                (["--body", "body", "pivot=0,0"], "--body body: nothing to do"),
                (["--body", "rotate=5"], "expected the name of a marker before it: --body NAME rotate=5"),
                (["--body", ""], "--body: expected NAME[,NAME...] KEY=VALUE..."),
                (["--body", "", "rotate=5"], "expected the name of a marker before it: --body NAME rotate=5"),
                (["--body", "body", "rotate=5", "--body", "", "rotate=5"], "--body NAME rotate=5"),
                (["--body", "body,", "rotate=5"], "--body body,: found an empty name"),
                (["--body", "body,body", "rotate=5"], "--body body,body: names body twice"),
                (["--body", "body", "rotat=5"],
                 f'--body body: found the key "rotat", expected one of {keys}; did you mean rotate?'),
                (["--body", "body", "spin=5"], f'found the key "spin", expected one of {keys}\n'),
                (["--body", "body", "rotate", "5"],
                 f'--body body: found "rotate", expected KEY=VALUE with a key of {keys}'),
                (["--body", "body", "rotate=5", "more.su2", "other.su2"], "the mesh IN goes before --body"),
                (["--body", "body", "rotate=fast"], '--body body rotate: found "fast", expected a number'),
                (["--body", "body", "rotate="], '--body body rotate: found "", expected a number'),
                (["--body", "body", "rotate=nan"], "--body body rotate: found nan, expected a finite number"),
                (["--body", "body", "rotate=1,2"], "found 2 numbers, expected one: rotate=NUMBER"),
                (["--body", "body", "rotate=1", "rotate=2"], "--body body: gives rotate twice"),
                (["--body", "body", "translate=1"],
                 "--body body translate: found 1 number, expected two, in space three: translate=X,Y or"),
                (["--body", "body", "rotate=1", "pivot=1,,2"], "numbers with commas between them and no spaces"),
                (["--body", "body", "rotate=1", "axis=0,1"],
                 "--body body axis: found 2 numbers, expected three: axis=X,Y,Z"),
                (["--body", "body", "rotate=1", "axis=0,0,1"], "axis"),
                (["--body", "bodi", "rotate=1"], 'unknown marker "bodi"; did you mean body?'),
                (["--marker", "body", "--rotate", "5", "--pivot", "1", "2", "--body", "farfield", "rotate=3"],
                 "found --body together with --marker, --rotate, --pivot, which are of a single body: "
                 'expected "--body body rotate=5 pivot=1,2" in their place'),
                (["--body", "body", "rotate=3", "--translate", "1", "-2"],
                 'expected "--body NAME translate=1,-2" in their place'),
                (["--rotate", "3"], "--body NAME rotate=DEG")):
            with self.subTest(words=words):
                run = self.winslow("move", "ring.su2", "-o", "out.su2", *words, code=USAGE)
                self.assertIn(message, run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_every_option_of_a_motion_is_a_key(self):
        write_box(self.path("box.su2"))
        table = self.winslow("reference", "rigid").stdout
        keys = re.findall(r"^\| `--\w+` \| `(\w+)` \|", table, re.M)
        self.assertIn("rotate", keys)
        # A key that is not here is new: it has to be one of --body, too.
        values = {"rotate": "0", "axis": "0,1,0", "pivot": "1,2,3", "translate": "0,0,0"}
        self.move("--body", "body", *(f"{key}={values[key]}" for key in keys), "--save-recipe", "p.json",
                  mesh="box.su2")
        body = self.json("p.json")["commands"][0]
        self.assertEqual((body["axis"], body["pivot"]), ([0, 1, 0], [1, 2, 3]))

    def test_bodies_of_a_volume_mesh(self):
        nodes, _, markers = write_box(self.path("box.su2"))
        self.move("--body", "body", "rotate=20", "axis=0,0,2", "translate=0.02,0,0.05", "--body", "far",
                  "rotate=20", "axis=0,0,1", "--save-recipe", "p.json", mesh="box.su2")
        after = read_nodes(self.path("out.su2"))
        for name, shift in (("body", (0.02, 0, 0.05)), ("far", (0, 0, 0))):
            for n in nodes_of(markers[name]):
                there = support.rotated(nodes[n], 20, (0.5, 0.5), shift)
                self.assertLess(math.dist((*there, nodes[n][2] + shift[2]), after[n]), 1e-12)
        body = self.json("p.json")["commands"][0]["bodies"][0]
        self.assertEqual((body["axis"], body["translate"]), ([0, 0, 2], [0.02, 0, 0.05]))
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_text(), self.path("out.su2").read_text())
        run = self.move("--body", "body", "rotate=20", mesh="box.su2", code=USAGE)
        self.assertIn("axis", run.stderr)

    def test_films_show_each_body_on_its_own_arc(self):
        if not support.HAS_GUI:
            self.skipTest("the program cannot draw")
        self.move("--body", "slat", "rotate=5", "--body", "flap", "rotate=-10", "--save-recipe", "p.json")
        self.winslow("render", WING, "--recipe", "p.json", "--frames", "film", "--per-command", "2", "--size",
                     "160", "120")
        self.assertGreaterEqual(len(list(self.path("film").iterdir())), 3)


if __name__ == "__main__":
    support.main()
