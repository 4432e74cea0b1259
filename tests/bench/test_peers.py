"""bench/peers measures what it says, and fails where a program does."""

import csv
import os
import pathlib
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEERS = ROOT / "bench" / "peers"
sys.path.insert(0, str(PEERS))

import measuring  # noqa: E402
import rows  # noqa: E402

WINSLOW = os.environ["WINSLOW"]
ELASTIC_MOVE = os.environ.get("ELASTIC_MOVE")
DONE, FAILED, USAGE, NO_MESH, INTERRUPTED = 0, 1, 2, 3, 130


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="winslow-peers-test-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def script(self, name, body):
        """A program in place of winslow. "$winslow" is the real one, and measures for it."""
        path = self.write(name, f'#!/bin/sh\nwinslow="{WINSLOW}"\n{body}\n')
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path


class Command(Folder):
    def peers(self, *arguments, code=DONE, env=None):
        words = [sys.executable, "-B", str(PEERS), "--cache", str(self.folder / "cache"), *map(str, arguments)]
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=300, cwd=self.folder,
                              env={**os.environ, **(env or {})})
        self.assertEqual(done.returncode, code, f"{' '.join(words)}\n{done.stdout}\n{done.stderr}")
        return done

    def lines(self, name="out.csv"):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_row_has_times_memory_and_quality(self):
        elasticity = ["--elasticity", ELASTIC_MOVE] if ELASTIC_MOVE else []
        done = self.peers("--program", WINSLOW, *elasticity, "--rows", "coarse-90,coarse-plane-90", "--peers",
                          "elasticity", "--csv", "out.csv", "--markdown", "out.md")
        lines = self.lines()
        self.assertEqual({line["row"] for line in lines}, {"coarse-90", "coarse-plane-90"})
        for line in lines:
            if line["contender"] == "winslow":
                self.assertEqual((line["state"], line["inverted"], float(line["ratio"])), ("measured", "0", 1))
                self.assertGreater(float(line["user_s"]), 0)
                self.assertGreater(float(line["wall_s"]), 0)
                self.assertGreater(float(line["peak_mb"]), 5)
                self.assertIn("solves", line["notes"])
        ours = {line["row"]: float(line["scaled_jacobian_min"]) for line in lines if line["contender"] == "winslow"}
        # What the same motions give when they are run by hand.
        self.assertAlmostEqual(ours["coarse-90"], 0.135, delta=0.03)
        self.assertAlmostEqual(ours["coarse-plane-90"], 0.423, delta=0.05)
        theirs = [line for line in lines if line["contender"].startswith("elasticity")]
        if ELASTIC_MOVE:
            self.assertEqual([line["contender"] for line in theirs],
                             ["elasticity, 1 increment", "elasticity, 5 increments"] * 2)
            self.assertGreater(float(theirs[1]["scaled_jacobian_min"]), float(theirs[0]["scaled_jacobian_min"]))
            self.assertEqual(theirs[1]["notes"], "")
        table = (self.folder / "out.md").read_text()
        self.assertIn("| coarse sphere, 90 degrees and its radius | 2,791 | as given |", table)
        self.assertEqual(len({line.count("|") for line in table.splitlines() if line.startswith("|")}), 1)
        self.assertIn("coarse-plane-90: ", done.stdout)

    def test_peers_that_are_missing_are_skipped(self):
        done = self.peers("--program", WINSLOW, "--rows", "coarse-smooth,coarse-90", "--peers", "gmsh,openfoam",
                          "--csv", "out.csv", env={"PATH": str(self.folder)})
        skipped = [line for line in self.lines() if line["state"] == "skipped"]
        self.assertEqual([line["contender"] for line in skipped], ["Gmsh", "OpenFOAM displacementLaplacian"])
        self.assertIn("gmsh is not installed", done.stdout)
        self.assertIn("moveDynamicMesh is not installed", done.stdout)

    def test_a_peer_that_fails_is_a_result(self):
        for body, words in (("echo no memory; exit 1", "no memory"), ("exit 0", "the body is not where"),
                            ('grep -q "^sphere { type solidBody" "$3/0/pointDisplacement" && '
                             'grep -q "^farfield { type fixedValue" "$3/0/pointDisplacement" || echo wrong; exit 1',
                             "it said nothing")):
            with self.subTest(body=body):
                self.script("moveDynamicMesh", body)
                self.peers("--program", WINSLOW, "--rows", "coarse-90", "--peers", "openfoam", "--csv", "out.csv",
                           env={"PATH": f"{self.folder}:{os.environ['PATH']}"})
                line = self.lines()[-1]
                self.assertEqual(line["contender"], "OpenFOAM displacementLaplacian")
                self.assertIn(words, line["notes"])

    def test_an_interrupted_run_leaves_its_tables_and_no_program(self):
        program = self.script("program", '[ "$1" != smooth ] && exec "$winslow" "$@"\n'
                              "echo $$ > pid.new; mv pid.new pid; exec sleep 100")
        words = [sys.executable, "-B", str(PEERS), "--program", str(program), "--rows", "coarse-plane-90,coarse-smooth",
                 "--peers", "none", "--csv", "out.csv"]
        for number in (signal.SIGINT, signal.SIGTERM):
            pid = self.folder / "pid"
            pid.unlink(missing_ok=True)
            with subprocess.Popen(words, cwd=self.folder, stdout=subprocess.DEVNULL) as process:
                wait_until(pid.exists)
                process.send_signal(number)
                self.assertEqual(process.wait(60), INTERRUPTED)
            wait_until(lambda: not alive(int(pid.read_text())))
            self.assertEqual([line["contender"] for line in self.lines()], ["as given", "winslow"])

    def test_two_programs_run_by_turns(self):
        logged = self.folder / "order"
        both = [self.script(name, f'[ "$1" = move ] && echo {name} >> "{logged}"\nexec "$winslow" "$@"')
                for name in ("old", "new")]
        self.peers("--program", f"old={both[0]}", "--program", f"new={both[1]}", "--rows", "coarse-plane-90", "--peers",
                   "none", "--repeat", 2, "--allow-loss", 0, "--csv", "out.csv")
        self.assertEqual(logged.read_text().split(), ["old", "new"] * 2)
        self.assertEqual([(line["contender"], line["runs"]) for line in self.lines()[1:]], [("old", "2"), ("new", "2")])

    def fails(self, body, reason, *arguments):
        program = self.script("program", f'if [ "$1" = quality ]; then exec "$winslow" "$@"; fi\n{body}')
        done = self.peers("--program", program, "--rows", "coarse-plane-90", "--peers", "none", "--csv", "out.csv",
                          *arguments, code=FAILED)
        self.assertIn("FAILED: ", done.stdout)
        self.assertIn(reason, done.stdout)
        self.assertEqual(self.lines()[1]["state"], "failed")

    def test_a_program_that_ends_with_an_error_fails(self):
        self.fails("echo the disk is full; exit 3", "exit status 3: the disk is full")

    def test_a_program_that_is_killed_fails(self):
        self.fails("kill -9 $$", "exit status -9")

    def test_a_program_that_writes_nothing_fails(self):
        self.fails("exit 0", "it wrote no mesh")

    def test_a_program_that_does_not_move_the_body_fails(self):
        self.fails('cp "$2" "$4"', "the body is not where the motion takes it")

    def test_a_program_that_inverts_elements_fails(self):
        self.fails('shift; exec "$winslow" move "$@" --no-smooth --allow-inverted --quiet || exit 0',
                   "exit status 4")
        self.fails('shift; "$winslow" move "$@" --no-smooth --allow-inverted --quiet; exit 0', "elements are inverted")

    def test_a_program_that_writes_another_mesh_when_it_is_run_again_fails(self):
        self.fails('[ -e once ] && set -- "$@" --targets rest\ntouch once\nexec "$winslow" "$@"',
                   "it wrote another mesh when it was run again", "--repeat", 2)

    def test_a_program_that_takes_too_long_is_ended_with_all_that_it_started(self):
        begin = time.monotonic()
        self.fails("sleep 100 & echo $! > pid; wait", "not done within 2 s", "--timeout", 2)
        self.assertLess(time.monotonic() - begin, 60)
        pid = int((self.folder / "pid").read_text())
        wait_until(lambda: not alive(pid))

    def test_lost_quality_fails_where_it_is_asked_for(self):
        programs = ["--program", f"old={WINSLOW}", "--program", f"new={WINSLOW} --targets rest", "--rows", "coarse-90",
                    "--peers", "none"]
        self.assertNotIn("LOST", self.peers(*programs).stdout)
        lost = self.peers(*programs, "--allow-loss", 2, code=FAILED)
        self.assertIn("LOST: coarse-90: new has a smallest scaled Jacobian of", lost.stdout)

    def test_a_mesh_that_cannot_be_made_is_said(self):
        done = self.peers("--program", WINSLOW, "--rows", "cube-45", env={"PATH": str(self.folder)}, code=NO_MESH)
        self.assertIn("cube-45: not measured: volumes/cube is made by Gmsh, which is not installed", done.stdout)

    def test_wrong_options_are_refused(self):
        for arguments, words in ((["--rows", "no-such"], "no row 'no-such'; known: coarse-smooth"),
                                 (["--quick", "--rows", "cube-45"], "no row is left"),
                                 (["--peers", "ansys"], "no peer 'ansys'; known: elasticity"),
                                 (["--program", "/no/such"], "/no/such is no program"),
                                 (["--program", WINSLOW, "--program", WINSLOW], "two programs have the same name"),
                                 (["--timeout", "0"], "--timeout"), (["--repeat", "x"], "--repeat"),
                                 (["--increments", "1,-5"], "--increments"), (["--colour"], "--colour")):
            with self.subTest(arguments=arguments):
                program = [] if "--program" in arguments else ["--program", WINSLOW]
                done = self.peers(*program, *arguments, code=USAGE)
                self.assertIn(words, done.stderr)

    def test_a_table_that_cannot_be_written_is_said_before_anything_runs(self):
        done = self.peers("--program", WINSLOW, "--quick", "--csv", self.folder / "no" / "out.csv", code=USAGE)
        self.assertIn("out.csv", done.stderr)
        self.assertNotIn("coarse-smooth", done.stdout)

    def test_all_rows_are_listed(self):
        listed = self.peers("--list").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in listed], [row.name for row in rows.ROWS])


