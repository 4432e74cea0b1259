"""The names of USMesh over Deformer and Sensitivity: warped meshes, solver vectors, derivatives."""

import contextlib
import io
import warnings

import numpy as np

import winslow
from winslow.warping import USMesh
from support import PackageTest, cube, main, ring


class Warping(PackageTest):
    def setUp(self):
        super().setUp()
        self.given = ring(around=16, rings=5)
        self.mesh = USMesh({"gridFile": self.given, "specifiedSurfaces": ["body"], "threads": 1})

    def bend(self, mesh=None, amount=0.08):
        mesh = mesh or self.mesh
        surface = mesh.getSurfaceCoordinates()
        surface[:, 1] += amount * np.cos(3 * surface[:, 0])
        mesh.setSurfaceCoordinates(surface)
        mesh.warpMesh()
        return surface

    def verified(self, mesh, **options):
        """The error that verifyWarpDeriv finds, and how many rows it prints."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            error = mesh.verifyWarpDeriv(**options)
        return error, len(out.getvalue().splitlines()) - 1

    def test_meshes(self):
        np.testing.assert_array_equal(self.mesh.getSurfaceCoordinates(), self.given.points[self.given.markers["body"]])
        np.testing.assert_array_equal(self.mesh.getSolverGrid(), self.given.points.ravel())
        surface = self.bend()
        np.testing.assert_array_equal(self.mesh.getSurfaceCoordinates(), surface)
        wanted = winslow.deform(self.given, "body", positions=surface).mesh.points
        np.testing.assert_allclose(self.mesh.getSolverGrid().reshape(-1, 2), wanted, atol=1e-8)
        self.mesh.writeGrid(self.folder / "warped.su2")
        np.testing.assert_array_equal(winslow.read(self.folder / "warped.su2").points.ravel(), self.mesh.getWarpGrid())

    def test_solver_vectors(self):
        indices = np.random.default_rng(2).permutation(self.given.points.size)[:40]
        indices = np.append(indices, indices[:3])  # a solver may have an entry twice
        self.mesh.setExternalMeshIndices(indices)
        self.bend()
        np.testing.assert_array_equal(self.mesh.getSolverGrid(), self.mesh.getWarpGrid()[indices])
        seed = np.random.default_rng(3).standard_normal(len(indices))
        self.mesh.warpDeriv(seed)
        first = self.mesh.getdXs()
        whole = np.zeros(self.given.points.size)
        np.add.at(whole, indices, seed)
        self.mesh.warpDeriv(whole, solverVec=False)
        np.testing.assert_allclose(first, self.mesh.getdXs(), atol=1e-13)

    def test_transposed_identity(self):
        self.bend()
        random = np.random.default_rng(4)
        for points in (None, self.mesh.getSurfaceCoordinates()):
            if points is not None:
                # The surface of a solver: another order, and nodes that it has twice.
                self.mesh.setSurfaceDefinition(self.given.points[self.given.markers["body"]][[3, 1, 2, 0, 3, 7, 5]])
                self.bend(amount=0.02)
            with self.subTest(own_surface=points is not None):
                shape = self.mesh.getSurfaceCoordinates().shape
                d_s, d_v = random.standard_normal(shape), random.standard_normal(self.mesh.getSolverGrid().shape)
                self.mesh.warpDeriv(d_v)
                a, b = (self.mesh.getdXs() * d_s).sum(), self.mesh.warpDerivFwd(d_s) @ d_v
                self.assertLess(abs(a - b), 1e-11 * abs(self.mesh.warpDerivFwd(d_s)).sum())

    def test_verify(self):
        self.bend()
        error, rows = self.verified(self.mesh, dofStart=3, dofEnd=12, h=1e-5)
        self.assertEqual(rows, 10)
        self.assertLess(error, 1e-6)
        # A wrong derivative is seen.
        right = self.mesh.warpDeriv
        self.mesh.warpDeriv = lambda d, solverVec: right(1.001 * d, solverVec)
        self.assertGreater(self.verified(self.mesh, h=1e-5)[0], 1e-4)

    def test_verify_own_surface_and_vector(self):
        self.mesh.setSurfaceDefinition(self.given.points[self.given.markers["body"]][[3, 1, 2, 0, 3, 7, 5]])
        self.mesh.setExternalMeshIndices(np.arange(0, self.given.points.size, 3))
        vector = np.random.default_rng(5).random(len(self.mesh.getSolverGrid()))
        self.bend(amount=0.02)
        self.assertLess(self.verified(self.mesh, dXv=vector, dofEnd=99, h=1e-5)[0], 1e-6)

    def test_space_and_symmetry(self):
        mesh = USMesh({"gridFile": cube(), "specifiedSurfaces": ["bottom"], "symmetrySurfaces": ["others"],
                       "threads": 1})
        surface = mesh.getSurfaceCoordinates()
        self.assertEqual(surface.shape[1], 3)
        inside = (abs(surface[:, :2] - 0.5) < 0.4).all(axis=1)
        surface[inside, 2] += 0.1
        mesh.setSurfaceCoordinates(surface)
        mesh.warpMesh()
        # A point within the surface; those at the sides stay in their planes.
        first = 3 * int(np.flatnonzero(inside)[1])
        error, rows = self.verified(mesh, dofStart=first, dofEnd=first + 2, h=1e-5)
        self.assertEqual(rows, 3)
        self.assertLess(error, 1e-6)

    def test_before_a_warp(self):
        self.assertEqual(abs(self.mesh.getdXs()).max(), 0)
        moved = self.mesh.warpDerivFwd(np.tile([1.0, 0.0], (16, 1)))
        self.assertGreater(moved.max(), 0.9)

    def test_a_surface_without_a_mesh(self):
        before = self.mesh.getSolverGrid()
        self.mesh.setSurfaceCoordinates(self.mesh.getSurfaceCoordinates() + [50, 0])
        with self.assertRaises(winslow.IncompleteMotion):
            self.mesh.warpMesh()
        np.testing.assert_array_equal(self.mesh.getSolverGrid(), before)

    def test_options(self):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            mesh = USMesh({"gridFile": self.given, "aExp": 3.0, "useRotations": True})
        self.assertIn("aExp, useRotations", str(said[0].message))
        self.assertEqual(len(mesh.getSurfaceCoordinates()), 32)

        class Two:
            size = 2

        for call, text in ((lambda: USMesh({}), "gridFile"),
                           (lambda: USMesh({"gridFile": self.given}, Two()), "2 processes"),
                           (lambda: self.mesh.setSurfaceCoordinates(np.zeros((3, 2))), "shape"),
                           (lambda: self.mesh.setSurfaceCoordinates(np.full((16, 2), np.nan)), "finite"),
                           (lambda: self.mesh.setExternalMeshIndices([10000]), "expected 0 to"),
                           (lambda: self.mesh.setExternalMeshIndices([0.5]), "whole numbers"),
                           (lambda: self.mesh.warpDeriv(np.zeros(3)), "found 3 numbers"),
                           (lambda: self.mesh.setSurfaceDefinition([[9, 9]]), "row 0"),
                           (lambda: USMesh({"gridFile": self.given, "specifiedSurfaces": ["bdy"]}), "body")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


if __name__ == "__main__":
    main()
