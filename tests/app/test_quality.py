import csv
import io
import json

import support
import volume_meshes
from support import INPUT, INVERTED, USAGE, ProgramTest

METRICS = ("normalized_jacobian", "aspect_ratio", "condition_number", "smallest_angle", "largest_angle",
           "skewness", "smallest_solid_angle", "largest_solid_angle")
ENDS = ("min", "mean", "max", "worst_element", "worst_x", "worst_y", "worst_z")
HEIGHTS = ("first_height_min", "first_height_median", "first_height_max")


def unit_squares():
    """Nodes and elements of 3 by 3 unit squares."""
    nodes = [(float(i), float(j)) for j in range(4) for i in range(4)]
    quads = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4)
             for j in range(3) for i in range(3)]
    return nodes, quads


class Quality(ProgramTest):
    def test_prints_the_table_and_the_worst_elements(self):
        # One cell of unit squares is squeezed into a kite: it must head every list.
        nodes = [(float(i), float(j)) for j in range(4) for i in range(4)]
        nodes[0] = (0.3, 0.3)
        quads = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4)
                 for j in range(3) for i in range(3)]
        support.write_su2(self.path("grid.su2"), nodes, quads, {})
        text = self.winslow("quality", "grid.su2", "--worst", "2").stdout
        for word in ("minimum", "average", "maximum", "Normalized Jacobian", "Aspect ratio",
                     "Condition number", "16 nodes, 9 elements, 0 inverted"):
            self.assertIn(word, text)
        lists = text.split("Worst elements by ")[1:]
        # No body, so no walls: of their fields the size ratio alone.
        self.assertEqual([block.split("\n")[0] for block in lists[6:]], ["Size ratio"])
        self.assertEqual(len(lists), 7)
        for block in lists:
            rows = [line.split() for line in block.splitlines()[2:] if line.strip()]
            self.assertEqual(len(rows), 2)
            self.assertEqual(rows[0][0], "0")
            self.assertEqual(rows[0][2:], ["(0.575,", "0.575)"])

    def test_inverted_elements_are_listed_and_make_the_status(self):
        nodes = [(float(i), float(j)) for j in range(4) for i in range(4)]
        nodes[5] = (2.5, 1.0)  # pulls an interior node through its neighbour
        quads = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4)
                 for j in range(3) for i in range(3)]
        support.write_su2(self.path("grid.su2"), nodes, quads, {})
        run = self.winslow("quality", "grid.su2", "--report", "q.json", code=INVERTED)
        report = self.json("q.json")
        self.assertIn(f"{report['inverted']} inverted", run.stdout)
        ids = {e["element"] for e in report["inverted_elements"]}
        self.assertTrue(ids <= {0, 1, 3, 4} and ids, ids)
        for e in report["inverted_elements"]:
            self.assertIn(f"element {e['element']} at", run.stdout)
            corners = [nodes[n] for n in quads[e["element"]]]
            self.assertAlmostEqual(e["centre"][0], sum(p[0] for p in corners) / 4)
            self.assertAlmostEqual(e["centre"][1], sum(p[1] for p in corners) / 4)
        self.assertLess(report["quality"]["normalized_jacobian"]["min"], 0)

    def test_histogram_counts_everything_once(self):
        self.ring()
        text = self.winslow("quality", "ring.su2", "--histogram", "--bins", "7", "--worst",
                            "0").stdout
        block = text.split("\nAspect ratio\n")[1].split("\n\n")[0]
        counts = [int(line.split()[3]) for line in block.splitlines()]
        self.assertEqual(len(counts), 7)
        self.assertEqual(sum(counts), 2 * 8 * 24)
        self.assertNotIn("Worst", text)

    def test_quiet(self):
        self.ring()
        run = self.winslow("quality", "ring.su2", "--quiet", "--report", "q.json")
        self.assertEqual((run.stdout, run.stderr), ("", ""))
        self.assertEqual(self.json("q.json")["inverted"], 0)

    def test_openfoams_measures_of_volume_meshes(self):
        nodes, cells, markers = volume_meshes.box_mesh()
        volume_meshes.write_box(self.path("box.su2"))
        run = self.winslow("quality", "box.su2", "--report", "q.json")
        report = self.json("q.json")
        measures = report["openfoam"]
        self.assertNotIn("non_orthogonality", report["quality"])
        self.assertAlmostEqual(measures["total_volume"], 1 - 1 / volume_meshes.N ** 3)
        self.assertAlmostEqual(measures["volume"]["min"], 1 / 6 / volume_meshes.N ** 3)
        self.assertAlmostEqual(measures["edge_length"]["max"], 3 ** .5 / volume_meshes.N)
        faces, outer = 4 * len(cells), sum(map(len, markers.values()))
        self.assertEqual(measures["skewness"]["count"], (faces + outer) / 2)
        self.assertEqual(measures["non_orthogonality"]["count"], (faces - outer) / 2)
        self.assertEqual(measures["volume"]["count"], len(cells))
        self.assertLess(max(map(abs, measures["boundary_openness"])), 1e-14)
        self.assertEqual(measures["failures"], [])
        lines = run.stdout.splitlines()
        row = next(line for line in lines if line.startswith("Non-orthogonality, degrees"))
        self.assertEqual(row.split()[2:], [f"{measures['non_orthogonality'][end]:.6g}" for end in ("min", "avg", "max")]
                         + ["<=", "70", "all", "internal", "faces"])
        self.assertIn("checkMesh finds no fault of the geometry", lines)
        # A node inside is pulled through its neighbours.
        inner = next(n for n, p in enumerate(nodes) if all(.1 < x < .3 for x in p))
        volume_meshes.write_box(self.path("bad.su2"), (inner, (.9, .25, .3)))
        run = self.winslow("quality", "bad.su2", "--report", "q.json", code=INVERTED)
        measures = self.json("q.json")["openfoam"]
        self.assertGreater(measures["pyramid_errors"], 0)
        self.assertIn(f"{measures['pyramid_errors']} pyramids of faces with negative volume", run.stdout)
        self.assertRegex(run.stdout, r"Non-orthogonality, degrees .* but \d+ of \d+ internal faces")
        # A plane mesh has no such measures, and a table of several meshes leaves them out.
        self.ring("a.su2")
        self.assertNotIn("OpenFOAM", self.winslow("quality", "a.su2", "--report", "q.json").stdout)
        self.assertNotIn("openfoam", self.json("q.json"))
        self.assertNotIn("OpenFOAM", self.winslow("quality", "a.su2", "box.su2").stdout)