def wait_until(holds):
    for _ in range(1200):
        if holds():
            return
        time.sleep(0.05)
    raise AssertionError("nothing happened within a minute")


def alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Measures(Folder):
    """Two prisms on a wall of two triangles, .5 and .25 high."""

    MESH = """NDIME= 3
NELEM= 2
13 0 1 2 4 5 6 0
13 7 8 9 1 3 2 1
NPOIN= 10
0 0 0 0
1 0 0 1
0 1 0 2
1 1 0 3
{x} 0 .5 4
1 0 {z} 5
0 1 .5 6
1 0 .25 7
1 1 .25 8
0 1 .25 9
NMARK= 2
MARKER_TAG= other
MARKER_ELEMS= 1
5 4 5 6
MARKER_TAG= wall
MARKER_ELEMS= 2
5 0 2 1
5 1 2 3
"""

    def test_first_heights_are_those_over_the_wall(self):
        before = measuring.first_heights(self.write("a.su2", self.MESH.format(x=0, z=".5")), "wall")
        self.assertEqual(before, {frozenset({0, 1, 2}): 0.5, frozenset({1, 2, 3}): 0.25})
        # Along the wall nothing changes; a corner raised by .3 raises the middle by .1.
        along = measuring.first_heights(self.write("b.su2", self.MESH.format(x=".7", z=".5")), "wall")
        self.assertEqual(measuring.height_changes(before, along), (0, 0))
        raised = measuring.first_heights(self.write("c.su2", self.MESH.format(x=0, z=".8")), "wall")
        self.assertAlmostEqual(measuring.height_changes(before, raised)[1], 20)
        with self.assertRaises(measuring.MeasuringError):
            measuring.height_changes(before, {})

    def test_rotation_is_counter_clockwise_seen_from_the_tip_of_the_axis(self):
        turn = rows.Motion(("wall",), 90, (1, 0, 0), (0, 0, 5), (0, 0, 2))
        self.assertLess(max(abs(a - b) for a, b in zip(measuring.image(turn, (2, 0, 1)), (1, 1, 6))), 1e-12)
        plane = rows.Motion(("wall",), -90, (0, 0), (1, 0))
        self.assertLess(max(abs(a - b) for a, b in zip(measuring.image(plane, (0, 1, 7)), (2, 0, 0))), 1e-12)

    def test_a_body_that_stays_behind_is_seen(self):
        mesh = self.write("a.su2", self.MESH.format(x=0, z=".5"))
        shift = rows.Motion(("wall",), 0, (0, 0, 0), (0.1, 0, 0), (0, 0, 1))
        self.assertAlmostEqual(measuring.motion_error(shift, mesh, mesh), 0.1)

    def test_cpu_of_children_counts_and_wall_time_is_not_cpu(self):
        spin = self.script("spin", f"'{sys.executable}' -c 'for _ in range(3000000): pass' & wait")
        self.assertGreater(measuring.run([spin], 100).user, 0.02)
        idle = measuring.run(["sleep", "0.3"], 100)
        self.assertGreater(idle.wall, 0.3)
        self.assertLess(idle.user, 0.1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
