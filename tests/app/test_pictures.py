import unittest

import support
from png_pictures import HEADLESS, read_png
from support import ASSETS, HAS_GUI, INPUT, INTERNAL, INVERTED, USAGE, ProgramTest


@unittest.skipUnless(HAS_GUI, "built without graphics")
class Render(ProgramTest):
    def render(self, *args, code=support.DONE):
        return self.winslow("render", *args, code=code, env=HEADLESS)

    def test_draws_a_mesh_at_the_size_asked_for(self):
        self.ring()
        self.render("ring.su2", "-o", "p.png", "--size", "320", "200")
        width, height, rows = read_png(self.path("p.png"))
        self.assertEqual((width, height), (320, 200))
        colours = {pixel for row in rows for pixel in row}
        self.assertIn((255, 255, 255), colours)
        self.assertGreater(len(colours), 5)

    def test_bounds_choose_the_part_that_is_shown(self):
        self.ring(quads=True)
        base = ("ring.su2", "--size", "200", "200", "--color", "aspect_ratio", "--no-wireframe",
                "--no-legend")
        self.render(*base, "-o", "cells.png", "--bounds", "1", "1", "1.5", "1.5")
        _, _, rows = read_png(self.path("cells.png"))
        self.assertNotIn((255, 255, 255), rows[90][50:150])  # inside the ring: cells everywhere
        self.render(*base, "-o", "hole.png", "--bounds", "-0.2", "-0.2", "0.2", "0.2")
        _, _, rows = read_png(self.path("hole.png"))
        self.assertEqual(set(rows[90][50:150]), {(255, 255, 255)})  # inside the body: nothing

    def test_options_change_the_picture(self):
        self.ring()
        base = ("ring.su2", "-o", "p.png", "--size", "320", "240", "--color",
                "normalized_jacobian")
        seen = set()
        for extra in ((), ("--dark",), ("--no-wireframe",), ("--no-legend",), ("--title", "Ring"),
                      ("--map", "cividis"), ("--range", "0.2", "0.4"),
                      ("--bounds", "-1", "-1", "1", "1")):
            self.render(*base, *extra)
            seen.add(self.path("p.png").read_bytes())
        self.assertEqual(len(seen), 8)

    def test_axis_and_percentiles_change_the_colours(self):
        # Rings of cells whose areas span five decades.
        self.ring(quads=True, rings=24, inner=0.01)
        base = ("ring.su2", "-o", "p.png", "--size", "320", "240", "--color", "area",
                "--no-wireframe", "--no-legend", "--bounds", "-4", "-4", "4", "4")
        pictures = {}
        for extra in ((), ("--axis", "linear"), ("--axis", "log"), ("--percentiles", "5", "95"),
                      ("--percentiles", "0", "100", "--axis", "linear")):
            self.render(*base, *extra)
            _, _, rows = read_png(self.path("p.png"))
            pictures[extra] = {pixel for row in rows for pixel in row}
        self.assertEqual(pictures[()], pictures["--axis", "log"])
        self.assertGreater(len(pictures[()]), len(pictures["--axis", "linear"]) + 3)
        for wrong in (("--percentiles", "90", "10"), ("--percentiles", "-1", "50"),
                      ("--percentiles", "1", "99", "--range", "0", "1"), ("--axis", "square")):
            self.render(*base, *wrong, code=USAGE)

    def test_a_scrambled_mesh_is_red_where_it_lies_over_itself(self):
        self.winslow("scramble", ASSETS / "three_element.su2", "-o", "s.su2", "--seed", "1",
                     "--allow-inverted", code=INVERTED)
        for color in ((), ("--color", "normalized_jacobian")):
            self.render("s.su2", "-o", "p.png", *color)
            _, _, rows = read_png(self.path("p.png"))
            inside = [rows[y][x] for y in range(250, 700, 10) for x in range(300, 700, 10)]
            self.assertTrue(all(r > 120 and g < 120 and b < 120 for r, g, b in inside))

    def test_inverted_elements_are_red(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "t.su2", "--marker", "body", "--translate", "1.5",
                     "0", "--no-smooth", "--allow-inverted", code=INVERTED)
        red = []
        for name in ("ring.su2", "t.su2"):
            self.render(name, "-o", "p.png", "--size", "400", "400", "--no-wireframe", "--bounds",
                        "-2", "-2", "2", "2")  # without the far field, whose line is reddish
            _, _, rows = read_png(self.path("p.png"))
            red.append(sum(r > 180 and g < 90 and b < 90 for row in rows for r, g, b in row))
        self.assertLess(red[0], 100)
        self.assertGreater(red[1], 1000)

    def test_control_volumes_are_drawn_over_the_mesh(self):
        self.ring()
        pictures = []
        for args in ((), ("--vcv", "84"), ("--vcv", "84,85,60")):
            self.render("-o", "p.png", "--size", "300", "300", *args, "ring.su2")
            pictures.append(read_png(self.path("p.png"))[2])

        def differing(a, b):
            return sum(p != q for r, s in zip(a, b) for p, q in zip(r, s))
        self.assertGreater(differing(pictures[0], pictures[1]), 50)
        self.assertGreater(differing(pictures[1], pictures[2]), 50)

    def test_control_volumes_are_vectors_in_vector_graphics(self):
        self.ring()
        for name in ("p.svg", "p.pdf"):
            sizes = []
            for args in ((), ("--vcv", "84"), ("--vcv", "84,85,60")):
                self.render("-o", name, *args, "ring.su2")
                sizes.append(self.path(name).stat().st_size)
            self.assertLess(sizes[0], sizes[1])
            self.assertLess(sizes[1], sizes[2])
        self.assertNotIn("<image", self.path("p.svg").read_text())

    def test_a_picture_is_what_its_name_says(self):
        self.ring()
        for name in ("p.bmp", "p.jpg", "p"):
            run = self.render("ring.su2", "-o", name, code=USAGE)
            self.assertIn(".png, .svg or .pdf", run.stderr)
            self.assertFalse(self.path(name).exists())
        self.render("ring.su2", "-o", "P.PNG")

    def test_a_node_without_a_control_volume_is_named(self):
        self.ring()
        self.render("ring.su2", "-o", "p.svg", "--vcv", "3", code=USAGE)
        run = self.render("ring.su2", "-o", "p.png", "--vcv", "84,99999", code=USAGE)
        self.assertIn("no node 99999: its nodes count from 0 to 215", run.stderr)
        run = self.render("ring.su2", "-o", "p.png", "--vcv", "3", code=USAGE)
        self.assertIn("node 3 lies on the boundary", run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_fields_of_the_control_volumes_colour_elements(self):
        self.ring()
        pictures = set()
        for field in ("kappa", "smallest_weight", "residual"):
            self.render("ring.su2", "-o", "p.png", "--size", "200", "200", "--color", field)
            pictures.add(self.path("p.png").read_bytes())
        self.assertEqual(len(pictures), 3)

    def test_bad_usage(self):
        self.ring()
        for args in (("--color", "beauty"), ("--vcv", "one"), ("--size", "0", "10"), ("--bounds", "1", "0", "0", "1"),
                     ("--bounds", "0", "0", "1"), ("--bounds", "0", "0", "nan", "1"),
                     ("--color", "area", "--range", "2", "1"), ("--range", "0", "1"),
                     ("--map", "rainbow")):
            with self.subTest(args=args):
                self.render("ring.su2", "-o", "p.png", *args, code=USAGE)
        self.render("none.su2", "-o", "p.png", code=INPUT)
        self.render("ring.su2", "-o", "no/p.png", code=INPUT)
        self.assertEqual(self.files(), ["ring.su2"])


@unittest.skipUnless(HAS_GUI, "built without graphics")
class Studio(ProgramTest):
    def test_screenshot_without_a_display(self):
        self.ring()
        self.winslow("studio", "--screenshot", "empty.png", "--size", "800", "500", env=HEADLESS)
        self.winslow("studio", "--screenshot", "ring.png", "--size", "800", "500", "ring.su2",
                     env=HEADLESS)
        width, height, rows = read_png(self.path("ring.png"))
        self.assertEqual((width, height), (800, 500))
        self.assertNotEqual(rows, read_png(self.path("empty.png"))[2])

    def test_no_display_says_what_to_do(self):
        run = self.winslow("studio", code=INTERNAL, env=HEADLESS)
        self.assertIn("winslow studio --screenshot", run.stderr)

    def test_errors(self):
        self.winslow("studio", "--screenshot", "p.png", "none.su2", code=INPUT, env=HEADLESS)
        self.winslow("studio", "--screenshot", "no/p.png", code=INPUT, env=HEADLESS)
        self.winslow("studio", "--size", "1", "1", code=USAGE, env=HEADLESS)


@unittest.skipIf(HAS_GUI, "built with graphics")
class WithoutGraphics(ProgramTest):
    def test_render_and_studio_say_so(self):
        self.ring()
        for args in (("render", "ring.su2", "-o", "p.png"), ("studio", "ring.su2"),
                     ("studio", "--screenshot", "p.png")):
            run = self.winslow(*args, code=INTERNAL)
            self.assertIn("built without graphics", run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])


if __name__ == "__main__":
    support.main()
