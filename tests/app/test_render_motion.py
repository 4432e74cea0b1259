import json
import unittest
import xml.etree.ElementTree

import support
from support import HAS_GUI, INPUT, USAGE, ProgramTest
from png_pictures import HEADLESS, read_png


@unittest.skipUnless(HAS_GUI, "built without graphics")
class RenderMotion(ProgramTest):
    def setUp(self):
        super().setUp()
        self.ring()
        self.path("r.json").write_text(json.dumps({"winslow_recipe": 1, "commands": [
            {"command": "move", "markers": ["body"], "rotate": 20, "increments": 3}]}))

    def render(self, *args, code=support.DONE):
        return self.winslow("render", "ring.su2", "--size", "240", "180", *args, code=code,
                            env=HEADLESS)

    def test_vector_graphics_by_the_ending(self):
        self.render("-o", "p.svg", "--color", "aspect_ratio", "--title", "Ring & body")
        root = xml.etree.ElementTree.parse(self.path("p.svg")).getroot()
        self.assertTrue(root.tag.endswith("svg"))
        self.render("-o", "p.pdf")
        self.assertTrue(self.path("p.pdf").read_bytes().startswith(b"%PDF"))

    def test_before_and_after_side_by_side(self):
        self.winslow("move", "ring.su2", "-o", "m.su2", "--marker", "body", "--translate", "0.5", "0")
        self.winslow("render", "m.su2", "--before", "ring.su2", "-o", "p.png", "--size", "240", "180",
                     env=HEADLESS)
        width, height, rows = read_png(self.path("p.png"))
        self.assertEqual((width, height), (480, 180))
        self.assertNotEqual([row[:240] for row in rows], [row[240:] for row in rows])
        self.ring("other.su2", around=20)
        run = self.render("--before", "other.su2", "-o", "q.png", code=INPUT)
        self.assertIn("other.su2", run.stderr)
        self.render("--before", "ring.su2", "-o", "q.svg", code=USAGE)

    def test_frames_of_a_recipe(self):
        self.render("--recipe", "r.json", "--frames", "film", "--per-command", "4")
        frames = sorted(p.name for p in self.path("film").iterdir())
        self.assertEqual(frames, [f"frame-{k:05d}.png" for k in range(1, 6)])
        pictures = {self.path("film").joinpath(name).read_bytes() for name in frames}
        self.assertEqual(len(pictures), 5)

    def test_a_turn_has_a_frame_for_every_degree(self):
        self.path("turn.json").write_text(json.dumps({"winslow_recipe": 1, "commands": [
            {"command": "move", "markers": ["airfoil"], "rotate": 60}]}))
        self.winslow("render", support.ASSETS / "coarse" / "naca0012.su2", "--recipe", "turn.json",
                     "--frames", "film", "--size", "160", "120", "--bounds", -1, -1, 2, 1,
                     env=HEADLESS)
        frames = sorted(self.path("film").iterdir())
        self.assertGreater(len(frames), 60)
        different = sum(a.read_bytes() != b.read_bytes() for a, b in zip(frames, frames[1:]))
        self.assertGreaterEqual(different, 60)

    def test_heights_over_those_before(self):
        self.winslow("move", "ring.su2", "-o", "m.su2", "--marker", "body", "--rotate", "20")
        args = ("render", "m.su2", "-o", "p.png", "--color", "first_height_ratio", "--size", "240", "180")
        refused = self.winslow(*args, code=USAGE, env=HEADLESS)
        self.assertIn("--before MESH", refused.stderr)
        self.winslow(*args, "--before", "ring.su2", env=HEADLESS)
        self.assertEqual(read_png(self.path("p.png"))[:2], (480, 180))

    def test_bad_usage(self):
        self.render(code=USAGE)
        self.render("--frames", "film", code=USAGE)
        done = self.render("--recipe", "r.json", "--frames", "film.webm", code=USAGE)
        self.assertIn("a film ends in .mp4 or .gif", done.stderr)
        self.assertFalse(self.path("film.webm").exists())
        self.render("--recipe", "none.json", "--frames", "film", code=INPUT)


if __name__ == "__main__":
    support.main()
