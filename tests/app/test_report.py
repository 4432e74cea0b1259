import csv
import json
import subprocess

import support
import volume_meshes
from support import INPUT, INVERTED, NOT_CONVERGED, USAGE, ProgramTest

METRICS = ("normalized_jacobian", "aspect_ratio", "condition_number", "smallest_angle",
           "largest_angle", "skewness")
BEST_OF_SQUARES = (1, 1, 1, 90, 90, 0)
MOVE = ("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "25")


class Report(ProgramTest):
    def test_has_the_promised_keys(self):
        self.ring()
        self.winslow(*MOVE, "--report", "r.json")
        report = self.json("r.json")
        for key in ("formulation", "converged", "outer_iterations", "linear_solves", "residual",
                    "inverted", "fraction_reached", "quality", "nodes", "elements", "seconds",
                    "peak_memory_bytes", "memory_bytes", "quality_before", "walls", "units"):
            self.assertIn(key, report)
        for metric in METRICS:
            block = report["quality"][metric]
            self.assertLessEqual(block["min"], block["avg"])
            self.assertLessEqual(block["avg"], block["max"])
        seconds = report["seconds"]
        self.assertEqual(set(seconds), {"load", "solve", "save", "total"})
        self.assertGreaterEqual(seconds["total"] + 1e-9,
                                seconds["load"] + seconds["solve"] + seconds["save"])
        self.assertEqual(report["formulation"], "variational")
        self.assertIs(report["converged"], True)
        self.assertGreater(report["outer_iterations"], 0)
        self.assertGreaterEqual(report["linear_solves"], report["outer_iterations"])
        self.assertLessEqual(report["residual"], 1e-10)
        self.assertEqual(report["inverted"], 0)
        self.assertEqual(report["inverted_elements"], [])
        self.assertEqual(report["fraction_reached"], 1)
        self.assertEqual((report["nodes"], report["elements"]), (9 * 24, 2 * 8 * 24))
        self.assertGreater(report["peak_memory_bytes"], 1 << 20)
        parts = ("mesh", "targets", "structure", "matrix", "preconditioner", "factors", "vectors")
        self.assertEqual(set(report["memory_bytes"]), set(parts))
        self.assertEqual(report["commands"][0]["memory_bytes"], report["memory_bytes"])
        for part in ("mesh", "targets", "structure", "matrix", "factors", "vectors"):
            self.assertGreater(report["memory_bytes"][part], 0, part)
        self.assertLess(sum(report["memory_bytes"].values()), report["peak_memory_bytes"])
        self.assertEqual(report["command"], "move")

    def test_says_what_took_the_memory(self):
        self.ring()
        lines = self.winslow(*MOVE, "--memory", "--report", "r.json").stdout.splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("Memory: at most "))
        table = dict((line[:18].strip(), float(line[18:].split()[0])) for line in lines[first + 1:])
        report = self.json("r.json")
        for part, count in report["memory_bytes"].items():
            if count > 0:
                self.assertAlmostEqual(table[part], count / 1e6, delta=0.051, msg=part)
            else:
                self.assertNotIn(part, table)
        most = float(lines[first].split()[3])
        self.assertAlmostEqual(sum(table.values()), most, delta=1)
        self.assertIn("not counted", table)
        self.assertNotIn("Memory", self.winslow(*MOVE).stdout)
        self.assertEqual(self.winslow(*MOVE, "--memory", "--quiet").stdout, "")
        # Nothing is solved: only the peak is known.
        self.winslow("scramble", "ring.su2", "-o", "out.su2", "--report", "r.json", code=INVERTED)
        self.assertIsNone(self.json("r.json")["memory_bytes"])

    def test_says_the_version_and_the_sizes_of_the_markers(self):
        self.ring()
        version = self.winslow("--version").stdout.split()[1]
        sizes = [{"name": name, "nodes": 24, "edges": 24} for name in ("body", "farfield")]
        layers = ("layers", "ring.su2", "-o", "out.su2", "--marker", "body", "--count", "2", "--first",
                  "0.02")
        deform = ("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "0.01", "1")
        for run in (MOVE, deform, layers, ("smooth", "ring.su2", "-o", "out.su2"), ("quality", "ring.su2")):
            self.winslow(*run, "--report", "r.json")
            report = self.json("r.json")
            self.assertEqual(report["version"], version)
            self.assertEqual(report["markers"], sizes, run)
        nodes, cells, markers = volume_meshes.write_box(self.path("box.su2"))
        self.winslow("quality", "box.su2", "--report", "r.json")
        self.assertEqual(self.json("r.json")["markers"],
                         [{"name": name, "nodes": len({n for face in faces for n in face}),
                           "faces": len(faces)} for name, faces in markers.items()])

    def test_goes_to_the_standard_output_alone(self):
        self.ring()
        self.winslow(*MOVE, "--report", "r.json", "--save-recipe", "recipe.json")
        said = self.winslow(*MOVE).stdout
        for run in (MOVE, ("replay", "recipe.json")):
            done = self.winslow(*run, "--report", "-")
            report = json.loads(done.stdout)
            self.assertEqual(report["quality"], self.json("r.json")["quality"])
            self.assertEqual(report["output"], "out.su2")
            # What is said all the same is elsewhere, but for the seconds.
            self.assertEqual(done.stderr.split("Wrote")[0], said.split("Wrote")[0])
            self.assertNotIn("-", self.files())
            done = self.winslow(*run, "--report", "-", "--quiet")
            self.assertEqual(json.loads(done.stdout)["quality"], report["quality"])
            self.assertEqual(done.stderr, "")
        # Also of a run that fails; and not where the run is refused.
        done = self.winslow("move", "ring.su2", "-o", "no.su2", "--marker", "body", "--translate", "20", "0",
                            "--report", "-", code=INVERTED)
        self.assertLess(json.loads(done.stdout)["fraction_reached"], 1)
        done = self.winslow("move", "ring.su2", "-o", "no.su2", "--marker", "bod", "--rotate", "1", "--report",
                            "-", code=USAGE)
        self.assertEqual(done.stdout, "")
        for flag in ("--history", "--save-recipe"):
            done = self.winslow(*MOVE, flag, "-", code=USAGE)
            self.assertIn(f"{flag} -: found - for the standard output, expected the name of a file",
                          done.stderr)
        with open("/dev/full", "w") as full:
            done = subprocess.run([support.WINSLOW, *MOVE, "--report", "-", "--quiet"], cwd=self.folder,
                                  stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, INPUT)
        self.assertIn("the standard output cannot be written", done.stderr)

    def test_quality_reports_the_same_block(self):
        self.ring()
        self.winslow(*MOVE, "--report", "r.json")
        self.winslow("quality", "out.su2", "--report", "q.json")
        self.assertEqual(self.json("q.json")["quality"], self.json("r.json")["quality"])
        self.assertEqual(self.json("q.json")["nodes"], self.json("r.json")["nodes"])

    def test_statistics_are_right_on_squares(self):
        nodes = [(float(i), float(j)) for j in range(4) for i in range(4)]
        quads = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4)
                 for j in range(3) for i in range(3)]
        support.write_su2(self.path("grid.su2"), nodes, quads, {})
        self.winslow("quality", "grid.su2", "--report", "q.json")
        for metric, best in zip(METRICS, BEST_OF_SQUARES):
            for value in self.json("q.json")["quality"][metric].values():
                self.assertAlmostEqual(value, best, delta=1e-12)

    def test_tells_of_a_scramble_too(self):
        self.ring()
        self.winslow("scramble", "ring.su2", "-o", "out.su2", "--report", "r.json",
                     "--allow-inverted", code=INVERTED)
        report = self.json("r.json")
        self.assertEqual(report["outer_iterations"], 0)
        self.assertGreater(report["inverted"], 0)


