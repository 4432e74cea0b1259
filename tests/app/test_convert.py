import gzip

import support
from support import INPUT, USAGE, ProgramTest


class Convert(ProgramTest):
    def test_there_and_back_again(self):
        self.ring()
        original = support.read_su2(self.path("ring.su2"))
        for name in ("m.msh", "m.vtk", "m.vtu"):
            for flag in ("--ascii", "--binary"):
                self.winslow("convert", "ring.su2", name, flag)
                self.winslow("convert", name, "back.su2")
                self.assertEqual(support.read_su2(self.path("back.su2")), original, (name, flag))

    def test_gmsh_versions(self):
        self.ring()
        for version in ("2.2", "4.1"):
            self.winslow("convert", "ring.su2", "m.msh", "--gmsh-version", version)
            self.assertEqual(self.path("m.msh").read_text().split()[:2], ["$MeshFormat", version])

    def test_lost_markers_are_a_warning(self):
        self.ring()
        run = self.winslow("convert", "ring.su2", "m.obj")
        self.assertIn("warning", run.stderr)
        self.assertIn("marker", run.stderr)

    def test_cgns(self):
        self.ring()
        self.path("none.cgns").write_bytes(b"\x89HDF\r\n\x1a\n")
        run = self.winslow("quality", "none.cgns", code=INPUT)
        self.path("none.cgns").unlink()
        if "built without CGNS" in run.stderr:
            run = self.winslow("convert", "ring.su2", "m.cgns", code=USAGE)
            self.assertIn("install libcgns", run.stderr)
            self.assertEqual(self.files(), ["ring.su2"])
            self.skipTest("winslow was built without CGNS")
        original = support.read_su2(self.path("ring.su2"))
        signatures = {"hdf5": b"\x89HDF", "adf": b"\xc0\xa8\xa3\xa9ADF"}
        for container, signature in signatures.items():
            self.winslow("convert", "ring.su2", "m.cgns", "--cgns-container", container)
            self.assertTrue(self.path("m.cgns").read_bytes().startswith(signature))
            self.winslow("convert", "m.cgns", "back.su2")
            self.assertEqual(support.read_su2(self.path("back.su2")), original)
            self.winslow("move", "m.cgns", "-o", "moved.cgns", "--marker", "body", "--rotate", "20",
                         "--quiet")
            self.assertTrue(self.path("moved.cgns").read_bytes().startswith(signature))
            self.winslow("move", "ring.su2", "-o", "moved.su2", "--marker", "body", "--rotate", "20",
                         "--quiet")
            self.winslow("convert", "moved.cgns", "back.su2")
            self.assertEqual(support.read_su2(self.path("back.su2")),
                             support.read_su2(self.path("moved.su2")))
        self.path("cut.cgns").write_bytes(self.path("m.cgns").read_bytes()[:3000])
        self.winslow("quality", "cut.cgns", code=INPUT)
        self.winslow("convert", "ring.su2", "m.cgns", "--cgns-container", "tar", code=USAGE)

    def test_says_what_it_wrote(self):
        self.ring()
        run = self.winslow("convert", "ring.su2", "m.msh")
        self.assertIn("216 nodes, 384 elements, 2 markers", run.stdout)
        self.assertEqual(self.winslow("convert", "ring.su2", "m.msh", "--quiet").stdout, "")

    def test_the_output_may_be_given_as_in_other_commands(self):
        self.ring()
        self.winslow("convert", "ring.su2", "-o", "a.vtk")
        self.winslow("convert", "ring.su2", "b.vtk")
        self.assertEqual(self.path("a.vtk").read_bytes(), self.path("b.vtk").read_bytes())
        self.winslow("convert", "ring.su2", "c.vtk", "-o", "d.vtk", code=USAGE)
        self.winslow("convert", "ring.su2", code=USAGE)
        self.assertEqual(self.files(), ["a.vtk", "b.vtk", "ring.su2"])

    def test_compressed_files(self):
        self.ring()
        self.winslow("convert", "ring.su2", "m.su2.gz")
        self.winslow("convert", "ring.su2", "m.su2")
        self.assertEqual(gzip.decompress(self.path("m.su2.gz").read_bytes()),
                         self.path("m.su2").read_bytes())
        self.winslow("convert", "m.su2.gz", "back.vtu.gz")
        self.winslow("convert", "back.vtu.gz", "back.su2")
        self.assertEqual(support.read_su2(self.path("back.su2")),
                         support.read_su2(self.path("ring.su2")))
        self.winslow("convert", "ring.su2", "m.docx.gz", code=USAGE)

    def test_errors(self):
        self.ring()
        self.winslow("convert", "ring.su2", "m.docx", code=USAGE)
        self.winslow("convert", "ring.su2", "m.msh", "--binary", "--ascii", code=USAGE)
        self.path("empty.su2").write_text("")
        self.winslow("convert", "empty.su2", "m.msh", code=INPUT)
        self.assertEqual(self.files(), ["empty.su2", "ring.su2"])


if __name__ == "__main__":
    support.main()
