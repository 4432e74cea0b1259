"""A mesh as a participant of a coupled simulation by preCICE (precice.org), with the names of its versions 2 and 3.

    import precice
    from winslow.coupling import CoupledMesh

    deformer = winslow.Deformer(mesh, "flap")
    coupling = CoupledMesh(deformer, precice.Participant("Fluid", "precice-config.xml", 0, 1),
                           "Fluid-Mesh", "Displacement", "Force")
    coupling.initialize()
    while coupling.is_coupling_ongoing():
        if coupling.requires_writing_checkpoint():
            kept = flow.copy()
        dt = coupling.get_max_time_step_size()
        points = coupling.move(dt)
        forces = flow.solve(points, coupling.velocities, dt)     # a row for each node of deformer.nodes
        coupling.advance(dt, forces)
        if coupling.requires_reading_checkpoint():
            flow = kept
    coupling.finalize()

The names are those of version 3 of preCICE's Python bindings (`precice.Participant`). An object of version 2
(`precice.Interface`) is accepted too. This module imports no precice: it calls the object that it is given.
"""

import numpy as np

from .errors import UsageError


class CoupledMesh:
    """A Deformer whose boundary gets its displacements from a coupling.

    Where preCICE repeats a time window, the deformer goes back to its checkpoint: the same displacements give the
    same mesh, bit for bit.

    Attributes
    ----------
    deformer : Deformer
    velocities : numpy.ndarray (n, dimension) or None
        Of all nodes in the last `move`: the way since the mesh before, divided by dt, as the geometric conservation
        law of first order wants it.
    """

    def __init__(self, deformer, participant, mesh_name, displacements="Displacement", forces=None, *, tolerance=None):
        """Connect a mesh.

        Parameters
        ----------
        deformer : Deformer
            Its `nodes`, at their places in the mesh as given, are the vertices of the coupling mesh.
        participant : precice.Participant or precice.Interface
            Of preCICE 3 or 2; not yet initialized.
        mesh_name : str
            The mesh of the configuration that this participant provides.
        displacements : str
            Data that is read: vectors from the mesh as given, at the vertices.
        forces : str, optional
            Data that is written by `advance`.
        tolerance : float, optional
            As of `Deformer.step`.
        """
        if len(deformer.nodes) == 0:
            raise UsageError("the deformer has no nodes to couple: make it with markers")
        self.deformer, self.velocities = deformer, None
        self._participant = _Version2(participant) if hasattr(participant, "read_block_vector_data") else participant
        if not hasattr(self._participant, "read_data"):
            raise UsageError(f"found {type(participant).__name__}, expected a Participant or Interface of preCICE")
        self._mesh, self._displacements, self._forces, self._tolerance = mesh_name, displacements, forces, tolerance
        self._start = deformer.given.points[deformer.nodes]
        dimension = self._participant.get_mesh_dimensions(mesh_name)
        if dimension != self._start.shape[1]:
            raise UsageError(f"the coupling has {dimension} dimensions, the mesh {self._start.shape[1]}")
        self._vertices = self._participant.set_mesh_vertices(mesh_name, self._start)
        self._checkpoint = None

    def initialize(self, forces=None):
        """Start the coupling. forces: those at the begin, where the configuration asks for them; None: zero."""
        if self._participant.requires_initial_data() and self._forces:
            self._write(np.zeros_like(self._start) if forces is None else forces)
        self._participant.initialize()

    def is_coupling_ongoing(self):
        """Whether there is a time step to do."""
        return self._participant.is_coupling_ongoing()

    def is_time_window_complete(self):
        """Whether the last `advance` ended a time window."""
        return self._participant.is_time_window_complete()

    def get_max_time_step_size(self):
        """The longest time step that is allowed now."""
        return self._participant.get_max_time_step_size()

    def requires_writing_checkpoint(self):
        """Whether the caller has to save its state now. The mesh is saved by this call."""
        required = self._participant.requires_writing_checkpoint()
        if required:
            self._checkpoint = self.deformer.checkpoint()
        return required

    def requires_reading_checkpoint(self):
        """Whether the caller has to go back to what it saved. The mesh goes back by this call."""
        required = self._participant.requires_reading_checkpoint()
        if required:
            if self._checkpoint is None:
                raise UsageError("the coupling goes back to a checkpoint that was not written: call "
                                 "requires_writing_checkpoint() at the begin of every time step")
            self.deformer.restore(self._checkpoint)
        return required

    def move(self, dt):
        """Read the displacements at the end of a time step and take the mesh there.

        Parameters
        ----------
        dt : float
            The time step.

        Returns
        -------
        numpy.ndarray (n, dimension)
            The coordinates: a read-only view.

        Raises
        ------
        IncompleteMotion
            No valid mesh has this boundary; the mesh is that of the step before.
        """
        if not dt > 0:
            raise UsageError(f"dt: found {dt}, expected more than 0")
        read = np.asarray(self._participant.read_data(self._mesh, self._displacements, self._vertices, dt))
        if read.shape != self._start.shape:
            raise UsageError(f"{self._displacements}: found an array of shape {read.shape}, expected "
                             f"{self._start.shape}")
        if not np.isfinite(read).all():
            row = int(np.argwhere(~np.isfinite(read))[0][0])
            raise UsageError(f"{self._displacements}: not finite at node {self.deformer.nodes[row]}")
        self.deformer.set_boundary(self._start + read)
        self.deformer.step(self._tolerance)
        self.velocities = self.deformer.displacement() / dt
        return self.deformer.points

    def advance(self, dt, forces=None):
        """Write the forces, a row for each node of `deformer.nodes`, and end the time step."""
        if self._forces:
            if forces is None:
                raise UsageError(f"expected forces for {self._forces}")
            self._write(forces)
        elif forces is not None:
            raise UsageError("found forces, but no name of the data that they are")
        self._participant.advance(dt)

    def finalize(self):
        """End the coupling."""
        self._participant.finalize()

    def run(self, solve, *, save=None, load=None, on_window=None):
        """The whole loop of the coupling.

        Parameters
        ----------
        solve : callable
            solve(points, velocities, dt) returns the forces, or None where none are written.
        save, load : callable, optional
            save() returns the state of the flow, load(state) goes back to it: needed by implicit couplings.
        on_window : callable, optional
            on_window(deformer) is called at the end of each time window.
        """
        self.initialize()
        kept = None
        while self.is_coupling_ongoing():
            if self.requires_writing_checkpoint() and save is not None:
                kept = save()
            dt = self.get_max_time_step_size()
            self.advance(dt, solve(self.move(dt), self.velocities, dt))
            if self.requires_reading_checkpoint():
                if load is not None:
                    load(kept)
            elif on_window is not None and self.is_time_window_complete():
                on_window(self.deformer)
        self.finalize()

    def _write(self, forces):
        rows = np.ascontiguousarray(forces, dtype=float)
        if rows.shape != self._start.shape:
            raise UsageError(f"forces: found an array of shape {rows.shape}, expected {self._start.shape}")
        self._participant.write_data(self._mesh, self._forces, self._vertices, rows)


