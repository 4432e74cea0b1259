"""No leak: 10,000 calls of all kinds, by Python's own count of its memory and by the process's.

Under AddressSanitizer (preset asan), which keeps memory that was freed for a while, its own count of leaks
takes the place of the process's: of few calls and of many it has to be the same.
"""

import gc
import os
import re
import resource
import subprocess
import sys
import threading
import tracemalloc
import unittest

import numpy as np

import winslow
from support import PackageTest, main, ring

CALLS = int(os.environ.get("WINSLOW_LEAK_CALLS", "10000"))
SANITIZED = "WINSLOW_SANITIZED" in os.environ


def resident():
    """Bytes of the resident set."""
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


def session(mesh):
    """Two steps of a session, and what is asked of it."""
    deformer = winslow.Deformer(mesh, "body", threads=1)
    for angle in (1, 2):
        deformer.set_motion(rotate=angle)
        deformer.step(1e-4, progress=lambda record: record.residual)
    deformer.restore(deformer.checkpoint())
    return deformer.points, deformer.displacement(), deformer.sensitivity().transpose(mesh.points)


class Leaks(PackageTest):
    def calls(self):
        """One round of calls of all kinds; returns how many."""
        mesh = ring(around=8, rings=2)
        points = mesh.copy_points()
        for call in (lambda: mesh.points.sum(), lambda: mesh.with_points(points).points.base.markers,
                     lambda: winslow.Mesh(points, mesh.cells, {"body": mesh.faces["body"]}),
                     lambda: (mesh.cells, mesh.faces, mesh.regions, repr(mesh)),
                     lambda: winslow.values(mesh, "aspect_ratio"),
                     lambda: winslow.move(mesh, "body", rotate=1, threads=1, progress=lambda r: r.residual).history,
                     lambda: winslow.quality(mesh, threads=1), lambda: mesh.to_meshio(), lambda: session(mesh)):
            call()
        for call in (lambda: winslow.move(mesh, "body", rotat=1), lambda: winslow.move(mesh, "bdy", rotate=1),
                     lambda: mesh.with_points(points[:3]), lambda: winslow.read(self.folder / "none.su2"),
                     lambda: winslow.move(mesh, "body", rotate=1, threads=1, progress=lambda record: 1 / 0),
                     lambda: winslow.Mesh(points, {"triangle": [[0, 1, 99]]})):
            try:
                call()
            except (winslow.Error, ZeroDivisionError):
                pass
        return 15

    @unittest.skipIf(SANITIZED, "the sanitizer keeps what is freed")
    def test_ten_thousand_calls(self):
        rounds = max(CALLS // 15, 10)
        for _ in range(rounds // 5):
            self.calls()
        gc.collect()
        before = resident()
        made = sum(self.calls() for _ in range(rounds))
        gc.collect()
        grown = resident() - before
        self.assertGreaterEqual(made, min(CALLS, 150) - 15)
        self.assertLess(grown, 4 << 20, f"{made} calls: {grown} bytes")

    def test_objects_of_python(self):
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        counts = []
        for rounds in (300, 1000):  # tables of strings and the like fill up at first
            for _ in range(rounds):
                self.calls()
            gc.collect()
            counts.append(tracemalloc.get_traced_memory()[0])
        self.assertLess(counts[1] - counts[0], 60000, "more than 60 bytes for each round of calls")

    @unittest.skipUnless(SANITIZED, "for a sanitized build")
    def test_calls_under_the_sanitizer(self):
        leaked = [self.leaked(rounds) for rounds in (20, CALLS // 15)]
        self.assertLess(leaked[1] - leaked[0], 20000, f"bytes leaked by few and by many calls: {leaked}")

    def leaked(self, rounds):
        """Bytes that the sanitizer counts at the end of a process that makes so many rounds of calls."""
        options = os.environ.get("ASAN_OPTIONS", "").replace("detect_leaks=0", "detect_leaks=1")
        run = subprocess.run([sys.executable, "-B", __file__, "--rounds", str(rounds)], capture_output=True, text=True,
                             check=False, env={**os.environ, "ASAN_OPTIONS": options, "LSAN_OPTIONS": "exitcode=0",
                                               "PYTHONMALLOC": "malloc"})
        if "LeakSanitizer has encountered a fatal error" in run.stderr:
            self.skipTest("the leak sanitizer cannot look at the memory of a process here")
        self.assertEqual(run.returncode, 0, run.stderr[-3000:])
        found = re.search(r"SUMMARY: AddressSanitizer: (\d+) byte", run.stderr)
        return int(found[1]) if found else 0

    @unittest.skipIf(SANITIZED, "the sanitizer keeps what is freed")
    def test_a_large_array_is_freed(self):
        mesh = ring(around=600, rings=200)  # 2 MB of coordinates
        for _ in range(5):
            mesh.with_points(mesh.points)
        before = resident()
        for _ in range(200):
            mesh.with_points(mesh.points).copy_points()
        self.assertLess(resident() - before, 16 << 20)

    def test_arrays_outlive_threads(self):
        found = []
        thread = threading.Thread(target=lambda: found.append(winslow.move(ring(), "body", rotate=5).mesh.points))
        thread.start()
        thread.join()
        self.assertTrue(np.isfinite(found[0]).all())


def make_rounds(count):
    """What a process of its own does under the sanitizer."""
    case = Leaks("calls")
    case.setUp()
    for _ in range(count):
        case.calls()
    case.doCleanups()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--rounds"]:
        make_rounds(int(sys.argv[2]))
    else:
        main()
