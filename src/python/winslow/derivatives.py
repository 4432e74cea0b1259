"""How a moved mesh depends on its boundary."""

import os

from . import _winslow
from .files import say
from .foreign import as_mesh
from .tables import documented


class Sensitivity:
    """The derivative dX/dB of the nodes X of a moved mesh by those of its boundary B.

    One linear solve for each product; docs/sensitivity.md has the equations and what is held constant.

        result = winslow.move(mesh, "flap", rotate=-10, pivot=(0.8, 0))
        sensitivity = winslow.Sensitivity(mesh, result.mesh, "flap")
        on_boundary = sensitivity.transpose(dJ_dX)                # (n, dimension), zero inside
        per_degree = (on_boundary * sensitivity.velocities("rotate", pivot=(0.8, 0))).sum()

    Attributes
    ----------
    mesh : Mesh
        The mesh at which the derivative is: `moved`, solved to 1e-10.
    boundary : numpy.ndarray (b,) int32
        The nodes on which all others depend, ascending.
    distance : float
        How far a node of `mesh` is from its place in `moved` at most, as a share of its edges. More
        than about 0.01: the motion was not converged, or had other options.
    frozen : dict
        What is held constant although the mesh may depend on it: knee, stuck_nodes.
    solver : str
        The linear solver.
    """

    @documented("sensitivity", """Raises
------
UsageError
    Options that minimise no energy, held layers, a boundary that lies elsewhere than the motion takes it.
NumericError
    No solution is found near `moved`.""")
    def __init__(self, mesh, moved, markers, **options):
        """Prepare the derivative of a moved mesh.

        Parameters
        ----------
        mesh : Mesh
            Before the motion.
        moved : Mesh or array_like (n, dimension)
            After the motion, of the same connectivity.
        markers : str or sequence of str
            What moved.
        """
        mesh = as_mesh(mesh)
        if not isinstance(moved, _winslow.Mesh):
            moved = mesh.with_points(moved) if hasattr(moved, "shape") or isinstance(moved, list) else as_mesh(moved)
        if options.get("config") is not None:
            options["config"] = os.fspath(options["config"])
        self._take(_winslow.Sensitivity(mesh, moved, markers, options))
        if self.distance > 0.01:
            say([f"a node is {self.distance:.2g} of its edges from the solution of the motion, where the derivative "
                 "is: the motion was not converged, or had other options"])

    def _take(self, of):
        self._of, self.mesh, self.boundary, self.distance = of, of.mesh, of.boundary, of.distance
        self.frozen, self.solver = of.frozen, of.solver

    @classmethod
    def _wrap(cls, of):
        """The derivative that a session has made."""
        sensitivity = cls.__new__(cls)
        sensitivity._take(of)
        return sensitivity

    def forward(self, velocities):
        """dX/dB dB: the velocities of all nodes from those of the boundary.

        Parameters
        ----------
        velocities : array_like (n, dimension) or (b, dimension)
            Of all nodes, of which those of `boundary` are read; or of `boundary` alone.

        Returns
        -------
        numpy.ndarray (n, dimension)
        """
        return self._of.forward(velocities)

    def transpose(self, derivative):
        """(dX/dB)^T dJ/dX: the derivative of a function by the boundary from that by all nodes.

        Parameters
        ----------
        derivative : array_like (n, dimension)
            dJ/dX.

        Returns
        -------
        numpy.ndarray (n, dimension)
            Zero at nodes that are not of `boundary`.
        """
        return self._of.transpose(derivative)

    def velocities(self, parameter, markers=None, *, pivot=None, axis=None):
        """Velocities of the nodes of a body by a number of its motion.

        Parameters
        ----------
        parameter : str
            "rotate" (per degree), "translate_x", "translate_y" or "translate_z".
        markers : str or sequence of str, optional
            The body; None: all that moved.
        pivot, axis : array_like
            Of the rotation.

        Returns
        -------
        numpy.ndarray (n, dimension)
            Zero at all other nodes.
        """
        return self._of.velocities(parameter, markers, pivot, axis)

    def __repr__(self):
        return f"<winslow.Sensitivity: {len(self.boundary)} nodes of the boundary, {self.solver}>"