class History(ProgramTest):
    def rows(self, name):
        with open(self.path(name), newline="") as file:
            return list(csv.DictReader(file))

    def test_has_a_line_for_every_iteration(self):
        self.ring()
        self.winslow(*MOVE, "--report", "r.json", "--history", "h.csv")
        rows, report = self.rows("h.csv"), self.json("r.json")
        for column in ("iteration", "residual", "largest_move", "inverted", "min_sine"):
            self.assertIn(column, rows[0])
        # A stage begins with a line for its start, numbered as the last iteration before.
        self.assertEqual(sorted({int(r["iteration"]) for r in rows}),
                         list(range(report["outer_iterations"] + 1)))
        self.assertEqual([r["stage"] for r in rows][-1], "newton")
        self.assertEqual(float(rows[-1]["residual"]), report["residual"])
        self.assertLess(float(rows[-1]["residual"]), 1e-3 * max(float(r["residual"]) for r in rows))
        self.assertEqual(float(rows[0]["largest_move"]), 0)
        self.assertGreater(max(float(r["largest_move"]) for r in rows), 0)
        self.assertAlmostEqual(float(rows[-1]["min_sine"]),
                               report["quality"]["normalized_jacobian"]["min"], delta=1e-12)

    def test_is_written_when_the_solve_falls_short(self):
        self.ring()
        self.winslow(*MOVE, "--direct", "--tolerance", "1e-14",
                     "--max-iterations", "1", "--history", "h.csv", code=NOT_CONVERGED)
        self.assertEqual(len(self.rows("h.csv")), 2)


if __name__ == "__main__":
    support.main()
