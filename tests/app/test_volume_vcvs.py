"""Virtual control volumes of volume meshes: the pointwise form, targets over them, what is refused."""
import math
import pathlib
import shutil

import support
from support import INVERTED, NOT_CONVERGED, USAGE, ProgramTest

DATA = pathlib.Path(__file__).resolve().parents[1] / "data"
CENTRE, RADIUS = (0.0, 0.0, 0.0), 1.0


def read_mesh(path):
    """Nodes, tetrahedra and the nodes of each marker of an SU2 file."""
    lines = iter(pathlib.Path(path).read_text().splitlines())
    nodes, cells, markers = [], [], {}
    for line in lines:
        key, _, value = (part.strip() for part in line.partition("="))
        if key == "NELEM":
            cells = [tuple(map(int, next(lines).split()[1:5])) for _ in range(int(value))]
        elif key == "NPOIN":
            count = int(value.split()[0])
            nodes = [tuple(map(float, next(lines).split()[:3])) for _ in range(count)]
        elif key == "MARKER_TAG":
            count = int(next(lines).partition("=")[2])
            faces = [tuple(map(int, next(lines).split()[1:4])) for _ in range(count)]
            markers[value] = {n for face in faces for n in face}
    return nodes, cells, markers


class VolumeVcvs(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copy(DATA / "sphere_in_box.su2", self.path("in.su2"))
        self.given = self.quality("in.su2")

    def quality(self, name):
        """Mean R/3r and smallest solid angle of a file."""
        self.winslow("quality", name, "--report", "q.json")
        metrics = self.json("q.json")["quality"]
        return metrics["aspect_ratio"]["avg"], metrics["smallest_solid_angle"]["min"]

    def smoothed(self, *args, name="o.su2", code=0):
        self.winslow("smooth", "in.su2", "-o", name, *args, code=code)
        return self.quality(name)

    def height(self, name):
        """Mean distance from the sphere of the nodes next to it."""
        nodes, cells, markers = read_mesh(self.path(name))
        on_boundary = set().union(*markers.values())
        near = {n for cell in cells if markers["body"] & set(cell) for n in cell} - on_boundary
        return sum(math.dist(nodes[n], CENTRE) - RADIUS for n in near) / len(near)

    def test_equal_angles_collapse_existing_ones_elongate_adjusted_ones_improve(self):
        picard = ("--formulation", "pointwise", "--outer", "picard")
        found, heights = {}, {}
        for vcv in ("equal", "existing", "adjusted"):
            found[vcv] = self.smoothed(*picard, "--vcv", vcv)
            heights[vcv] = self.height("o.su2")
        self.assertLess(heights["equal"], heights["adjusted"])
        self.assertGreater(heights["existing"], heights["adjusted"])
        for vcv in ("equal", "existing"):
            self.assertGreater(found[vcv][0], 1.05 * self.given[0])
            self.assertLess(found[vcv][1], 0.5 * self.given[1])
        self.assertLess(found["adjusted"][0], self.given[0])
        self.assertGreater(found["adjusted"][1], self.given[1])

    def test_targets_over_adjusted_vcvs_improve_the_mesh(self):
        mean, smallest = self.smoothed("--targets", "vcv")
        self.assertLess(mean, self.given[0])
        self.assertGreater(smallest, self.given[1])
        # They are the default, and a blend lies between its parts.
        self.smoothed("--targets", "vcv", "--vcv", "adjusted", name="a.su2")
        self.assertEqual(self.path("o.su2").read_bytes(), self.path("a.su2").read_bytes())
        element, _ = self.smoothed("--targets", "element")
        blend, _ = self.smoothed("--targets", "element=0.5", "vcv=0.5")
        self.assertLess(blend, mean)
        self.assertNotEqual(blend, element)

    def test_newton_and_the_fixed_point_agree(self):
        for outer in ("newton", "picard"):
            self.winslow("smooth", "in.su2", "-o", f"{outer}.su2", "--formulation", "pointwise",
                         "--outer", outer, "--tolerance", "1e-10", "--report", f"{outer}.json")
        a, b = (read_mesh(self.path(f"{outer}.su2"))[0] for outer in ("newton", "picard"))
        self.assertLess(max(math.dist(p, q) for p, q in zip(a, b)), 1e-8)
        solves = [self.json(f"{outer}.json")["commands"][0]["linear_solves"]
                  for outer in ("newton", "picard")]
        self.assertLess(solves[0], solves[1])

    def test_updates_and_the_perturbation_change_the_mesh(self):
        plain = self.smoothed("--targets", "vcv")
        meshes = [self.path("o.su2").read_bytes()]
        for args in (("--vcv-updates", "20"), ("--vcv", "perturbation")):
            mean, smallest = self.smoothed("--targets", "vcv", *args)
            self.assertLess(mean, self.given[0])
            self.assertGreater(smallest, 0.8 * plain[1])
            self.assertNotIn(self.path("o.su2").read_bytes(), meshes)
            meshes.append(self.path("o.su2").read_bytes())

    def test_edge_lengths_keep_the_grading(self):
        picard = ("--formulation", "pointwise", "--vcv", "existing", "--outer", "picard")
        self.smoothed(*picard)
        unit = self.height("o.su2")
        self.smoothed(*picard, "--vcv-lengths", "1")
        given = self.height("in.su2")
        self.assertLess(abs(self.height("o.su2") - given), abs(unit - given))

    def test_a_sphere_moves_over_its_vcvs_and_a_recipe_does_it_again(self):
        for form in (("--formulation", "pointwise"), ("--targets", "vcv")):
            self.winslow("move", "in.su2", "-o", "a.su2", "--marker", "body", "--rotate", "30",
                         "--axis", "1", "0", "0", "--translate", "0.3", "0.2", "0.1", *form,
                         "--vcv", "adjusted", "--report", "r.json", "--save-recipe", "recipe.json")
            report = self.json("r.json")
            self.assertEqual(report["inverted"], 0)
            self.assertTrue(report["converged"])
            self.assertEqual(self.json("recipe.json")["commands"][0]["smooth"]["vcv"], "adjusted")
            self.winslow("replay", "recipe.json", "-o", "b.su2")
            self.assertEqual(self.path("a.su2").read_bytes(), self.path("b.su2").read_bytes())

    def test_a_scramble_comes_back(self):
        self.winslow("scramble", "in.su2", "-o", "s.su2", "--allow-inverted", code=INVERTED)
        for form in (("--formulation", "pointwise"), ("--targets", "vcv")):
            self.winslow("smooth", "s.su2", "-o", "o.su2", *form)
            self.assertGreater(self.quality("o.su2")[1], 0.5 * self.given[1])

    def test_too_few_iterations_do_not_converge(self):
        run = self.winslow("smooth", "in.su2", "-o", "o.su2", "--formulation", "pointwise",
                           "--outer", "picard", "--max-iterations", "3", code=NOT_CONVERGED)
        self.assertIn("NOT converged after 3 iterations", run.stdout)

    def test_what_does_not_fit_is_refused_by_name(self):
        plane = self.ring()
        for vcv in ("existing", "adjusted", "perturbation"):
            run = self.winslow("smooth", plane, "-o", "o.su2", "--vcv", vcv, code=USAGE)
            self.assertIn("vcv: solid angles of volume meshes only; a plane mesh takes auto or equal",
                          run.stderr)
        run = self.winslow("smooth", plane, "-o", "o.su2", "--vcv-updates", "2", code=USAGE)
        self.assertIn("vcv_updates: for volume meshes only", run.stderr)
        run = self.winslow("smooth", plane, "-o", "o.su2", "--vcv-lengths", "0.5", code=USAGE)
        self.assertIn("vcv_lengths: for volume meshes only", run.stderr)
        run = self.winslow("smooth", "in.su2", "-o", "o.su2", "--vcv-lengths", "2", code=USAGE)
        self.assertIn("--vcv-lengths", run.stderr)
        run = self.winslow("smooth", "in.su2", "-o", "o.su2", "--vcv", "equal", "--vcv-updates", "2",
                           code=USAGE)
        self.assertIn("equal and existing VCVs do not follow the mesh", run.stderr)
        run = self.winslow("smooth", "in.su2", "-o", "o.su2", "--vcv", "nonsense", code=USAGE)
        self.assertIn("auto, equal, existing, adjusted, perturbation", run.stderr)
        self.assertFalse(self.path("o.su2").exists())
        # The plane's own are equal ones, whether they are named or not.
        self.winslow("smooth", plane, "-o", "a.su2", "--formulation", "pointwise")
        self.winslow("smooth", plane, "-o", "b.su2", "--formulation", "pointwise", "--vcv", "equal")
        self.assertEqual(self.path("a.su2").read_bytes(), self.path("b.su2").read_bytes())


if __name__ == "__main__":
    support.main()
