import math

import support
from support import INPUT, USAGE, ProgramTest


class Layers(ProgramTest):
    COUNT, FIRST, RATIO = 6, 0.004, 1.3

    def insert(self, *more, marker="body", code=support.DONE):
        return self.winslow("layers", "ring.su2", "-o", "out.su2", "--marker", marker, "--count",
                            self.COUNT, "--first", self.FIRST, "--ratio", self.RATIO, "--growth", 1,
                            "--report", "report.json", *more, code=code)

    def test_heights_are_what_was_asked(self):
        self.ring(around=32, rings=10)
        self.insert()
        before, after = support.read_su2(self.path("ring.su2")), support.read_su2(self.path("out.su2"))
        self.assertEqual(before[2], after[2])  # the markers
        for n in {n for edges in before[2].values() for edge in edges for n in edge}:
            self.assertEqual(before[0][n], after[0][n])
        self.assertEqual(len(after[1]), len(before[1]) + 32 * self.COUNT)
        radii = sorted(math.hypot(x, y) for x, y in after[0])
        expected = 0.5
        for k in range(self.COUNT + 1):  # rings of 32 nodes from the wall outwards
            for radius in radii[32 * k:32 * (k + 1)]:
                self.assertAlmostEqual(radius, expected, delta=0.01 * self.FIRST * self.RATIO**k)
            # Heights are normal to the edges of the wall, which is a polygon.
            expected += self.FIRST * self.RATIO**k / math.cos(math.pi / 32)
        layers = self.json("report.json")["layers"]
        self.assertEqual(layers["columns"], 32)
        self.assertEqual(layers["cut_short"], [])
        self.assertEqual(layers["first_height_within"]["0.01"], 1)
        self.assertLess(layers["spacing_error"]["max"], 0.01)
        self.assertLess(layers["orthogonality"]["max"], 1)

    def test_heights_and_columns_cut_short_are_printed(self):
        self.ring(around=32, rings=10)
        out = self.insert().stdout
        rows = {line[:22].strip(): line[22:].split() for line in out.splitlines() if len(line) > 22}
        self.assertEqual([float(v) for v in rows["First height"]],
                         [float(f"{self.json('report.json')['layers']['first_height'][k]:.4g}")
                          for k in ("min", "avg", "max")])
        self.assertLess(float(rows["Error of heights, %"][2]), 1)
        self.assertIn("32 columns of layers, none cut short\n", out)
        # A quarter of the ring: its columns get thinner towards the ends, which have none.
        out = self.winslow("layers", "ring.su2", "-o", "out.su2", "--first", 0.02, "--wall",
                           "body:count=6,xmin=-1e-9,ymin=-1e-9", "--report", "report.json").stdout
        cut = self.json("report.json")["layers"]["cut_short"]
        self.assertGreater(len(cut), 5)
        self.assertIn(f"columns of layers, {len(cut)} cut short\n", out)
        self.assertEqual(out.count(": no layers (end)\n"), 2)
        self.assertIn(f"  and {len(cut) - 5} more\n", out)
        self.assertNotIn("columns of layers", self.insert("--quiet").stdout)

    def assert_kept(self, before, after, corner, opposite):
        """Nodes outside the box are as they were; no element is inverted."""
        old, new = support.read_su2(before)[0], support.read_su2(self.path(after))
        outside = [n for n, p in enumerate(old)
                   if any(not low <= x <= high for low, x, high in zip(corner, p, opposite))]
        self.assertGreater(len(outside), 100)
        self.assertEqual([new[0][n] for n in outside], [old[n] for n in outside])
        self.assertGreater(support.smallest_corner_area(new[0], new[1]), 0)

    def test_outside_a_region_nothing_moves(self):
        low, high = (-0.6, -0.8), (1.6, 0.8)
        region = ["--keep-outside-corner", *low, "--keep-outside-opposite", *high]
        for name, markers, moving in (("naca0012", ["airfoil"], "airfoil"),
                                      ("three_element", ["slat", "main", "flap"], "flap")):
            with self.subTest(name):
                asset = support.ASSETS / "coarse" / f"{name}.su2"
                walls = [word for marker in markers for word in ("--marker", marker)]
                self.winslow("layers", asset, "-o", "layers.su2", *walls, "--count", 8, "--first", 1e-4,
                             *region, "--save-recipe", "p.json")
                self.assert_kept(asset, "layers.su2", low, high)
                self.winslow("layers", "layers.su2", "-o", "spaced.su2", *walls, "--respace", "--first",
                             2e-4, *region)
                self.assert_kept(self.path("layers.su2"), "spaced.su2", low, high)
                held = [word for marker in markers for word in ("--hold-layers", marker)]
                self.winslow("move", "layers.su2", "-o", "held.su2", "--marker", moving, "--rotate", -5,
                             *held, *region)
                self.assert_kept(self.path("layers.su2"), "held.su2", low, high)
                self.winslow("replay", "p.json", "-o", "again.su2")
                self.assertEqual(self.path("again.su2").read_bytes(),
                                 self.path("layers.su2").read_bytes())

    def test_a_region_that_leaves_out_a_wall_is_refused(self):
        asset = support.ASSETS / "coarse" / "three_element.su2"
        refused = self.winslow("layers", asset, "-o", "out.su2", "--marker", "main", "--marker", "flap",
                               "--first", 1e-4, "--keep-outside-corner", 0.7, -0.5,
                               "--keep-outside-opposite", 1.5, 0.5, code=USAGE)
        self.assertIn("part of the wall 'main'", refused.stderr)
        self.assertNotIn("out.su2", self.files())

    def test_a_recipe_gives_the_same_mesh(self):
        self.ring()
        self.insert("--save-recipe", "recipe.json")
        self.winslow("replay", "recipe.json", "-o", "again.su2")
        self.assertEqual(self.path("out.su2").read_bytes(), self.path("again.su2").read_bytes())

    def test_a_recipe_moves_the_body_with_its_layers(self):
        self.ring(around=32, rings=10)
        self.insert("--save-recipe", "recipe.json")
        recipe = self.json("recipe.json")
        recipe["commands"].append({"command": "move", "markers": ["body"], "rotate": 30,
                                   "translate": [0.6, 0.2]})
        self.path("recipe.json").write_text(support.json.dumps(recipe))
        self.winslow("replay", "recipe.json", "-o", "moved.su2", "--report", "moved.json")
        self.assertLess(self.json("moved.json")["layers"]["spacing_error"]["max"], 0.01)

    def test_layers_of_a_mesh_are_spaced_anew_and_held(self):
        self.ring(around=32, rings=10)
        self.insert()
        self.winslow("layers", "out.su2", "-o", "finer.su2", "--marker", "body", "--respace",
                     "--count", self.COUNT, "--first", 0.001, "--ratio", 1.4, "--growth", 1, "--report",
                     "finer.json")
        layers = self.json("finer.json")["layers"]
        self.assertAlmostEqual(layers["first_height"]["avg"], 0.001, delta=1e-5)
        self.assertLess(layers["spacing_error"]["max"], 0.01)
        self.assertEqual(len(support.read_su2(self.path("finer.su2"))[1]),
                         len(support.read_su2(self.path("out.su2"))[1]))
        out = self.winslow("move", "out.su2", "-o", "moved.su2", "--marker", "body", "--rotate", 40,
                           "--translate", 0.5, 0.2, "--hold-layers", "body", "--report",
                           "moved.json").stdout
        layers = self.json("moved.json")["layers"]
        found = next(line for line in out.splitlines() if line.startswith("Layers found: "))
        self.assertTrue(found.startswith(f"Layers found: 32 columns of {self.COUNT} rows; they end where "))
        self.assertEqual(sum(layers["ends"].values()), 32)
        self.assertEqual(layers["rows"], self.COUNT)
        self.assertEqual({c["rows"] for c in layers["found"]}, {self.COUNT})
        self.assertAlmostEqual(layers["first_height"]["min"], self.FIRST, delta=0.01 * self.FIRST)
        self.assertAlmostEqual(layers["first_height"]["max"], self.FIRST, delta=0.01 * self.FIRST)
        error = self.winslow("move", "ring.su2", "-o", "no.su2", "--marker", "body", "--rotate", 4,
                             "--hold-layers", "body", code=USAGE).stderr
        self.assertIn("the mesh has no layers at 'body': ", error)
        self.assertFalse(self.path("no.su2").exists())

    def test_walls_with_settings_of_their_own(self):
        self.ring(around=32, rings=10)
        self.winslow("layers", "ring.su2", "-o", "out.su2", "--first", 0.01, "--ratio", 1.1, "--growth",
                     1, "--wall", "body:count=3,first=0.005", "--wall", "farfield:count=2,total=0.05",
                     "--report", "report.json")
        heights = self.json("report.json")["layers"]["first_height"]
        self.assertAlmostEqual(heights["min"], 0.005, delta=1e-4)
        self.assertAlmostEqual(heights["max"], 0.01, delta=2e-4)

    def test_part_of_a_marker(self):
        self.ring(around=32, rings=10)
        self.winslow("layers", "ring.su2", "-o", "out.su2", "--first", 0.004, "--wall",
                     "body:count=4,xmin=-1e-9", "--report", "report.json", "--save-recipe", "recipe.json")
        layers = self.json("report.json")["layers"]
        self.assertEqual(layers["columns"], 17)
        self.assertEqual(layers["columns_with_layers"], 15)
        self.winslow("replay", "recipe.json", "-o", "again.su2")
        self.assertEqual(self.path("out.su2").read_bytes(), self.path("again.su2").read_bytes())

    def test_a_column_of_its_own(self):
        self.ring(around=32, rings=10)
        wall = {n for edge in support.read_su2(self.path("ring.su2"))[2]["body"] for n in edge}
        self.insert("--column", f"{min(wall)}:thickness=0.03", "--save-recipe", "recipe.json")
        thickness = self.json("report.json")["layers"]["total_thickness"]
        self.assertAlmostEqual(thickness["min"], 0.03, delta=3e-4)
        asked = self.FIRST * (self.RATIO**self.COUNT - 1) / (self.RATIO - 1)
        self.assertAlmostEqual(thickness["max"], asked, delta=0.01 * asked)
        self.winslow("replay", "recipe.json", "-o", "again.su2")
        self.assertEqual(self.path("out.su2").read_bytes(), self.path("again.su2").read_bytes())

    def test_y_plus(self):
        self.ring(around=32, rings=10)
        self.winslow("layers", "ring.su2", "-o", "out.su2", "--marker", "body", "--count", 4, "--y-plus",
                     50, "--reynolds", 1e5, "--report", "report.json")
        friction = 0.026 / 1e5 ** (1 / 7)
        self.assertAlmostEqual(self.json("report.json")["layers"]["first_height"]["avg"],
                               50 / (1e5 * math.sqrt(friction / 2)), delta=2e-5)

    def test_without_control(self):
        self.ring(quads=True)
        self.insert("--no-control")
        report = self.json("report.json")
        self.assertEqual(report["inverted"], 0)
        self.assertFalse(report["layers"]["held"])

    def test_what_is_wrong_is_said(self):
        self.ring()
        for options, words in (
                (("--marker", "bdy"), 'unknown marker "bdy"'),
                (("--marker", "body", "--count", "0"), "--count: found 0, expected 1 to 1000"),
                (("--marker", "body", "--first", "-1"), "--first: found -1, expected more than 0"),
                (("--marker", "body", "--wall", "body:count=3"), "asked for twice"),
                (("--wall", "body:height=3"), 'found "height"'),
                (("--wall", "body:xmin=77"), "no edge of marker 'body' lies in the part"),
                (("--wall", "body:count=x"), "expected a number"),
                (("--wall", "body:count=2.5"), "must be whole"),
                (("--marker", "body", "--column", "3"), "expected NODE:columns=N,thickness=T"),
                (("--marker", "body", "--column", "3:fan=1"), 'found "fan"'),
                (("--marker", "body", "--column", "3:columns=1.5"), "must be whole"),
                (("--marker", "body", "--column", "3:thickness=x"), "expected a number"),
                (("--marker", "body", "--column", "999999:columns=1"), "is on none of the walls"),
                (("--marker", "body", "--y-plus", "1"), "--reynolds"),
                ((), "no wall is given"),
                (("--marker", "body", "--first", "50"), "no room")):
            done = self.winslow("layers", "ring.su2", "-o", "out.su2", *options, code=USAGE)
            self.assertIn(words, done.stderr)
            self.assertFalse(self.path("out.su2").exists())

    def test_a_recipe_with_a_fault_is_refused(self):
        self.ring()
        self.path("bad.json").write_text(
            '{"winslow_recipe": 1, "input": "ring.su2", "output": "out.su2", "commands": '
            '[{"command": "layers", "walls": [{"markers": ["body"], "counts": 3}]}]}')
        done = self.winslow("replay", "bad.json", code=INPUT)
        self.assertIn("counts", done.stderr)


