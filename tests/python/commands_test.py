"""The commands of the Python package against those of the program."""

import numpy as np

import winslow
from support import ASSETS, PackageTest, main, ring

COARSE = ASSETS / "coarse" / "three_element.su2"


class LikeTheProgram(PackageTest):
    """The same command gives the same bits."""

    def same(self, result, *arguments):
        self.program(*arguments, "-o", "out.su2", "--quiet")
        expected = winslow.read(self.folder / "out.su2")
        self.assert_same(result.mesh.points, expected.points)
        self.assertEqual(result.mesh.element_count, expected.element_count)

    def test_move(self):
        self.same(winslow.move(COARSE, "flap", rotate=-15, pivot=(0.86, -0.02), translate=[0.01, 0]),
                  "move", COARSE, "--marker", "flap", "--rotate", -15, "--pivot", 0.86, -0.02, "--translate", 0.01, 0)

    def test_bodies_and_options(self):
        bodies = [{"markers": "slat", "rotate": 5}, {"markers": ["flap"], "rotate": -10, "pivot": (0.86, -0.02)}]
        self.same(winslow.move(COARSE, bodies=bodies, slide="farfield", exponent=4, linear="direct"),
                  "move", COARSE, "--body", "slat", "rotate=5", "--body", "flap", "rotate=-10", "pivot=0.86,-0.02",
                  "--slide", "farfield", "--exponent", 4, "--linear", "direct")

    def test_smooth_with_shares(self):
        self.same(winslow.smooth(COARSE, targets={"element": 0.7, "rest": 0.3}),
                  "smooth", COARSE, "--targets", "element=0.7", "rest=0.3")

    def test_deform(self):
        self.same(winslow.deform(COARSE, "main", sine={"amplitude": 0.01, "waves": 1, "fade": "both"}),
                  "deform", COARSE, "--marker", "main", "--sine", 0.01, 1, "--fade", "both")

    def test_deform_by_rows(self):
        mesh = winslow.read(COARSE)
        nodes = mesh.markers["flap"]
        shift = np.tile([0.002, -0.004], (len(nodes), 1))
        rows = "".join(f"{n},{x!r},{y!r}\n" for n, (x, y) in zip(nodes, shift.tolist()))
        (self.folder / "d.csv").write_text("node,dx,dy\n" + rows)
        result = winslow.deform(mesh, "flap", displacements=shift)
        self.same(result, "deform", COARSE, "--marker", "flap", "--displacements", "d.csv")
        by_file = winslow.deform(mesh, "flap", displacements=self.folder / "d.csv")
        self.assert_same(by_file.mesh.points, result.mesh.points)
        whole = np.zeros_like(mesh.points)
        whole[nodes] = shift
        self.assert_same(winslow.deform(mesh, "flap", displacements=whole).mesh.points, result.mesh.points)
        by_ids = winslow.deform(mesh, nodes=nodes, positions=mesh.points[nodes] + shift)
        self.assert_same(by_ids.mesh.points[nodes], mesh.points[nodes] + shift)

    def test_layers(self):
        mesh = ASSETS / "coarse" / "naca0012.su2"
        result = winslow.layers(mesh, "airfoil", count=5, first=1e-3, ratio=1.2)
        self.same(result, "layers", mesh, "--marker", "airfoil", "--count", 5, "--first", 1e-3, "--ratio", 1.2)
        self.assertIn("quad", result.mesh.cells)
        walls = [{"markers": "airfoil", "first": 2e-3}]
        self.same(winslow.layers(mesh, walls=walls, columns={0: {"columns": 1}}, count=4, ratio=1.3),
                  "layers", mesh, "--wall", "airfoil:first=2e-3", "--count", 4, "--ratio", 1.3,
                  "--column", "0:columns=1")
        self.same(winslow.layers(mesh, "airfoil", y_plus=50, reynolds=1e6, count=3),
                  "layers", mesh, "--marker", "airfoil", "--y-plus", 50, "--reynolds", 1e6, "--count", 3)
        held = winslow.move(result.mesh, "airfoil", rotate=-3, hold_layers="airfoil")
        winslow.write(result.mesh, self.folder / "layered.su2")
        self.same(held, "move", "layered.su2", "--marker", "airfoil", "--rotate", -3, "--hold-layers", "airfoil")

    def test_scramble_and_untangle(self):
        scrambled = winslow.scramble(COARSE, seed=3, allow_inverted=True)
        self.program("scramble", COARSE, "--seed", 3, "-o", "out.su2", "--allow-inverted", "--quiet", code=4)
        self.assert_same(scrambled.mesh.points, winslow.read(self.folder / "out.su2").points)
        self.assertGreater(scrambled.inverted, 0)
        untangled = winslow.untangle(scrambled.mesh)
        self.assertEqual(winslow.quality(untangled).inverted, 0)
        self.assertIs(winslow.untangle(untangled), untangled)

    def test_replay(self):
        (self.folder / "r.json").write_text(
            '{"winslow_recipe": 1, "commands": [{"command": "move", "markers": ["flap"], "rotate": -5}, '
            '{"command": "smooth"}]}')
        result = winslow.replay(self.folder / "r.json", COARSE)
        self.same(result, "replay", "r.json", "--input", COARSE)

    def test_reference(self):
        mesh = winslow.read(COARSE)
        first = winslow.move(mesh, "flap", rotate=-10, pivot=(0.86, -0.02))
        winslow.write(first.mesh, self.folder / "first.su2")
        self.same(winslow.move(first.mesh, "flap", rotate=10, pivot=(0.86, -0.02), reference=mesh),
                  "move", "first.su2", "--marker", "flap", "--rotate", 10, "--pivot", 0.86, -0.02,
                  "--reference-mesh", COARSE)

    def test_quality(self):
        self.program("quality", COARSE, "--report", "q.json", "--quiet")
        import json
        expected = json.loads((self.folder / "q.json").read_text())
        found = winslow.quality(COARSE)
        for key in ("quality", "worst", "elements", "inverted", "walls", "markers"):
            self.assertEqual(found[key], expected[key], key)
        sine = winslow.values(COARSE, "normalized_jacobian")
        self.assertEqual(sine.min(), found.min("normalized_jacobian"))
        self.assertIn("aspect_ratio", winslow.fields(COARSE))
        self.assertIn("normalized_jacobian", repr(found))


