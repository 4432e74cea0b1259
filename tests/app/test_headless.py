import json
import unittest

import support
from png_pictures import HEADLESS
from support import HAS_GUI, INPUT, INVERTED, USAGE, ProgramTest


@unittest.skipUnless(HAS_GUI, "built without graphics")
class Headless(ProgramTest):
    def setUp(self):
        super().setUp()
        self.ring()
        self.recipe({"command": "move", "markers": ["body"], "rotate": 20})

    def recipe(self, *commands, name="r.json", source="ring.su2"):
        self.path(name).write_text(json.dumps(
            {"winslow_recipe": 1, "input": source, "commands": list(commands)}))

    def studio(self, *args, code=support.DONE, text=None):
        return self.winslow("studio", "--headless", "--size", "800", "500", *args, code=code,
                            env=HEADLESS, text=text)

    def test_the_same_command_gives_the_same_picture(self):
        for name in ("a.png", "b.png"):
            self.studio("--replay", "r.json", "--screenshot", name, "--panels", "none")
        self.assertEqual(self.path("a.png").read_bytes(), self.path("b.png").read_bytes())
        self.studio("ring.su2", "--screenshot", "c.png", "--panels", "none")
        self.assertNotEqual(self.path("a.png").read_bytes(), self.path("c.png").read_bytes())

    def test_frames_are_numbered_pictures_of_the_way(self):
        self.studio("--replay", "r.json", "--frames", "film", "--panels", "none")
        frames = sorted(p.name for p in self.path("film").iterdir())
        self.assertGreater(len(frames), 2)
        self.assertEqual(frames[0], "frame-00001.png")
        self.assertEqual(frames[-1], f"frame-{len(frames):05d}.png")

    def test_errors(self):
        for args, code, part in (
                ((), USAGE, "--screenshot"),
                (("--replay", "none.json", "--screenshot", "p.png"), INPUT, "none.json"),
                (("--replay", "r.json", "--screenshot", "no/p.png"), INPUT, "no"),
                (("ring.su2", "--frames", "film"), USAGE, "--replay"),
                (("ring.su2", "--screenshot", "p.jpg"), USAGE, ".png, .svg or .pdf"),
                (("--replay", "r.json", "--screenshot", "p.png", "--transparent"), USAGE, "panels"),
                (("--script", "none.txt"), INPUT, "none.txt")):
            with self.subTest(args=args):
                self.assertIn(part, self.studio(*args, code=code).stderr)
        self.recipe({"command": "move", "markers": ["rudder"], "rotate": 20}, name="wrong.json")
        run = self.studio("--replay", "wrong.json", "--screenshot", "p.png", code=USAGE)
        self.assertIn("body", run.stderr)  # what there is instead
        self.assertNotIn("p.png", self.files())

    def test_the_status_tells_of_the_mesh(self):
        self.recipe({"command": "scramble", "seed": 1})
        self.studio("--replay", "r.json", "--screenshot", "p.png", code=INVERTED)
        self.assertIn("p.png", self.files())

    def test_a_script_is_played(self):
        self.path("s.txt").write_text("click 0.5 0\nscreenshot p.png\nwidgets tool/fit\n")
        run = self.studio("ring.su2", "--script", "s.txt")
        self.assertIn("p.png", self.files())
        self.assertIn("tool/fit", run.stdout)

    def test_a_script_comes_through_a_pipe(self):
        run = self.studio("--script", "/dev/stdin",
                          text="open ring.su2\nwidgets marker/\nscreenshot p.png\n")
        self.assertIn("marker/farfield", run.stdout)
        self.assertIn("p.png", self.files())

    def test_what_was_done_before_a_fault_is_said(self):
        run = self.studio("--script", "/dev/stdin", code=support.INPUT,
                          text="open ring.su2\nscreenshot p.png\nclick nothing/there\n")
        self.assertIn("Wrote p.png", run.stdout)
        self.assertIn("/dev/stdin:3: ", run.stderr)


if __name__ == "__main__":
    support.main()
