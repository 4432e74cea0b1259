"""Mesh warping under the names that users of the USMesh class of IDWarp know (github.com/mdolab/idwarp).

    from winslow.warping import USMesh

    mesh = USMesh({"gridFile": "wing.su2", "specifiedSurfaces": ["wing"]})
    mesh.setExternalMeshIndices(solver.getSolverMeshIndices())
    surface = mesh.getSurfaceCoordinates()
    mesh.setSurfaceCoordinates(surface + shape_change)
    mesh.warpMesh()
    solver.setGrid(mesh.getSolverGrid())
    mesh.warpDeriv(dJ_dX)                     # of the solver's grid
    dJ_dshape = mesh.getdXs()

The meshes are those of `winslow.Deformer`, the derivatives those of `winslow.Sensitivity`. Code of its own, not
of IDWarp. Differences: one process holds the whole mesh; plane meshes have rows of two components.
"""

import numpy as np

from .errors import UsageError
from .files import say, write
from .foreign import as_mesh
from .session import Deformer

# Options of IDWarp's weights and files that an elliptic mesh has no use for.
WITHOUT_EFFECT = {"fileType", "symmetryPlanes", "aExp", "bExp", "LdefFact", "alpha", "errTol", "evalMode", "symmTol",
                  "useRotations", "zeroCornerRotations", "cornerAngle", "restartFile", "bucketSize"}