class Results(PackageTest):
    def test_result(self):
        mesh = ring()
        result = winslow.move(mesh, "body", translate=(0.3, 0))
        self.assertTrue(result.converged and result.complete)
        self.assertEqual((result.inverted, result.fraction_reached, result.why_incomplete), (0, 1.0, ""))
        self.assertGreater(result.linear_solves, 0)
        self.assertEqual(result.history[0].iteration, 0)
        self.assertLess(result.history[-1].residual, 1e-9)
        self.assertEqual(result.history[-1].stage, "newton")
        self.assertTrue(result.mesh.has_connectivity_of(mesh))
        nodes = mesh.markers["body"]
        np.testing.assert_allclose(result.mesh.points[nodes], mesh.points[nodes] + [0.3, 0], atol=1e-14)
        self.assertEqual(result.report()["inverted"], 0)
        self.assertIn("converged, 0 inverted", repr(result))

    def test_an_incomplete_motion_raises(self):
        with self.assertRaises(winslow.IncompleteMotion) as raised:
            winslow.move(ring(), "body", translate=(20, 0))
        self.assertLess(raised.exception.result.fraction_reached, 1)
        self.assertIn("allow_incomplete", str(raised.exception))
        partial = winslow.move(ring(), "body", translate=(20, 0), allow_incomplete=True)
        self.assertTrue(0 < partial.fraction_reached < 1)
        self.assertTrue(partial.why_incomplete)
        self.assertEqual(winslow.quality(partial.mesh).inverted, 0)

    def test_inverted_elements_raise(self):
        with self.assertRaises(winslow.IncompleteMotion) as raised:
            winslow.scramble(ring())
        self.assertGreater(raised.exception.result.inverted, 0)

    def test_a_result_that_is_not_converged(self):
        with self.assertWarnsRegex(winslow.MeshWarning, "not converged"):
            result = winslow.move(ring(), "body", rotate=40, max_iterations=1)
        self.assertFalse(result.converged)
        self.assertTrue(result.warnings)

    def test_wrong_use(self):
        mesh = ring()
        for call, text in (
                (lambda: winslow.move(mesh, "body", rotat=1), "unknown option \"rotat\"; did you mean rotate"),
                (lambda: winslow.move(mesh, "bdy", rotate=1), "did you mean body"),
                (lambda: winslow.move(mesh, "body"), "nothing to do"),
                (lambda: winslow.move(mesh, rotate=1), "nothing to move"),
                (lambda: winslow.move(mesh, "body", bodies=[{"markers": "body", "rotate": 1}]), "bodies together"),
                (lambda: winslow.move(mesh, bodies=[{"markers": "body", "rotat": 1}]), r"bodies\[0\]"),
                (lambda: winslow.move(mesh, "body", rotate="ten"), "rotate: found 'ten'"),
                (lambda: winslow.move(mesh, "body", rotate=True), "rotate: found True"),
                (lambda: winslow.move(mesh, "body", rotate=float("nan")), "rotate"),
                (lambda: winslow.move(mesh, "body", rotate=1, pivot=(1, 2, 3, 4)), "two numbers"),
                (lambda: winslow.move(mesh, "body", rotate=1, axis=(0, 0, 1)), "axis"),
                (lambda: winslow.smooth(mesh, exponent=1000), "exponent: found 1000, expected 1 to 64"),
                (lambda: winslow.smooth(mesh, outer="newto"), "expected one of auto, newton"),
                (lambda: winslow.smooth(mesh, threads=1.5), "whole number"),
                (lambda: winslow.smooth(mesh, raise_worst="yes"), "True or False"),
                (lambda: winslow.smooth(mesh, progress=3), "progress"),
                (lambda: winslow.smooth(mesh, slide=[3]), "a name"),
                (lambda: winslow.smooth(5), "found int, expected a winslow.Mesh"),
                (lambda: winslow.deform(mesh, "body"), "give either"),
                (lambda: winslow.deform(mesh, "body", displacements=np.zeros((3, 2))), "found 3 rows, expected 24"),
                (lambda: winslow.deform(mesh, "body", sine={"waves": 1}), "amplitude"),
                (lambda: winslow.move(mesh, "body", rotate=1, min_quality={"beauty": 1}), "unknown metric"),
                (lambda: winslow.move(mesh, "body", rotate=1, reference=ring(around=12)), "nodes"),
                (lambda: winslow.layers(mesh, count=3), "no wall"),
                (lambda: winslow.layers(mesh, "body", y_plus=1), "reynolds"),
                (lambda: winslow.layers(mesh, "body", y_plus="thin", reynolds=1e6), "y_plus: found 'thin'"),
                (lambda: winslow.layers(mesh, "body", columns={3: {"columns": 1.5}}), "whole number"),
                (lambda: winslow.layers(mesh, "body", columns={3: {"colums": 1}}), "did you mean columns"),
                (lambda: winslow.layers(mesh, walls=[{"markers": "body", "frst": 1}]), "did you mean first"),
                (lambda: winslow.layers(mesh, walls="body"), "list of dicts"),
                (lambda: winslow.move(mesh, bodies="body"), "list of dicts"),
                (lambda: winslow.deform(mesh, "body", sine=3), "expected a dict"),
                (lambda: winslow.values(mesh, "beauty"), "expected")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()

    def test_messages_speak_of_keywords(self):
        with self.assertRaises(winslow.IncompleteMotion) as raised:
            winslow.move(ring(), "body", translate=(20, 0))
        self.assertNotIn("--", str(raised.exception))

    def test_an_option_of_each_kind(self):
        mesh = ring()
        moved = winslow.move(mesh, "body", rotate=np.float64(3), pivot=np.array([0.0, 0]), increments=np.int32(0),
                             raise_worst=False, tolerance=1e-8, targets="keep", slide=["farfield"], threads=2,
                             hold_node=[200, 201], min_quality={"normalized_jacobian": 0.01})
        self.assertTrue(moved.converged)
        self.assert_same(moved.mesh.points[[200, 201]], mesh.points[[200, 201]])


if __name__ == "__main__":
    main()
