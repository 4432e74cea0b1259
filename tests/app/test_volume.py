"""Volume meshes: files, motions, quality, and what says that it is for plane meshes only."""
import math
import unittest

import support
from support import HAS_GUI, INVERTED, USAGE, ProgramTest
from volume_meshes import N, write_box


def read_nodes(path):
    lines = path.read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("NPOIN="))
    count = int(lines[start].split("=")[1])
    return [tuple(map(float, line.split()[:3])) for line in lines[start + 1:start + 1 + count]]


def volume6(nodes, cell):
    a, b, c, d = (nodes[n] for n in cell)
    u, v, w = ([q[k] - a[k] for k in range(3)] for q in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
            u[2] * (v[0] * w[1] - v[1] * w[0]))


class Volume(ProgramTest):
    def setUp(self):
        super().setUp()
        self.nodes, self.cells, self.markers = write_box(self.path("box.su2"))

    def signs(self, name):
        """Whether each element of a file has the sign that it had as given."""
        after = read_nodes(self.path(name))
        return [volume6(after, c) * volume6(self.nodes, c) > 0 for c in self.cells]

    def test_a_body_turns_about_an_axis_and_all_elements_stay_valid(self):
        run = self.winslow("move", "box.su2", "-o", "o.su2", "--marker", "body", "--rotate", "40",
                           "--axis", "0", "0", "2", "--translate", "0.02", "0", "0.05", "--report",
                           "r.json")
        self.assertIn("turned about (0.5, 0.5, 0.5)", run.stdout)
        report = self.json("r.json")
        self.assertEqual(report["dimension"], 3)
        self.assertEqual(report["inverted"], 0)
        self.assertEqual(report["commands"][0]["fraction_reached"], 1)
        self.assertTrue(all(self.signs("o.su2")))
        after = read_nodes(self.path("o.su2"))
        body = {n for face in self.markers["body"] for n in face}
        angle = math.radians(40)
        for n in body:
            x, y, z = (c - 0.5 for c in self.nodes[n])
            there = (0.52 + x * math.cos(angle) - y * math.sin(angle),
                     0.5 + x * math.sin(angle) + y * math.cos(angle), 0.55 + z)
            self.assertLess(math.dist(there, after[n]), 1e-12)
        for n in {n for face in self.markers["far"] for n in face}:
            self.assertEqual(after[n], self.nodes[n])

    def test_it_ends_at_1e_4_and_a_plane_mesh_at_1e_10_unless_a_tolerance_is_given(self):
        self.winslow("scramble", "box.su2", "-o", "in.su2", "--allow-inverted", code=4)
        solves = {}
        for words, most in (((), 1e-4), (("--tolerance", "1e-10"), 1e-10)):
            self.winslow("smooth", "in.su2", "-o", "o.su2", *words, "--report", "r.json",
                         "--save-recipe", "recipe.json")
            self.assertLessEqual(self.json("r.json")["residual"], most)
            solves[most] = self.json("r.json")["commands"][0]["linear_solves"]
            given = self.json("recipe.json")["commands"][0]["smooth"].get("tolerance")
            self.assertEqual(given, most if words else None)
            self.winslow("replay", "recipe.json", "-o", "again.su2")
            self.assertEqual(self.path("o.su2").read_bytes(), self.path("again.su2").read_bytes())
        self.assertLess(solves[1e-4], solves[1e-10])
        self.winslow("scramble", self.ring(), "-o", "in.su2", "--allow-inverted", code=4)
        self.winslow("smooth", "in.su2", "-o", "o.su2", "--report", "r.json")
        self.assertLessEqual(self.json("r.json")["residual"], 1e-10)
        for command, default in (("smooth", "1e-10; volume meshes: 1e-4"),
                                 ("move", "1e-10; volume meshes: 1e-4"), ("sweep", "1e-10")):
            self.assertIn(f"--tolerance NUMBER [{default}]", self.winslow(command, "--help").stdout)

    def test_the_interior_follows_motions_that_are_smaller_than_the_tolerance(self):
        for angle in ("1e-3", "1e-6"):
            for words in ((), ("--direct",)):
                after = {}
                for name, more in (("loose.su2", ()), ("tight.su2", ("--tolerance", "1e-13"))):
                    self.winslow("move", "box.su2", "-o", name, "--marker", "body", "--rotate", angle,
                                 "--axis", "0", "0", "1", *words, *more)
                    after[name] = read_nodes(self.path(name))
                ways = [math.dist(a, b) for a, b in zip(after["tight.su2"], self.nodes)]
                off = [math.dist(a, b) for a, b in zip(after["tight.su2"], after["loose.su2"])]
                self.assertGreater(max(ways), 0.1 * math.radians(float(angle)))
                self.assertLess(max(off), 0.02 * max(ways))
                boundary = {n for faces in self.markers.values() for face in faces for n in face}
                interior = max(w for n, w in enumerate(ways) if n not in boundary)
                self.assertGreater(interior, 0.1 * max(ways))
        self.winslow("move", "box.su2", "-o", "still.su2", "--marker", "body", "--rotate", "0",
                     "--axis", "0", "0", "1")
        self.assertEqual(self.path("still.su2").read_bytes(), self.path("box.su2").read_bytes())

    def test_a_body_is_deformed_by_a_sine(self):
        self.winslow("deform", "box.su2", "-o", "o.su2", "--marker", "body", "--sine", "0.03", "0.5",
                     "--direction", "0", "0", "1", "--along", "1", "0", "0")
        self.assertTrue(all(self.signs("o.su2")))
        after = read_nodes(self.path("o.su2"))
        for n in {n for face in self.markers["body"] for n in face}:
            x, y, z = self.nodes[n]
            s = (x - 0.4) / 0.2  # the body is [0.4, 0.6] in x
            self.assertLess(math.dist(after[n], (x, y, z + 0.03 * math.sin(math.pi * s))), 1e-12)

    def test_a_table_with_three_components_moves_nodes(self):
        node = next(iter(self.markers["body"]))[0]
        place = self.nodes[node]
        for text in (f"node,dx,dy,dz\n{node},0.01,0.02,-0.03\n",
                     " ".join(map(repr, (*place, 0.01, 0.02, -0.03))) + "\n"):
            self.path("d.csv").write_text(text)
            self.winslow("deform", "box.su2", "-o", "o.su2", "--marker", "body", "--displacements",
                         "d.csv", "--save-recipe", "r.json")
            after = read_nodes(self.path("o.su2"))
            for n in {n for face in self.markers["body"] for n in face}:
                by = (0.01, 0.02, -0.03) if n == node else (0, 0, 0)
                there = tuple(c + d for c, d in zip(self.nodes[n], by))
                self.assertLess(math.dist(after[n], there), 1e-15)
            self.winslow("replay", "r.json", "-o", "again.su2")
            self.assertEqual(self.path("o.su2").read_bytes(), self.path("again.su2").read_bytes())
        self.path("d.csv").write_text(f"{node},0.01,0.02\n")
        run = self.winslow("deform", "box.su2", "-o", "p.su2", "--marker", "body", "--displacements",
                           "d.csv", code=USAGE)
        self.assertIn("has no dz", run.stderr)
        self.assertFalse(self.path("p.su2").exists())

    def test_a_motion_into_the_boundary_is_not_begun(self):
        run = self.winslow("move", "box.su2", "-o", "o.su2", "--marker", "body", "--translate", "0",
                           "0", "0.8", "--report", "r.json", code=INVERTED)
        self.assertIn("body would touch far at 50 % of the way; nothing was written", run.stderr)
        self.assertFalse(self.path("o.su2").exists())
        contact = self.json("r.json")["commands"][0]["contact"]
        self.assertEqual((contact["moving"], contact["other"]), ("body", "far"))
        self.assertAlmostEqual(contact["place"][2], 1, delta=1e-3)

    def test_a_recipe_does_the_same_again(self):
        self.winslow("move", "box.su2", "-o", "a.su2", "--marker", "body", "--rotate", "20", "--axis",
                     "1", "0", "0", "--pivot", "0.5", "0.5", "0.4", "--save-recipe", "r.json")
        self.winslow("replay", "r.json", "-o", "b.su2")
        self.assertEqual(self.path("a.su2").read_bytes(), self.path("b.su2").read_bytes())

    def test_a_tangled_mesh_is_named_and_mended(self):
        inner = next(n for n, p in enumerate(self.nodes) if p == (0.2, 0.2, 0.2))
        write_box(self.path("t.su2"), (inner, (0.9, 0.9, 0.9)))
        run = self.winslow("quality", "t.su2", code=INVERTED)
        self.assertIn("inverted", run.stdout)
        self.winslow("smooth", "t.su2", "-o", "o.su2")
        self.assertTrue(all(self.signs("o.su2")))
        run = self.winslow("quality", "o.su2")
        self.assertIn("Smallest solid angle", run.stdout)
        self.assertIn("cannot move", run.stdout)

    def test_scrambles_come_back(self):
        self.winslow("scramble", "box.su2", "-o", "s.su2", code=INVERTED)
        self.winslow("scramble", "box.su2", "-o", "s.su2", "--allow-inverted", code=INVERTED)
        self.assertFalse(all(self.signs("s.su2")))
        self.winslow("smooth", "s.su2", "-o", "o.su2", "--targets", "element")
        self.assertTrue(all(self.signs("o.su2")))

    def test_formats_keep_a_volume_mesh(self):
        self.winslow("convert", "box.su2", "a.su2", "--quiet")  # winslow's way to print numbers
        for name in ("m.msh", "m.vtu", "m.mesh", "m.ugrid"):
            self.winslow("convert", "a.su2", name, "--quiet")
            self.winslow("convert", name, "b.su2", "--quiet")
            self.assertEqual(self.path("a.su2").read_bytes(), self.path("b.su2").read_bytes(), name)

    def test_what_is_for_plane_meshes_says_so(self):
        run = self.winslow("smooth", "box.su2", "-o", "o.su2", "--keep-outside-radius", "1", code=USAGE)
        self.assertIn("give the centre of the sphere", run.stderr)
        run = self.winslow("move", "box.su2", "-o", "o.su2", "--marker", "body", "--rotate", "9",
                           code=USAGE)
        self.assertIn("a rotation in space needs an axis", run.stderr)
        plane = self.ring()
        run = self.winslow("move", plane, "-o", "o.su2", "--marker", "body", "--axis", "0", "0", "1",
                           "--rotate", "9", code=USAGE)
        self.assertIn("only for a volume mesh", run.stderr)
        self.assertFalse(self.path("o.su2").exists())

    @unittest.skipUnless(HAS_GUI, "built without pictures")
    def test_the_studio_shows_it(self):
        self.winslow("studio", "--headless", "box.su2", "--screenshot", "o.png")
        self.assertGreater(self.path("o.png").stat().st_size, 10000)


