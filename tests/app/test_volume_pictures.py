"""`winslow render` of volume meshes: cuts, views, what is shown of the boundary, refusals."""
import json
import math
import shutil
import unittest

import support
from png_pictures import HEADLESS, read_png
from support import HAS_GUI, INPUT, INVERTED, USAGE, ProgramTest
from volume_meshes import write_box

WHITE = (255, 255, 255)


def is_red(pixel):
    return pixel[0] > 150 and pixel[1] < 90 and pixel[2] < 90


@unittest.skipUnless(HAS_GUI, "built without graphics")
class VolumePictures(ProgramTest):
    """A box [0, 1]^3 with a cubic body [.4, .6]^3 in its middle, markers body and far."""

    def setUp(self):
        super().setUp()
        write_box(self.path("box.su2"))

    def render(self, *args, mesh="box.su2", code=support.DONE):
        return self.winslow("render", mesh, "-o", "p.png", *args, code=code, env=HEADLESS)

    def rows(self, *args, mesh="box.su2"):
        self.render("--size", 200, 200, *args, mesh=mesh)
        width, height, rows = read_png(self.path("p.png"))
        self.assertEqual((width, height), (200, 200))
        return rows

    def pixel(self, x, z, *args):
        """Colour of a place [0, 1]^2 seen from -y. So small a picture has no letters."""
        self.render("--size", 160, 160, "--view", "-y", "--centre", .5, .5, .5, "--half-width", .5,
                    "--no-legend", "--no-wireframe", *args)
        return read_png(self.path("p.png"))[2][int((1 - z) * 159)][int(x * 159)]

    def test_a_picture_needs_no_option(self):
        run = self.render()
        self.assertIn("Wrote p.png", run.stdout)
        width, height, rows = read_png(self.path("p.png"))
        self.assertEqual((width, height), (1200, 900))
        inked = sum(pixel != WHITE for row in rows for pixel in row)
        self.assertGreater(inked, 100000)
        self.assertLess(inked, 900000)
        self.assertGreater(len({pixel for row in rows for pixel in row}), 50)

    def test_the_body_is_shown_and_the_box_around_it_does_not_hide_it(self):
        self.assertEqual(self.pixel(.2, .2, "--no-cut"), WHITE)
        self.assertNotEqual(self.pixel(.5, .5, "--no-cut"), WHITE)
        self.assertNotEqual(self.pixel(.2, .2), WHITE)  # the cut through the body's middle
        self.assertEqual(self.pixel(.5, .5, "--no-cut", "--hide", "body"), WHITE)
        self.assertNotEqual(self.pixel(.2, .2, "--no-cut", "--show", "far"), WHITE)

    def test_cuts_have_the_colours_of_their_elements(self):
        # All tetrahedra of the box are alike: one colour, of the range's ends by turns.
        base = ("--cut", .5, .5, .5, 0, -1, 0, "--color", "volume", "--map", "viridis", "--range")
        low = self.pixel(.2, .2, *base, 1, 2)
        high = self.pixel(.2, .2, *base, 0, 1e-6)
        for got, expected in ((low, (68, 1, 84)), (high, (253, 231, 37))):
            self.assertLess(max(abs(a - b) for a, b in zip(got, expected)), 4, (got, expected))

    def test_two_cuts_and_a_crinkled_one(self):
        corner = ("--cut", .5, .5, .5, 0, -1, 0, "--cut", .5, .5, .5, 1, 0, 0, "--hide", "body")
        self.assertNotEqual(self.pixel(.2, .2, *corner), WHITE)
        self.assertEqual(self.pixel(.8, .2, *corner), WHITE)
        across = ("--cut", .5, .5, .3, 0, 0, 1, "--hide", "body")
        self.assertEqual(self.pixel(.5, .35, *across), WHITE)
        self.assertNotEqual(self.pixel(.5, .35, *across, "--crinkle"), WHITE)  # cubes up to .4
        self.assertEqual(self.pixel(.5, .45, *across, "--crinkle"), WHITE)

    def test_options_change_the_picture(self):
        seen = set()
        for extra in ((), ("--dark",), ("--no-wireframe",), ("--no-legend",), ("--title", "Box"),
                      ("--view", "iso"), ("--view", "+z"), ("--azimuth", 10), ("--elevation", -10),
                      ("--perspective",), ("--up", "y"), ("--crinkle",), ("--no-cut",), ("--color", "none"),
                      ("--color", "smallest_solid_angle"), ("--see-through", "far"),
                      ("--half-width", .3), ("--isolate", .9), ("--map", "viridis", "--color",
                                                               "normalized_jacobian")):
            self.render("--size", 320, 240, *extra)
            seen.add(self.path("p.png").read_bytes())
        self.assertEqual(len(seen), 19)

    def test_inverted_elements_are_red_after_a_motion_too(self):
        self.winslow("move", "box.su2", "-o", "t.su2", "--marker", "body", "--translate", .25, 0, 0,
                     "--no-smooth", "--allow-inverted", code=INVERTED)
        red = [sum(is_red(pixel) for row in self.rows("--no-wireframe", mesh=mesh) for pixel in row)
               for mesh in ("box.su2", "t.su2")]
        self.assertEqual(red[0], 0)
        self.assertGreater(red[1], 300)

    def test_an_earlier_state_stands_on_the_left_seen_alike(self):
        self.winslow("move", "box.su2", "-o", "t.su2", "--marker", "body", "--translate", .1, 0, 0)
        self.winslow("render", "t.su2", "--before", "box.su2", "-o", "p.png", "--size", 160, 120,
                     "--no-wireframe", "--view", "-y", env=HEADLESS)
        width, height, rows = read_png(self.path("p.png"))
        self.assertEqual((width, height), (320, 120))

        def middle_of_body(first):  # its colour is none of the cut's map, which has no blue alone
            places = [x for x in range(first, first + 160) for y in range(120)
                      if rows[y][x][2] > rows[y][x][0] + 40]
            return sum(places) / len(places) - first
        self.assertGreater(middle_of_body(160), middle_of_body(0) + 5)
        ring = self.ring()
        run = self.winslow("render", "t.su2", "--before", ring, "-o", "q.png", code=INPUT)
        self.assertIn("not the same nodes and elements", run.stderr)

    def frames(self, commands, *args, code=support.DONE):
        """Pictures of a recipe's way, as rows of pixels; those of the plain body have no letters."""
        self.path("r.json").write_text(json.dumps({"winslow_recipe": 1, "commands": commands}))
        run = self.winslow("render", "box.su2", "--recipe", "r.json", "--frames", "film", "--size", 120,
                           120, *args, code=code, env=HEADLESS)
        if code != support.DONE:
            return run.stderr
        names = sorted(self.path("film").iterdir())
        self.assertEqual([n.name for n in names], [f"frame-{k:05d}.png" for k in range(1, len(names) + 1)])
        pictures = [read_png(name)[2] for name in names]
        shutil.rmtree(self.path("film"))
        return pictures

    def test_frames_of_a_body_that_turns(self):
        turn = {"command": "move", "markers": ["body"], "rotate": 30, "axis": [0, 0, 1]}
        frames = self.frames([turn], "--view", "+z", "--no-cut", "--no-wireframe")
        self.assertGreater(len(frames), 30)  # one for every degree
        different = sum(a != b for a, b in zip(frames, frames[1:]))
        self.assertGreaterEqual(different, 28)

        def width_of_body(rows):  # a square of edge a that turns by t spans a (cos t + sin t)
            across = [x for row in rows for x in range(5, 115) if row[x][2] < 200 and row[x] != row[5]]
            return max(across) - min(across)
        whole = width_of_body(frames[-1]) / width_of_body(frames[0])
        self.assertAlmostEqual(whole, math.cos(math.radians(30)) + .5, delta=.12)

    def test_frames_are_seen_alike_in_one_range_of_colours(self):
        move = {"command": "move", "markers": ["body"], "translate": [.1, 0, 0]}
        base = ("--cut", .5, .5, .5, 0, -1, 0, "--no-wireframe", "--no-legend", "--color", "volume",
                "--per-command", 3)
        frames = self.frames([move], *base)
        self.assertEqual(len(frames), 4)
        inked = [[(x, y) for y, row in enumerate(rows) for x, p in enumerate(row) if p != WHITE]
                 for rows in frames]
        for axis in (0, 1):  # the box fills the same part of every picture
            self.assertEqual(len({min(p[axis] for p in pixels) for pixels in inked}), 1)
            self.assertEqual(len({max(p[axis] for p in pixels) for pixels in inked}), 1)
        self.assertEqual(len({str(rows) for rows in frames}), 4)
        # The first mesh alone has elements of one volume, and would be of one colour at either end.
        self.assertGreater(len({p for row in frames[-1] for p in row}), 20)
        self.winslow("render", "box.su2", "-o", "one.png", "--size", 120, 120, *base[:-2], env=HEADLESS)
        self.assertNotEqual(read_png(self.path("one.png"))[2], frames[0])

    def test_frames_have_all_options_of_pictures(self):
        move = {"command": "move", "markers": ["body"], "translate": [0, 0, .1]}
        seen = set()
        for extra in ((), ("--crinkle",), ("--isolate", .6), ("--show", "body"), ("--hide", "body"),
                      ("--see-through", "far"), ("--perspective",), ("--view", "-x"), ("--dark",),
                      ("--half-width", .3), ("--no-cut",), ("--color", "aspect_ratio")):
            frames = self.frames([move], "--per-command", 2, *extra)
            self.assertEqual(len(frames), 3)
            seen.add(str(frames[-1]))
        self.assertEqual(len(seen), 12)
        text = self.frames([move], "--bounds", 0, 0, 1, 1, code=USAGE)
        self.assertIn("--bounds: only for a plane mesh", text)
        self.assertIn("misses the mesh", self.frames([move], "--cut", 9, 0, 0, 1, 0, 0, code=USAGE))
        self.assertFalse(self.path("film").exists())

    def test_the_mesh_may_follow_options_of_many_numbers(self):
        self.winslow("render", "-o", "p.png", "--cut", .5, .5, .5, -1, 0, 0, "box.su2", env=HEADLESS)
        self.winslow("render", "-o", "p.png", "--hide", "far,body", "box.su2", env=HEADLESS)

    def test_refusals_name_what_was_found(self):
        ring = self.ring()
        for args, words in (
                (("--cut", 0, 0, 3, 0, 0, 1), "misses the mesh, which lies from -3 to -2"),
                (("--cut", 0, 0, 0, 0, 0, 0), "the normal not 0 0 0"),
                (("--cut", 0, 0, 0, 0, 1), "--cut"),
                (("--cut", .5, .5, .5, 0, 0, 1) * 7, "at most 6 planes"),
                (("--cut", .5, .5, .5, 0, 0, 1, "--no-cut"), "--no-cut"),
                (("--hide", "wing"), "wing"),
                (("--view", "front"), "front"),
                (("--elevation", 100), "-90 to 90"),
                (("--half-width", 0), "--half-width"),
                (("--isolate", .3, "--color", "none"), "--color none"),
                (("--color", "area"), "smallest_solid_angle"),
                (("--color", "kappa"), "smallest_solid_angle"),
                (("--bounds", 0, 0, 1, 1), "--bounds: only for a plane mesh"),
                (("--vcv", 0), "node 0 lies on the boundary or on a marker: it has no VCV"),
                (("--vcv", 9999), "the mesh has no node 9999"),
                (("--vcv", 0, "--vcv-kind", "round"), "round")):
            with self.subTest(args=args):
                self.assertIn(words, self.render(*args, code=USAGE).stderr)
        for name in ("p.jpg", "p.eps"):
            run = self.winslow("render", "box.su2", "-o", name, code=USAGE)
            self.assertIn(".png, .svg or .pdf", run.stderr)
        of_volumes = (("--cut", 0, 0, 0, 0, 0, 1), ("--crinkle",), ("--hide", "body"), ("--vcv-kind", "equal"))
        in_space = (("--view", "+x"), ("--isolate", .5), ("--perspective",))  # of surface meshes, too
        for group, whose in ((of_volumes, "volume mesh"), (in_space, "mesh in space")):
            for args in group:
                run = self.winslow("render", ring, "-o", "p.png", *args, code=USAGE)
                self.assertIn(f"{args[0]}: only for a {whose}", run.stderr)
        run = self.winslow("render", ring, "-o", "p.png", "--color", "volume", code=USAGE)
        self.assertIn("normalized_jacobian", run.stderr)
        self.assertEqual(self.files(), ["box.su2", "ring.su2"])


if __name__ == "__main__":
    support.main()
