"""Cases of OpenFOAM: time folders, safe outputs, plane meshes one cell thick, wedges, symmetry and
cyclic patches. Where OpenFOAM is installed, its checkMesh and icoFoam judge what was written."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

from support import INPUT, USAGE, ProgramTest

DATA = pathlib.Path(__file__).resolve().parents[1] / "data" / "openfoam"
FOAM = pathlib.Path("/usr/share/openfoam")
TUTORIALS = pathlib.Path("/usr/share/doc/openfoam-examples/examples")
HAS_FOAM = shutil.which("checkMesh") is not None
POINT = re.compile(r"^\(([^ ()]+) ([^ ()]+) ([^ ()]+)\)$", re.M)


def points(file):
    return [tuple(map(float, p)) for p in POINT.findall(file.read_text())]


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


class FoamTest(ProgramTest):
    def case(self, name, to="case"):
        shutil.copytree(DATA / name, self.path(to))
        return self.path(to)

    def foam(self, *command, cwd=None):
        env = {**os.environ}
        env.setdefault("WM_PROJECT_DIR", str(FOAM))
        run = subprocess.run(command, cwd=cwd or self.folder, capture_output=True, text=True,
                             check=False, timeout=300, env=env)
        self.assertEqual(run.returncode, 0, f"{command}\n{run.stdout[-3000:]}\n{run.stderr[-2000:]}")
        return run.stdout

    def check_mesh(self, case, time=None):
        """Fails unless checkMesh finds nothing wrong."""
        if not HAS_FOAM:
            return
        if not (case / "system").exists():
            shutil.copytree(DATA / "cyclic" / "system", case / "system")
        said = self.foam("checkMesh", "-case", case, *(["-time", time] if time else []))
        self.assertIn("Mesh OK.", said, said[-4000:])


class TimeFolders(FoamTest):
    def test_a_time_gets_the_points_alone(self):
        case = self.case("ellipse")
        before = contents(case)
        self.winslow("move", "case", "-o", "case/0.5", "--marker", "airfoil", "--rotate", "20",
                     "--pivot", "0", "0")
        after = contents(case)
        self.assertEqual(set(after) - set(before), {"0.5/polyMesh/points"})
        self.assertEqual({name: after[name] for name in before}, before)
        run = self.winslow("quality", "case/0.5/polyMesh")
        self.assertIn("190 nodes, 340 elements, 0 inverted", run.stdout)
        self.assertEqual(run.stdout, self.winslow("quality", "case", "--time", "latest").stdout)
        self.assertEqual(run.stdout, self.winslow("quality", "case", "--time", "0.5").stdout)
        run = self.winslow("quality", "case")
        self.assertIn("--time latest", run.stderr)
        self.winslow("move", "case", "--time", "latest", "-o", "case/1", "--marker", "airfoil",
                     "--rotate", "-20", "--pivot", "0", "0")
        self.assertEqual(len(points(case / "1/polyMesh/points")), 380)
        self.winslow("quality", "case", "--time", "2", code=USAGE)
        self.check_mesh(case, "0.5")
        self.check_mesh(case, "1")

    def test_the_mesh_that_is_read_is_not_replaced_by_another_name(self):
        case = self.case("ellipse")
        before = contents(case)
        move = ["--marker", "airfoil", "--rotate", "5"]
        for out, said in (("case", "would be replaced"), ("case/constant", "would be replaced"),
                          ("case/x.foam", "expected a folder"), ("x.foam", "expected a folder"),
                          ("out.xyz", "unknown extension")):
            run = self.winslow("move", "case", "-o", out, *move, code=USAGE)
            self.assertIn(said, run.stderr)
            self.assertEqual(contents(self.path("case")), before)
        self.assertEqual(self.files(), ["case"])
        self.winslow("move", "case", "-o", "case/constant/polyMesh", *move)
        after = contents(case)
        self.assertEqual([n for n in before if before[n] != after[n]], ["constant/polyMesh/points"])
        self.assertEqual(set(after), set(before))

    def test_another_case_gets_all_of_the_mesh(self):
        case = self.case("cyclic")
        self.winslow("smooth", "case", "-o", "other")
        before = contents(case / "constant/polyMesh")
        after = contents(self.path("other/constant/polyMesh"))
        self.assertEqual(set(after), set(before))
        for name, text in before.items():
            if name != "points":
                self.assertEqual(after[name], text, name)
        self.check_mesh(self.path("other"))

    def test_a_time_folder_without_faces_says_where_they_are_missing(self):
        self.path("alone/0.5/polyMesh").mkdir(parents=True)
        shutil.copy(DATA / "ellipse/constant/polyMesh/points", self.path("alone/0.5/polyMesh"))
        run = self.winslow("quality", "alone/0.5/polyMesh", code=INPUT)
        self.assertIn("found no file faces here, at an earlier time or in alone/constant/polyMesh",
                      run.stderr)


class PlaneMeshes(FoamTest):
    def test_an_ellipse_turns_as_in_a_plane_mesh(self):
        self.case("ellipse")
        self.winslow("convert", "case", "ellipse.su2")
        move = ["--marker", "airfoil", "--rotate", "20", "--pivot", "0", "0", "--report"]
        self.winslow("move", "case", "-o", "case/0.5", *move, "a.json")
        self.winslow("move", "ellipse.su2", "-o", "b.su2", *move, "b.json")
        a, b = self.json("a.json"), self.json("b.json")
        self.assertEqual(a["quality"], b["quality"])
        self.check_mesh(self.path("case"), "0.5")
        before = points(self.path("case/constant/polyMesh/points"))
        after = points(self.path("case/0.5/polyMesh/points"))
        self.assertEqual([p[2] for p in before], [p[2] for p in after])
        self.assertGreater(sum(p != q for p, q in zip(before, after)), 250)

    def test_symmetry_slides_and_cyclic_sides_move_together_unless_held(self):
        case = self.case("cyclic")
        move = ["--marker", "bafM", "--marker", "bafS", "--translate", "0.05", "0", "0"]
        run = self.winslow("move", "case", "-o", "case/0.5", *move)
        self.assertIn("top (symmetryPlane)", run.stdout)
        self.assertIn("cycA and cycB move together", run.stdout)
        self.check_mesh(case, "0.5")
        run = self.winslow("quality", "case")
        self.assertIn('"cycA" and "cycB"', run.stdout)
        before = points(case / "constant/polyMesh/points")
        after = points(case / "0.5/polyMesh/points")
        at = {tuple(round(x, 9) for x in p): i for i, p in enumerate(before)}
        moved = 0
        for (x, y, z), i in at.items():
            if y == 0 and (x, 1.0, z) in at:
                j = at[(x, 1.0, z)]
                way = [after[i][k] - before[i][k] for k in range(3)]
                for k in range(3):
                    self.assertAlmostEqual(way[k], after[j][k] - before[j][k], delta=1e-12)
                moved += any(way)
        self.assertGreater(moved, 2)
        run = self.winslow("move", "case", "-o", "case/1", *move, "--fixed", "cycA", "--fixed",
                           "top")
        self.assertNotIn("As the file says", run.stdout)
        self.assertIn("no longer match", run.stderr)

    def test_names_of_groups_stand_for_their_patches(self):
        self.case("cyclic")
        move = ["--translate", "0.05", "0", "0", "-o"]
        self.winslow("move", "case", "--marker", "b", *move, "case/1")
        self.winslow("move", "case", "--marker", "bafM", "--marker", "bafS", *move, "case/2")
        self.assertEqual(points(self.path("case/1/polyMesh/points")),
                         points(self.path("case/2/polyMesh/points")))


if __name__ == "__main__":
    unittest.main()
