"""CoupledMesh against stand-ins of preCICE, which Debian does not have: versions 3 and 2 of its Python bindings."""

import numpy as np

import winslow
from winslow.coupling import CoupledMesh
from support import PackageTest, main, ring

WINDOWS, DT = 4, 0.1


class Script:
    """What both stand-ins share: an implicit coupling that does each time window `repeats` times, and checks the
    order of the calls as preCICE does."""

    def __init__(self, displacement, repeats=3, dimension=2):
        self.displacement, self.repeats, self.dimension = displacement, repeats, dimension
        self.window, self.iteration, self.started, self.ended = 0, 0, False, False
        self.written, self.initial, self.owed = [], None, set()

    def vertices(self, mesh, positions):
        assert mesh == "Fluid-Mesh" and not self.started
        self.positions = np.array(positions)
        return np.arange(len(positions)) + 7

    def start(self):
        self.started = True
        self.owe()

    def owe(self):
        if self.repeats > 1 and self.iteration == 0 and self.window < WINDOWS:
            self.owed.add("write-iteration-checkpoint")

    def asked(self, action):
        asked = action in self.owed
        self.owed.discard(action)
        return asked

    def read(self, vertices):
        assert self.started and vertices[0] == 7
        return self.displacement(self.positions, self.window, self.iteration)

    def write(self, vertices, values):
        assert len(vertices) == len(values)
        if self.started:
            self.written.append((self.window, self.iteration, np.array(values)))
        else:
            self.initial = np.array(values)

    def go_on(self, dt):
        assert not self.owed, f"not asked for: {self.owed}"
        assert dt == DT
        self.iteration += 1
        if self.iteration < self.repeats:
            self.owed.add("read-iteration-checkpoint")
        else:
            self.window, self.iteration = self.window + 1, 0
            self.owe()


class Version3:
    def __init__(self, script):
        self.script = script

    def get_mesh_dimensions(self, mesh):
        return self.script.dimension

    def set_mesh_vertices(self, mesh, positions):
        return self.script.vertices(mesh, positions)

    def requires_initial_data(self):
        return True

    def initialize(self):
        self.script.start()

    def is_coupling_ongoing(self):
        return self.script.window < WINDOWS

    def is_time_window_complete(self):
        return self.script.iteration == 0

    def get_max_time_step_size(self):
        return DT

    def requires_writing_checkpoint(self):
        return self.script.asked("write-iteration-checkpoint")

    def requires_reading_checkpoint(self):
        return self.script.asked("read-iteration-checkpoint")

    def read_data(self, mesh, data, vertices, relative_read_time):
        assert (mesh, data, relative_read_time) == ("Fluid-Mesh", "Displacement", DT)
        return self.script.read(vertices)

    def write_data(self, mesh, data, vertices, values):
        assert (mesh, data) == ("Fluid-Mesh", "Force")
        self.script.write(vertices, values)

    def advance(self, dt):
        self.script.go_on(dt)

    def finalize(self):
        self.script.ended = True


class Version2:
    def __init__(self, script):
        self.script, self.open = script, {"write-initial-data"}

    def get_dimensions(self):
        return self.script.dimension

    def get_mesh_id(self, name):
        return {"Fluid-Mesh": 3}[name]

    def get_data_id(self, name, mesh):
        return {("Displacement", 3): 11, ("Force", 3): 12}[name, mesh]

    def set_mesh_vertices(self, mesh, positions):
        assert mesh == 3
        return self.script.vertices("Fluid-Mesh", positions)

    def initialize(self):
        return DT

    def initialize_data(self):
        assert not self.open
        self.script.start()

    def is_action_required(self, action):
        return action in self.open or action in self.script.owed

    def mark_action_fulfilled(self, action):
        self.open.discard(action)
        self.script.owed.discard(action)

    def is_coupling_ongoing(self):
        return self.script.window < WINDOWS

    def is_time_window_complete(self):
        return self.script.iteration == 0

    def read_block_vector_data(self, data, vertices):
        assert data == 11
        return self.script.read(vertices)

    def write_block_vector_data(self, data, vertices, values):
        assert data == 12
        self.script.write(vertices, values)

    def advance(self, dt):
        self.script.go_on(dt)
        return DT

    def finalize(self):
        self.script.ended = True


def same_in_a_window(positions, window, iteration):
    """Displacements that do not change while a window is repeated."""
    return 0.03 * (window + 1) * np.cos(2 * positions[:, ::-1])


def converging(positions, window, iteration):
    """Displacements that change while a window is repeated."""
    return same_in_a_window(positions, window, iteration) * (1 + 0.5 ** (iteration + 1))