class USMesh:
    """A mesh that follows its surface.

    Vectors of the volume are flat: x, y(, z) of the first node, then of the second. The grid of the solver has the
    entries that `setExternalMeshIndices` chose; before, it is the whole mesh in the order of the file.
    """

    def __init__(self, options=None, comm=None, debug=False):
        """Prepare a mesh.

        Parameters
        ----------
        options : dict
            gridFile : the mesh: a file or whatever else `winslow.as_mesh` takes.
            specifiedSurfaces : markers that move; None: all that do not slide.
            symmetrySurfaces : markers along which nodes slide.
            Others: options of `winslow.Deformer`. The remaining options of IDWarp have no effect, which a
            MeshWarning says.
        comm : mpi4py communicator, optional
            Of one process.
        debug : bool
            For compatibility; without effect.
        """
        options = dict(options or {})
        if comm is not None and comm.size > 1:
            raise UsageError(f"comm: found {comm.size} processes, expected 1, which holds the whole mesh")
        if options.get("gridFile") is None:
            raise UsageError('options: expected "gridFile", the mesh')
        mesh = as_mesh(options.pop("gridFile"))
        surfaces, sliding = options.pop("specifiedSurfaces", None), options.pop("symmetrySurfaces", None)
        ignored = sorted(WITHOUT_EFFECT & options.keys())
        for name in ignored:
            del options[name]
        if ignored:
            say([f"options of IDWarp without effect here: {', '.join(ignored)}"])
        if sliding:
            options["slide"] = list(sliding)
        if surfaces is None:
            surfaces = [name for name in mesh.markers if name not in (sliding or ())]
        self.deformer = Deformer(mesh, surfaces, **options)
        self._indices = None  # of the solver's entries in the flat mesh; None: all
        self._rows = np.arange(len(self.deformer.nodes))  # the node, as a row of deformer.nodes, of each surface point
        self._surface = mesh.points[self.deformer.nodes].copy()  # of deformer.nodes
        self._warped, self._sensitivity = False, None
        self._dXs = np.zeros_like(self._surface)

    # The surface.

    def getSurfaceCoordinates(self):
        """The points of the surface as they were set last: (N, dimension)."""
        return self._surface[self._rows]

    def setSurfaceCoordinates(self, coordinates):
        """Set all points of the surface: (N, dimension), as `getSurfaceCoordinates` returns them.

        Points that are one node of the mesh go to their mean.
        """
        places = self._mean(self._rows_of(coordinates, "coordinates"))
        if not np.isfinite(places).all():
            raise UsageError("coordinates: found one that is not finite")
        self._surface = places
        self._warped = False

    def setSurfaceDefinition(self, pts, conn=None, faceSizes=None, cgnsBlockID=None):
        """Name the points of the surface in an order of your own, as a flow solver has it.

        Parameters
        ----------
        pts : array_like (M, dimension)
            Points of the mesh as given, each a node of the surfaces to within 1e-6 of its extent; several points
            may be one node. Nodes that none of them is stay.
        conn, faceSizes, cgnsBlockID
            Faces, of which an elliptic mesh needs nothing.
        """
        from scipy.spatial import cKDTree

        given = self.deformer.given.points[self.deformer.nodes]
        points = np.asarray(pts, dtype=float)
        if points.ndim != 2 or points.shape[1] != given.shape[1]:
            raise UsageError(f"pts: found an array of shape {points.shape}, expected (M, {given.shape[1]})")
        distances, rows = cKDTree(given).query(points)
        if len(points) and distances.max() > 1e-6 * np.ptp(given, axis=0).max():
            worst = int(distances.argmax())
            raise UsageError(f"pts: row {worst} is {distances[worst]:.3g} from the nearest node of the surfaces, "
                             f"expected a node of {', '.join(self.deformer.markers)}")
        self._rows = rows
        self._surface, self._warped = given.copy(), False

    # The volume.

    def setExternalMeshIndices(self, ind):
        """Choose the entries of the flat mesh (x, y(, z) of each node, in the order of the file) that the solver's
        grid has, counted from 0."""
        indices = np.asarray(ind)
        size = self.deformer.given.points.size
        if indices.ndim != 1 or (len(indices) and not np.issubdtype(indices.dtype, np.integer)):
            raise UsageError("ind: expected an array of whole numbers")
        if len(indices) and not (0 <= indices.min() and indices.max() < size):
            raise UsageError(f"ind: found {indices.min()} to {indices.max()}, expected 0 to {size - 1}")
        self._indices = indices.astype(np.int64)

    def warpMesh(self):
        """Take the mesh to the surface that was set. Raises IncompleteMotion if no valid mesh has it; the mesh is then
        as it was."""
        self._warp(None)

    def getSolverGrid(self):
        """The mesh as the solver has it: flat, with the entries of `setExternalMeshIndices`."""
        return self._to_solver(self.getWarpGrid())

    def getWarpGrid(self):
        """The whole mesh: flat, in the order of the file."""
        return self.deformer.points.ravel().copy()

    getCommonGrid = getWarpGrid

    def writeGrid(self, fileName):
        """Write the present mesh; the extension says the format."""
        return write(self.deformer.mesh, fileName)

    # Derivatives.

    def warpDeriv(self, dXv, solverVec=True):
        """(dXv/dXs)^T dXv, for `getdXs`.

        Parameters
        ----------
        dXv : array_like
            The derivative of a function by the solver's grid; entries of one node and component add up.
        solverVec : bool
            False: `dXv` is by the whole mesh, as `getWarpGrid` has it.
        """
        on_nodes = self._derivative().transpose(self._to_warp(dXv, solverVec))[self.deformer.nodes]
        count = np.bincount(self._rows, minlength=len(on_nodes))
        self._dXs = (on_nodes / np.maximum(count, 1)[:, None])[self._rows]

    def getdXs(self):
        """The result of `warpDeriv`: (N, dimension), a row for each point of the surface."""
        return self._dXs.copy()

    def warpDerivFwd(self, dXs, solverVec=True):
        """(dXv/dXs) dXs.

        Parameters
        ----------
        dXs : array_like (N, dimension)
            How the points of the surface move.
        solverVec : bool
            False: the result is of the whole mesh.

        Returns
        -------
        numpy.ndarray
            How the solver's grid moves, flat.
        """
        field = np.zeros_like(self.deformer.given.points)
        field[self.deformer.nodes] = self._mean(self._rows_of(dXs, "dXs"), fill=0)
        moved = self._derivative().forward(field).ravel()
        return self._to_solver(moved) if solverVec else moved

    def verifyWarpDeriv(self, dXv=None, solverVec=True, dofStart=0, dofEnd=10, h=1e-6, randomSeed=314):
        """Compare `warpDeriv` with central differences of meshes, and print a table.

        Parameters
        ----------
        dXv : array_like, optional
            As of `warpDeriv`; None: random numbers.
        solverVec : bool
            As of `warpDeriv`.
        dofStart, dofEnd : int
            First and last entry of the flat surface to look at.
        h : float
            Step, in the unit of the mesh.
        randomSeed : int
            Of the random numbers.

        Returns
        -------
        float
            Largest difference, as a share of the largest derivative.
        """
        if dXv is None:
            size = self.deformer.given.points.size
            dXv, solverVec = np.random.default_rng(randomSeed).random(size), False
        weights = self._to_warp(dXv, solverVec).ravel()
        self.warpDeriv(weights, solverVec=False)
        derivative, kept = self.getdXs().ravel(), self.getSurfaceCoordinates()
        entries = range(max(dofStart, 0), min(dofEnd + 1, derivative.size))
        rows = []
        try:
            for entry in entries:
                ends = []
                for sign in (1, -1):
                    changed = kept.copy().ravel()
                    changed[entry] += sign * h
                    self.setSurfaceCoordinates(changed.reshape(kept.shape))
                    self._warp(1e-12)  # differences need more digits than a mesh
                    ends.append(self.getWarpGrid())
                rows.append((entry, derivative[entry], weights @ (ends[0] - ends[1]) / (2 * h)))
        finally:
            self.setSurfaceCoordinates(kept)
            self.warpMesh()
        scale = max((abs(row[2]) for row in rows), default=1) or 1
        print(f"{'entry':>8} {'warpDeriv':>16} {'difference':>16} {'error':>10}")
        for entry, exact, difference in rows:
            print(f"{entry:8} {exact:16.9e} {difference:16.9e} {abs(exact - difference) / scale:10.2e}")
        return max((abs(row[1] - row[2]) for row in rows), default=0) / scale

    def _warp(self, tolerance):
        if not self._warped:
            self.deformer.set_boundary(self._surface)
            self.deformer.step(tolerance)
            self._warped, self._sensitivity = True, None

    def _derivative(self):
        """The derivative at the surface that was set."""
        self.warpMesh()
        if self._sensitivity is None:
            self._sensitivity = self.deformer.sensitivity()
        return self._sensitivity

    def _rows_of(self, array, name):
        shape = (len(self._rows), self._surface.shape[1])
        rows = np.asarray(array, dtype=float)
        if rows.shape != shape:
            raise UsageError(f"{name}: found an array of shape {rows.shape}, expected {shape}, that of "
                             "getSurfaceCoordinates()")
        return rows

    def _mean(self, rows, fill=None):
        """For each node the mean of its points; nodes without a point keep their place, or have `fill`."""
        total = np.zeros_like(self._surface)
        np.add.at(total, self._rows, rows)
        count = np.bincount(self._rows, minlength=len(total))[:, None]
        single = np.zeros_like(total)
        single[self._rows] = rows  # to the bit where there is one point
        out = np.where(count > 1, total / np.maximum(count, 1), single)
        return np.where(count > 0, out, self._surface if fill is None else fill)

    def _to_solver(self, flat):
        return flat if self._indices is None else flat[self._indices]

    def _to_warp(self, vector, solver):
        """A vector of the solver's grid, or of the whole mesh, as (n, dimension)."""
        vector, shape = np.asarray(vector, dtype=float).ravel(), self.deformer.given.points.shape
        chosen = self._indices if solver else None
        expected = shape[0] * shape[1] if chosen is None else len(chosen)
        if vector.size != expected:
            raise UsageError(f"dXv: found {vector.size} numbers, expected {expected}")
        if chosen is None:
            return vector.reshape(shape)
        return np.bincount(chosen, weights=vector, minlength=shape[0] * shape[1]).reshape(shape)
