"""`winslow render` of surface meshes: views, deviation from a mesh before, refusals."""
import unittest

import support
import surface_meshes as surfaces
from png_pictures import HEADLESS
from support import DONE, HAS_GUI, USAGE, ProgramTest
from surface_meshes import write_obj


@unittest.skipUnless(HAS_GUI, "built without graphics")
class SurfacePictures(ProgramTest):
    def render(self, *args, code=DONE):
        return self.winslow("render", *args, code=code, env=HEADLESS)

    def test_a_surface_is_drawn_and_its_deviation_from_the_mesh_before(self):
        write_obj(self.path("in.obj"), *surfaces.sphere(4))
        self.winslow("smooth", "in.obj", "-o", "out.obj")
        draw = ("out.obj", "--size", "320", "240")
        self.render(*draw, "-o", "plain.png", "--view", "iso")
        self.render(*draw, "-o", "turned.png", "--view", "+x")
        self.assertNotEqual(*(self.path(name).read_bytes() for name in ("plain.png", "turned.png")))
        self.render(*draw, "-o", "both.png", "--before", "in.obj", "--color", "deviation")
        self.render(*draw, "-o", "figure.svg", "--color", "none")
        self.render("out.obj", "--size", "160", "120", "--turntable", "3", "--frames",
                     "turn")
        for arguments, words in ((["--color", "deviation"], "--before MESH"),
                                 (["--cut", "0", "0", "0", "1", "0", "0"], "only for a volume mesh"),
                                 (["--bounds", "0", "0", "1", "1"], "only for a plane mesh"),
                                 (["--vcv", "3"], "not for a surface mesh")):
            run = self.render(*draw, "-o", "no.png", *arguments, code=USAGE)
            self.assertIn(words, run.stderr)


if __name__ == "__main__":
    support.main()
