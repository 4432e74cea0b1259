"""Sensitivity of the Python package: against differences of motions, and its transpose."""

import numpy as np

import winslow
from support import PackageTest, main, ring


class Sensitivities(PackageTest):
    def setUp(self):
        super().setUp()
        self.mesh = ring(around=16, rings=5)
        self.motion = {"rotate": 20, "pivot": (0.2, 0)}
        self.moved = winslow.move(self.mesh, "body", **self.motion).mesh
        self.sensitivity = winslow.Sensitivity(self.mesh, self.moved, "body")

    def moved_by(self, **more):
        return winslow.move(self.mesh, "body", **{**self.motion, **more}).mesh.points

    def test_against_differences(self):
        h = 1e-4
        for name, plus, minus in (("rotate", {"rotate": 20 + h}, {"rotate": 20 - h}),
                                  ("translate_x", {"translate": (h, 0)}, {"translate": (-h, 0)}),
                                  ("translate_y", {"translate": (0, h)}, {"translate": (0, -h)})):
            with self.subTest(name):
                pivot = self.motion["pivot"] if name == "rotate" else None
                forward = self.sensitivity.forward(self.sensitivity.velocities(name, pivot=pivot))
                differences = (self.moved_by(**plus) - self.moved_by(**minus)) / (2 * h)
                self.assertLess(abs(forward - differences).max(), 1e-6 * abs(differences).max())

    def test_transpose(self):
        random = np.random.default_rng(5)
        d_b, d_x = random.standard_normal((2, *self.mesh.points.shape))
        outside = np.setdiff1d(np.arange(self.mesh.node_count), self.sensitivity.boundary)
        d_b[outside] = 0
        a = (d_x * self.sensitivity.forward(d_b)).sum()
        b = (self.sensitivity.transpose(d_x) * d_b).sum()
        self.assertLess(abs(a - b), 1e-10 * abs(a))
        self.assertEqual(abs(self.sensitivity.transpose(d_x)[outside]).max(), 0)
        # Rows of the boundary alone.
        self.assert_same(self.sensitivity.forward(d_b[self.sensitivity.boundary]), self.sensitivity.forward(d_b))

    def test_properties(self):
        self.assertLess(self.sensitivity.distance, 1e-6)
        self.assertGreater(self.sensitivity.frozen["knee"], 1)
        self.assertEqual(len(self.sensitivity.boundary), 32)
        self.assertFalse(self.sensitivity.boundary.flags.writeable)
        self.assertTrue(self.sensitivity.mesh.has_connectivity_of(self.mesh))
        product = self.sensitivity.forward(np.ones_like(self.mesh.points))
        self.assertTrue(product.flags.writeable and product.flags.c_contiguous)
        np.testing.assert_allclose(product, 1, atol=1e-9)  # a shift of everything

    def test_points_in_place_of_a_mesh(self):
        other = winslow.Sensitivity(self.mesh, self.moved.points, "body")
        self.assert_same(other.mesh.points, self.sensitivity.mesh.points)

    def test_wrong_use(self):
        for call, text in ((lambda: winslow.Sensitivity(self.mesh, self.moved, []), "markers"),
                           (lambda: winslow.Sensitivity(self.mesh, self.moved, "bdy"), "did you mean body"),
                           (lambda: winslow.Sensitivity(self.mesh, self.moved, "body", reference=self.mesh),
                            "unknown option"),
                           (lambda: winslow.Sensitivity(self.mesh, ring(), "body"), "nodes"),
                           (lambda: self.sensitivity.forward(np.zeros((3, 2))), "shape"),
                           (lambda: self.sensitivity.transpose(np.zeros((3, 2))), "shape"),
                           (lambda: self.sensitivity.velocities("roll"), "expected one of rotate"),
                           (lambda: self.sensitivity.velocities("translate_z"), "plane")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


if __name__ == "__main__":
    main()
