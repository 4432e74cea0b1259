"""Deformer of the Python package: against single motions, repeated to the bit, in threads, without leaks."""

import gc
import math
import os
import resource
import threading
import time
import unittest

import numpy as np

import winslow
from support import ASSETS, PackageTest, cube, main, ring

CALLS = int(os.environ.get("WINSLOW_LEAK_CALLS", "10000"))


def bent(deformer, amount):
    """Places of the nodes of a deformer after a bend."""
    places = deformer.given.points[deformer.nodes].copy()
    places[:, 1] += amount * np.cos(3 * places[:, 0])
    return places


class Steps(PackageTest):
    def setUp(self):
        super().setUp()
        self.mesh = ring()
        self.deformer = winslow.Deformer(self.mesh, "body", threads=1)

    def test_held_layers(self):
        mesh = winslow.layers(ASSETS / "coarse" / "naca0012.su2", "airfoil", count=6, first=1e-3, ratio=1.2).mesh
        deformer = winslow.Deformer(mesh, "airfoil", hold_layers="airfoil", threads=1)
        wall = deformer.nodes
        for turn in (2, 4, 3):
            deformer.set_motion(rotate=turn, pivot=(0.25, 0))
            result = deformer.step()
            single = winslow.move(mesh, "airfoil", rotate=turn, pivot=(0.25, 0), hold_layers="airfoil")
            np.testing.assert_allclose(result.mesh.points, single.mesh.points, atol=1e-5)
        derivative = deformer.sensitivity()
        field = np.sin(np.arange(mesh.points.size)).reshape(mesh.points.shape)
        boundary = np.zeros_like(field)
        boundary[wall] = field[wall]
        np.testing.assert_allclose(np.sum(derivative.forward(boundary) * field),
                                   np.sum(derivative.transpose(field) * boundary), rtol=1e-9)

    def test_places_against_deform(self):
        for amount in (0.05, 0.1, 0.15):
            places = bent(self.deformer, amount)
            self.deformer.set_boundary(places)
            result = self.deformer.step()
            self.assertTrue(result.converged)
            single = winslow.deform(self.mesh, "body", positions=places)
            np.testing.assert_allclose(result.mesh.points, single.mesh.points, atol=1e-8)
            self.assert_same(result.mesh.points[self.deformer.nodes], places)
        self.assertLess(result.linear_solves, single.linear_solves)

    def test_ways_to_give_places(self):
        places = bent(self.deformer, 0.1)
        whole = self.mesh.copy_points()
        whole[self.deformer.nodes] = places
        found = []
        for call in (lambda d: d.set_boundary(places), lambda d: d.set_boundary(whole),
                     lambda d: d.set_boundary(whole.tolist()),
                     lambda d: d.set_boundary(places[::-1], self.deformer.nodes[::-1].astype(np.int64))):
            deformer = winslow.Deformer(self.mesh, "body", threads=1)
            call(deformer)
            found.append(deformer.step().mesh.points)
        for points in found[1:]:
            self.assert_same(points, found[0])

    def test_motions_and_sines_against_commands(self):
        self.deformer.set_motion(rotate=20, pivot=(0.2, 0))
        turned = self.deformer.step()
        np.testing.assert_allclose(turned.mesh.points,
                                   winslow.move(self.mesh, "body", rotate=20, pivot=(0.2, 0)).mesh.points, atol=1e-8)
        self.deformer.set_motion(bodies=[{"markers": "bod*", "translate": (0.1, 0.2)}])
        np.testing.assert_allclose(self.deformer.step().mesh.points,
                                   winslow.move(self.mesh, "body", translate=(0.1, 0.2)).mesh.points, atol=1e-8)
        self.deformer.set_sine(amplitude=0.05, waves=1)
        np.testing.assert_allclose(
            self.deformer.step().mesh.points,
            winslow.deform(self.mesh, "body", sine={"amplitude": 0.05, "waves": 1}).mesh.points, atol=1e-8)
        # Any marker, without those of a session.
        free = winslow.Deformer(self.mesh)
        self.assertEqual(len(free.nodes), 0)
        free.set_motion("body", rotate=20, pivot=(0.2, 0))
        np.testing.assert_allclose(free.step().mesh.points, turned.mesh.points, atol=1e-8)

    def test_space(self):
        mesh = cube()
        deformer = winslow.Deformer(mesh, "bottom")
        places = mesh.points[deformer.nodes].copy()
        inside = (abs(places[:, :2] - 0.5) < 0.4).all(axis=1)
        places[inside, 2] += 0.1
        deformer.set_boundary(places)
        np.testing.assert_allclose(deformer.step().mesh.points,
                                   winslow.deform(mesh, "bottom", positions=places, tolerance=1e-10).mesh.points,
                                   atol=1e-8)

    def test_returns(self):
        """A boundary that returns gets its mesh back, and a tolerance makes no difference that adds up."""
        for angle in (0, 10, 20, 30, 20, 10, 0):
            self.deformer.set_motion(rotate=angle, pivot=(0, 0))
            self.deformer.step(1e-4)
        self.assertLess(abs(self.deformer.points - self.mesh.points).max(), 1e-4)

    def test_displacement_and_points(self):
        self.assert_same(self.deformer.points, self.mesh.points)
        self.assertEqual(abs(self.deformer.displacement()).max(), 0)
        before = self.deformer.points
        for shift in (0.1, 0.2):
            self.deformer.set_motion(translate=(shift, 0))
            result = self.deformer.step()
        points = self.deformer.points
        self.assertEqual(points.__array_interface__["data"], self.deformer.points.__array_interface__["data"])
        self.assertFalse(points.flags.writeable)
        self.assert_same(points, result.mesh.points)
        self.assert_same(before, self.mesh.points)
        np.testing.assert_allclose(self.deformer.displacement()[self.deformer.nodes], [[0.1, 0]] * 24, atol=1e-15)
        self.deformer.set_motion(translate=(0, 0))
        kept = points.copy()
        self.deformer.step()
        self.assert_same(points, kept)  # a view of the earlier step keeps its numbers
        self.assertTrue(self.deformer.mesh.has_connectivity_of(self.mesh))
        del self.deformer
        gc.collect()
        self.assert_same(points, kept)

    def test_checkpoints_repeat_to_the_bit(self):
        def run(first, last):
            out = []
            for k in range(first, last):
                self.deformer.set_boundary(bent(self.deformer, 0.02 * k))
                out.append(self.deformer.step(1e-6).mesh.points)
            return out

        run(0, 3)
        kept = self.deformer.checkpoint()
        first = run(3, 7)
        for _ in range(2):
            self.deformer.restore(kept)
            for a, b in zip(run(3, 7), first):
                self.assert_same(a, b)

    def test_incomplete(self):
        self.deformer.set_motion(rotate=10)
        self.deformer.step()
        here = self.deformer.points.copy()
        self.deformer.set_motion(translate=(50, 0))
        with self.assertRaises(winslow.IncompleteMotion) as caught:
            self.deformer.step()
        self.assertLess(caught.exception.result.fraction_reached, 1)
        self.assertEqual(caught.exception.result.inverted, 0)
        self.assert_same(self.deformer.points, here)
        partial = self.deformer.step(allow_incomplete=True)
        self.assertIn("%", repr(partial))
        self.assert_same(self.deformer.points, here)
        self.deformer.set_motion(rotate=12)
        self.assertTrue(self.deformer.step().complete)

    def test_cancel(self):
        self.deformer.set_motion(rotate=40)
        with self.assertRaises(winslow.Cancelled):
            self.deformer.step(progress=lambda record: False)
        with self.assertRaises(ZeroDivisionError):
            self.deformer.step(progress=lambda record: 1 / 0)
        self.assert_same(self.deformer.points, self.mesh.points)
        seen = []
        result = self.deformer.step(progress=seen.append)
        self.assertEqual(len(seen), len(result.history))
        # A call from within a call.
        self.deformer.set_motion(rotate=50)
        with self.assertRaisesRegex(winslow.UsageError, "one call at a time"):
            self.deformer.step(progress=lambda record: self.deformer.points)

    def test_report(self):
        self.deformer.set_motion(rotate=20)
        report = self.deformer.step().report()
        self.assertEqual(report["command"], "step")
        self.assertEqual(report["inverted"], 0)
        self.assertIn("normalized_jacobian", report["quality"])

    def test_options(self):
        mesh = ring()
        stretched = winslow.move(mesh, "body", rotate=30).mesh
        deformer = winslow.Deformer(stretched, "body", reference=mesh, tolerance=1e-6, threads=1)
        self.assertIn("body", repr(deformer))
        self.assertEqual(deformer.markers, ["body"])
        deformer.set_motion(rotate=-30)
        np.testing.assert_allclose(deformer.step(1e-10).mesh.points, mesh.points, atol=1e-7)

    def test_wrong_use(self):
        d = self.deformer
        other = winslow.Deformer(self.mesh, "body")
        for call, text in ((d.step, "no boundary is set"),
                           (lambda: winslow.Deformer(self.mesh, "bdy"), "did you mean body"),
                           (lambda: winslow.Deformer(self.mesh, []), "found none"),
                           (lambda: winslow.Deformer(self.mesh, "body", tolerence=1), "tolerance"),
                           (lambda: winslow.Deformer(self.mesh, "body", progress=print), "argument of step"),
                           (lambda: winslow.Deformer(self.mesh, "body", hold_layers="boddy"), "did you mean body"),
                           (lambda: d.set_boundary(np.zeros((3, 2))), "shape"),
                           (lambda: d.set_boundary(np.zeros((1, 2)), [99999]), "found 99999"),
                           (lambda: winslow.Deformer(self.mesh).set_boundary(np.zeros((1, 2))), "without ids"),
                           (lambda: winslow.Deformer(self.mesh).set_motion(rotate=1), "give markers"),
                           (lambda: d.set_motion(pivot=(0, 0)), "nothing to do"),
                           (lambda: d.set_motion("body", bodies=[]), "together with markers"),
                           (lambda: d.set_sine(amplitude=1), "waves"),
                           (lambda: d.step(2), "tolerance"),
                           (d.sensitivity, r"call step\(\)"),
                           (lambda: d.restore(None), "checkpoint"),
                           (lambda: d.restore(other.checkpoint()), "another deformer")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


class Derivatives(PackageTest):
    def setUp(self):
        super().setUp()
        self.mesh = ring(around=16, rings=5)
        self.deformer = winslow.Deformer(self.mesh, "body", threads=1)
        self.places = bent(self.deformer, 0.1)
        self.deformer.set_boundary(self.places)
        self.deformer.step()

    def test_velocities_against_differences(self):
        h, direction = 1e-5, np.random.default_rng(1).standard_normal(self.places.shape)
        velocities = self.deformer.velocities(direction)
        ends = []
        for sign in (1, -1):
            other = winslow.Deformer(self.mesh, "body", threads=1)
            other.set_boundary(self.places + sign * h * direction)
            ends.append(other.step().mesh.points)
        differences = (ends[0] - ends[1]) / (2 * h)
        self.assertLess(abs(velocities - differences).max(), 1e-6 * abs(differences).max())

    def test_sensitivity(self):
        sensitivity = self.deformer.sensitivity()
        self.assertIsInstance(sensitivity, winslow.Sensitivity)
        direction = np.zeros_like(self.mesh.points)
        direction[self.deformer.nodes, 0] = 1
        before = sensitivity.forward(direction)
        np.testing.assert_allclose(before, self.deformer.velocities(direction), atol=1e-12)
        alone = winslow.Sensitivity(self.mesh, self.deformer.mesh, "body")
        np.testing.assert_allclose(before, alone.forward(direction), atol=1e-7)
        # It outlives the next step.
        self.deformer.set_boundary(bent(self.deformer, 0.2))
        self.deformer.step()
        self.assert_same(sensitivity.forward(direction), before)
        self.assertGreater(abs(self.deformer.velocities(direction) - before).max(), 1e-3)

    def test_largest_valid(self):
        self.assertEqual(self.deformer.largest_valid(bent(self.deformer, 0.11)), 1)
        far = self.places + (30, 0)
        share = self.deformer.largest_valid(far)
        self.assertTrue(0 < share < 0.5, share)
        # The mesh is valid there.
        self.deformer.set_boundary(self.places + 0.9 * share * (far - self.places))
        self.assertTrue(self.deformer.step().complete)


class Threads(PackageTest):
    def test_two_sessions_in_two_threads(self):
        mesh = winslow.read(ASSETS / "coarse" / "three_element.su2")

        def run(marker):
            deformer = winslow.Deformer(mesh, marker, threads=1)
            out = []
            for k in range(4):
                deformer.set_motion(rotate=2 * math.sin(k))
                out.append(deformer.step(1e-6).mesh.points)
            return out

        alone = {marker: run(marker) for marker in ("flap", "slat")}
        found, failed = {}, []

        def work(marker):
            try:
                found[marker] = run(marker)
            except BaseException as error:  # for the main thread to show
                failed.append(error)

        threads = [threading.Thread(target=work, args=(marker,)) for marker in alone]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failed, [])
        for marker, steps in alone.items():
            for a, b in zip(found[marker], steps):
                self.assert_same(a, b)

    def test_python_goes_on_during_a_step(self):
        deformer = winslow.Deformer(winslow.read(ASSETS / "naca0012.su2"), "airfoil", threads=1)
        deformer.set_motion(rotate=-40, pivot=(0.5, 0))
        counts, stop, refused = [0], threading.Event(), []

        def count():
            while not stop.is_set():
                counts[0] += 1
                try:
                    deformer.displacement()
                except winslow.UsageError as error:
                    refused.append(str(error))
                time.sleep(0.001)

        other = threading.Thread(target=count)
        other.start()
        deadline = time.monotonic() + 60
        try:
            while time.monotonic() < deadline:
                try:
                    deformer.step()
                    break
                except winslow.UsageError:  # the other thread was within its call
                    pass
            deformer_is_free = deformer.points
        finally:
            stop.set()
            other.join()
        self.assertGreater(counts[0], 5)
        self.assertTrue(refused)
        self.assertIn("one call at a time", refused[0])
        self.assertTrue(np.isfinite(deformer_is_free).all())


