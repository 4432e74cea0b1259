"""What bites: signals, limits, devices, damaged files, outputs that are inputs."""
import os
import pathlib
import resource
import signal
import subprocess
import time
import unittest

import support
from support import ASSETS, HAS_GUI, INPUT, INTERRUPTED, USAGE, WINSLOW, ProgramTest

TANGLED_REST = 6
DATA = pathlib.Path(__file__).resolve().parents[1] / "data"


def has_cgns():
    run = subprocess.run([WINSLOW, "quality", DATA / "long_label.cgns"], capture_output=True,
                         text=True, check=False)
    return "built without CGNS" not in run.stderr


class Inputs(ProgramTest):
    """Nothing that a run reads is written over, but the mesh itself on demand."""

    def refused(self, *args):
        run = self.winslow(*args, code=USAGE)
        self.assertIn("is a file that this run reads, and would be replaced", run.stderr)

    def test_reports_do_not_replace_what_is_read(self):
        self.ring()
        self.ring("rest.su2")
        self.path("d.csv").write_text("node,dx,dy\n30,0.01,0\n")
        smooth = ("smooth", "ring.su2", "-o", "o.su2")
        move = ("move", "ring.su2", "--marker", "body", "--rotate", "5")
        deform = ("deform", "ring.su2", "--displacements", "d.csv")
        self.refused(*smooth, "--report", "./ring.su2")
        self.refused(*smooth, "--history", "ring.su2")
        self.refused(*move, "-o", "rest.su2", "--reference-mesh", "rest.su2")
        self.refused(*move, "-o", "o.su2", "--reference-mesh", "rest.su2", "--report", "rest.su2")
        self.refused(*deform, "-o", "o.su2", "--report", "d.csv")
        self.refused(*deform, "-o", "o.su2", "--history", self.path("d.csv"))
        self.refused("quality", "ring.su2", "rest.su2", "--report", "rest.su2")
        self.path("link.su2").symlink_to("rest.su2")
        self.refused(*move, "-o", "link.su2", "--reference-mesh", "rest.su2")
        self.assertEqual(self.files(), ["d.csv", "link.su2", "rest.su2", "ring.su2"])

    def test_replay_does_not_replace_its_recipe_or_tables(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n30,0.01,0\n")
        self.path("r.json").write_text(
            '{"winslow_recipe": 1, "input": "ring.su2", "commands":'
            ' [{"command": "deform", "displacements": {"file": "d.csv"}}]}')
        self.refused("replay", "r.json", "-o", "o.su2", "--report", "r.json")
        self.refused("replay", "r.json", "-o", "o.su2", "--report", "d.csv")
        self.winslow("replay", "r.json", "-o", "o.su2", "--report", "report.json")

    def test_the_mesh_itself_may_be_written_over(self):
        self.ring()
        self.winslow("smooth", "ring.su2", "-o", "ring.su2")

    @unittest.skipUnless(HAS_GUI, "built without the studio")
    def test_pictures_do_not_replace_what_is_read(self):
        self.ring("a.su2")
        self.path("b.png").write_bytes(self.path("a.su2").read_bytes())
        self.refused("render", "a.su2", "-o", "b.png", "--before", "b.png")


class Outputs(ProgramTest):
    def test_a_full_standard_output_is_an_error(self):
        self.ring()
        for args in (("quality", "ring.su2"), ("quality", "ring.su2", "--csv", "-"), ("--help",),
                     ("smooth", "ring.su2", "-o", "o.su2")):
            with open("/dev/full", "w", encoding="utf-8") as full:
                run = subprocess.run([WINSLOW, *args], cwd=self.folder, stdout=full, text=True,
                                     stderr=subprocess.PIPE, check=False, timeout=60)
            self.assertEqual(run.returncode, INPUT, args)
            self.assertIn("the standard output cannot be written", run.stderr)

    def test_a_limit_of_file_sizes_is_an_error(self):
        self.ring(around=96, rings=48)
        self.path("o.su2").write_text("precious")
        run = subprocess.run(
            [WINSLOW, "smooth", "ring.su2", "-o", "o.su2"], cwd=self.folder, text=True,
            capture_output=True, check=False, timeout=60,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000)))
        self.assertEqual(run.returncode, INPUT, run.stderr)
        self.assertIn("o.su2: cannot be written: File too large", run.stderr)
        self.assertEqual(self.path("o.su2").read_text(), "precious")
        self.assertEqual(self.files(), ["o.su2", "ring.su2"])


