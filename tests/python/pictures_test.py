"""Pictures of the Python package."""

import struct
import unittest

import winslow
from support import HAS_GUI, PackageTest, cube, main, ring


def size_of(png):
    return struct.unpack(">II", png[16:24])


@unittest.skipUnless(HAS_GUI, "built without graphics")
class Pictures(PackageTest):
    def test_png(self):
        png = winslow.render(ring(), size=(320, 240), color="aspect_ratio", title="A ring")
        self.assertTrue(png.startswith(b"\x89PNG"))
        self.assertEqual(size_of(png), (320, 240))
        self.assertNotEqual(png, winslow.render(ring(), size=(320, 240)))

    def test_like_the_program(self):
        winslow.write(ring(), self.folder / "ring.su2")
        self.program("render", "ring.su2", "-o", "a.png", "--size", 320, 240, "--color", "normalized_jacobian",
                     "--dark", "--bounds", -1, -1, 1, 1)
        winslow.render(self.folder / "ring.su2", self.folder / "b.png", size=(320, 240), color="normalized_jacobian",
                       dark=True, bounds=(-1, -1, 1, 1))
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_volume(self):
        winslow.write(cube(), self.folder / "cube.su2")
        self.program("render", "cube.su2", "-o", "a.png", "--size", 320, 240, "--azimuth", 30, "--elevation", 20,
                     "--cut", 0.5, 0.5, 0.5, 1, 0, 0)
        png = winslow.render(cube(), size=(320, 240), azimuth=30, elevation=20, cuts=[((0.5, 0.5, 0.5), (1, 0, 0))])
        self.assertEqual((self.folder / "a.png").read_bytes(), png)

    def test_notebook(self):
        picture = ring().plot(size=(200, 100))
        self.assertEqual(size_of(picture._repr_png_()), (200, 100))
        self.assertIn("200 x 100", repr(picture))
        picture.save(self.folder / "p.png")
        self.assertEqual((self.folder / "p.png").read_bytes(), picture.png)

    def test_vector_graphics(self):
        self.assertIsNone(winslow.render(ring(), self.folder / "a.svg"))
        self.assertIn("<svg", (self.folder / "a.svg").read_text())

    def test_wrong_use(self):
        for call, text in ((lambda: winslow.render(ring(), colour="x"), "did you mean color"),
                           (lambda: winslow.render(ring(), color="beauty"), "expected"),
                           (lambda: winslow.render(ring(), size=(4, 4)), "16 to 16384"),
                           (lambda: winslow.render(ring(), size="big"), "size: found 'big'"),
                           (lambda: winslow.render(ring(), view="top"), "unknown option \"view\""),
                           (lambda: winslow.render(ring(), range=(1, 0)), "low < high"),
                           (lambda: winslow.render(ring(), self.folder / "a.jpg"), "png")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


if __name__ == "__main__":
    main()
