"""Virtual control volumes of volume meshes from the command line: by hand in recipes, and in pictures."""
import json
import math
import unittest

import support
from png_pictures import HEADLESS, read_png
from support import ASSETS, HAS_GUI, ProgramTest

STENCILS = ASSETS / "coarse" / "stencils.su2"
LINKS = [4, 6, 8, 10, 22, 40, 80]


class SphereVcvs(ProgramTest):
    """Seven stars side by side, whose middles are nodes 0 to 6."""

    def points(self, path):
        lines = path.read_text().splitlines()
        at = next(i for i, line in enumerate(lines) if line.startswith("NPOIN"))
        count = int(lines[at].split("=")[1].split()[0])
        return [tuple(map(float, line.split()[:3])) for line in lines[at + 1:at + 1 + count]]

    def edit(self, node, off):
        """A recipe that gives a node its star, seen from a place beside it; the place."""
        points = self.points(STENCILS)
        place = tuple(c + d for c, d in zip(points[node], off))
        ring = [k for k, p in enumerate(points) if k > 6 and math.dist(p, points[node]) < 1.35]
        directions = [[points[k][c] - place[c] for c in range(3)] for k in ring]
        self.path("r.json").write_text(json.dumps({
            "winslow_recipe": 1, "input": str(STENCILS), "output": "out.su2",
            "commands": [{"command": "edit_vcv", "nodes": [{
                "node": node, "neighbours": ring, "directions": directions,
                "lengths": [math.hypot(*d) for d in directions]}]}]}))
        return place

    def test_a_node_goes_to_where_its_star_looks_like_its_control_volume(self):
        for node in (0, 2, 6):
            with self.subTest(node=node):
                place = self.edit(node, (0.1, -0.05, 0.08))
                self.winslow("replay", "r.json")
                self.assertLess(math.dist(self.points(self.path("out.su2"))[node], place), 1e-6)

    def test_a_turned_over_face_is_refused_by_its_node(self):
        self.edit(3, (0, 0, 0))
        recipe = self.json("r.json")
        directions = recipe["commands"][0]["nodes"][0]["directions"]
        directions[0] = [-c for c in directions[0]]
        self.path("r.json").write_text(json.dumps(recipe))
        run = self.winslow("replay", "r.json", code=support.USAGE)
        self.assertIn("VCV of node 3: the directions do not cover the sphere once", run.stderr)
        self.assertFalse(self.path("out.su2").exists())

    @unittest.skipUnless(HAS_GUI, "built without graphics")
    def test_pictures_have_the_control_volumes_that_are_asked_for(self):
        def ink(*nodes, kind="equal"):
            self.winslow("render", STENCILS, "-o", "p.png", "--size", 700, 140, "--no-cut", "--color", "none",
                         "--hide", ",".join(f"link{n}" for n in LINKS), "--azimuth", -90, "--elevation", 10,
                         "--centre", 8.4, 0, 0, "--half-width", 10, "--vcv", ",".join(map(str, nodes)),
                         "--vcv-kind", kind, env=HEADLESS)
            width, _, rows = read_png(self.path("p.png"))
            # Seen from -y, x runs to the right: a column of the picture for each star.
            return [sum(row[x] != (255, 255, 255) for row in rows[:100]
                        for x in range(int(width * (2.8 * k + 0.4) / 20), int(width * (2.8 * k + 2.8) / 20)))
                    for k in range(7)]
        all_seven = ink(*range(7))
        self.assertGreater(min(all_seven), 800)
        two = ink(1, 5)
        self.assertEqual([n > 800 for n in two], [False, True, False, False, False, True, False])
        self.assertNotEqual(ink(1, 5, kind="existing"), two)


if __name__ == "__main__":
    support.main()