class _Version2:
    """precice.Interface of version 2 with the names of version 3."""

    def __init__(self, interface):
        self._of, self._dt, self._first = interface, None, []  # _first: written before initialize()
        self.is_coupling_ongoing, self.finalize = interface.is_coupling_ongoing, interface.finalize
        self.is_time_window_complete = interface.is_time_window_complete

    def get_mesh_dimensions(self, mesh):
        return self._of.get_dimensions()

    def set_mesh_vertices(self, mesh, positions):
        return self._of.set_mesh_vertices(self._of.get_mesh_id(mesh), positions)

    def requires_initial_data(self):
        # Version 2 says this only after initialize(), which its initialize_data() follows.
        return True

    def initialize(self):
        self._dt = self._of.initialize()
        if self._required("write-initial-data"):
            for mesh, data, vertices, values in self._first:
                self._put(mesh, data, vertices, values)
            self._of.mark_action_fulfilled("write-initial-data")
        self._of.initialize_data()

    def get_max_time_step_size(self):
        return self._dt

    def requires_writing_checkpoint(self):
        return self._fulfilled("write-iteration-checkpoint")

    def requires_reading_checkpoint(self):
        return self._fulfilled("read-iteration-checkpoint")

    def read_data(self, mesh, data, vertices, relative_time):
        # Data of version 2 is of the end of the time window.
        return self._of.read_block_vector_data(self._of.get_data_id(data, self._of.get_mesh_id(mesh)), vertices)

    def write_data(self, mesh, data, vertices, values):
        if self._dt is None:
            self._first.append((mesh, data, vertices, values))
        else:
            self._put(mesh, data, vertices, values)

    def advance(self, dt):
        self._dt = self._of.advance(dt)

    def _put(self, mesh, data, vertices, values):
        self._of.write_block_vector_data(self._of.get_data_id(data, self._of.get_mesh_id(mesh)), vertices, values)

    def _required(self, action):
        return self._of.is_action_required(action)

    def _fulfilled(self, action):
        required = self._required(action)
        if required:
            self._of.mark_action_fulfilled(action)
        return required