class Leaks(PackageTest):
    @unittest.skipIf("WINSLOW_SANITIZED" in os.environ, "the sanitizer keeps what is freed: see memory_test.py")
    def test_ten_thousand_calls(self):
        deformer = winslow.Deformer(ring(around=8, rings=2), "body", threads=1)
        places = bent(deformer, 0.05)
        whole = np.zeros_like(deformer.given.points)

        def calls(count):
            for k in range(count):
                deformer.set_boundary(places)
                deformer.set_motion(rotate=1)
                deformer.points.sum()
                deformer.displacement()
                deformer.restore(deformer.checkpoint())
                try:
                    deformer.set_boundary(places[:3])
                except winslow.UsageError:
                    pass
                if k % 20 == 0:
                    deformer.set_motion(rotate=k % 3 + 1)
                    deformer.step(1e-4)
                    deformer.sensitivity().transpose(whole)

        def resident():
            gc.collect()
            with open("/proc/self/statm", encoding="ascii") as statm:
                return int(statm.read().split()[1]) * resource.getpagesize()

        calls(CALLS // 10)
        before = resident()
        calls(CALLS // 2)
        half = resident()
        calls(CALLS // 2)
        self.assertLess(resident() - before, 4 << 20, f"after half of the calls {half - before}")


if __name__ == "__main__":
    main()