N_LAYERED = 6


def write_layered_block(path):
    """Hexahedra over a floor: rows from a height of .01 on, each 1.7 times as high as the last."""
    n = N_LAYERED
    height = [0.01 * (1.7 ** k - 1) / 0.7 for k in range(n + 1)]
    number = lambda i, j, k: (k * (n + 1) + j) * (n + 1) + i
    nodes = [(i / n, j / n, height[k]) for k in range(n + 1) for j in range(n + 1)
             for i in range(n + 1)]
    square = lambda i, j, k: [number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k),
                              number(i, j + 1, k)]
    cells = [square(i, j, k) + square(i, j, k + 1) for k in range(n) for j in range(n)
             for i in range(n)]
    floor = [square(i, j, 0)[::-1] for j in range(n) for i in range(n)]
    lid = [square(i, j, n) for j in range(n) for i in range(n)]
    sides = []
    for k in range(n):
        for i in range(n):
            for a, b in (((i, 0), (i + 1, 0)), ((i + 1, n), (i, n)), ((0, i + 1), (0, i)),
                         ((n, i), (n, i + 1))):
                sides.append([number(*a, k), number(*b, k), number(*b, k + 1), number(*a, k + 1)])
    lines = ["NDIME= 3", f"NELEM= {len(cells)}"]
    lines += ["12 " + " ".join(map(str, c)) for c in cells]
    lines += [f"NPOIN= {len(nodes)}"] + [" ".join(map(repr, p)) for p in nodes] + ["NMARK= 3"]
    for name, faces in (("floor", floor), ("lid", lid), ("sides", sides)):
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        lines += ["9 " + " ".join(map(str, f)) for f in faces]
    path.write_text("\n".join(lines) + "\n")
    return nodes


