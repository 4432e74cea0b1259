import csv
import math

import support
from support import INVERTED, NOT_CONVERGED, USAGE, ProgramTest


class Move(ProgramTest):
    def test_moves_the_body_exactly_and_repairs_the_interior(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "-30",
                     "--pivot", "0.5", "0", "--translate", "0.2", "-0.3")
        before, elements, markers = support.read_su2(self.path("ring.su2"))
        after, elements_after, markers_after = support.read_su2(self.path("out.su2"))
        self.assertEqual(elements_after, elements)
        self.assertEqual(markers_after, markers)
        for node in {n for edge in markers["body"] for n in edge}:
            expected = support.rotated(before[node], -30, (0.5, 0), (0.2, -0.3))
            self.assertAlmostEqual(after[node][0], expected[0], delta=1e-12)
            self.assertAlmostEqual(after[node][1], expected[1], delta=1e-12)
        for node in {n for edge in markers["farfield"] for n in edge}:
            self.assertEqual(after[node], before[node])
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        moved = sum(a != b for a, b in zip(before, after))
        self.assertGreater(moved, 100)  # the interior followed

    def test_no_motion_writes_the_same_bytes_and_says_so(self):
        self.ring()
        given = self.path("ring.su2").read_bytes()
        for more in ((), ("--targets", "auto"), ("--raise-worst",), ("--direct",)):
            run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body",
                               "--translate", "0", "0", "--report", "r.json", *more)
            self.assertEqual(self.path("out.su2").read_bytes(), given)
            self.assertIn("nothing moves", run.stdout)
            self.assertTrue(self.json("r.json")["commands"][0]["nothing_moves"])

    def test_steps_from_file_to_file_with_the_reference_mesh_end_as_one_motion(self):
        self.ring()
        turn = ("--marker", "body", "--pivot", "0.5", "0", "--rotate")
        self.winslow("move", "ring.su2", "-o", "once.su2", *turn, "30")
        self.winslow("move", "ring.su2", "-o", "s1.su2", *turn, "10")
        for k in (1, 2):
            self.winslow("move", f"s{k}.su2", "-o", f"s{k + 1}.su2", *turn, "10",
                         "--reference-mesh", "ring.su2", "--save-recipe", "p.json")
        once, _, _ = support.read_su2(self.path("once.su2"))
        steps, _, _ = support.read_su2(self.path("s3.su2"))
        self.assertLess(max(math.dist(a, b) for a, b in zip(once, steps)), 1e-8)
        self.assertEqual(self.json("p.json")["reference_mesh"], "ring.su2")
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_bytes(), self.path("s3.su2").read_bytes())
        # Back again.
        self.winslow("move", "s3.su2", "-o", "back.su2", *turn, "-30", "--reference-mesh", "ring.su2")
        given, _, _ = support.read_su2(self.path("ring.su2"))
        back, _, _ = support.read_su2(self.path("back.su2"))
        self.assertLess(max(math.dist(a, b) for a, b in zip(given, back)), 1e-8)

    def test_a_reference_mesh_of_other_connectivity_is_refused(self):
        self.ring()
        self.winslow("convert", "ring.su2", "-o", "other.su2")
        text = self.path("other.su2").read_bytes().decode()
        with open(self.path("other.su2"), "w") as file:
            file.write(text.replace("MARKER_TAG= body", "MARKER_TAG= wing"))
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "5",
                           "--reference-mesh", "other.su2", code=USAGE)
        self.assertIn('other.su2: the reference mesh does not have the connectivity of the mesh: '
                      'marker "body" is missing', run.stderr)
        self.assertFalse(self.path("out.su2").exists())

    def test_positive_angles_turn_counter_clockwise(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "20")
        before, _, _ = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        self.assertAlmostEqual(before[0][1], 0.0)
        self.assertGreater(after[0][1], 0.1)

    def test_outside_a_region_nothing_moves_and_a_recipe_says_so_too(self):
        self.ring()
        before, elements, markers = support.read_su2(self.path("ring.su2"))
        body = {n for edge in markers["body"] for n in edge}
        boundary = body | {n for edge in markers["farfield"] for n in edge}
        centre = [0.5 * (min(before[n][k] for n in body) + max(before[n][k] for n in body))
                  for k in range(2)]
        radius = 2 * max(math.dist(before[n], centre) for n in body)
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "20",
                           "--keep-outside-radius", repr(radius), "--report", "r.json",
                           "--save-recipe", "p.json")
        after, _, _ = support.read_su2(self.path("out.su2"))
        outside = [n for n in range(len(before))
                   if n not in boundary and math.dist(before[n], centre) > radius]
        inside = [n for n in range(len(before)) if n not in boundary and n not in outside]
        self.assertGreater(len(outside), 20)
        for node in outside:
            self.assertEqual(after[node], before[node])
        self.assertGreater(sum(after[n] != before[n] for n in inside), len(inside) // 2)
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        self.assertIn(f"{len(outside)} interior nodes kept outside", run.stdout)
        self.assertEqual(self.json("r.json")["commands"][0]["kept_outside"], len(outside))
        self.assertEqual(self.json("p.json")["commands"][0]["smooth"]["keep_outside"]["radius"], radius)
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(support.read_su2(self.path("again.su2"))[0], after)

    def test_a_region_that_leaves_out_the_body_is_refused(self):
        self.ring()
        refused = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "20",
                               "--keep-outside-corner", "50", "50", "--keep-outside-opposite", "60", "60",
                               code=USAGE)
        self.assertIn("lie outside the region in which nodes may move", refused.stderr)
        refused = self.winslow("smooth", "ring.su2", "-o", "out.su2", "--keep-outside-corner", "0", "0",
                               code=USAGE)
        self.assertIn("one corner", refused.stderr)

    def off_the_origin(self, dx, dy):
        """A ring whose body is far from (0, 0); returns its nodes and the body's."""
        nodes, elements, markers = support.ring_mesh()
        nodes = [(x + dx, y + dy) for x, y in nodes]
        support.write_su2(self.path("far.su2"), nodes, elements, markers)
        return nodes, sorted({n for edge in markers["body"] for n in edge})

    def test_without_a_pivot_a_body_turns_about_its_own_centre(self):
        before, body = self.off_the_origin(1000, -300)
        run = self.winslow("move", "far.su2", "-o", "out.su2", "--marker", "body", "--rotate", "40",
                           "--report", "r.json", "--save-recipe", "p.json")
        self.assertIn("turned about (1000, -300)", run.stdout)
        self.assertEqual(self.json("r.json")["commands"][0]["pivot"], [1000, -300])
        after, elements, _ = support.read_su2(self.path("out.su2"))
        for node in body:
            expected = support.rotated(before[node], 40, (1000, -300))
            self.assertAlmostEqual(after[node][0], expected[0], delta=1e-10)
            self.assertAlmostEqual(after[node][1], expected[1], delta=1e-10)
        self.assertGreater(support.smallest_corner_area(after, elements), 0)
        # The recipe leaves open what was left open, and means the same.
        self.assertNotIn("pivot", self.json("p.json")["commands"][0])
        self.winslow("replay", "p.json", "-o", "again.su2")
        self.assertEqual(self.path("again.su2").read_text(), self.path("out.su2").read_text())

    def test_a_pivot_that_is_given_is_meant_even_at_the_origin(self):
        before, body = self.off_the_origin(100, 0)
        run = self.winslow("move", "far.su2", "-o", "out.su2", "--marker", "body", "--rotate", "90",
                           "--pivot", "0", "0", "--no-smooth", "--allow-inverted",
                           "--save-recipe", "p.json", code=INVERTED)
        self.assertIn("turned about (0, 0)", run.stdout)
        self.assertEqual(self.json("p.json")["commands"][0]["pivot"], [0, 0])
        after, _, _ = support.read_su2(self.path("out.su2"))
        for node in body:
            self.assertAlmostEqual(after[node][0], -before[node][1], delta=1e-10)
            self.assertAlmostEqual(after[node][1], before[node][0], delta=1e-10)

    def test_translations_say_nothing_of_a_pivot(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate",
                           "0.1", "0", "--report", "r.json")
        self.assertNotIn("turned", run.stdout)
        self.assertNotIn("pivot", self.json("r.json")["commands"][0])

    def test_several_markers_move_together(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--marker",
                     "farfield", "--translate", "3", "-2")
        before, _, markers = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        for edges in markers.values():
            for node, _ in edges:
                self.assertAlmostEqual(after[node][0] - before[node][0], 3)
                self.assertAlmostEqual(after[node][1] - before[node][1], -2)

    def test_the_positional_may_follow_the_markers(self):
        self.ring()
        self.winslow("move", "--marker", "body", "ring.su2", "--translate", "0.1", "0", "-o",
                     "out.su2")
        self.assertIn("out.su2", self.files())

    def test_output_may_be_the_input(self):
        self.ring()
        before, _, _ = support.read_su2(self.path("ring.su2"))
        self.winslow("move", "ring.su2", "-o", "ring.su2", "--marker", "body", "--rotate", "10")
        after, _, _ = support.read_su2(self.path("ring.su2"))
        self.assertNotEqual(before, after)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_nothing_to_do_is_a_usage_error(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", code=USAGE)
        self.assertIn("--rotate", run.stderr)

    def test_an_unknown_marker_lists_those_there_are(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "bodi", "--rotate", "5",
                           code=USAGE)
        self.assertIn('unknown marker "bodi"', run.stderr)
        self.assertIn("did you mean body?", run.stderr)
        self.assertIn("farfield (24 edges)", run.stderr)
        self.assertEqual(self.files(), ["ring.su2"])

    def test_increments_are_carried_out(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "40",
                     "--increments", "4", "--report", "r.json")
        self.assertEqual(self.json("r.json")["increments"], 4)

    def test_all_linear_solvers_agree(self):
        self.ring()
        results = []
        for name in ("direct", "gmres", "point-implicit"):
            self.winslow("move", "ring.su2", "-o", f"{name}.su2", "--marker", "body", "--rotate",
                         "30", "--linear", name, "--max-iterations", "5000")
            results.append(support.read_su2(self.path(f"{name}.su2"))[0])
        for other in results[1:]:
            for a, b in zip(results[0], other):
                self.assertAlmostEqual(a[0], b[0], delta=1e-6)
                self.assertAlmostEqual(a[1], b[1], delta=1e-6)

    def test_the_pointwise_form_by_newton_and_by_picard(self):
        self.ring()
        results, solves = {}, {}
        for outer in ("picard", "newton", "auto"):
            self.winslow("move", "ring.su2", "-o", f"{outer}.su2", "--marker", "body", "--rotate",
                         "90", "--formulation", "pointwise", "--outer", outer, "--report", "r.json",
                         "--history", f"{outer}.csv")
            results[outer] = support.read_su2(self.path(f"{outer}.su2"))[0]
            solves[outer] = self.json("r.json")["linear_solves"]
            with self.path(f"{outer}.csv").open() as file:
                stages = [row["stage"] for row in csv.DictReader(file)]
            self.assertEqual("picard" in stages, outer == "picard")
            self.assertEqual("path" in stages, outer != "picard")
        for outer in ("newton", "auto"):
            self.assertLess(solves[outer], solves["picard"] / 2)
            for a, b in zip(results["picard"], results[outer]):
                self.assertLess(math.dist(a, b), 1e-8)

    def test_boundary_only(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate", "0.02",
                     "0", "--no-smooth", "--report", "r.json")
        before, _, markers = support.read_su2(self.path("ring.su2"))
        after, _, _ = support.read_su2(self.path("out.su2"))
        body = {n for edge in markers["body"] for n in edge}
        self.assertEqual({n for n in range(len(before)) if before[n] != after[n]}, body)
        self.assertEqual(self.json("r.json")["outer_iterations"], 0)

    def test_the_result_does_not_depend_on_threads(self):
        self.ring(around=48, rings=24)
        for threads in ("1", "4"):
            self.winslow("move", "ring.su2", "-o", f"{threads}.su2", "--marker", "body", "--rotate",
                         "25", "--threads", threads)
        self.assertEqual(self.path("1.su2").read_bytes(), self.path("4.su2").read_bytes())


class Verdicts(ProgramTest):
    def test_an_inverted_result_is_not_written(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate",
                           "1.5", "0", "--no-smooth", "--report", "r.json", code=INVERTED)
        self.assertEqual(self.files(), ["r.json", "ring.su2"])
        report = self.json("r.json")
        self.assertGreater(report["inverted"], 0)
        self.assertEqual(len(report["inverted_elements"]), min(100, report["inverted"]))
        for element in report["inverted_elements"]:
            self.assertLess(abs(element["centre"][1]), 4)
        self.assertIn("inverted", run.stderr)
        self.assertIn("element", run.stderr)
        self.assertIsNone(report["output"])

    def test_an_inverted_result_leaves_the_old_output_alone(self):
        self.ring()
        self.path("out.su2").write_text("precious")
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate", "1.5",
                     "0", "--no-smooth", code=INVERTED)
        self.assertEqual(self.path("out.su2").read_text(), "precious")

    def test_allow_inverted_writes_it_and_still_says_so(self):
        self.ring()
        self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate", "1.5",
                     "0", "--no-smooth", "--allow-inverted", code=INVERTED)
        nodes, elements, _ = support.read_su2(self.path("out.su2"))
        self.assertLess(support.smallest_corner_area(nodes, elements), 0)

    def test_too_few_iterations_write_the_valid_mesh(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate",
                           "0.2", "0", "--direct", "--max-iterations", "2", "--report", "r.json",
                           code=NOT_CONVERGED)
        self.assertIn("not converged", run.stderr)
        report = self.json("r.json")
        self.assertFalse(report["converged"])
        self.assertEqual(report["inverted"], 0)
        self.assertEqual(report["output"], "out.su2")
        nodes, elements, _ = support.read_su2(self.path("out.su2"))
        self.assertGreater(support.smallest_corner_area(nodes, elements), 0)

    def test_a_motion_cut_short_is_not_written_unless_asked_for(self):
        self.ring()
        move = ("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--rotate", "170",
                "--pivot", "0", "0", "--max-iterations", "2", "--report", "r.json")
        run = self.winslow(*move, code=INVERTED)
        self.assertIn("the limit of iterations was reached", run.stderr)
        self.assertNotIn("out.su2", self.files())
        reached = self.json("r.json")["fraction_reached"]
        self.assertTrue(0 < reached < 1)
        self.winslow(*move, "--accept-partial", code=INVERTED)
        nodes, elements, _ = support.read_su2(self.path("out.su2"))
        before, _, _ = support.read_su2(self.path("ring.su2"))
        self.assertGreater(support.smallest_corner_area(nodes, elements), 0)
        turned = math.atan2(nodes[0][1], nodes[0][0]) - math.atan2(before[0][1], before[0][0])
        self.assertAlmostEqual(math.degrees(turned), 170 * reached, delta=1e-9)

    def test_a_motion_that_is_blocked_ends_at_the_last_valid_mesh(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate",
                           "9", "0", "--report", "r.json", "--accept-partial", code=INVERTED)
        self.assertIn("the motion could be followed to", run.stderr)
        self.assertIn("body would touch farfield at 38.9 % of the way", run.stderr)
        contact = self.json("r.json")["commands"][0]["contact"]
        self.assertEqual((contact["moving"], contact["other"]), ("body", "farfield"))
        self.assertAlmostEqual(contact["fraction"], 3.5 / 9, delta=0.01)
        reached = self.json("r.json")["fraction_reached"]
        self.assertTrue(0.3 < reached < 3.5 / 9, reached)  # contact: the rings' gap is 3.5
        nodes, elements, _ = support.read_su2(self.path("out.su2"))
        self.assertGreater(support.smallest_corner_area(nodes, elements), 0)

    def test_a_motion_into_contact_is_not_begun(self):
        self.ring()
        run = self.winslow("move", "ring.su2", "-o", "out.su2", "--marker", "body", "--translate",
                           "9", "0", "--report", "r.json", code=INVERTED)
        self.assertIn("body would touch farfield at 38.9 % of the way; nothing was written",
                      run.stderr)
        report = self.json("r.json")
        self.assertEqual((report["outer_iterations"], report["fraction_reached"]), (0, 0))
        self.assertNotIn("out.su2", self.files())


if __name__ == "__main__":
    support.main()
