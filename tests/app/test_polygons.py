import polygon_meshes as polygons
import support
from support import HAS_GUI, INPUT, USAGE, ProgramTest, read_su2


class Polygons(ProgramTest):
    """Meshes of polygons: the dual of a mesh around an aerofoil, and a Voronoi-like one."""

    def write_dual(self, name, asset="coarse/naca0012.su2", voronoi=False):
        nodes, elements, markers = read_su2(support.ASSETS / asset)
        mesh = polygons.dual(nodes, elements, markers, voronoi)
        polygons.write_vtk(self.path(name), *mesh)
        return mesh, list(markers)

    def body(self, markers):
        return next(name for name in markers if "far" not in name.lower())

    def check_sound(self, name):
        nodes, cells = polygons.read_vtk(self.path(name))
        wrong = [c for c in cells if not polygons.is_sound([nodes[k] for k in c])]
        self.assertEqual(wrong, [])
        return nodes

    def test_an_aerofoil_turns_there_and_back(self):
        for voronoi in (False, True):
            (nodes, _, _), markers = self.write_dual("dual.vtk", voronoi=voronoi)
            self.check_sound("dual.vtk")
            body = self.body(markers)
            turn = ("--marker", body, "--pivot", "0.25", "0")
            self.winslow("move", "dual.vtk", "-o", "there.vtk", *turn, "--rotate", "15", "--report", "r.json")
            self.assertEqual(self.json("r.json")["inverted"], 0)
            there = self.check_sound("there.vtk")
            self.assertGreater(polygons.distance(nodes, there), 0.1)
            self.winslow("move", "there.vtk", "-o", "back.vtk", *turn, "--rotate", "-15",
                         "--reference-mesh", "dual.vtk", "--report", "r.json")
            back = self.check_sound("back.vtk")
            self.assertLess(polygons.distance(nodes, back), 1e-4)

    def test_smoothing_with_every_kind_of_targets(self):
        self.write_dual("dual.vtk")
        for targets in ("auto", "element", "vcv", "rest", "keep"):
            self.winslow("smooth", "dual.vtk", "-o", "out.vtk", "--targets", targets, "--report", "r.json")
            self.assertEqual(self.json("r.json")["inverted"], 0, targets)
            self.check_sound("out.vtk")

    def test_scrambled_polygons_are_untangled(self):
        self.write_dual("dual.vtk")
        self.winslow("scramble", "dual.vtk", "-o", "tangled.vtk", "--allow-inverted", "--seed", "3",
                     code=support.INVERTED)
        self.winslow("smooth", "tangled.vtk", "-o", "out.vtk", "--targets", "element", "--report", "r.json")
        self.assertEqual(self.json("r.json")["inverted"], 0)
        self.check_sound("out.vtk")

    def test_quality_counts_and_lists_polygons(self):
        (_, cells, _), _ = self.write_dual("dual.vtk")
        told = self.winslow("quality", "dual.vtk", "--report", "q.json")
        report = self.json("q.json")
        self.assertEqual(report["elements"], len(cells))
        self.assertEqual(report["inverted"], 0)
        self.assertIn("0 inverted", told.stdout)

    def test_other_formats_refuse_polygons_by_name(self):
        self.write_dual("dual.vtk")
        for name in ("out.su2", "out.msh"):
            run = self.winslow("convert", "dual.vtk", name, code=USAGE)
            self.assertIn("polygons of this mesh", run.stderr)
            self.assertFalse(self.path(name).exists())
        for name in ("out.vtu", "out.obj", "out.off", "out.ply"):
            self.winslow("convert", "dual.vtk", name)
            self.winslow("quality", name)

    def test_a_surface_of_polygons_is_refused(self):
        self.path("bent.obj").write_text("v 0 0 0\nv 2 0 0\nv 2 2 1\nv 1 3 0\nv 0 2 0\nf 1 2 3 4 5\n")
        run = self.winslow("quality", "bent.obj", code=INPUT)
        self.assertIn("bent.obj:6:", run.stderr)
        self.assertIn("cut its polygons into triangles", run.stderr)

    def test_layers_below_polygons_are_refused(self):
        _, markers = self.write_dual("dual.vtk")
        run = self.winslow("layers", "dual.vtk", "-o", "out.vtk", "--marker", self.body(markers),
                           "--count", "3", "--first", "0.002", code=USAGE)
        self.assertIn("at the wall is a polygon; layers are inserted beneath triangles", run.stderr)
        self.assertFalse(self.path("out.vtk").exists())

    def test_pictures(self):
        if not HAS_GUI:
            self.skipTest("built without pictures")
        self.write_dual("dual.vtk")
        for name in ("out.svg", "out.png"):
            self.winslow("render", "dual.vtk", "-o", name, "--color", "normalized_jacobian")
            self.assertGreater(self.path(name).stat().st_size, 10000)


if __name__ == "__main__":
    support.main()