class Space(ProgramTest):
    """Prisms around the bundled sphere, of 820 triangles."""
    COUNT, FIRST, RATIO = 6, 0.004, 1.3
    COARSE = support.ASSETS / "coarse"

    def insert(self, *more, **how):
        return self.winslow("layers", self.COARSE / "sphere.su2.gz", "-o", "out.su2", "--marker", "sphere", "--count",
                            self.COUNT, "--first", self.FIRST, "--ratio", self.RATIO, "--growth", 1,
                            "--report", "report.json", *more, **how)

    def test_heights_are_what_was_asked(self):
        out = self.insert().stdout
        self.assertIn("columns of layers, none cut short\n", out)
        lines = iter(self.path("out.su2").read_text().splitlines())
        prisms, points, wall = [], [], []
        for line in lines:
            key, _, value = (part.strip() for part in line.partition("="))
            if key == "NELEM":
                rows = [list(map(int, next(lines).split())) for _ in range(int(value))]
                prisms = [row[1:7] for row in rows if row[0] == 13]
            elif key == "NPOIN":
                points = [tuple(map(float, next(lines).split()[:3])) for _ in range(int(value.split()[0]))]
            elif key == "MARKER_TAG" and value == "sphere":
                wall = [list(map(int, next(lines).split()))[1:4] for _ in range(int(next(lines).partition("=")[2]))]
        self.assertEqual(len(wall), 820)
        self.assertEqual(len(prisms), 820 * self.COUNT)
        faces = {tuple(sorted(face)) for face in wall}
        checked = 0
        for prism in prisms:
            for low, high in ((prism[:3], prism[3:]), (prism[3:], prism[:3])):
                if tuple(sorted(low)) not in faces:
                    continue
                a, b, c = (points[n] for n in low)
                u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                length = math.hypot(*normal)
                for at, to in zip(low, high):
                    height = abs(sum(n * (q - p) for n, p, q in zip(normal, points[at], points[to]))) / length
                    self.assertAlmostEqual(height, self.FIRST, delta=0.02 * self.FIRST)
                    checked += 1
        self.assertEqual(checked, 3 * 820)
        report = self.json("report.json")["layers"]
        self.assertEqual(report["first_height_within"]["0.01"], 1)
        self.assertLess(report["spacing_error"]["max"], 0.01)

    def test_they_move_with_their_wall(self):
        self.insert()
        out = self.winslow("move", "out.su2", "-o", "moved.su2", "--marker", "sphere", "--rotate", 40,
                           "--axis", 0, 0, 1).stdout
        self.assertIn("first height changed by more than 5 % at 0 % of them", out)

    def test_walls_without_room_for_columns_are_refused_with_the_place(self):
        options = self.COARSE / "wing.su2.gz", "-o", "out.su2", "--count", 5, "--first", 1e-3
        for marker, words in (("flap", "the wall turns too sharply at node "), ("flp", "did you mean flap")):
            done = self.winslow("layers", *options, "--marker", marker, code=USAGE)
            self.assertIn(words, done.stderr)
            self.assertFalse(self.path("out.su2").exists())
        done = self.insert("--respace", code=USAGE)
        self.assertIn("layers that are spaced anew: only for a plane mesh", done.stderr)


if __name__ == "__main__":
    support.main()
