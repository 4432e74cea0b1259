import math

import support
from support import INPUT, INVERTED, USAGE, ProgramTest


def area(nodes, element):
    """Of a triangle."""
    a, b, c = (nodes[n] for n in element)
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2


def write_sail(path, n):
    """The unit square of n by n squares, cut in two, with a sail without thickness at x = 1/2, from y =
    1/6 to 5/6: its nodes but for the tips are there twice, the second time for what is on the right."""
    nodes = [(i / n, j / n) for j in range(n + 1) for i in range(n + 1)]
    low, high = n // 6, 5 * n // 6
    copies = {}
    for j in range(low + 1, high):
        copies[j * (n + 1) + n // 2] = len(nodes)
        nodes.append((0.5, j / n))
    elements = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            square = [a, a + 1, a + n + 2, a + n + 1]
            if i == n // 2:
                square = [copies.get(node, node) for node in square]
            elements += [[square[k] for k in (0, 1, 2)], [square[k] for k in (0, 2, 3)]]
    line = [j * (n + 1) + n // 2 for j in range(low, high + 1)]
    right = [copies.get(node, node) for node in line]
    sail = [*zip(line, line[1:]), *zip(right, right[1:])]
    outer = [edge for k in range(n) for edge in (
        (k, k + 1), (n * (n + 1) + k, n * (n + 1) + k + 1), (k * (n + 1), (k + 1) * (n + 1)),
        (k * (n + 1) + n, (k + 1) * (n + 1) + n))]
    text = f"NDIME= 2\nNELEM= {len(elements)}\n"
    text += "".join("5 " + " ".join(map(str, e)) + "\n" for e in elements)
    text += f"NPOIN= {len(nodes)}\n" + "".join(f"{x!r} {y!r}\n" for x, y in nodes) + "NMARK= 2\n"
    for name, edges in (("outer", outer), ("sail", sail)):
        text += f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(edges)}\n"
        text += "".join(f"3 {a} {b}\n" for a, b in edges)
    path.write_text(text)


class Deform(ProgramTest):
    def body(self, name):
        nodes, _, markers = support.read_su2(self.path(name))
        return {n: nodes[n] for edge in markers["body"] for n in edge}

    def test_sine(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "0.05",
                     "2")
        before, after = self.body("ring.su2"), self.body("out.su2")
        for node, (x, y) in before.items():
            s = x + 0.5  # the body reaches from x = -0.5 to 0.5
            self.assertAlmostEqual(after[node][0], x, delta=1e-12)
            self.assertAlmostEqual(after[node][1], y + 0.05 * math.sin(4 * math.pi * s), delta=1e-12)

    def test_sine_with_a_negative_amplitude_and_direction(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "-0.05",
                     "1", "--direction", "-1", "0")
        before, after = self.body("ring.su2"), self.body("out.su2")
        largest = max(abs(after[n][0] - before[n][0]) for n in before)
        self.assertGreater(largest, 0.045)
        for node in before:
            self.assertAlmostEqual(after[node][1], before[node][1], delta=1e-12)

    def test_fade(self):
        self.ring(around=48)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--sine", "0.05",
                     "1.5", "--fade", "end", "--fade-length", "0.3")
        before, after = self.body("ring.su2"), self.body("out.su2")
        at_end = max(before, key=lambda n: before[n][0])
        self.assertAlmostEqual(after[at_end][1], before[at_end][1], delta=1e-12)
        moved = max(abs(after[n][1] - before[n][1]) for n in before if before[n][0] < 0)
        self.assertGreater(moved, 0.04)

    def test_displacement_file_by_node(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n0,0.05,-0.02\n5,-0.01,0.03\n")
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "d.csv")
        before, after = self.body("ring.su2"), self.body("out.su2")
        for node in before:
            dx, dy = {0: (0.05, -0.02), 5: (-0.01, 0.03)}.get(node, (0, 0))
            self.assertAlmostEqual(after[node][0] - before[node][0], dx, delta=1e-12)
            self.assertAlmostEqual(after[node][1] - before[node][1], dy, delta=1e-12)

    def test_displacement_file_by_coordinates(self):
        self.ring()
        self.path("d.csv").write_text("x,y,dx,dy\n0.5,0,0.05,-0.02\n")
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "d.csv")
        after = self.body("out.su2")
        self.assertAlmostEqual(after[0][0], 0.55)
        self.assertAlmostEqual(after[0][1], -0.02)

    def test_bad_displacement_files(self):
        self.ring()
        for text, code in (("node,dx,dy\n0,0.05\n", INPUT), ("node,dx,dy\n0,x,0\n", INPUT)):
            self.path("d.csv").write_text(text)
            run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body",
                               "--displacements", "d.csv", code=code)
            self.assertIn("d.csv:2", run.stderr)
        nodes, _, markers = support.read_su2(self.path("ring.su2"))
        far = markers["farfield"][0][0]
        self.path("d.csv").write_text(f"node,dx,dy\n{far},0.05,0\n")  # of another marker
        run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body",
                           "--displacements", "d.csv", code=USAGE)
        self.assertIn(f'd.csv:2: node {far} lies on "farfield", which does not belong to the chosen '
                      'markers: choose its marker, too, or no marker at all', run.stderr)
        self.path("d.csv").write_text(f"node,dx,dy\n{len(nodes)},0.05,0\n")
        run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--displacements", "d.csv",
                           code=USAGE)
        self.assertIn(f"node {len(nodes)} does not exist: the mesh has nodes 0 to {len(nodes) - 1}",
                      run.stderr)
        self.winslow("deform", "ring.su2", "-o", "out.su2", "--marker", "body", "--displacements",
                     "none.csv", code=INPUT)
        self.assertNotIn("out.su2", self.files())

    def test_nodes_inside_without_a_marker(self):
        """The solid of a coupled mesh: all of its nodes are in the file."""
        self.ring()
        nodes, elements, markers = support.read_su2(self.path("ring.su2"))
        fixed = {n for edges in markers.values() for edge in edges for n in edge}
        # Everything near the body moves as a whole.
        solid = [n for n, (x, y) in enumerate(nodes) if math.hypot(x, y) < 1 and n not in fixed]
        solid += sorted(self.body("ring.su2"))
        self.assertGreater(len(solid), len(self.body("ring.su2")))
        self.path("d.csv").write_text("node,dx,dy\n" + "".join(f"{n},0.06,-0.03\n" for n in solid))
        self.path("p.csv").write_text("node,x,y\n" + "".join(
            f"{n},{nodes[n][0] + 0.06!r},{nodes[n][1] - 0.03!r}\n" for n in solid))
        for option, file in (("--displacements", "d.csv"), ("--positions", "p.csv")):
            run = self.winslow("deform", "ring.su2", "-o", "out.su2", option, file, "--report",
                               "r.json", "--save-recipe", "r2.json")
            inside = len(solid) - len(self.body("ring.su2"))
            self.assertIn(f"{inside} nodes inside prescribed", run.stdout)
            self.assertEqual(self.json("r.json")["commands"][0]["prescribed_inside"], inside)
            after, _, _ = support.read_su2(self.path("out.su2"))
            moved = 0
            for n, before in enumerate(nodes):
                if n in solid:
                    self.assertLess(math.dist(after[n], (before[0] + 0.06, before[1] - 0.03)), 1e-15)
                elif n in fixed:
                    self.assertEqual(after[n], before)
                else:
                    moved += after[n] != before
            self.assertGreater(moved, 0)
            self.winslow("replay", "r2.json", "-o", "again.su2")
            self.assertEqual(self.path("out.su2").read_bytes(), self.path("again.su2").read_bytes())
        self.assertNotIn("markers", self.json("r2.json")["commands"][0])

    def test_positions_are_not_taken_for_displacements(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n0,0.05,0\n")
        self.path("p.csv").write_text("node,x,y\n0,0.55,0\n")
        base = ("deform", "ring.su2", "-o", "out.su2", "--marker", "body")
        run = self.winslow(*base, "--displacements", "p.csv", code=INPUT)
        self.assertIn("found columns of positions", run.stderr)
        self.assertIn("--positions", run.stderr)
        run = self.winslow(*base, "--positions", "d.csv", code=INPUT)
        self.assertIn("found columns of displacements", run.stderr)
        self.winslow(*base, "--positions", "p.csv")
        self.assertEqual(self.body("out.su2")[0], (0.55, 0))
        self.winslow(*base, "--positions", "p.csv", "--displacements", "d.csv", code=USAGE)
        run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--sine", "0.1", "1", code=USAGE)
        self.assertIn("--marker NAME", run.stderr)

    def test_prescribed_nodes_that_invert_an_element(self):
        self.ring()
        nodes, elements, markers = support.read_su2(self.path("ring.su2"))
        fixed = {n for edges in markers.values() for edge in edges for n in edge}
        element = next(e for e in elements if not set(e) & fixed)
        centre = [sum(nodes[n][k] for n in element) / len(element) for k in range(2)]
        # Mirrored at a line through its middle.
        self.path("d.csv").write_text("node,dx,dy\n" + "".join(
            f"{n},{2 * (centre[0] - nodes[n][0])!r},0\n" for n in element))
        run = self.winslow("deform", "ring.su2", "-o", "out.su2", "--displacements", "d.csv",
                           "--report", "r.json", code=INVERTED)
        self.assertIn("the prescribed nodes invert element", run.stderr)
        self.assertIn("nothing was written", run.stderr)
        self.assertAlmostEqual(self.json("r.json")["commands"][0]["held_inversion"]["fraction"], 0.5,
                               delta=1e-3)
        self.assertNotIn("out.su2", self.files())

    def test_sides_of_a_sail(self):
        """A row by place moves both nodes there; a side alone may open a hole, and not overlap."""
        write_sail(self.path("sail.su2"), 12)
        nodes, _, markers = support.read_su2(self.path("sail.su2"))
        sail = sorted({n for edge in markers["sail"] for n in edge})
        places = {}
        for n in sail:
            places.setdefault(nodes[n], []).append(n)
        double = [both for both in places.values() if len(both) == 2]
        self.assertEqual(len(double), 7)
        base = ("deform", "sail.su2", "-o", "out.su2", "--marker", "sail", "--displacements", "d.csv")
        for sign in (-1, 1):
            ways = {both[0]: sign * 0.1 * math.cos(1.5 * math.pi * (nodes[both[0]][1] - 0.5))
                    for both in double}
            self.path("d.csv").write_text("x,y,dx,dy\n" + "".join(
                f"{nodes[n][0]!r},{nodes[n][1]!r},{dx!r},0\n" for n, dx in ways.items()))
            run = self.winslow(*base)
            self.assertIn("Displace what lies in 7 places of sail", run.stdout)
            after, elements, _ = support.read_su2(self.path("out.su2"))
            for both in double:
                self.assertEqual(after[both[0]], after[both[1]])
                self.assertAlmostEqual(after[both[0]][0], nodes[both[0]][0] + ways[both[0]],
                                       delta=1e-15)
            self.assertAlmostEqual(sum(area(after, e) for e in elements), 1, delta=1e-12)
            # The side that was there first is the left one.
            self.path("d.csv").write_text("node,dx,dy\n" + "".join(
                f"{n},{dx!r},0\n" for n, dx in ways.items()))
            if sign < 0:
                self.winslow(*base)
                after, elements, _ = support.read_su2(self.path("out.su2"))
                self.assertLess(sum(area(after, e) for e in elements), 0.97)
            else:
                self.path("out.su2").unlink()
                run = self.winslow(*base, code=INVERTED)
                self.assertIn("the two sides of sail would pass through each other at (0.5, 0.5) at 0 "
                              "% of the way; nothing was written", run.stderr)
                self.assertNotIn("out.su2", self.files())

    def test_exactly_one_shape(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n0,0.05,0\n")
        base = ("deform", "ring.su2", "-o", "out.su2", "--marker", "body")
        self.winslow(*base, code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--displacements", "d.csv", code=USAGE)
        self.winslow(*base, "--displacements", "d.csv", "--fade", "end", code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--fade", "ends", code=USAGE)
        self.winslow(*base, "--sine", "0.1", "1", "--fade", "end", "--fade-length", "0.9",
                     code=USAGE)


if __name__ == "__main__":
    support.main()
