import math

from support import INPUT, INVERTED, USAGE, ProgramTest

CELLS = 6


def strata(physical=True):
    """Text of a MSH file: a square of shaken triangles, whose lower third is another region."""
    def node(i, j):
        return j * (CELLS + 1) + i + 1

    nodes = []
    for j in range(CELLS + 1):
        for i in range(CELLS + 1):
            inside = 0 < i < CELLS and 0 < j < CELLS
            # No random numbers: the same shake everywhere.
            shake = 0.3 / CELLS * math.sin(7 * i + 3 * j) if inside else 0
            nodes.append((i / CELLS + shake, j / CELLS + (0 if j == 2 else shake)))
    elements = []
    for j in range(CELLS):
        region = 1 if j < 2 else 2
        tags = f"2 2 {region if physical else 0} {region}"
        for i in range(CELLS):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            elements += [f"{tags} {a} {b} {c}", f"{tags} {a} {c} {d}"]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    if physical:
        lines += ["$PhysicalNames", "2", '2 1 "rock"', '2 2 "sand"', "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(nodes))]
    lines += [f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{k + 1} {e}" for k, e in enumerate(elements)]
    return "\n".join(lines + ["$EndElements", ""])


def places(text):
    lines = text.split("$Nodes\n")[1].split("\n$EndNodes")[0].split("\n")[1:]
    return [tuple(map(float, line.split()[1:3])) for line in lines]


class Interfaces(ProgramTest):
    def smooth(self, *args, **kwargs):
        run = self.winslow("smooth", "in.msh", "-o", "out.msh", *args, **kwargs)
        return run, places(self.path("out.msh").read_text())

    def setUp(self):
        super().setUp()
        self.path("in.msh").write_text(strata())
        self.before = places(self.path("in.msh").read_text())
        first = 2 * (CELLS + 1)
        self.meeting = range(first + 1, first + CELLS)

    def test_nodes_where_regions_meet_are_held_slide_or_go(self):
        run, after = self.smooth("--report", "r.json")
        self.assertIn("holds 5 nodes in which the regions rock and sand meet", run.stdout)
        self.assertEqual([after[k] for k in self.meeting], [self.before[k] for k in self.meeting])
        self.assertNotEqual(after, self.before)
        self.assertNotIn("belong to no marker: smoothing", run.stderr)
        self.assertEqual(self.json("r.json")["commands"][0]["interfaces"],
                         [{"regions": "rock and sand", "held": 5, "slide": 0, "free": 0}])
        self.assertEqual(self.json("r.json")["commands"][0]["kept_outside"], 0)

        run, after = self.smooth("--slide-interfaces", "--report", "r.json", "--save-recipe",
                                 "p.json")
        self.assertIn("slides 5 nodes in which the regions rock and sand meet", run.stdout)
        self.assertNotIn("nodes of the boundary slide", run.stdout)
        for k in self.meeting:
            self.assertAlmostEqual(after[k][1], 2 / CELLS, delta=1e-12)
            self.assertNotEqual(after[k], self.before[k])
        self.assertEqual(self.json("r.json")["commands"][0]["sliding"],
                         [{"regions": "rock and sand", "on": "straight line", "nodes": 5,
                           "spacing": "free"}])
        slide = self.json("p.json")["commands"][0]["smooth"]["slide"]
        self.assertEqual(slide["interfaces"], "slide")
        self.winslow("replay", "p.json", "-o", "again.msh")
        self.assertEqual(self.path("again.msh").read_bytes(), self.path("out.msh").read_bytes())

        run, after = self.smooth("--free-interfaces")
        self.assertIn("leaves free 5 nodes in which the regions rock and sand meet", run.stdout)
        self.assertGreater(max(abs(after[k][1] - 2 / CELLS) for k in self.meeting), 1e-4)

    def test_entities_are_regions_where_no_group_has_the_elements(self):
        self.path("in.msh").write_text(strata(physical=False))
        run, after = self.smooth()
        self.assertIn("the regions surface_entity_1 and surface_entity_2 meet", run.stdout)
        self.assertEqual([after[k] for k in self.meeting], [self.before[k] for k in self.meeting])

    def test_motions_leave_them_free_or_hold_them(self):
        for option, words in (((), "leaves free 5 nodes"),
                              (("--hold-interfaces",), "holds 5 nodes")):
            run = self.winslow("deform", "in.msh", "-o", "out.msh", "--marker", "loop_1", "--sine",
                               "0.01", "1", *option)
            self.assertIn(words, run.stdout)
            after = places(self.path("out.msh").read_text())
            same = [after[k] == self.before[k] for k in self.meeting]
            self.assertEqual(all(same), bool(option))

    def test_one_of_the_flags_at_a_time(self):
        run = self.winslow("smooth", "in.msh", "-o", "none.msh", "--slide-interfaces",
                           "--free-interfaces", code=USAGE)
        self.assertIn("--slide-interfaces", run.stderr)
        self.assertIn("--free-interfaces", run.stderr)
        self.assertFalse(self.path("none.msh").exists())
        self.path("p.json").write_text(
            '{"winslow_recipe": 1, "input": "in.msh", "output": "none.msh", "commands": '
            '[{"command": "smooth", "smooth": {"slide": {"interfaces": "loose"}}}]}')
        run = self.winslow("replay", "p.json", code=INPUT)
        self.assertIn("auto, held, slide, free", run.stderr)

    def test_what_cannot_be_untangled_with_held_nodes_says_how_to_let_them_go(self):
        text = strata()
        here = self.before[self.meeting[0]]
        there = self.before[self.meeting[3]]
        swapped = text.replace(f" {here[0]!r} {here[1]!r} 0", " HERE")
        swapped = swapped.replace(f" {there[0]!r} {there[1]!r} 0", f" {here[0]!r} {here[1]!r} 0")
        self.path("in.msh").write_text(
            swapped.replace(" HERE", f" {there[0]!r} {there[1]!r} 0"))
        run = self.winslow("smooth", "in.msh", "-o", "none.msh", code=INVERTED)
        self.assertIn("--free-interfaces lets them go", run.stderr)
        self.winslow("smooth", "in.msh", "-o", "out.msh", "--free-interfaces")
