"""`winslow render` of volume meshes: cuts, views, what is shown of the boundary, refusals."""
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
                (("--vcv", 3), "--vcv: only for a plane mesh")):
            with self.subTest(args=args):
                self.assertIn(words, self.render(*args, code=USAGE).stderr)
        for name in ("p.svg", "p.pdf"):
            run = self.winslow("render", "box.su2", "-o", name, code=USAGE)
            self.assertIn("ends in .png", run.stderr)
        self.path("r.json").write_text(
            '{"winslow_recipe": 1, "commands": [{"command": "smooth"}]}')
        run = self.winslow("render", "box.su2", "--recipe", "r.json", "--frames", "f", code=USAGE)
        self.assertIn("only for a plane mesh", run.stderr)
        for args in (("--cut", 0, 0, 0, 0, 0, 1), ("--view", "+x"), ("--crinkle",), ("--hide", "body"),
                     ("--isolate", .5), ("--perspective",)):
            run = self.winslow("render", ring, "-o", "p.png", *args, code=USAGE)
            self.assertIn(f"{args[0]}: only for a volume mesh", run.stderr)
        run = self.winslow("render", ring, "-o", "p.png", "--color", "volume", code=USAGE)
        self.assertIn("normalized_jacobian", run.stderr)
        self.assertEqual(self.files(), ["box.su2", "r.json", "ring.su2"])


if __name__ == "__main__":
    support.main()