class Endless(ProgramTest):
    def test_devices_are_no_files(self):
        run = self.winslow("replay", "/dev/zero", code=INPUT)
        self.assertIn("/dev/zero: cannot be read: it is neither a file nor a pipe", run.stderr)
        self.winslow("quality", "/dev/zero", code=INPUT)

    def test_a_recipe_of_nested_lists_is_refused(self):
        self.path("r.json").write_text("[" * 1000000)
        self.assertIn("nested too deeply", self.winslow("replay", "r.json", code=INPUT).stderr)

    def test_null_characters_end_no_name(self):
        self.ring()
        self.path("r.json").write_text('{"winslow_recipe": 1, "input": "ring.su2\\u0000.vtk",'
                                       ' "output": "o.su2", "commands": []}')
        run = self.winslow("replay", "r.json", code=INPUT)
        self.assertIn("r.json:1: input: found", run.stderr)
        self.assertIn("expected a text without null characters", run.stderr)


class TangledRest(ProgramTest):
    def test_a_tangled_rest_mesh_has_a_status_of_its_own(self):
        self.ring()
        self.winslow("scramble", "ring.su2", "-o", "s.su2", "--allow-inverted",
                     code=support.INVERTED)
        run = self.winslow("smooth", "s.su2", "-o", "o.su2", "--targets", "rest",
                           code=TANGLED_REST)
        self.assertIn("the rest mesh, whose shapes the targets keep, is tangled: element ",
                      run.stderr)
        self.assertIn("nothing was written", run.stderr)
        self.assertNotIn("o.su2", self.files())
        self.winslow("smooth", "s.su2", "-o", "o.su2", "--targets", "auto")


class Signals(ProgramTest):
    def start(self, *args, **env):
        return subprocess.Popen([WINSLOW, *map(str, args)], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                env={**os.environ, **env})

    def interrupt(self, run):
        self.assertIsNone(run.poll(), "it ended before it could be interrupted")
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, INTERRUPTED)
        self.assertIn("interrupted", errors)

    def test_a_linear_solve_of_many_iterations_is_interrupted(self):
        self.ring(around=192, rings=96)
        run = self.start("move", "ring.su2", "-o", "o.su2", "--marker", "body", "--rotate", "20",
                         "--linear", "point-implicit", "--linear-tolerance", "1e-300",
                         "--linear-max-iterations", "100000000")
        time.sleep(2)
        self.assertIsNone(run.poll(), "it ended before it could be interrupted")
        start = time.monotonic()
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, INTERRUPTED)
        self.assertIn("interrupted; nothing was written", errors)
        self.assertLess(time.monotonic() - start, 10)

    @unittest.skipUnless(HAS_GUI, "built without the studio")
    def test_an_interrupted_picture_is_not_written(self):
        sphere = ASSETS / "coarse" / "sphere.su2.gz"
        run = self.start("render", sphere, "-o", "a.png", "--size", "8000", "8000")
        time.sleep(0.8)
        self.interrupt(run)
        self.assertEqual(self.files(), [])

    @unittest.skipUnless(HAS_GUI, "built without the studio")
    def test_an_interrupted_film_leaves_no_frames(self):
        self.ring("a.su2")
        cube = ASSETS / "coarse" / "sphere.su2.gz"
        run = self.start("render", cube, "--frames", "film", "--turntable", "36000")
        deadline = time.monotonic() + 60
        while not list(self.folder.glob("film/*.png")) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.interrupt(run)
        self.assertEqual(self.files(), ["a.su2"])


@unittest.skipUnless(has_cgns(), "built without CGNS")
class Cgns(ProgramTest):
    def test_attributes_that_libcgns_cannot_bear(self):
        for name, found in (("int_type.h5", "found an HDF5 file without the nodes of CGNS"),
                            ("vlen_type.h5", "found an HDF5 file without the nodes of CGNS"),
                            ("long_label.cgns", "\"label\" with 60 characters")):
            run = self.winslow("quality", DATA / name, code=INPUT)
            self.assertIn(found, run.stderr)

    def test_nothing_stays_in_the_temporary_folder(self):
        support.write_su2(self.path("a.su2"), *support.ring_mesh(around=192, rings=96))
        temporary = self.path("tmp")
        temporary.mkdir()
        for container in ("hdf5", "adf"):
            self.winslow("convert", "a.su2", "a.cgns", "--cgns-container", container)
            for k in range(12):
                with subprocess.Popen([WINSLOW, "smooth", "a.cgns", "-o", "o.cgns", "--quiet"],
                                      cwd=self.folder,
                                      env={**os.environ, "TMPDIR": str(temporary)}) as run:
                    time.sleep(0.02 * (k + 1))
                    run.send_signal(signal.SIGINT)
                self.assertEqual(list(temporary.iterdir()), [])


class Zones(ProgramTest):
    def test_thousands_of_zones_of_su2(self):
        zone = ("NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n"
                "NMARK= 0\n")
        count = 3000
        self.path("z.su2").write_text(
            f"NZONE= {count}\n" + "".join(f"IZONE= {k}\n{zone}" for k in range(1, count + 1)))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.winslow("convert", "z.su2", "o.su2", "--quiet")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime - before.ru_utime, 10)


if __name__ == "__main__":
    support.main()
