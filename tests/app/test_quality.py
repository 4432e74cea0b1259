import support
from support import INVERTED, ProgramTest


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


if __name__ == "__main__":
    support.main()
