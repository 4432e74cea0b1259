"""A mesh whose boundary moves many times: time loops, couplings, shape optimisation."""

import os

from . import _winslow
from .derivatives import Sensitivity
from .errors import UsageError
from .foreign import as_mesh
from .results import checked
from .tables import documented


class Deformer:
    """A mesh whose boundary moves many times, each step starting from those before it.

    Every boundary refers to the mesh as given, and the meshes depend on the boundary alone, not on the way
    to it. A step predicts its mesh from earlier ones and corrects it, with targets, orderings and
    hierarchies reused: about one linear solve for a small step.

        deformer = winslow.Deformer(mesh, "flap")
        for time in times:
            deformer.set_motion(rotate=10 * math.sin(time), pivot=(0.86, -0.02))
            points = deformer.step(1e-4).mesh.points
            flow.advance(points, deformer.displacement() / dt)

    One call at a time; several deformers may work in several threads at once. A call that raises changes
    nothing.
    """

    @documented("deformer", """Raises
------
UsageError
    An unknown option or marker, one out of range, or one that does not suit the mesh.
InputError
    A file that an option names cannot be read.""")
    def __init__(self, mesh, markers=None, **options):
        """Prepare a mesh for many motions.

        Parameters
        ----------
        mesh : Mesh
            The mesh to which all boundaries refer. Or a file, a mesh of meshio or pyvista, or
            (points, cells, cell_sets).
        markers : str or sequence of str
            What moves as a rule: `nodes` are the nodes of these. None: each call says what moves.
        """
        if options.get("reference") is not None:
            options["reference"] = as_mesh(options["reference"])
        if options.get("config") is not None:
            options["config"] = os.fspath(options["config"])
        self._of = _winslow.Session(as_mesh(mesh), markers, options)
        self._nodes = self._of.nodes

    @property
    def markers(self):
        """What moves as a rule: a list of str."""
        return self._of.markers

    @property
    def remarks(self):
        """What the file says of its boundary and the steps take over: a list of str."""
        return self._of.remarks

    @property
    def nodes(self):
        """The nodes of `markers`, ascending: (k,) int32, read-only. `set_boundary` takes rows for these."""
        return self._nodes

    @property
    def given(self):
        """The mesh to which all boundaries refer."""
        return self._of.given

    @property
    def mesh(self):
        """The mesh of the last complete step; before the first one, that given."""
        return self._of.mesh

    @property
    def points(self):
        """The coordinates of the last complete step: (n, dimension) float64.

        A read-only view without a copy. It keeps its numbers when the deformer goes on.
        """
        return self._of.points

    def set_boundary(self, places, nodes=None):
        """Say where nodes of the boundary go; all others are where they are in the mesh as given, or slide.

        Parameters
        ----------
        places : array_like (k, dimension) or (n, dimension)
            Where the nodes go, to the bit: a row for each of `nodes`, or for each node of the mesh, of which
            those of `nodes` are taken.
        nodes : array_like (k,), optional
            Ids of the nodes; None: `Deformer.nodes`.
        """
        self._of.set_boundary(places, nodes)

    def set_motion(self, markers=None, *, bodies=None, **motion):
        """Move bodies rigidly from where they are in the mesh as given.

        Parameters
        ----------
        markers : str or sequence of str, optional
            The body; None: the markers of the deformer.
        bodies : sequence of dict, optional
            In place of `markers`: several bodies, each a dict with markers, rotate, translate, pivot, axis.
        rotate : float
            Angle in degrees.
        translate, pivot, axis : array_like
            Shift, centre of the rotation (None: the body's own) and, in space, its axis.
        """
        self._of.set_motion(markers, bodies, motion)

    def set_sine(self, markers=None, **sine):
        """Bend bodies by a sine wave.

        Parameters
        ----------
        markers : str or sequence of str, optional
            The bodies; None: the markers of the deformer.
        **sine
            amplitude, waves, direction, along, fade, fade_length: as of `deform`.
        """
        self._of.set_sine(markers, sine)

    def step(self, tolerance=None, *, progress=None, allow_incomplete=False):
        """Take the mesh to the boundary that was set.

        Parameters
        ----------
        tolerance : float, optional
            Of the largest scaled residual: about how far a node is from its place in the solution, as a
            share of its edges. Errors do not add up, so that 1e-4 is enough for a flow solver. None: that of
            the options, 1e-10.
        progress : callable, optional
            Called with each Iteration; returning False cancels, an exception ends the step and propagates.
        allow_incomplete : bool
            Return the last valid mesh on the way instead of raising.

        Returns
        -------
        Result

        Raises
        ------
        IncompleteMotion
            No valid mesh has this boundary; has the last one on the way as `result`. The deformer stays at
            the step before.
        UsageError, Cancelled, NumericError
            No boundary was set; the callback said so; no solution was found.
        """
        if tolerance is not None and not 0 < tolerance < 1:
            raise UsageError(f"tolerance: found {tolerance}, expected more than 0, less than 1")
        return checked("a step", self._of.step(tolerance or 0.0, progress), False, allow_incomplete)

    def displacement(self):
        """How far each node went in the last complete step: (n, dimension).

        Divided by the time step it is the mesh velocity that fulfils the geometric conservation law of first
        order in time.
        """
        return self._of.displacement()

    def sensitivity(self):
        """The derivative of the present mesh by its boundary: a `Sensitivity`, which outlives the next step."""
        return Sensitivity._wrap(self._of.sensitivity())

    def velocities(self, boundary, nodes=None):
        """The velocities of all nodes if those of the boundary move at given ones, from one linear solve.

        Parameters
        ----------
        boundary : array_like (k, dimension) or (n, dimension)
            A row for each of `nodes`, the rest of the boundary at rest; or for all nodes of the mesh, of which
            those of the boundary are read.
        nodes : array_like (k,), optional
            Ids of the nodes; None: `Deformer.nodes`.

        Returns
        -------
        numpy.ndarray (n, dimension)
        """
        return self._of.velocities(boundary, nodes)

    def largest_valid(self, places, nodes=None):
        """The largest share, 0 to 1, of the way of the boundary to these places with a valid mesh, to first
        order: a bound for the next time step, from one linear solve. `step` goes farther where it can.

        Parameters
        ----------
        places, nodes
            As of `set_boundary`.
        """
        return self._of.largest_valid(places, nodes)

    def checkpoint(self):
        """All that the next steps depend on, for `restore`."""
        return self._of.checkpoint()

    def restore(self, checkpoint):
        """Go back to a checkpoint of this deformer: the same steps give the same bits again."""
        if not isinstance(checkpoint, _winslow.Checkpoint):
            raise UsageError(f"found {type(checkpoint).__name__}, expected what checkpoint() returned")
        self._of.restore(checkpoint)

    def __repr__(self):
        what = ", ".join(self.markers) or "any marker"
        return f"<winslow.Deformer of {what}: {self.given!r}>"
