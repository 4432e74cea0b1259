"""Progress, cancelling, Ctrl-C, threads: what happens while a command runs."""

import os
import signal
import threading
import time

import numpy as np

import winslow
from support import ASSETS, PackageTest, main, ring

LONG = {"formulation": "pointwise", "outer": "picard", "acceleration": 0, "damping": 0.01, "adapt_damping": False,
        "max_iterations": 1000000, "tolerance": 1e-15, "increments": 1, "allow_inverted": True}


class Progress(PackageTest):
    def test_records(self):
        seen = []
        result = winslow.move(ring(), "body", translate=(0.3, 0), progress=seen.append)
        self.assertEqual([r.iteration for r in seen], [r.iteration for r in result.history])
        self.assertEqual(seen[-1].residual, result.history[-1].residual)
        self.assertIn("newton", repr(seen[-1]))

    def test_false_cancels(self):
        calls = []

        def stop(record):
            calls.append(record)
            return len(calls) < 2

        with self.assertRaises(winslow.Cancelled):
            winslow.move(ring(), "body", translate=(0.3, 0), progress=stop)
        self.assertEqual(len(calls), 2)
        # None, 0 and "" are no wish to cancel.
        self.assertTrue(winslow.move(ring(), "body", translate=(0.3, 0), progress=lambda record: 0).converged)

    def test_an_exception_of_the_callback(self):
        class Own(Exception):
            pass

        def fail(record):
            raise Own("from within")

        with self.assertRaisesRegex(Own, "from within"):
            winslow.move(ring(), "body", translate=(0.3, 0), progress=fail)

    def test_ctrl_c(self):
        mesh = winslow.read(ASSETS / "naca0012.su2")
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            winslow.move(mesh, "airfoil", rotate=-90, pivot=(0.5, 0), **LONG)
        self.assertLess(time.monotonic() - begin, 10)
        timer.join()

    def test_ctrl_c_in_a_sweep(self):
        mesh = winslow.read(ASSETS / "naca0012.su2")
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            winslow.sweep(mesh, "airfoil", rotate=np.linspace(-40, 40, 400), jobs=2)
        timer.join()

    def test_python_goes_on_while_a_command_runs(self):
        mesh = winslow.read(ASSETS / "naca0012.su2")
        counts, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counts[0] += 1
                time.sleep(0.001)

        other = threading.Thread(target=count)
        other.start()
        begin = time.monotonic()
        try:
            winslow.move(mesh, "airfoil", rotate=-60, pivot=(0.5, 0), threads=1)
        finally:
            took = time.monotonic() - begin
            stop.set()
            other.join()
        # With the GIL held it would be about one.
        self.assertGreater(counts[0], 5, f"{counts[0]} counts in {took:.2f} s")

    def test_two_threads_at_once(self):
        mesh = winslow.read(ASSETS / "coarse" / "three_element.su2")
        angles = [-3.0, -6.0, -9.0, -12.0]
        alone = [winslow.move(mesh, "flap", rotate=a, pivot=(0.86, -0.02), threads=1).mesh.points for a in angles]
        found, failed = [None] * len(angles), []

        def work(first):
            try:
                for k in range(first, len(angles), 2):
                    found[k] = winslow.move(mesh, "flap", rotate=angles[k], pivot=(0.86, -0.02), threads=1,
                                            progress=lambda record: None).mesh.points
            except BaseException as error:  # for the main thread to show
                failed.append(error)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failed, [])
        for a, b in zip(found, alone):
            self.assert_same(a, b)


class Sweeps(PackageTest):
    def setUp(self):
        super().setUp()
        self.mesh = winslow.read(ASSETS / "coarse" / "three_element.su2")

    def test_like_single_motions(self):
        steps = winslow.sweep(self.mesh, "flap", rotate=[-10, -5, 5], pivot=(0.86, -0.02))
        self.assertEqual([step.status for step in steps], ["done"] * 3)
        for step, angle in zip(steps, (-10, -5, 5)):
            single = winslow.move(self.mesh, "flap", rotate=angle, pivot=(0.86, -0.02))
            np.testing.assert_allclose(step.mesh.points, single.mesh.points, atol=1e-8)
            self.assertEqual(step.bodies[0]["rotate"], angle)

    def test_jobs_give_the_same_bits(self):
        one = winslow.sweep(self.mesh, "flap", rotate=[-4, -2, 2, 4])
        two = winslow.sweep(self.mesh, "flap", rotate=[-4, -2, 2, 4], jobs=2)
        for a, b in zip(one, two):
            self.assert_same(a.mesh.points, b.mesh.points)

    def test_combinations_and_steps(self):
        steps = winslow.sweep(self.mesh, "flap", rotate=[0, -2], translate=[(0, 0), (0.001, 0)], keep=False)
        self.assertEqual([(s.bodies[0]["rotate"], tuple(s.bodies[0]["translate"])) for s in steps],
                         [(0, (0, 0)), (-2, (0, 0)), (0, (0.001, 0)), (-2, (0.001, 0))])
        self.assertEqual([step.mesh for step in steps], [None] * 4)
        own = winslow.sweep(self.mesh, steps=[{"markers": "flap", "rotate": -1},
                                              [{"markers": "flap", "rotate": -1}, {"markers": "slat", "rotate": 1}]])
        self.assertEqual([step.status for step in own], ["done", "done"])

    def test_a_step_that_fails(self):
        steps = winslow.sweep(self.mesh, "flap", translate=[(0.001, 0), (500, 0)])
        self.assertEqual([step.status for step in steps], ["done", "incomplete"])
        self.assertTrue(steps[1].message)

    def test_on_step(self):
        seen = []
        steps = winslow.sweep(self.mesh, "flap", rotate=[-1, -2], on_step=seen.append)
        self.assertEqual(sorted(step.step for step in seen), [0, 1])
        self.assertIs(steps[0].mesh, next(s for s in seen if s.step == 0).mesh)
        with self.assertRaises(winslow.Cancelled):
            winslow.sweep(self.mesh, "flap", rotate=range(-9, 0), on_step=lambda step: False)
        with self.assertRaises(ZeroDivisionError):
            winslow.sweep(self.mesh, "flap", rotate=range(-9, 0), on_step=lambda step: 1 / 0)

    def test_wrong_use(self):
        for call, text in ((lambda: winslow.sweep(self.mesh, "flap"), "nothing to do"),
                           (lambda: winslow.sweep(self.mesh, rotate=[1]), "nothing to move"),
                           (lambda: winslow.sweep(self.mesh, "flap", rotate=[]), "found none"),
                           (lambda: winslow.sweep(self.mesh, "flp", rotate=[1]), "did you mean flap"),
                           (lambda: winslow.sweep(self.mesh, "flap", rotate=[1], progress=print), "on_step"),
                           (lambda: winslow.sweep(self.mesh, steps=[{"markers": "flap"}]), "step 0: bodies"),
                           (lambda: winslow.sweep(self.mesh, "flap", rotate=[1], jobs=-1), "jobs")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


if __name__ == "__main__":
    main()
