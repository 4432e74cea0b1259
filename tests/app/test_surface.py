import json
import math
import random

import support
import surface_meshes as surfaces
from support import DONE, INPUT, USAGE, ProgramTest
from surface_meshes import norm, read_obj, write_obj


def bumps(p):
    x, y, z = p
    factor = 1 + 0.1 * math.sin(3 * x + 1) * math.cos(2 * y) * math.cos(2 * z)
    return tuple(factor * value for value in p)


class Surface(ProgramTest):
    def smooth(self, *arguments, code=DONE):
        self.winslow("smooth", "in.obj", "-o", "out.obj", "--report", "r.json", *arguments, code=code)
        return self.json("r.json")

    def scrambled_and_smoothed(self, nodes, elements, seed=1):
        """Scrambled and smoothed in one recipe, which keeps the shape of the mesh as given."""
        write_obj(self.path("in.obj"), nodes, elements)
        self.path("p.json").write_text(json.dumps({
            "winslow_recipe": 1, "input": "in.obj", "output": "out.obj",
            "commands": [{"command": "scramble", "seed": seed}, {"command": "smooth"}]}))
        self.winslow("replay", "p.json", "--report", "r.json")
        report = self.json("r.json")
        self.assertGreater(report["commands"][0]["inverted"], 0.1 * len(elements))
        self.assertTrue(report["commands"][1]["converged"])
        self.assertEqual(report["inverted"], 0)
        return report

    def test_a_folded_surface_is_said_to_be_and_unfolds_onto_a_reference(self):
        bumpy = str(support.ASSETS / "coarse/bumpy.obj.gz")
        self.winslow("convert", bumpy, "bumpy.obj")
        scrambled = self.winslow("scramble", "bumpy.obj", "-o", "in.obj", "--allow-inverted",
                                 "--report", "s.json", code=support.INVERTED)
        backwards = self.json("s.json")["inverted"]
        self.assertGreater(backwards, 500)
        self.assertNotIn("folded", scrambled.stderr)  # they are inverted elements there
        told = self.winslow("quality", "in.obj", "--report", "q.json")
        report = self.json("q.json")
        self.assertEqual(report["inverted"], 0)
        self.assertLess(abs(report["folds"]["elements"] - backwards), 0.05 * backwards)
        for words in ("The surface is folded: it turns back on itself at "
                      f"{report['folds']['edges']} edges", "--reference-surface", "  edge "):
            self.assertIn(words, told.stdout)
        self.assertIn("folded", report["warnings"][0])
        smoothed = self.winslow("smooth", "in.obj", "-o", "out.obj", "--report", "r.json")
        self.assertIn("warning: the surface is folded", smoothed.stderr)
        self.assertIn("--reference-surface", smoothed.stderr)
        self.assertGreater(self.json("r.json")["folds"]["elements"], 500)
        unfolded = self.winslow("smooth", "in.obj", "-o", "out.obj", "--report", "r.json",
                                "--reference-surface", "bumpy.obj")
        self.assertNotIn("folded", unfolded.stderr)
        self.assertEqual(self.json("r.json")["folds"]["edges"], 0)
        self.assertGreater(self.json("r.json")["folds_before"]["elements"], 500)
        self.assertEqual(self.winslow("quality", "out.obj").stderr, "")

    def test_thin_trailing_edges_are_no_folds(self):
        wing = str(support.ASSETS / "coarse/wing.su2.gz")
        self.winslow("convert", wing, "wing.obj")
        self.assertNotIn("folded", self.winslow("quality", "wing.obj", "--report", "q.json").stdout)
        folds = self.json("q.json")["folds"]
        self.assertEqual(folds["edges"], 0)
        self.assertGreater(folds["thin_edges"], 100)

    def check_shape(self, report, deviation):
        sine = report["quality"]["normalized_jacobian"]
        self.assertGreaterEqual(sine["min"], 0.35)
        self.assertGreaterEqual(sine["avg"], 0.84)
        self.assertLessEqual(report["surface"]["hausdorff"],
                             deviation * report["surface"]["extent"])

    def test_a_scrambled_sphere_comes_back_on_its_sphere(self):
        report = self.scrambled_and_smoothed(*surfaces.sphere(12))
        self.check_shape(report, 2e-3)
        # All but three, which hold it where it is.
        self.assertEqual(report["commands"][1]["sliding"],
                         [{"marker": "surface", "on": "sphere of radius 1", "nodes": 575}])
        nodes, _ = read_obj(self.path("out.obj"))
        self.assertLess(max(abs(norm(p) - 1) for p in nodes), 1e-12)
        volume = report["surface"]
        self.assertAlmostEqual(volume["volume_before"], 4 / 3 * math.pi, delta=0.05)
        self.assertAlmostEqual(volume["volume_after"], volume["volume_before"], delta=0.01)

    def test_scrambled_curved_surfaces_come_back_on_their_shape(self):
        self.check_shape(self.scrambled_and_smoothed(*surfaces.torus(100, 50)), 1e-3)
        nodes, elements = surfaces.sphere(24)
        self.check_shape(self.scrambled_and_smoothed([bumps(p) for p in nodes], elements), 1e-3)
        saddle = surfaces.grid(20, lambda x, y: (x, y, 0.5 * (x * x - y * y)), rows=23)
        self.check_shape(self.scrambled_and_smoothed(*saddle), 1e-3)

    def test_open_surfaces_keep_their_border(self):
        nodes, elements = surfaces.grid(10, lambda x, y: (x, y, 0.3 * math.sin(3 * x) * y), True)
        numbers = random.Random(2)
        inner = [i for i in range(len(nodes)) if 0 < i % 11 < 10 and 0 < i // 11 < 10]
        for i in inner:
            x, y, _ = nodes[i]
            x, y = x + numbers.uniform(-0.02, 0.02), y + numbers.uniform(-0.02, 0.02)
            nodes[i] = (x, y, 0.3 * math.sin(3 * x) * y)
        write_obj(self.path("in.obj"), nodes, elements)
        report = self.smooth("--targets", "element")
        self.assertEqual(report["space_dimension"], 3)
        self.assertGreater(report["quality"]["normalized_jacobian"]["min"],
                           report["quality_before"]["normalized_jacobian"]["min"])
        after, same = read_obj(self.path("out.obj"))
        self.assertEqual(same, elements)
        for i, (p, q) in enumerate(zip(nodes, after)):
            self.assertEqual(p == q, i not in inner)

    def test_sharp_edges_and_corners_stay_or_slide(self):
        nodes, elements = surfaces.cube(6, seed=3)
        edges, corners = surfaces.features_of_cube(nodes)
        write_obj(self.path("in.obj"), nodes, elements)
        report = self.smooth()
        self.assertEqual([part["on"] for part in report["commands"][0]["sliding"]], 6 * ["plane"])
        after, _ = read_obj(self.path("out.obj"))
        for i in edges + corners:
            self.assertEqual(after[i], nodes[i])
        for p in after:
            self.assertTrue(any(abs(value - side) < 1e-12 for value in p for side in (0, 1)))
        self.assertLess(report["surface"]["hausdorff"], 1e-12)
        self.assertAlmostEqual(report["surface"]["volume_after"], 1, delta=1e-12)

        # Nodes crowded at one end of an edge are spread along it.
        crowded = [tuple(value ** 1.5 for value in p) for p in nodes]
        write_obj(self.path("in.obj"), crowded, elements)
        report = self.smooth("--slide-features", "--targets", "element")
        after, _ = read_obj(self.path("out.obj"))
        for i in corners:
            self.assertEqual(after[i], crowded[i])
        moved = 0
        for i in edges:
            off = sorted(min(abs(value), abs(value - 1)) for value in after[i])
            self.assertLess(off[1], 1e-12)
            moved = max(moved, math.dist(after[i], crowded[i]))
        self.assertGreater(moved, 0.02)
        self.assertLess(report["surface"]["hausdorff"], 1e-12)

    def test_every_format_of_surfaces_takes_part(self):
        nodes, elements = surfaces.sphere(4)
        write_obj(self.path("a.obj"), nodes, elements)
        results = {}
        for name in ("off", "ply", "vtk", "vtu", "msh", "mesh", "su2"):
            self.winslow("convert", "a.obj", f"a.{name}")
            self.winslow("smooth", f"a.{name}", "-o", f"out.{name}")
            self.winslow("convert", f"out.{name}", f"{name}.obj")
            results[name] = read_obj(self.path(f"{name}.obj"))
        self.winslow("smooth", "a.obj", "-o", "out.obj")
        for name, result in results.items():
            self.assertEqual(result, read_obj(self.path("out.obj")), name)
        self.winslow("convert", "a.obj", "a.stl")
        self.winslow("smooth", "a.stl", "-o", "out.stl")
        self.winslow("convert", "out.stl", "stl.obj")
        for p in read_obj(self.path("stl.obj"))[0]:
            self.assertAlmostEqual(norm(p), 1, delta=1e-12)

    def test_quality_measures_elements_in_their_own_planes(self):
        write_obj(self.path("a.obj"), *surfaces.cube(3))
        run = self.winslow("quality", "a.obj", "--report", "r.json")
        self.assertIn("108 elements, 0 inverted", run.stdout)
        quality = self.json("r.json")["quality"]
        self.assertAlmostEqual(quality["normalized_jacobian"]["min"], math.sqrt(0.5), delta=1e-12)
        self.assertAlmostEqual(quality["smallest_angle"]["min"] if "smallest_angle" in quality else 45,
                               45, delta=1e-9)

    def test_a_surface_from_another_file_takes_the_place_of_a_tangled_one(self):
        nodes, elements = surfaces.sphere(8)
        scatter = random.Random(2)
        tangled = []
        for p in nodes:
            q = tuple(value + scatter.uniform(-0.3, 0.3) for value in p)
            tangled.append(tuple(value / norm(q) for value in bumps(q)))
        write_obj(self.path("in.obj"), [bumps(p) for p in tangled], elements)
        fine, of_fine = surfaces.sphere(30)
        self.path("shapes").mkdir()
        write_obj(self.path("shapes/fine.obj"), [bumps(p) for p in fine], of_fine)
        report = self.smooth("--reference-surface", "shapes/fine.obj", "--save-recipe", "shapes/p.json")
        self.assertTrue(report["commands"][0]["converged"])
        self.assertEqual(report["inverted"], 0)
        self.assertIn("of fine.obj", report["commands"][0]["sliding"][0]["on"])
        for p in read_obj(self.path("out.obj"))[0]:
            on = norm(bumps(tuple(value / norm(p) for value in p)))
            self.assertAlmostEqual(norm(p), on, delta=2e-4)
        # A recipe that is written to the working folder names it from there.
        self.smooth("--reference-surface", "shapes/fine.obj", "--save-recipe", "here.json")
        self.assertEqual(self.json("here.json")["commands"][0]["smooth"]["slide"]["reference"],
                         "shapes/fine.obj")
        # The recipe names the file from its own folder, and can be moved together with it.
        recipe = self.json("shapes/p.json")
        self.assertEqual(recipe["commands"][0]["smooth"]["slide"]["reference"], "fine.obj")
        self.path("shapes").rename(self.path("moved"))
        self.winslow("replay", "moved/p.json", "--input", "in.obj", "-o", "again.obj")
        self.assertEqual(self.path("again.obj").read_bytes(), self.path("out.obj").read_bytes())

    def test_a_reference_that_cannot_be_read_is_named(self):
        write_obj(self.path("in.obj"), *surfaces.sphere(3))
        run = self.winslow("smooth", "in.obj", "-o", "out.obj", "--reference-surface", "none.stl", code=INPUT)
        self.assertIn("none.stl", run.stderr)
        self.path("bad.obj").write_text("v 0 0 0\nv 1 0 zero\n")
        run = self.winslow("smooth", "in.obj", "-o", "out.obj", "--reference-surface", "bad.obj", code=INPUT)
        self.assertIn("bad.obj:2:", run.stderr)
        self.assertFalse(self.path("out.obj").exists())

    def test_what_a_surface_mesh_cannot_do_is_refused_by_name(self):
        nodes, elements = surfaces.sphere(3)
        write_obj(self.path("in.obj"), nodes, elements)
        for arguments, words in ((["--formulation", "pointwise"], "the pointwise form"),
                                 (["--slide", "surface"], "sliding markers")):
            run = self.winslow("smooth", "in.obj", "-o", "out.obj", *arguments, code=USAGE)
            self.assertIn(words, run.stderr)
        run = self.winslow("smooth", "in.obj", "-o", "out.ugrid", code=USAGE)
        self.assertIn("cannot hold a surface mesh", run.stderr)

    def test_surfaces_that_are_none_are_refused_with_a_reason(self):
        strip = [(math.cos(a) * r, math.sin(a) * r, s * math.sin(a / 2))
                 for a in (2 * math.pi * k / 12 for k in range(12))
                 for s, r in ((-0.3, 2 - 0.3 * math.cos(a / 2)), (0.3, 2 + 0.3 * math.cos(a / 2)))]
        moebius = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(11)] + [(22, 23, 0, 1)]
        write_obj(self.path("in.obj"), strip, moebius)
        run = self.winslow("smooth", "in.obj", "-o", "out.obj", code=INPUT)
        self.assertIn("orient", run.stderr)
        three = [(0, 0, 0), (1, 0, 0), (0.5, 1, 0), (0.5, -1, 0), (0.5, 0, 1)]
        write_obj(self.path("in.obj"), three, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
        run = self.winslow("smooth", "in.obj", "-o", "out.obj", code=INPUT)
        self.assertIn("in.obj:8:", run.stderr)


if __name__ == "__main__":
    support.main()
