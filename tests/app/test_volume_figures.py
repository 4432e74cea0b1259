"""`winslow render` of volume meshes as vector graphics, as frames of a turn, and by layers at a marker;
films of a script."""
import os
import unittest
import xml.etree.ElementTree as ElementTree

import support
from png_pictures import HEADLESS, read_png
from support import HAS_GUI, USAGE, ProgramTest
from volume_meshes import N, write_box


@unittest.skipUnless(HAS_GUI, "built without graphics")
class VolumeFigures(ProgramTest):
    """A box [0, 1]^3 with a cubic body [.4, .6]^3 in its middle, markers body and far."""

    def setUp(self):
        super().setUp()
        write_box(self.path("box.su2"))

    def render(self, *args, code=support.DONE):
        return self.winslow("render", "box.su2", *args, code=code, env=HEADLESS)

    def test_a_cut_is_drawn_as_vectors(self):
        self.render("-o", "p.svg", "--size", 400, 300, "--title", "A box")
        root = ElementTree.parse(self.path("p.svg")).getroot()
        self.assertTrue(root.tag.endswith("svg"))
        tags = [element.tag.rsplit("}", 1)[-1] for element in root.iter()]
        self.assertNotIn("image", tags)
        self.assertGreater(tags.count("path"), 100)
        texts = ["".join(element.itertext()) for element in root.iter() if element.tag.endswith("text")]
        self.assertIn("A box", texts)
        self.assertTrue(any(text.startswith("Cut at") for text in texts), texts)
        self.render("-o", "p.pdf")
        with open(self.path("p.pdf"), "rb") as file:
            self.assertTrue(file.read(5) == b"%PDF-")

    def test_what_is_hidden_is_left_out(self):
        """Of the outside of a box three sides are seen from aslant, and one from the side."""
        for name, view in (("whole.svg", "iso"), ("side.svg", "+x")):
            self.render("-o", name, "--show", "far", "--no-cut", "--view", view, "--no-wireframe", "--no-legend")
        faces = [self.path(name).read_text().count("stroke-width:0.25;") for name in ("whole.svg", "side.svg")]
        self.assertEqual(faces, [3 * 2 * N * N, 2 * N * N])

    def test_a_turn_is_drawn_in_frames(self):
        run = self.render("--turntable", 3, "--frames", "turn", "--size", 120, 90)
        self.assertIn("3 frames", run.stdout)
        names = sorted(os.listdir(self.path("turn")))
        self.assertEqual(names, ["frame-00001.png", "frame-00002.png", "frame-00003.png"])
        pictures = [read_png(self.path("turn/" + name))[2] for name in names]
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[1], pictures[2])

    def test_frames_are_of_a_recipe_or_of_a_turn(self):
        self.assertIn("--turntable", self.render("--frames", "f", code=USAGE).stderr)
        self.render("--turntable", 3, "-o", "p.png", code=USAGE)

    def test_layers_at_a_marker(self):
        args = ("-o", "p.png", "--size", 160, 160, "--view", "-y", "--no-legend", "--no-wireframe",
                "--centre", .5, .5, .5, "--half-width", .5)
        white = (255, 255, 255)
        self.render(*args, "--peel", "body:1:1", "--no-cut")
        near = read_png(self.path("p.png"))[2]
        self.render(*args, "--peel", "body:1:9", "--no-cut")
        all_layers = read_png(self.path("p.png"))[2]
        inked = [sum(p != white for row in rows for p in row) for rows in (near, all_layers)]
        self.assertGreater(inked[1], 1.5 * inked[0])
        self.assertIn("marker", self.render(*args, "--peel", "body", code=USAGE).stderr)
        self.assertIn("body", self.render(*args, "--peel", "nobody:1:2", code=USAGE).stderr)
        self.render(*args, "--peel", "body:3:2", code=USAGE)

    def test_a_script_films_a_turn(self):
        with open(self.path("s.txt"), "w", encoding="utf-8") as script:
            script.write('size 640 480\nkey 7\nfilm turn mesh-alone 0.2\npicture p.svg\n')
        self.winslow("studio", "--headless", "box.su2", "--script", "s.txt", env=HEADLESS)
        self.assertEqual(len(os.listdir(self.path("turn"))), 4)  # 20 a second
        self.assertTrue(os.path.getsize(self.path("p.svg")) > 1000)


if __name__ == "__main__":
    support.main()
