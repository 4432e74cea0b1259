"""Numbers without a leading zero: ".3" and "-.2" are read as "0.3" and "-0.2", in lists, too."""
import unittest

import support
from support import HAS_GUI, USAGE, ProgramTest
from volume_meshes import write_box


class Numbers(ProgramTest):
    def assert_same(self, command, short, long, output="o.su2"):
        """Runs `command` with the options `short`, then with `long`: the outputs are the same bytes."""
        self.winslow(*command, "-o", output, *short)
        bytes_of_short = self.path(output).read_bytes()
        self.winslow(*command, "-o", output, *long)
        self.assertEqual(self.path(output).read_bytes(), bytes_of_short)

    def test_single_numbers(self):
        self.ring()
        move = ("move", "ring.su2", "--marker", "body")
        self.assert_same(move, ("--rotate", "-.5"), ("--rotate", "-0.5"))
        self.assert_same(move, ("--rotate=-.5",), ("--rotate", "-0.5"))
        self.assert_same(move, ("--rotate", "-.5e1"), ("--rotate", "-5"))
        self.assert_same(move, ("--rotate", ".5", "--damping", ".9"), ("--rotate", "0.5", "--damping", "0.9"))

    def test_lists_of_two_or_three(self):
        self.ring()
        move = ("move", "ring.su2", "--marker", "body", "--rotate", "5")
        self.assert_same(move, ("--pivot", ".3", "-.2"), ("--pivot", "0.3", "-0.2"))
        self.assert_same(move, ("--pivot", "-.3", "-.2"), ("--pivot", "-0.3", "-0.2"))
        self.assert_same(move, ("--translate", "-.1", "-.2"), ("--translate", "-0.1", "-0.2"))
        self.assert_same(move, ("--keep-outside-centre", "-.1", "-.2", "--keep-outside-radius", "3"),
                         ("--keep-outside-centre", "-0.1", "-0.2", "--keep-outside-radius", "3"))
        self.assert_same(move, ("--keep-outside-corner", "-3", "-.9e1", "--keep-outside-opposite", "3", "3"),
                         ("--keep-outside-corner", "-3", "-9", "--keep-outside-opposite", "3", "3"))

    def test_lists_of_three(self):
        write_box(self.path("box.su2"))
        move = ("move", "box.su2", "--marker", "body", "--rotate", "10")
        self.assert_same(move, ("--axis", "-.1", ".2", "-.3", "--pivot", ".4", ".5", ".6"),
                         ("--axis", "-0.1", "0.2", "-0.3", "--pivot", "0.4", "0.5", "0.6"))
        self.assert_same(move, ("--axis", "0", "0", "1", "--translate", "-.01", "-.02", "-.03"),
                         ("--axis", "0", "0", "1", "--translate", "-0.01", "-0.02", "-0.03"))

    def test_lists_of_a_shape(self):
        self.ring()
        self.assert_same(("deform", "ring.su2", "--marker", "body"),
                         ("--sine", "-.05", ".5", "--direction", "-.6", "-.8"),
                         ("--sine", "-0.05", "0.5", "--direction", "-0.6", "-0.8"))

    @unittest.skipUnless(HAS_GUI, "draws")
    def test_lists_of_a_picture(self):
        self.ring()
        write_box(self.path("box.su2"))
        small = ("--size", "200", "150", "--quiet")
        self.assert_same(("render", "ring.su2", "--color", "normalized_jacobian", *small),
                         ("--bounds", "-.9", "-.8", ".9", ".8", "--range", "-.1", ".9"),
                         ("--bounds", "-0.9", "-0.8", "0.9", "0.8", "--range", "-0.1", "0.9"), "o.png")
        self.assert_same(("render", "box.su2", *small),
                         ("--cut", ".5", ".5", ".5", "-.1", "-.2", "1", "--centre", ".4", "-.1", ".5"),
                         ("--cut", "0.5", "0.5", "0.5", "-0.1", "-0.2", "1", "--centre", "0.4", "-0.1", "0.5"),
                         "o.png")

    def test_words_that_are_no_numbers_stay_as_they_are(self):
        self.ring()
        move = ("move", "ring.su2", "-o", "o.su2", "--marker", "body")
        self.assertIn("--pivot", self.winslow(*move, "--pivot", ".3", "-.2x", "--rotate", "1", code=USAGE).stderr)
        self.assertIn("-.", self.winslow(*move, "--rotate", "-.", code=USAGE).stderr)
        self.winslow("smooth", "ring.su2", "-o", "-.su2")
        self.assertIn("-.su2", self.files())


if __name__ == "__main__":
    support.main()