class Coupling(PackageTest):
    def setUp(self):
        super().setUp()
        self.mesh = ring()

    def deformer(self):
        return winslow.Deformer(self.mesh, "body", threads=1)

    def run_with(self, participant, tolerance=1e-6):
        """All meshes and velocities of a coupling, and the state of a flow that is saved and loaded."""
        coupling = CoupledMesh(self.deformer(), participant, "Fluid-Mesh", "Displacement", "Force", tolerance=tolerance)
        flow, out = {"time": 0.0}, []

        def solve(points, velocities, dt):
            out.append((participant.script.window, participant.script.iteration, points, velocities))
            flow["time"] += dt
            return points[coupling.deformer.nodes] * flow["time"]

        coupling.run(solve, save=lambda: dict(flow), load=flow.update,
                     on_window=lambda deformer: out.append(("window", deformer.points)))
        return coupling, out, flow

    def test_repeats_to_the_bit(self):
        for version in (Version3, Version2):
            with self.subTest(version.__name__):
                script = Script(same_in_a_window)
                _, out, flow = self.run_with(version(script))
                steps = [row for row in out if row[0] != "window"]
                self.assertEqual([row[:2] for row in steps], [(w, i) for w in range(WINDOWS) for i in range(3)])
                for window in range(WINDOWS):
                    first, *others = steps[3 * window:3 * window + 3]
                    for other in others:
                        self.assert_same(other[2], first[2])
                        self.assert_same(other[3], first[3])
                self.assertAlmostEqual(flow["time"], WINDOWS * DT)
                self.assertEqual(len(out) - len(steps), WINDOWS)
                self.assertTrue(script.ended)
                self.assertEqual(script.initial.shape, (24, 2))
                self.assertEqual(abs(script.initial).max(), 0)
                self.assertEqual([row[:2] for row in script.written], [row[:2] for row in steps])
                for (_, _, values), (window, _, points, _) in zip(script.written, steps):
                    expected = points[self.mesh.markers["body"]] * DT * (window + 1)
                    np.testing.assert_allclose(values, expected, rtol=1e-12)

    def test_like_a_loop_without_repeats(self):
        """The last repeats of all windows give the meshes of a deformer that sees nothing else."""
        _, out, _ = self.run_with(Version3(Script(converging)))
        last = [row for row in out if row[0] != "window" and row[1] == 2]
        deformer = self.deformer()
        start = self.mesh.points[deformer.nodes]
        for window, row in enumerate(last):
            deformer.checkpoint()  # prepares solvers anew, as that of the coupling
            deformer.set_boundary(start + converging(start, window, 2))
            deformer.step(1e-6)
            self.assert_same(row[2], deformer.points)
            self.assert_same(row[3], deformer.displacement() / DT)

    def test_explicit(self):
        script = Script(same_in_a_window, repeats=1)
        _, out, _ = self.run_with(Version3(script))
        self.assertEqual(len([row for row in out if row[0] != "window"]), WINDOWS)

    def test_no_valid_mesh(self):
        coupling = CoupledMesh(self.deformer(), Version3(Script(lambda p, w, i: p * 0 + 50)), "Fluid-Mesh")
        coupling.initialize()
        with self.assertRaises(winslow.IncompleteMotion):
            coupling.move(DT)
        self.assert_same(coupling.deformer.points, self.mesh.points)

    def test_wrong_use(self):
        def coupled(displacement, forces=None):
            coupling = CoupledMesh(self.deformer(), Version3(Script(displacement)), "Fluid-Mesh", forces=forces)
            coupling.initialize()
            return coupling

        def without_checkpoint():
            coupling = coupled(same_in_a_window)
            coupling._participant.requires_writing_checkpoint()
            coupling.move(DT)
            coupling.advance(DT)
            coupling.requires_reading_checkpoint()

        other = Version3(Script(converging, dimension=3))
        for call, text in ((lambda: CoupledMesh(winslow.Deformer(self.mesh), other, "Fluid-Mesh"), "markers"),
                           (lambda: CoupledMesh(self.deformer(), object(), "Fluid-Mesh"), "Participant"),
                           (lambda: CoupledMesh(self.deformer(), other, "Fluid-Mesh"), "3 dimensions"),
                           (lambda: coupled(lambda p, w, i: p[:3]).move(DT), "shape"),
                           (lambda: coupled(lambda p, w, i: p * np.nan).move(DT), "not finite at node 0"),
                           (lambda: coupled(converging).move(0), "dt"),
                           (lambda: coupled(converging, "Force").advance(DT), "expected forces"),
                           (lambda: coupled(converging).advance(DT, [1]), "no name"),
                           (lambda: coupled(converging, "Force").advance(DT, [1]), "shape"),
                           (without_checkpoint, "not written")):
            with self.subTest(text):
                with self.assertRaisesRegex(winslow.UsageError, text):
                    call()


if __name__ == "__main__":
    main()