class LayersInSpace(ProgramTest):
    def setUp(self):
        super().setUp()
        self.nodes = write_layered_block(self.path("block.su2"))

    def change(self, name):
        """Largest change of the heights of the first two rows, away from the sides."""
        after, n = read_nodes(self.path(name)), N_LAYERED
        row = (n + 1) ** 2
        inner = [j * (n + 1) + i for j in range(1, n) for i in range(1, n)]
        return max(abs(math.dist(after[node + (k + 1) * row], after[node + k * row]) /
                       (self.nodes[node + (k + 1) * row][2] - self.nodes[node + k * row][2]) - 1)
                   for node in inner for k in range(2))

    def test_heights_do_not_depend_on_how_far_the_wall_is_stretched(self):
        rows = ["id,dx,dy,dz"]
        for node, (x, y, z) in enumerate(self.nodes[:(N_LAYERED + 1) ** 2]):
            rows.append(f"{node},{0.02 * math.sin(2 * math.pi * x)},"
                        f"{-0.02 * math.sin(2 * math.pi * y)},0")
        self.path("d.csv").write_text("\n".join(rows) + "\n")
        self.winslow("deform", "block.su2", "-o", "o.su2", "--marker", "floor", "--displacements",
                     "d.csv")
        self.assertLess(self.change("o.su2"), 0.01)
        self.winslow("deform", "block.su2", "-o", "o.su2", "--marker", "floor", "--displacements",
                     "d.csv", "--targets", "rest")
        self.assertGreater(self.change("o.su2"), 0.03)

    def test_heights_are_held_on_request(self):
        push = ("--marker", "lid", "--translate", "0", "0", "-0.08", "--slide", "sides",
                "--slide-features")
        self.winslow("move", "block.su2", "-o", "free.su2", *push)
        run = self.winslow("move", "block.su2", "-o", "held.su2", *push, "--hold-layers", "floor",
                           "--report", "r.json")
        self.assertIn("heights of layers held within", run.stdout)
        held = self.json("r.json")["commands"][-1]["layers_held"]
        self.assertGreater(held["heights"], 0)
        self.assertLess(held["largest_error"], 0.005)
        self.assertLess(self.change("held.su2"), 0.005)
        self.assertGreater(self.change("free.su2"), 2 * self.change("held.su2"))

    def test_walls_without_layers_and_other_targets_are_refused(self):
        write_box(self.path("box.su2"))
        run = self.winslow("move", "box.su2", "-o", "o.su2", "--marker", "body", "--translate", "0",
                           "0", "0.01", "--hold-layers", "body", code=USAGE)
        self.assertIn("there are no layers at body", run.stderr)
        run = self.winslow("move", "block.su2", "-o", "o.su2", "--marker", "lid", "--translate",
                           "0", "0", "-0.01", "--hold-layers", "floor", "--targets", "auto",
                           code=USAGE)
        self.assertIn("only the targets keep hold heights", run.stderr)
        self.assertFalse(self.path("o.su2").exists())


if __name__ == "__main__":
    support.main()