class ManyMeshes(ProgramTest):
    def rows(self, text):
        return list(csv.DictReader(io.StringIO(text)))

    def write_squares(self, name, **moved):
        nodes, quads = unit_squares()
        for node, place in moved.items():
            nodes[int(node[1:])] = place
        support.write_su2(self.path(name), nodes, quads, {})

    def test_the_table_says_what_the_report_of_each_mesh_says(self):
        self.ring("a.su2")
        self.ring("b, c.su2", around=30, inner=0.6)
        volume_meshes.write_box(self.path("box.su2"))
        names = ("a.su2", "b, c.su2", "box.su2")
        self.winslow("quality", *names, "--csv", "q.csv", "--worst", "0")
        rows = self.rows(self.path("q.csv").read_text())
        self.assertEqual([r["file"] for r in rows], list(names))
        self.assertEqual(list(rows[0]), ["file", "zone", "nodes", "elements", "inverted",
                                         *(f"{m}_{end}" for m in METRICS for end in ENDS), *HEIGHTS])
        for row in rows:
            self.winslow("quality", row["file"], "--report", "q.json", "--worst", "1")
            report = self.json("q.json")
            self.assertEqual(row["zone"], "")
            for key in ("nodes", "elements", "inverted"):
                self.assertEqual(int(row[key]), report[key])
            self.assertEqual({m for m in METRICS if row[f"{m}_min"]}, set(report["quality"]))
            for metric, values in report["quality"].items():
                for end, key in (("min", "min"), ("mean", "avg"), ("max", "max")):
                    self.assertEqual(float(row[f"{metric}_{end}"]), values[key])
                worst = report["worst"][metric][0]
                self.assertEqual(int(row[f"{metric}_worst_element"]), worst["element"])
                place = [row[f"{metric}_worst_{axis}"] for axis in "xyz"]
                self.assertEqual([float(x) for x in place if x], worst["centre"])
            heights = report.get("walls", {}).get("now", {}).get("first_height")
            wanted = [heights[key] for key in ("min", "median", "max")] if heights else [""] * 3
            self.assertEqual([float(row[c]) if row[c] else "" for c in HEIGHTS], wanted)
        self.assertTrue(all(r["first_height_min"] for r in rows))

    def test_one_line_for_each_mesh_or_a_block_where_more_is_asked_for(self):
        self.ring("a.su2")
        self.ring("b.su2", around=30)
        lines = self.winslow("quality", "a.su2", "b.su2").stdout.splitlines()
        self.assertEqual(lines[0].split(), ["nodes", "elements", "inverted", "Normalized", "Jacobian",
                                            "Aspect", "ratio", "Condition", "number"])
        self.assertEqual(lines[1].split(), ["minimum", "maximum", "maximum"])
        self.winslow("quality", "b.su2", "--report", "b.json")
        report = self.json("b.json")
        name, nodes, elements, inverted, sine, *_ = lines[3].split()
        self.assertEqual((name, int(nodes), int(elements), int(inverted)),
                         ("b.su2", report["nodes"], report["elements"], 0))
        self.assertAlmostEqual(float(sine), report["quality"]["normalized_jacobian"]["min"], 3)
        self.assertEqual(lines[4:], ["", "2 meshes"])
        one = self.winslow("quality", "a.su2", "--worst", "2").stdout
        blocks = self.winslow("quality", "a.su2", "b.su2", "--worst", "2").stdout
        self.assertTrue(blocks.startswith("a.su2\n" + one + "\nb.su2\n"), blocks)
        self.assertTrue(blocks.endswith("\n2 meshes\n"), blocks)

    def test_a_mesh_that_cannot_be_read_is_named_and_the_others_are_done(self):
        self.ring("a.su2")
        self.write_squares("inverted.su2", n5=(2.5, 1.0))
        self.path("broken.su2").write_text("NDIME= 2\nNELEM= many\n")
        names = ("a.su2", "gone.su2", "broken.su2", "inverted.su2")
        run = self.winslow("quality", *names, "--csv", "q.csv", "--report", "q.json", code=INPUT)
        for name in names[1:3]:
            self.assertIn(f"winslow: {name}", run.stderr)
        self.assertIn("4 meshes, 2 could not be read, 1 with inverted elements", run.stdout)
        rows = self.rows(self.path("q.csv").read_text())
        self.assertEqual([r["file"] for r in rows], ["a.su2", "inverted.su2"])
        self.assertGreater(int(rows[1]["inverted"]), 0)
        report = self.json("q.json")
        self.assertEqual(report["input"], list(names))
        self.assertEqual([m["input"] for m in report["meshes"]], ["a.su2", "inverted.su2"])
        self.assertEqual([m["input"] for m in report["unread"]], ["gone.su2", "broken.su2"])
        self.assertIn("broken.su2:2", report["unread"][1]["error"])
        self.assertEqual(report["inverted"], int(rows[1]["inverted"]))
        self.assertEqual(report["nodes"], sum(int(r["nodes"]) for r in rows))
        self.winslow("quality", "a.su2", "inverted.su2", code=INVERTED)
        self.winslow("quality", "a.su2", "a.su2")
        # Nothing to write of meshes of which none can be read; --quiet names them all the same.
        run = self.winslow("quality", "gone.su2", "broken.su2", "--csv", "none.csv", "--report",
                           "none.json", "--quiet", code=INPUT)
        self.assertEqual(run.stdout, "")
        self.assertEqual(len(run.stderr.splitlines()), 2)
        self.assertFalse(self.path("none.csv").exists() or self.path("none.json").exists())
        self.winslow("quality", "gone.su2", "--csv", "none.csv", code=INPUT)
        self.assertFalse(self.path("none.csv").exists())

    def test_a_row_for_each_zone(self):
        blocks = []
        for number, inner in enumerate((0.5, 0.7), 1):
            support.write_su2(self.path("one.su2"), *support.ring_mesh(inner=inner))
            blocks.append(f"IZONE= {number}\n" + self.path("one.su2").read_text())
        self.path("z.su2").write_text("NZONE= 2\n" + "".join(blocks))
        run = self.winslow("quality", "z.su2", "one.su2", "--csv", "q.csv")
        self.assertIn("\nz.su2, zone 2 ", run.stdout)
        rows = self.rows(self.path("q.csv").read_text())
        self.assertEqual([(r["file"], r["zone"]) for r in rows],
                         [("z.su2", "1"), ("z.su2", "2"), ("one.su2", "")])
        values = [list(r.values())[2:] for r in rows]
        self.assertEqual(values[1], values[2])
        self.assertNotEqual(values[0], values[1])
        self.winslow("quality", "z.su2", "--csv", "q.csv", "--zone", "2")
        self.assertEqual([list(r.values())[1:] for r in self.rows(self.path("q.csv").read_text())],
                         [["2", *values[1]]])
        # A file without that zone is one that cannot be read.
        run = self.winslow("quality", "z.su2", "one.su2", "--zone", "2", code=INPUT)
        self.assertIn("winslow: one.su2", run.stderr)

    def test_the_table_on_the_standard_output_alone(self):
        self.ring("a.su2")
        self.write_squares("inverted.su2", n5=(2.5, 1.0))
        self.winslow("quality", "a.su2", "inverted.su2", "--csv", "q.csv", code=INVERTED)
        run = self.winslow("quality", "a.su2", "inverted.su2", "--csv", "-", code=INVERTED)
        self.assertEqual(run.stdout, self.path("q.csv").read_text())
        self.assertIn("2 meshes, 1 with inverted elements", run.stderr)
        run = self.winslow("quality", "a.su2", "--report", "-", "--quiet")
        self.assertEqual((json.loads(run.stdout)["nodes"], run.stderr), (9 * 24, ""))
        run = self.winslow("quality", "a.su2", "--report", "-", "--csv", "-", code=USAGE)
        self.assertEqual(run.stdout, "")
        self.assertIn("standard output", run.stderr)
        self.winslow("quality", "a.su2", "inverted.su2", "--csv", "inverted.su2", code=USAGE)


if __name__ == "__main__":
    support.main()
