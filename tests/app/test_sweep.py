"""A mesh for each of many motions: sweep."""
import csv
import math

import support
from support import ASSETS, INPUT, INVERTED, USAGE, ProgramTest
from volume_meshes import write_box

WING = ASSETS / "coarse" / "three_element.su2"
FLAP = ("--marker", "flap", "--pivot", "0.848", "-0.036")


def difference(path, other):
    one, two = support.read_su2(path)[0], support.read_su2(other)[0]
    return max(math.dist(a, b) for a, b in zip(one, two))


class Sweep(ProgramTest):
    def sweep(self, *words, mesh="ring.su2", out="out/s_{step}.su2", code=support.DONE):
        return self.winslow("sweep", mesh, "-o", out, *words, code=code)

    def rows(self, name="r.csv"):
        with open(self.path(name), newline="") as file:
            return list(csv.DictReader(file))

    def table(self, text, name="motions.csv"):
        self.path(name).write_text(text)
        return name

    def refused(self, *words, code=USAGE, **options):
        """The message; nothing has been written."""
        before = self.files()
        run = self.sweep(*words, code=code, **options)
        self.assertEqual(self.files(), before)
        return run.stderr

    def test_every_step_is_the_mesh_of_its_own_move(self):
        run = self.sweep(*FLAP, "--rotate", "-6:4:2", "--results", "r.csv", mesh=WING,
                         out="out/deep/flap_{rotate}.su2")
        folder = self.path("out/deep")
        self.assertEqual(sorted(p.name for p in folder.iterdir()),
                         sorted(f"flap_{angle}.su2" for angle in range(-6, 5, 2)))
        rows = self.rows()
        self.assertEqual([row["rotate"] for row in rows], ["-6", "-4", "-2", "0", "2", "4"])
        for angle, row in zip(range(-6, 5, 2), rows):
            self.assertEqual(row["status"], "done")
            self.assertEqual(row["output"], f"out/deep/flap_{angle}.su2")
            self.winslow("move", WING, "-o", "one.su2", *FLAP, "--rotate", angle, "--report",
                         "one.json")
            # In a mesh of 200 chords.
            self.assertLess(difference(self.path(row["output"]), self.path("one.su2")), 1e-8)
            quality = self.json("one.json")["quality"]
            for metric, values in quality.items():
                for key, name in (("min", "min"), ("avg", "mean"), ("max", "max")):
                    self.assertAlmostEqual(float(row[f"{metric}_{name}"]), values[key], 6)
            heights = self.json("one.json")["walls"]["first_height_ratio"]
            for key in ("p05", "median", "p95"):
                self.assertAlmostEqual(float(row[f"first_height_ratio_{key}"]), heights[key], 6)
        self.assertEqual(rows[0]["begins_at"], "2")
        self.assertEqual(rows[2]["begins_at"], "")
        self.assertEqual(rows[0]["motion"], "flap rotate=-6 pivot=0.848,-0.036")
        # At rest the file has the bytes of the input.
        self.assertEqual(self.path("out/deep/flap_0.su2").read_bytes(), WING.read_bytes())
        self.assertIn("step 4, flap rotate=0: done, nothing moves", run.stdout)
        self.assertIn("6 steps in ", run.stdout)

    def test_steps_that_harm_the_mesh_are_named_as_move_does(self):
        run = self.sweep(*FLAP, "--rotate", "-1,-30", mesh=WING)
        one = self.winslow("move", WING, "-o", "one.su2", *FLAP, "--rotate", "-1")
        self.assertNotIn("fell from", one.stderr)
        one = self.winslow("move", WING, "-o", "one.su2", *FLAP, "--rotate", "-30")
        self.assertIn("the smallest sine fell from", one.stderr)
        self.assertIn("warning: step 2: the smallest sine fell by more than 10 %", run.stderr)
        self.assertNotIn("1", run.stderr.split("warning: step")[1].split(":")[0])

    def test_ranges_are_lists_as_well_and_combine(self):
        self.ring()
        self.sweep("--marker", "body", "--rotate", "-.5,0:1:.25", "--translate", "0,0.1", "0:-.1:-.1",
                   "--results", "r.csv", out="{rotate}_{translate_x}_{translate_y}.su2")
        rows = self.rows()
        self.assertEqual(len(rows), 6 * 2 * 2)
        self.assertEqual([row["rotate"] for row in rows[:6]],
                         ["-0.5", "0", "0.25", "0.5", "0.75", "1"])
        self.assertIn("0.25_0.1_-0.1.su2", self.files())
        self.assertEqual(rows[0]["step"], "01")
        before, _, markers = support.read_su2(self.path("ring.su2"))
        after = support.read_su2(self.path("0.25_0.1_-0.1.su2"))[0]
        for node in {n for edge in markers["body"] for n in edge}:
            there = support.rotated(before[node], 0.25, (0, 0), (0.1, -0.1))
            self.assertLess(math.dist(after[node], there), 1e-12)

    def test_results_do_not_depend_on_jobs(self):
        self.ring()
        words = ("--marker", "body", "--rotate", "-20:20:5", "-q")
        self.sweep(*words)
        self.sweep(*words, "--jobs", "3", out="jobs/s_{step}.su2")
        for step in range(1, 10):
            self.assertEqual(self.path(f"jobs/s_{step}.su2").read_bytes(),
                             self.path(f"out/s_{step}.su2").read_bytes())

    def test_a_table_moves_bodies_together(self):
        table = self.table("# slat and flap\nstep; marker; rotate; pivot_x; pivot_y; translate_x\n"
                           'open; slat; 4;;; -0.01\nopen; "flap"; -8; 0.848; -0.036;\n\n'
                           "shut;flap;0;;;\n")
        self.sweep("--table", table, "--results", "r.csv", mesh=WING)
        self.winslow("move", WING, "-o", "one.su2", "--body", "slat", "rotate=4", "translate=-0.01,0",
                     "--body", "flap", "rotate=-8", "pivot=0.848,-0.036")
        self.assertLess(difference(self.path("out/s_open.su2"), self.path("one.su2")), 1e-8)
        self.assertEqual(self.path("out/s_shut.su2").read_bytes(), WING.read_bytes())
        opened, shut = self.rows()
        self.assertEqual((opened["slat rotate"], opened["flap rotate"]), ("4", "-8"))
        self.assertEqual((shut["slat rotate"], shut["flap rotate"]), ("0", "0"))

    def test_columns_and_fields_that_are_missing_have_defaults(self):
        self.ring()
        table = self.table('marker,rotate\n"body,farfield",5\n,10\n')
        self.sweep("--table", table, "--marker", "body", "--pivot", "0.2", "0", "--results", "r.csv")
        rows = self.rows()
        self.assertEqual([row["step"] for row in rows], ["1", "2"])
        self.assertEqual(rows[0]["motion"], "body,farfield rotate=5 pivot=0.2,0")
        self.assertEqual(rows[1]["motion"], "body rotate=10 pivot=0.2,0")

    def test_volumes_have_an_axis(self):
        write_box(self.path("box.su2"))
        table = self.table("step,marker,rotate,axis_x,axis_y,axis_z,translate_z\n"
                           "a,body,4,0,0,1,0\nb,body,8,0,0,1,0.01\n")
        self.sweep("--table", table, "--results", "r.csv", mesh="box.su2")
        self.winslow("move", "box.su2", "-o", "one.su2", "--marker", "body", "--rotate", 8, "--axis",
                     0, 0, 1, "--translate", 0, 0, 0.01)
        self.assertEqual([row["status"] for row in self.rows()], ["done", "done"])
        self.assertIn("axis=0,0,1", self.rows()[0]["motion"])

    def test_steps_that_fail_are_named_and_the_others_written(self):
        self.ring()
        run = self.sweep("--marker", "body", "--translate", "0.5,8,1", "0", "--results", "r.csv",
                         code=INVERTED)
        self.assertEqual(sorted(p.name for p in self.path("out").iterdir()),
                         ["s_1.su2", "s_3.su2"])
        self.assertIn("step 2 is incomplete: body would touch farfield at", run.stderr)
        self.assertIn("2 of 3 steps are done", run.stderr)
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows], ["done", "incomplete", "done"])
        self.assertIn("body would touch farfield", rows[1]["message"])
        self.assertEqual(rows[1]["output"], "")
        self.sweep("--marker", "body", "--translate", "0.5,8", "0", "--accept-partial",
                   out="part_{step}.su2", code=INVERTED)
        self.assertIn("part_2.su2", self.files())

    def test_what_is_read_is_not_written_over_and_no_two_steps_have_one_file(self):
        self.ring("s_2.su2")
        turn = ("--marker", "body", "--rotate", "0:4:2")
        self.assertIn("would be written over s_2.su2, which is read",
                      self.refused(*turn, mesh="s_2.su2", out="s_{step}.su2"))
        self.ring()
        self.assertIn("steps 1 and 2 would both be written to out.su2",
                      self.refused(*turn, out="out.su2"))
        self.assertIn("steps 1 and 2 would both", self.refused(*turn, out="s_{translate_x}.su2"))
        table = self.table("step,marker,rotate\nring,body,3\n")
        self.assertIn("which is read", self.refused("--table", table, out="{step}.su2"))
        self.assertIn("which is read",
                      self.refused("--table", table, "--results", "motions.csv"))
        self.assertIn("would be written twice",
                      self.refused(*turn, "--results", "out/s_1.su2", code=USAGE))

    def test_names_of_files_that_cannot_be(self):
        self.ring()
        turn = ("--marker", "body", "--rotate", "0:4:2")
        self.assertIn("did you mean rotate?", self.refused(*turn, out="s_{rotat}.su2"))
        self.assertIn("{ without }", self.refused(*turn, out="s_{step.su2"))
        self.assertIn("unknown extension", self.refused(*turn, out="s_{step}.xyz"))
        self.path("file").write_text("")
        self.assertIn("cannot be made in", self.refused(*turn, out="file/s_{step}.su2", code=INPUT))
        several = self.table("step,marker,rotate\na,body,3\na,farfield,3\n")
        self.assertIn("is of a single body, and 2 move in step a",
                      self.refused("--table", several, out="s_{rotate}.su2"))
        self.assertIn("has a slash", self.refused("--table", self.table(
            "step,marker,rotate\na/b,body,3\n")))

    def test_wrong_ranges_and_options(self):
        self.ring()
        body = ("--marker", "body")
        for words, message in (
                (body, "nothing to do"),
                (("--rotate", "1"), "nothing to move"),
                ((*body, "--rotate", "0:10:-2"), "does not lead from 0 to 10"),
                ((*body, "--rotate", "0:10:0"), "does not lead"),
                ((*body, "--rotate", "0:10"), 'found "0:10", expected a number, FROM:TO:STEP'),
                ((*body, "--rotate", "1,,2"), 'found ""'),
                ((*body, "--rotate", "0:1:1e-9"), "expected a longer step"),
                ((*body, "--rotate", "a"), 'found "a"'),
                ((*body, "--translate", "1", "2", "3"), "step 1: "),
                (("--marker", "bdy", "--rotate", "1,2"), "did you mean body?"),
                ((*body, "--rotate", "1,2", "--direct", "--min-quality", "normalized_jacobian=0.1"),
                 "need 0 steps"),
                ((*body, "--rotate", "1,2", "--slide", "nowhere"), "nowhere")):
            self.assertIn(message, self.refused(*words))
        table = self.table("marker,rotate\nbody,3\n")
        self.assertIn("found --table together with --rotate",
                      self.refused("--table", table, "--rotate", "1"))

    def test_bad_tables_name_the_line(self):
        self.ring()
        for text, line, message in (
                ("body,3\n", 1, "found the column 'body', expected names of columns"),
                ("marker,rotat\nbody,3\n", 1, "found the column 'rotat'"),
                ("marker,rotate,rotate\nbody,3,4\n", 1, "twice"),
                ("rotate\n3\n", 1, 'found no column "marker"'),
                ("marker\nbody\n", 1, "found nothing that moves"),
                ("marker,rotate,pivot_x\nbody,3,1\n", 1, "some of the columns pivot"),
                ("marker,rotate\n\n# none\n", 3, "found no row"),
                ("marker,rotate\nbody,3,4\n", 2, "found 3 columns, expected 2"),
                ("marker,rotate\nbody,x\n", 2, "found 'x' in the column rotate"),
                ("marker,rotate\nbody,inf\n", 2, "expected a finite number"),
                ("marker,rotate\n,3\n", 2, "found an empty name of a marker"),
                ("marker,rotate,pivot_x,pivot_y\nbody,3,1,\n", 2, "found an empty field of the pivot"),
                ("step,marker,rotate\na,body,3\n,body,4\n", 3, "found an empty field"),
                ('step,marker,rotate\na,body,3\nb,body,4\na,"farfield,body",4\n', 4,
                 "found the marker 'body' twice in step a")):
            error = self.refused("--table", self.table(text), code=INPUT)
            self.assertIn(f"motions.csv:{line}: ", error)
            self.assertIn(message, error)
        self.assertIn("nowhere", self.refused("--table", self.table("marker,rotate\nnowhere,3\n")))
        self.assertIn("missing.csv", self.refused("--table", "missing.csv", code=INPUT))

    def test_the_reference_mesh_and_held_layers(self):
        self.ring(quads=True)
        self.winslow("move", "ring.su2", "-o", "turned.su2", "--marker", "body", "--rotate", "10")
        self.sweep("--marker", "body", "--rotate", "-10:0:5", "--reference-mesh", "ring.su2",
                   mesh="turned.su2")
        self.assertLess(difference(self.path("out/s_1.su2"), self.path("ring.su2")), 1e-8)
        self.ring("layered.su2", quads=True, rings=24)
        self.sweep("--marker", "body", "--rotate", "5,10", "--hold-layers", "body",
                   out="held_{rotate}.su2", mesh="layered.su2")
        self.winslow("move", "layered.su2", "-o", "one.su2", "--marker", "body", "--rotate", "10",
                     "--hold-layers", "body")
        self.assertLess(difference(self.path("held_10.su2"), self.path("one.su2")), 1e-9)


if __name__ == "__main__":
    support.main()
