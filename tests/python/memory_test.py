"""No leak: 10,000 calls of all kinds, by Python's own count of its memory and by the process's.

Under AddressSanitizer: build with the preset asan; ctest loads the sanitizer before the interpreter.
"""

import gc
import os
import resource
import threading
import tracemalloc

import numpy as np

import winslow
from support import PackageTest, main, ring

CALLS = int(os.environ.get("WINSLOW_LEAK_CALLS", "10000"))


def resident():
    """Bytes of the resident set."""
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


class Leaks(PackageTest):
    def calls(self):
        """One round of calls; returns how many."""
        mesh = ring(around=8, rings=2)
        points = mesh.copy_points()
        for call in (lambda: mesh.points.sum(), lambda: mesh.with_points(points).points.base.markers,
                     lambda: winslow.Mesh(points, mesh.cells, {"body": mesh.faces["body"]}),
                     lambda: (mesh.cells, mesh.faces, mesh.regions, repr(mesh)),
                     lambda: winslow.values(mesh, "aspect_ratio"),
                     lambda: winslow.move(mesh, "body", rotate=1, threads=1, progress=lambda r: r.residual).history,
                     lambda: winslow.quality(mesh, threads=1), lambda: mesh.to_meshio()):
            call()
        for call in (lambda: winslow.move(mesh, "body", rotat=1), lambda: winslow.move(mesh, "bdy", rotate=1),
                     lambda: mesh.with_points(points[:3]), lambda: winslow.read(self.folder / "none.su2"),
                     lambda: winslow.move(mesh, "body", rotate=1, threads=1, progress=lambda record: 1 / 0),
                     lambda: winslow.Mesh(points, {"triangle": [[0, 1, 99]]})):
            try:
                call()
            except (winslow.Error, ZeroDivisionError):
                pass
        return 14

    def test_ten_thousand_calls(self):
        rounds = max(CALLS // 14, 10)
        for _ in range(rounds // 5):
            self.calls()
        gc.collect()
        before = resident()
        made = sum(self.calls() for _ in range(rounds))
        gc.collect()
        grown = resident() - before
        self.assertGreaterEqual(made, min(CALLS, 140) - 14)
        self.assertLess(grown, 4 << 20, f"{made} calls: {grown} bytes")

    def test_objects_of_python(self):
        for _ in range(20):
            self.calls()
        gc.collect()
        tracemalloc.start()
        self.addCleanup(tracemalloc.stop)
        self.calls()
        gc.collect()
        before = tracemalloc.get_traced_memory()[0]
        for _ in range(100):
            self.calls()
        gc.collect()
        self.assertLess(tracemalloc.get_traced_memory()[0] - before, 50000)

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


if __name__ == "__main__":
    main()
