"""Meshes that are no sound meshes: shown with what is wrong where, refused for motions, mended by --repair."""
import support
from support import INPUT, ProgramTest

# A tetrahedron: points twice, a facet twice, one facet seen from inside, a point of no facet.
BROKEN = """v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
v 0 0 1
v 9 9 9
f 1 3 2
f 1 2 4
f 2 5 3
f 3 5 1
f 1 3 5
"""


class Repair(ProgramTest):
    def write(self, name="broken.obj", text=BROKEN):
        self.path(name).write_text(text)

    def test_repair_counts_what_it_mends(self):
        self.write()
        run = self.winslow("convert", "broken.obj", "whole.obj", "--repair")
        for part in ("repaired: 1 point lies where an earlier one does: they are one now, at line 5",
                     "repaired: 1 element has the points of an earlier one: left out, at line 11",
                     "repaired: 2 elements face the other way than their neighbours, or inwards: turned",
                     "repaired: 1 point that no element uses is left out, at line 6"):
            self.assertIn("broken.obj: " + part, run.stderr)
        self.assertIn("Wrote whole.obj: 4 nodes, 4 elements", run.stdout)
        self.assertNotIn("repair", self.winslow("quality", "whole.obj").stderr)
        self.winslow("smooth", "broken.obj", "-o", "smooth.obj", "--repair")
        report = self.winslow("quality", "broken.obj", "--repair", "--report", "r.json")
        self.assertIn("repaired: 1 point lies where", report.stderr)
        self.assertTrue(any("repaired: 1 point" in text for text in self.json("r.json")["warnings"]))

    def test_without_repair_a_mesh_is_shown_and_not_moved(self):
        # A triangle without area beside another one.
        self.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nv 0.5 0 0\nf 1 2 3\nf 2 1 4\n")
        run = self.winslow("smooth", "flat.obj", "-o", "s.obj", code=INPUT)
        self.assertIn("flat.obj:6: element 1 has no area", run.stderr)
        self.assertIn("--repair mends it", run.stderr)
        run = self.winslow("quality", "flat.obj", code=INPUT)
        self.assertIn("line 6: element 1 has no area", run.stderr)
        self.assertIn("nodes", run.stdout)
        run = self.winslow("convert", "flat.obj", "flat.ply")
        self.assertIn("line 6: element 1 has no area", run.stderr)
        self.assertIn("Wrote flat.ply: 4 nodes, 2 elements", run.stdout)
        # An edge of three triangles: the third one is left out.
        self.write("fin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n")
        run = self.winslow("convert", "fin.obj", "fin.ply")
        self.assertIn("left out, at line 8", run.stderr)
        self.assertIn("2 elements", run.stdout)

    def test_files_of_other_programs_come_with_the_command_that_converts_them(self):
        self.write("plate.inp", "*Heading\n*NODE\n1, 0, 0, 0\n")
        run = self.winslow("quality", "plate.inp", code=INPUT)
        self.assertIn("found an Abaqus input deck", run.stderr)
        self.assertIn("meshio convert plate.inp plate.vtu", run.stderr)


if __name__ == "__main__":
    support.main()
