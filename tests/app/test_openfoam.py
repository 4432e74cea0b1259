"""Cases of OpenFOAM: time folders, safe outputs, plane meshes one cell thick, wedges, symmetry and
cyclic patches. Where OpenFOAM is installed, its checkMesh and icoFoam judge what was written."""

import gzip
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

    def foam(self, *command, check=True):
        env = {**os.environ}
        env.setdefault("WM_PROJECT_DIR", str(FOAM))
        run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True,
                             check=False, timeout=300, env=env)
        if check:
            self.assertEqual(run.returncode, 0,
                             f"{command}\n{run.stdout[-3000:]}\n{run.stderr[-2000:]}")
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


class Configuration(ProgramTest):
    def test_the_configuration_of_su2_names_sides_that_move_together(self):
        self.winslow("convert", DATA.parent / "periodic_41.msh", "p.su2")
        self.path("p.cfg").write_text("MARKER_PERIODIC= ( lower, upper, 0,0,0, 0,0,0, 0,1,0 )\n")
        run = self.winslow("smooth", "p.su2", "-o", "a.su2", "--config", "p.cfg")
        self.assertIn("As the file says, lower and upper move together", run.stdout)
        self.winslow("smooth", "p.su2", "-o", "b.su2", "--periodic", "lower", "upper")
        self.assertEqual(self.path("a.su2").read_bytes(), self.path("b.su2").read_bytes())
        self.winslow("smooth", "p.su2", "-o", "c.su2", "--config", "p.cfg", "--fixed", "lower")
        self.winslow("smooth", "p.su2", "-o", "d.su2")
        self.assertEqual(self.path("c.su2").read_bytes(), self.path("d.su2").read_bytes())


@unittest.skipUnless(HAS_FOAM and TUTORIALS.is_dir(), "needs OpenFOAM and its examples")
class Tutorials(FoamTest):
    """Cases of OpenFOAM's own tutorials, moved with default options."""

    def tutorial(self, name):
        """Copies a tutorial and makes its mesh; returns the case."""
        case = self.path(pathlib.Path(name).name)
        shutil.copytree(TUTORIALS / name, case)
        for file in case.rglob("*.gz"):
            file.with_suffix("").write_bytes(gzip.decompress(file.read_bytes()))
            file.unlink()
        if (case / "system" / "blockMeshDict").exists():
            self.foam("blockMesh", "-case", case)
        return case

    def moved(self, name, *command, time="0.1", checked=True):
        """Moves the mesh of a tutorial into a time folder; nothing but its points is new."""
        case = self.tutorial(name)
        before = contents(case)
        self.winslow(command[0], case, "-o", case / time, *command[1:], "--report", "r.json")
        after = contents(case)
        self.assertEqual(set(after) - set(before), {time + "/polyMesh/points"})
        self.assertEqual({file: after[file] for file in before}, before)
        self.assertNotEqual(after["constant/polyMesh/points"], after[time + "/polyMesh/points"])
        if checked:
            self.check_mesh(case, time)
        return case

    def go_on(self, case, solver, time, to):
        """Lets a solver go on from the written time."""
        for field in (case / "0").iterdir():
            if field.is_file():
                shutil.copy(field, case / time)
        control = case / "system" / "controlDict"
        text = re.sub(r"startFrom .*", "startFrom latestTime;", control.read_text())
        control.write_text(re.sub(r"endTime .*", f"endTime {to};", text))
        self.assertIn("End", self.foam(solver, "-case", case))

    def test_cavity(self):
        case = self.moved("incompressible/icoFoam/cavity/cavity", "deform", "--marker",
                          "fixedWalls", "--sine", "0.004", "1", "--direction", "1", "0")
        self.assertEqual(self.json("r.json")["nodes"], 21 * 21)
        self.go_on(case, "icoFoam", "0.1", "0.12")

    def test_pitz_daily(self):
        self.moved("incompressible/simpleFoam/pitzDaily", "deform", "--marker", "lowerWall",
                   "--sine", "0.002", "3")

    def test_an_aerofoil(self):
        # Its own faces are not in upper triangular order, which checkMesh minds.
        case = self.moved("incompressible/simpleFoam/airFoil2D", "move", "--marker", "walls",
                          "--rotate", "5", time="1", checked=False)
        said = self.foam("checkMesh", "-case", case, "-time", "1", check=False)
        self.assertEqual(re.findall(r"\*\*\*(.*)", said), ["Faces not in upper triangular order."])
        shutil.rmtree(case / "1" / "polyMesh" / "sets", ignore_errors=True)
        self.go_on(case, "simpleFoam", "1", "3")

    def test_a_wedge(self):
        self.moved("combustion/reactingFoam/RAS/SandiaD_LTS", "deform", "--marker", "wallOutside",
                   "--sine", "0.01", "2", "--direction", "1", "0")

    def test_a_channel_with_cyclic_sides(self):
        self.moved("incompressible/pimpleFoam/LES/channel395", "deform", "--marker", "bottomWall",
                   "--sine", "0.05", "2", "--along", "1", "0", "0")

    def test_a_dual_mesh_of_polyhedra_is_read_and_smoothed(self):
        case = self.tutorial("incompressible/icoFoam/cavity/cavity")
        self.foam("polyDualMesh", "-case", case, "75", "-overwrite")
        run = self.winslow("quality", case)
        self.assertIn("0 inverted", run.stdout)
        run = self.winslow("convert", case, "-o", "dual.su2", code=USAGE)
        self.assertIn("cannot hold the", run.stderr)


if __name__ == "__main__":
    unittest.main()
