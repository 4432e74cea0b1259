import os
import stat
import unittest

import support
from support import INPUT, USAGE, ProgramTest


class Usage(ProgramTest):
    def test_version(self):
        self.assertRegex(self.winslow("--version").stdout, r"^winslow \d+\.\d+\.\d+$")

    def test_help(self):
        drawing = ("render", "studio") if support.HAS_GUI else ()
        for command in ("smooth", "move", "deform", "scramble", "quality", "convert", "replay", *drawing):
            self.assertIn(command, self.winslow("--help").stdout)
            text = self.winslow(command, "--help").stdout
            self.assertIn(f"Usage: winslow {command}", text)

    def test_no_command(self):
        self.assertIn("Subcommands:", self.winslow(code=USAGE).stderr)

    def test_misspelt_command_and_option(self):
        run = self.winslow("smoth", "a.su2", code=USAGE)
        self.assertIn('unknown command "smoth"; did you mean smooth?', run.stderr)
        self.ring()
        run = self.winslow("smooth", "ring.su2", "-o", "o.su2", "--tolerence", "1e-3", code=USAGE)
        self.assertIn("unknown option --tolerence; did you mean --tolerance?", run.stderr)
        run = self.winslow("smooth", "ring.su2", "more.su2", "-o", "o.su2", code=USAGE)
        self.assertIn('unexpected argument "more.su2"', run.stderr)

    def test_bad_values(self):
        self.ring()
        smooth = ("smooth", "ring.su2", "-o", "o.su2")
        for option, value, word in (
                ("--linear", "dirct", "did you mean direct?"), ("--linear", "", "point-implicit"),
                ("--formulation", "magic", "pointwise"), ("--clip", "maybe", "auto"),
                ("--damping", "0", "damping"), ("--damping", "1.5", "damping"),
                ("--damping", "nan", "damping"), ("--damping", "fast", "damping"),
                ("--tolerance", "-1", "tolerance"), ("--max-iterations", "-3", "iterations"),
                ("--max-iterations", "1.5", "max-iterations"), ("--threads", "-1", "threads"),
                ("--gmsh-version", "3", "2.2")):
            with self.subTest(option=option, value=value):
                self.assertIn(word, self.winslow(*smooth, option, value, code=USAGE).stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_bad_motions(self):
        self.ring()
        move = ("move", "ring.su2", "-o", "o.su2", "--marker", "body")
        for values in (("--rotate", "nan"), ("--rotate", "inf"), ("--rotate",),
                       ("--rotate", "1", "--pivot", "0"), ("--translate", "1"),
                       ("--rotate", "1", "--increments", "-2")):
            with self.subTest(values=values):
                self.winslow(*move, *values, code=USAGE)
        self.winslow("scramble", "ring.su2", "-o", "o.su2", "--seed", "-1", code=USAGE)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_missing_arguments(self):
        self.ring()
        self.assertIn("-o OUT", self.winslow("smooth", "ring.su2", code=USAGE).stderr)
        self.winslow("smooth", "-o", "o.su2", code=USAGE)
        self.winslow("move", "ring.su2", "-o", "o.su2", "--rotate", "3", code=USAGE)
        if support.HAS_GUI:
            self.winslow("render", "ring.su2", code=USAGE)
        self.winslow("convert", "ring.su2", code=USAGE)
        self.winslow("replay", code=USAGE)

    def test_the_same_file_twice(self):
        self.ring()
        smooth = ("smooth", "ring.su2", "-o", "o.su2")
        self.winslow(*smooth, "--report", "a", "--history", "./a", code=USAGE)
        self.winslow(*smooth, "--report", "ring.su2", code=USAGE)
        self.assertEqual(self.files(), ["ring.su2"])


class Files(ProgramTest):
    def test_missing_and_broken_input(self):
        run = self.winslow("smooth", "none.su2", "-o", "o.su2", code=INPUT)
        self.assertIn("none.su2", run.stderr)
        self.path("bad.su2").write_text("NDIME= 2\nNELEM= 1\n5 0 1 7 0\nNPOIN= 3\n0 0\n1 0\n0 1\n")
        run = self.winslow("smooth", "bad.su2", "-o", "o.su2", code=INPUT)
        self.assertIn("bad.su2:3", run.stderr)
        self.assertNotIn("o.su2", self.files())

    def test_unwritable_output_is_noticed_before_the_solve(self):
        # The input does not exist: a check after loading would complain of that instead.
        run = self.winslow("smooth", "none.su2", "-o", "no/such/folder/o.su2", code=INPUT)
        self.assertIn("no/such/folder", run.stderr)
        for option in ("--report", "--history", "--save-recipe"):
            run = self.winslow("smooth", "none.su2", "-o", "o.su2", option, "nowhere/x", code=INPUT)
            self.assertIn("nowhere", run.stderr)
        run = self.winslow("smooth", "none.su2", "-o", ".", code=USAGE)
        run = self.winslow("smooth", "none.su2", "-o", "o.docx", code=USAGE)
        self.assertIn(".su2", run.stderr)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_read_only_folder(self):
        self.ring()
        self.path("locked").mkdir()
        self.path("locked").chmod(stat.S_IRUSR | stat.S_IXUSR)
        self.winslow("smooth", "ring.su2", "-o", "locked/o.su2", code=INPUT)

    def test_control_characters_of_names_do_not_reach_the_terminal(self):
        nodes, elements, markers = support.ring_mesh()
        markers = {"bo\x1b[31mdy": markers["body"], "far\u009bfield": markers["farfield"]}
        support.write_su2(self.path("m.su2"), nodes, elements, markers)
        run = self.winslow("move", "m.su2", "-o", "o.su2", "--marker", "bo\x1b[31mdy", "--rotate", "1")
        self.assertIn("Rotate bo\\x1b[31mdy", run.stdout)
        run = self.winslow("move", "m.su2", "-o", "o.su2", "--marker", "x\x07", "--rotate", "1",
                           code=USAGE)
        self.assertIn("far\\x9bfield", run.stderr)
        self.assertIn("x\\x07", run.stderr)
        for char in "\x1b\x07\u009b":
            self.assertNotIn(char, run.stdout + run.stderr)
        self.assertIn("bo\x1b[31mdy", self.path("o.su2").read_text())

    def test_warnings_of_the_reader_are_shown_and_reported(self):
        nodes, elements, markers = support.ring_mesh()
        support.write_su2(self.path("m.su2"), nodes + [(9.0, 9.0)], elements, markers)
        run = self.winslow("smooth", "m.su2", "-o", "o.su2", "--report", "r.json")
        self.assertIn("warning", run.stderr)
        self.assertEqual(len(self.json("r.json")["warnings"]), 1)
        run = self.winslow("smooth", "m.su2", "-o", "o.su2", "--quiet")
        self.assertEqual((run.stdout, run.stderr), ("", ""))


if __name__ == "__main__":
    support.main()
