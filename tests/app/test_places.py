"""Meshes far from the origin, and in planes of space: what is done to them is what is done near it."""
import support
from support import ProgramTest

AWAY = (1e7, -3e7)
ULP = 2.0 ** -28  # of coordinates around 3e7

# In-plane axes of planes in space: winslow's coordinates (p, q) lie at this x, y, z.
PLANES = {"x-z": lambda p, q: (p, 0.5, q),
          "y-z": lambda p, q: (-7.0, p, q),
          "x-y": lambda p, q: (p, q, 0.25)}


class FarAway(ProgramTest):
    def setUp(self):
        super().setUp()
        nodes, self.elements, self.markers = support.ring_mesh()
        self.far = [(x + AWAY[0], y + AWAY[1]) for x, y in nodes]
        # The same numbers in binary near the origin.
        self.near = [(x - AWAY[0], y - AWAY[1]) for x, y in self.far]
        support.write_su2(self.path("near.su2"), self.near, self.elements, self.markers)
        support.write_su2(self.path("far.su2"), self.far, self.elements, self.markers)

    def check_same(self, command, *options, far=()):
        results = {}
        for name in ("near", "far"):
            self.winslow(command, f"{name}.su2", "-o", f"{name}_out.su2", "--report", "r.json",
                         *(far or options if name == "far" else options))
            report = self.json("r.json")
            results[name] = ([report[k] for k in ("outer_iterations", "linear_solves", "converged")],
                             support.read_su2(self.path(f"{name}_out.su2"))[0])
        self.assertEqual(results["near"][0], results["far"][0])
        for a, b in zip(results["near"][1], results["far"][1], strict=True):
            for k in (0, 1):
                self.assertLess(abs(b[k] - AWAY[k] - a[k]), 2 * ULP)
        for node, _ in self.markers["farfield"]:
            self.assertEqual(results["far"][1][node], self.far[node])

    def test_commands_take_the_same_steps_to_the_same_mesh(self):
        self.check_same("smooth")
        self.check_same("smooth", "--formulation", "pointwise", "--outer", "picard")
        self.check_same("move", "--marker", "body", "--rotate", "50", "--translate", "0.3", "0.1")
        self.check_same("move", "--marker", "body", "--rotate", "20", "--pivot", "0.5", "0.25",
                        far=("--marker", "body", "--rotate", "20", "--pivot", "10000000.5", "-29999999.75"))
        self.check_same("deform", "--marker", "body", "--sine", "0.05", "2")
        self.check_same("layers", "--marker", "body", "--count", "4", "--first", "0.01")

    def test_places_are_said_in_as_many_digits_as_they_have(self):
        run = self.winslow("quality", "far.su2")
        self.assertRegex(run.stdout, r"\(1000000\d\.\d+, -\d{8}\.\d+\)")
        run = self.winslow("move", "far.su2", "-o", "o.su2", "--marker", "body", "--rotate", "5")
        self.assertIn("turned about (10000000, -30000000)", run.stdout)


class Planes(ProgramTest):
    def write_vtk(self, name, place):
        """The ring in a plane of space, its markers as winslow writes them."""
        self.winslow("convert", self.ring(), "plane.vtk", "--quiet")
        lines = self.path("plane.vtk").read_text().splitlines()
        at = next(k for k, line in enumerate(lines) if line.startswith("POINTS"))
        for k in range(at + 1, at + 1 + int(lines[at].split()[1])):
            p, q, _ = map(float, lines[k].split())
            lines[k] = " ".join(map(repr, place(p, q)))
        self.path(name).write_text("\n".join(lines) + "\n")
        return name

    def points(self, name):
        lines = self.path(name).read_text().splitlines()
        at = next(k for k, line in enumerate(lines) if line.startswith("POINTS"))
        return [tuple(map(float, line.split())) for line in lines[at + 1:at + 1 + int(lines[at].split()[1])]]

    def test_a_body_turns_and_moves_in_the_axes_of_its_plane(self):
        move = ("--marker", "body", "--rotate", "30", "--pivot", "0.5", "0", "--translate", "0.2", "-0.1")
        self.ring()
        self.winslow("move", "ring.su2", "-o", "flat.su2", *move)
        flat, _, markers = support.read_su2(self.path("flat.su2"))
        rim = {n for edge in markers["farfield"] for n in edge}
        for plane, place in PLANES.items():
            self.write_vtk("in.vtk", place)
            run = self.winslow("move", "in.vtk", "-o", "out.vtk", *move)
            if plane == "x-y":
                self.assertEqual(run.stderr, "")
            else:
                self.assertIn(f"its coordinates are ({plane[0]}, {plane[2]})", run.stderr)
            before, after = self.points("in.vtk"), self.points("out.vtk")
            # The same numbers as in x and y, so the same bits.
            self.assertEqual(after, [place(*p) for p in flat])
            for node in rim:
                self.assertEqual(after[node], before[node])

    def test_a_plane_seen_from_behind_comes_back_as_it_was(self):
        self.write_vtk("in.vtk", lambda p, q: (q, 0.5, p))
        run = self.winslow("smooth", "in.vtk", "-o", "out.vtk", "--max-iterations", "100")
        self.assertIn("the plane y = 0.5", run.stderr)
        self.assertNotIn("clockwise", run.stderr)
        self.winslow("quality", "in.vtk", "--report", "r.json")
        self.assertEqual(self.json("r.json")["inverted"], 0)
        cells = lambda name: self.path(name).read_text().split("CELL_TYPES")[0].split("CELLS")[1]
        self.assertEqual(cells("out.vtk"), cells("in.vtk"))
        self.assertEqual({p[1] for p in self.points("out.vtk")}, {0.5})

    def test_layers_are_inserted_in_the_plane(self):
        self.write_vtk("in.vtk", PLANES["x-z"])
        self.winslow("layers", "in.vtk", "-o", "out.vtk", "--marker", "body", "--count", "3", "--first", "0.02")
        self.assertGreater(len(self.points("out.vtk")), len(self.points("in.vtk")))
        self.assertEqual({p[1] for p in self.points("out.vtk")}, {0.5})

    def test_a_tilted_plane(self):
        self.write_vtk("in.vtk", lambda p, q: (0.6 * p - 2, q, 0.8 * p + 1))
        run = self.winslow("move", "in.vtk", "-o", "out.vtk", "--marker", "body", "--rotate", "45")
        self.assertIn("turned about", run.stdout)
        for x, _, z in self.points("out.vtk"):
            self.assertLess(abs(0.8 * (x + 2) - 0.6 * (z - 1)), 1e-14)

    def test_su2_takes_the_coordinates_in_the_plane(self):
        self.write_vtk("in.vtk", PLANES["x-z"])
        run = self.winslow("convert", "in.vtk", "out.su2")
        self.assertIn("where the plane lies is lost", run.stderr)
        self.assertEqual(support.read_su2(self.path("out.su2"))[0], support.read_su2(self.path("ring.su2"))[0])

    def test_a_surface_that_is_bent_is_smoothed_on_its_shape(self):
        self.write_vtk("in.vtk", lambda p, q: (p, 0.1 * p * p, q))
        self.winslow("smooth", "in.vtk", "-o", "out.vtk")
        before, after = self.points("in.vtk"), self.points("out.vtk")
        self.assertGreater(max(abs(p[0] - q[0]) for p, q in zip(before, after)), 0.01)
        for x, y, _ in after:
            self.assertLess(abs(y - 0.1 * x * x), 5e-3)


if __name__ == "__main__":
    support.main()
