# Made by docs/make_python.py from the tables of the program: changes here are lost.
"""winslow: moves the bodies of unstructured meshes and repairs the mesh around them."""

import os
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

PathLike = Union[str, "os.PathLike[str]"]
# A mesh, a file, a mesh of meshio, a grid of pyvista, or (points, cells[, cell_sets]).
MeshLike = Any
Names = Union[str, Sequence[str]]
Bodies = Sequence[Dict[str, Any]]
Reals = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int32]

__version__: str

class Error(Exception):
    """Base of all exceptions of this package."""

class UsageError(Error, ValueError):
    """An argument or an option that is unknown, out of range, or does not suit the mesh."""

class InputError(Error, OSError):
    """A file that cannot be read or has wrong content.

    Attributes
    ----------
    file : str or None
        The file, as it was named.
    line : int or None
        The line, counted from 1; None where the file is binary or the fault has no place.
    byte : int or None
        The byte, counted from 0, of a binary file.
    """

    file: Optional[str]
    line: Optional[int]
    byte: Optional[int]

class OutputError(Error, OSError):
    """A file that cannot be written. The file is as it was."""

class MeshError(Error, ValueError):
    """Arrays that are no mesh, for example with a node that does not exist.

    Attributes
    ----------
    entity : str
        What is wrong: "node", "element", "marker_face" or "mesh".
    index : int or None
        Which of them, counted from 0.
    elements, nodes : list of int
        The element or the node, if it is one.
    """

    entity: Literal["mesh", "node", "element", "marker_face"]
    index: Optional[int]
    elements: List[int]
    nodes: List[int]

class NumericError(Error, ArithmeticError):
    """A numerical failure: a singular matrix, a mesh of which no solution is found."""

class Cancelled(Error):
    """The progress callback returned False. Nothing is changed."""

class IncompleteMotion(Error):
    """The result has inverted elements, or the motion could not be completed.

    Attributes
    ----------
    result : Result
        The result all the same: its mesh, how far the motion went, and why no farther.
    """

    result: Result

class MeshWarning(UserWarning):
    """What is harmless, or may be: what a reader, a motion or a writer has to say about a mesh."""

class Iteration:
    """One row of a convergence history. Iteration 0 is the mesh as given."""

    @property
    def iteration(self) -> int: ...
    @property
    def residual(self) -> float: ...
    @property
    def largest_move(self) -> float: ...
    @property
    def inverted(self) -> int: ...
    @property
    def min_sine(self) -> float: ...
    @property
    def damping(self) -> float: ...
    @property
    def clipped(self) -> bool: ...
    @property
    def linear_iterations(self) -> int: ...
    @property
    def fraction(self) -> float: ...
    @property
    def stage(self) -> str: ...

class Mesh:
    """A mesh: an immutable value.

    Parameters
    ----------
    points : array_like (n, 2) or (n, 3)
        Coordinates of the nodes.
    cells : dict or list
        Nodes of the elements by their type: {"triangle": (m, 3), ...}, or a list of pairs or
        of meshio's CellBlocks. The order of elements is that of the blocks. Types: triangle,
        quad, polygon, tetra, pyramid, wedge, hexahedron, polyhedron. Cells of a lower
        dimension (line, in volume meshes also triangle, quad) are faces for `markers`.
    markers : dict, optional
        Parts of the boundary: the name to the faces, an (m, 2) array of a plane mesh, or a list
        of arrays for faces with various numbers of nodes. Or cell sets as meshio has them: the
        name to one array of indices for each block; of elements they are regions.
    regions : dict, optional
        Sets of elements: the name to ids of elements.

    Raises
    ------
    MeshError
        For arrays that are no mesh; has `elements` and `nodes`.
    UsageError
        For arrays of a wrong shape or type.
    """

    def __init__(self, points: npt.ArrayLike, cells: Any, markers: Optional[Mapping[str, Any]] = None,
                 regions: Optional[Mapping[str, npt.ArrayLike]] = None) -> None: ...
    @property
    def points(self) -> Reals: ...
    @property
    def dimension(self) -> int: ...
    @property
    def cell_dimension(self) -> int: ...
    @property
    def kind(self) -> Literal["plane", "surface", "volume"]: ...
    @property
    def node_count(self) -> int: ...
    @property
    def element_count(self) -> int: ...
    @property
    def cells(self) -> Mapping[str, Any]: ...
    @property
    def element_ids(self) -> Mapping[str, Ids]: ...
    @property
    def markers(self) -> Mapping[str, Ids]: ...
    @property
    def faces(self) -> Mapping[str, Mapping[str, Any]]: ...
    @property
    def regions(self) -> Mapping[str, Ids]: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def path(self) -> Optional[str]: ...
    @property
    def markers_from_file(self) -> bool: ...
    def with_points(self, points: npt.ArrayLike) -> Mesh: ...
    def copy_points(self) -> Reals: ...
    def has_connectivity_of(self, other: Mesh) -> bool: ...
    def to_meshio(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def plot(self, **options: Any) -> Picture: ...

class Result:
    """The result of a command.

    Attributes
    ----------
    mesh : Mesh
        The mesh after the command. It shares the connectivity of the mesh before, but after an
        insertion of layers.
    inverted : int
        Number of inverted elements.
    converged : bool
        Whether the mesh is the solution to within the tolerance.
    fraction_reached : float
        Share of the motion that was carried out, 0 to 1.
    why_incomplete : str
        Why it is less than 1, a clause; "": it is 1.
    linear_solves : int
        Linear systems solved.
    history : list of Iteration
        All outer iterations.
    warnings : list of str
        Damage that may hurt a flow solver, bodies that nothing followed.
    remarks : list of str
        What the file says of its boundary and the run took over: markers that slide, periodic pairs.
    """

    mesh: Mesh
    inverted: int
    converged: bool
    fraction_reached: float
    why_incomplete: str
    linear_solves: int
    warnings: List[str]
    remarks: List[str]
    @property
    def history(self) -> List[Iteration]: ...
    @property
    def complete(self) -> bool: ...
    def report(self) -> Dict[str, Any]: ...

class Quality(Dict[str, Any]):
    """The quality of a mesh: the dict that `winslow quality --report` writes.

    `quality["quality"]["normalized_jacobian"]` has min, avg and max; "worst" lists the worst elements,
    "histograms" the counts, "openfoam" what checkMesh would say of a volume mesh.
    """

    @property
    def inverted(self) -> int: ...
    def min(self, metric: str) -> float: ...
    def max(self, metric: str) -> float: ...
    def mean(self, metric: str) -> float: ...

class Picture:
    """A picture as the bytes of a PNG; a notebook shows it."""

    png: bytes
    def __init__(self, png: bytes) -> None: ...
    def save(self, path: PathLike) -> None: ...

class Step:
    """A step of a sweep.

    Attributes
    ----------
    step : int
        Its number, from 0 on.
    bodies : list of dict
        What moved: markers, rotate, translate, ...
    status : str
        "done", "not converged", "incomplete", "inverted" or "failed".
    message : str
        Why it is not done; "": it is.
    mesh : Mesh or None
        The mesh; None if the step failed, or once `keep=False` has handed it over.
    inverted, converged, fraction_reached, linear_solves
        As of `Result`; None if the step failed.
    begins : int or None
        The step from whose mesh it began; None: the mesh as given.
    seconds : float
        Wall-clock time.
    """

    step: int
    bodies: List[Dict[str, Any]]
    status: Literal["done", "not converged", "incomplete", "inverted", "failed"]
    message: str
    mesh: Optional[Mesh]
    inverted: Optional[int]
    converged: Optional[bool]
    fraction_reached: Optional[float]
    linear_solves: Optional[int]
    begins: Optional[int]
    seconds: float

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

    mesh: Mesh
    boundary: Ids
    distance: float
    frozen: Dict[str, float]
    solver: str
    def __init__(
        self, mesh: MeshLike, moved: Union[Mesh, npt.ArrayLike], markers: Names, *,
        formulation: Literal["variational", "pointwise"] = "variational",
        targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
        raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
        untangle: Literal["auto", "picard", "energy"] = "auto",
        vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
        vcv_updates: int = 0,
        linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
        linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30,
        damping: float = 0.3, adapt_damping: bool = True, acceleration: int = 15,
        clip: Literal["auto", "on", "off"] = "auto", max_iterations: int = 1000, tolerance: Optional[float] = None,
        threads: int = 0, keep_outside_radius: Optional[float] = None,
        keep_outside_centre: Optional[Sequence[float]] = None, keep_outside_corner: Optional[Sequence[float]] = None,
        keep_outside_opposite: Optional[Sequence[float]] = None, slide: Union[str, Sequence[str]] = (),
        fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40, slide_features: bool = False,
        surface_first: bool = False, reference_surface: Optional[PathLike] = None,
        slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
        hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
        periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
        config: Optional[PathLike] = None, progress: Optional[Callable[[Iteration], Any]] = None
    ) -> None:
        """Prepare the derivative of a moved mesh.

        Parameters
        ----------
        mesh : Mesh
            Before the motion.
        moved : Mesh or array_like (n, dimension)
            After the motion, of the same connectivity.
        markers : str or sequence of str
            What moved.

        Smoothing
        ---------
        formulation : Literal["variational", "pointwise"], default variational
            Equations solved over the virtual control volumes.
            'variational': an energy with a barrier against inversion, minimised by Newton's method through
            valid meshes only
            'pointwise': the paper's operator, node by node, for comparison
        targets : Union[str, Dict[str, float]], default default
            Variational: shapes that the elements are driven towards, alone or blended.
            'default': keep for motions, auto for everything else
            'auto': regular elements where the mesh is isotropic, each element's own shape where it is
            stretched like its neighbours
            'element': equilateral triangles, square corners everywhere; for isotropic meshes only
            'vcv': the virtual control volumes, with their angles and edge lengths
            'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
            'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
            from becoming worse
        exponent : float, default 8
            Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
            count alike; larger: better worst elements, more iterations.
        knee : float, default 1.78
            Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
            than 1). Raise it to let well-shaped elements alone.
        raise_worst : bool, default false
            Variational: after the solution, make the worst element as good as it can be, at the expense of
            the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
            Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
            iterations, in drags too.
        outer : Literal["auto", "newton", "descent", "picard"], default auto
            Outer iteration.
            'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
            where that does not end converged
            'newton': Newton's method; boundary motions through valid meshes
            'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
            are slow; variational, volume meshes only
            'picard': the paper's damped iteration, coefficients frozen (pointwise only)
        untangle : Literal["auto", "picard", "energy"], default auto
            How inverted elements are untangled before Newton's method begins. Choose one of them if the
            other wastes time.
            'auto': scrambles by energy first, moved boundaries by picard, then the other
            'picard': the paper's damped iteration, negative weights clipped
            'energy': the variational form with a regularised determinant
        vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
            Pointwise form and targets vcv: virtual control volumes of the interior nodes.
            'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
            'equal': each triangle of a star has the same angle
            'existing': the solid angles of the mesh as given; volume meshes only
            'adjusted': the mean of equal and existing solid angles; volume meshes only
            'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
            meshes only
        vcv_lengths : float, default 0
            VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
            unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
            draws nodes to a body, or where sizes jump.
        vcv_updates : int, default 0
            Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
            the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
            mesh as given is tangled.
        linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
            How the linear systems are solved; the converged mesh is the same.
            'automatic': The fastest for the size and the symmetry of the matrix.
            'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
            'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
            'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
            'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
            'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
        linear_tolerance : float, default 0.001
            Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
            outer iteration corrects what is left, and Newton's method on the energy chooses its own between
            1e-2 and 1e-6: tighten it only if outer iterations stall.
        linear_max_iterations : int, default 200
            Limit of sweeps or Krylov iterations for one linear system (1 or more).
        linear_restart : int, default 30
            Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
            memory.
        damping : float, default 0.3
            Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
            safer and slower: lower it where the iteration swings or the mesh does not untangle.
        adapt_damping : bool, default true
            Fixed point: halve the damping where the iteration makes no progress.
        acceleration : int, default 15
            Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
            plain iteration of the paper (0 to 100).
        clip : Literal["auto", "on", "off"], default auto
            Fixed point: whether negative weights of the operator are set to zero. Without them no node is
            drawn out of its neighbours.
            'auto': while the mesh is tangled
            'on': in every iteration
            'off': not at all
        max_iterations : int, default 1000
            Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
            attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
        tolerance : Optional[float], default 1e-10
            Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
            is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
            too.
        threads : int, default 0
            Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
        keep_outside_radius : Optional[float]
            Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
            For a change near a body in a large mesh.
        keep_outside_centre : Optional[Sequence[float]]
            Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
            bounding box of all that moves, or of the walls that get layers, units of the mesh.
        keep_outside_corner : Optional[Sequence[float]]
            Nodes outside the box with this corner and the one opposite stay where they are, units of the
            mesh.
        keep_outside_opposite : Optional[Sequence[float]]
            Of the box outside which nodes stay, units of the mesh.
        slide : Union[str, Sequence[str]]
            Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
            variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
            draws the mesh along.
        fixed : Union[str, Sequence[str]]
            Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
            cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
            their places: the body then goes as far as the elements at its foot allow.
        feature_angle : float, default 40
            Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
            degrees (0 to 180).
        slide_features : bool, default false
            In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
            staying.
        surface_first : bool, default false
            Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
            within them; without, all at once. For elements of the boundary that are as good as they can be
            by themselves.
        reference_surface : Optional[PathLike]
            In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
            mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
            stands for, or tangled.
        slide_spacing : Literal["auto", "held", "free"], default auto
            Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
            as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
            walls; free where they may go where the mesh draws them.
            'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
            long as high or more
            'held': For all sliding markers
            'free': For none
        hold_spacing : Union[str, Sequence[str]]
            Sliding markers whose spacing is held whatever is chosen for the others.
        hold_node : Sequence[int]
            Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
            mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
            probe.
        smooth_node : Sequence[int]
            Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
            turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
            the shape does not have.
        periodic : Sequence[Tuple[str, str]]
            Two markers of which one is the image of the other by a translation or a rotation: their nodes
            move together and keep matching; variational form only. The sides of a passage: they give way to
            a blade that turns.
        periodic_from_file : bool, default false
            Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
            of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
            configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
            instead.
        interfaces : Literal["auto", "held", "slide", "free"], default auto
            What nodes do in which regions of the mesh meet: the physical groups or references of its
            elements. Slide where elements beside an interface should get better and the interface must keep
            its shape.
            'auto': Held while a mesh is smoothed, free in a motion
            'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
            motion has it anyway
            'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
            mesh has there; corners and places where more than two regions meet stay
            'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
            anyway

        Other Parameters
        ----------------
        config : Optional[PathLike], default None
            Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
        progress : Optional[Callable[[Iteration], Any]], default None
            Called with each iteration; returning False cancels, an exception ends the run and propagates.

        Raises
        ------
        UsageError
            Options that minimise no energy, held layers, a boundary that lies elsewhere than the motion takes it.
        NumericError
            No solution is found near `moved`.
        """

    def forward(self, velocities: npt.ArrayLike) -> Reals: ...
    def transpose(self, derivative: npt.ArrayLike) -> Reals: ...
    def velocities(self, parameter: Literal["rotate", "translate_x", "translate_y", "translate_z"],
                   markers: Optional[Names] = None, *, pivot: Optional[npt.ArrayLike] = None,
                   axis: Optional[npt.ArrayLike] = None) -> Reals: ...

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

    def __init__(
        self, mesh: MeshLike, markers: Optional[Names] = None, *, increments: int = 0, smooth_after: bool = True,
        formulation: Literal["variational", "pointwise"] = "variational",
        targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
        raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
        untangle: Literal["auto", "picard", "energy"] = "auto",
        vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
        vcv_updates: int = 0,
        linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
        linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30,
        damping: float = 0.3, adapt_damping: bool = True, acceleration: int = 15,
        clip: Literal["auto", "on", "off"] = "auto", max_iterations: int = 1000, tolerance: Optional[float] = None,
        threads: int = 0, keep_outside_radius: Optional[float] = None,
        keep_outside_centre: Optional[Sequence[float]] = None, keep_outside_corner: Optional[Sequence[float]] = None,
        keep_outside_opposite: Optional[Sequence[float]] = None, slide: Union[str, Sequence[str]] = (),
        fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40, slide_features: bool = False,
        surface_first: bool = False, reference_surface: Optional[PathLike] = None,
        slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
        hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
        periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
        reference: Optional[MeshLike] = None, hold_layers: Union[str, Sequence[str]] = (),
        min_quality: Optional[Dict[str, float]] = None, config: Optional[PathLike] = None
    ) -> None:
        """Prepare a mesh for many motions.

        Parameters
        ----------
        mesh : Mesh
            The mesh to which all boundaries refer. Or a file, a mesh of meshio or pyvista, or
            (points, cells, cell_sets).
        markers : str or sequence of str
            What moves as a rule: `nodes` are the nodes of these. None: each call says what moves.

        Motion
        ------
        increments : int, default 0
            Steps in which the boundary moves, each followed by smoothing; 0: along the path of valid
            meshes, in steps as long as they can be (fixed point: at once and, if that ends tangled, in 8
            and then in 32 steps); 1: at once, as in the paper (0 to 1e+06).
        smooth_after : bool, default true
            Smooth the interior after the boundary has moved.

        Smoothing
        ---------
        formulation : Literal["variational", "pointwise"], default variational
            Equations solved over the virtual control volumes.
            'variational': an energy with a barrier against inversion, minimised by Newton's method through
            valid meshes only
            'pointwise': the paper's operator, node by node, for comparison
        targets : Union[str, Dict[str, float]], default default
            Variational: shapes that the elements are driven towards, alone or blended.
            'default': keep for motions, auto for everything else
            'auto': regular elements where the mesh is isotropic, each element's own shape where it is
            stretched like its neighbours
            'element': equilateral triangles, square corners everywhere; for isotropic meshes only
            'vcv': the virtual control volumes, with their angles and edge lengths
            'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
            'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
            from becoming worse
        exponent : float, default 8
            Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
            count alike; larger: better worst elements, more iterations.
        knee : float, default 1.78
            Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
            than 1). Raise it to let well-shaped elements alone.
        raise_worst : bool, default false
            Variational: after the solution, make the worst element as good as it can be, at the expense of
            the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
            Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
            iterations, in drags too.
        outer : Literal["auto", "newton", "descent", "picard"], default auto
            Outer iteration.
            'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
            where that does not end converged
            'newton': Newton's method; boundary motions through valid meshes
            'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
            are slow; variational, volume meshes only
            'picard': the paper's damped iteration, coefficients frozen (pointwise only)
        untangle : Literal["auto", "picard", "energy"], default auto
            How inverted elements are untangled before Newton's method begins. Choose one of them if the
            other wastes time.
            'auto': scrambles by energy first, moved boundaries by picard, then the other
            'picard': the paper's damped iteration, negative weights clipped
            'energy': the variational form with a regularised determinant
        vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
            Pointwise form and targets vcv: virtual control volumes of the interior nodes.
            'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
            'equal': each triangle of a star has the same angle
            'existing': the solid angles of the mesh as given; volume meshes only
            'adjusted': the mean of equal and existing solid angles; volume meshes only
            'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
            meshes only
        vcv_lengths : float, default 0
            VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
            unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
            draws nodes to a body, or where sizes jump.
        vcv_updates : int, default 0
            Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
            the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
            mesh as given is tangled.
        linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
            How the linear systems are solved; the converged mesh is the same.
            'automatic': The fastest for the size and the symmetry of the matrix.
            'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
            'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
            'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
            'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
            'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
        linear_tolerance : float, default 0.001
            Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
            outer iteration corrects what is left, and Newton's method on the energy chooses its own between
            1e-2 and 1e-6: tighten it only if outer iterations stall.
        linear_max_iterations : int, default 200
            Limit of sweeps or Krylov iterations for one linear system (1 or more).
        linear_restart : int, default 30
            Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
            memory.
        damping : float, default 0.3
            Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
            safer and slower: lower it where the iteration swings or the mesh does not untangle.
        adapt_damping : bool, default true
            Fixed point: halve the damping where the iteration makes no progress.
        acceleration : int, default 15
            Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
            plain iteration of the paper (0 to 100).
        clip : Literal["auto", "on", "off"], default auto
            Fixed point: whether negative weights of the operator are set to zero. Without them no node is
            drawn out of its neighbours.
            'auto': while the mesh is tangled
            'on': in every iteration
            'off': not at all
        max_iterations : int, default 1000
            Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
            attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
        tolerance : Optional[float], default 1e-10
            Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
            is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
            too.
        threads : int, default 0
            Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
        keep_outside_radius : Optional[float]
            Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
            For a change near a body in a large mesh.
        keep_outside_centre : Optional[Sequence[float]]
            Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
            bounding box of all that moves, or of the walls that get layers, units of the mesh.
        keep_outside_corner : Optional[Sequence[float]]
            Nodes outside the box with this corner and the one opposite stay where they are, units of the
            mesh.
        keep_outside_opposite : Optional[Sequence[float]]
            Of the box outside which nodes stay, units of the mesh.
        slide : Union[str, Sequence[str]]
            Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
            variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
            draws the mesh along.
        fixed : Union[str, Sequence[str]]
            Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
            cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
            their places: the body then goes as far as the elements at its foot allow.
        feature_angle : float, default 40
            Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
            degrees (0 to 180).
        slide_features : bool, default false
            In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
            staying.
        surface_first : bool, default false
            Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
            within them; without, all at once. For elements of the boundary that are as good as they can be
            by themselves.
        reference_surface : Optional[PathLike]
            In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
            mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
            stands for, or tangled.
        slide_spacing : Literal["auto", "held", "free"], default auto
            Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
            as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
            walls; free where they may go where the mesh draws them.
            'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
            long as high or more
            'held': For all sliding markers
            'free': For none
        hold_spacing : Union[str, Sequence[str]]
            Sliding markers whose spacing is held whatever is chosen for the others.
        hold_node : Sequence[int]
            Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
            mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
            probe.
        smooth_node : Sequence[int]
            Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
            turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
            the shape does not have.
        periodic : Sequence[Tuple[str, str]]
            Two markers of which one is the image of the other by a translation or a rotation: their nodes
            move together and keep matching; variational form only. The sides of a passage: they give way to
            a blade that turns.
        periodic_from_file : bool, default false
            Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
            of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
            configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
            instead.
        interfaces : Literal["auto", "held", "slide", "free"], default auto
            What nodes do in which regions of the mesh meet: the physical groups or references of its
            elements. Slide where elements beside an interface should get better and the interface must keep
            its shape.
            'auto': Held while a mesh is smoothed, free in a motion
            'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
            motion has it anyway
            'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
            mesh has there; corners and places where more than two regions meet stay
            'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
            anyway

        Other Parameters
        ----------------
        reference : Optional[MeshLike], default None
            Mesh of the same connectivity whose element shapes motions keep, in place of `mesh`: the mesh
            before the first of several motions.
        hold_layers : Union[str, Sequence[str]], default ()
            Walls whose layers, as the mesh has them, keep their heights.
        min_quality : Optional[Dict[str, float]], default None
            Limits by the names of metrics: the motion ends before any element is worse.
        config : Optional[PathLike], default None
            Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.

        Raises
        ------
        UsageError
            An unknown option or marker, one out of range, or one that does not suit the mesh.
        InputError
            A file that an option names cannot be read.
        """

    @property
    def markers(self) -> List[str]: ...
    @property
    def remarks(self) -> List[str]: ...
    @property
    def nodes(self) -> Ids: ...
    @property
    def given(self) -> Mesh: ...
    @property
    def mesh(self) -> Mesh: ...
    @property
    def points(self) -> Reals: ...
    def set_boundary(self, places: npt.ArrayLike, nodes: Optional[npt.ArrayLike] = None) -> None: ...
    def set_motion(self, markers: Optional[Names] = None, *, bodies: Optional[Bodies] = None,
                   rotate: float = 0, translate: Optional[npt.ArrayLike] = None,
                   pivot: Optional[npt.ArrayLike] = None, axis: Optional[npt.ArrayLike] = None) -> None: ...
    def set_sine(self, markers: Optional[Names] = None, **sine: Any) -> None: ...
    def step(self, tolerance: Optional[float] = None, *, progress: Optional[Callable[[Iteration], Any]] = None,
             allow_incomplete: bool = False) -> Result: ...
    def displacement(self) -> Reals: ...
    def sensitivity(self) -> Sensitivity: ...
    def velocities(self, boundary: npt.ArrayLike, nodes: Optional[npt.ArrayLike] = None) -> Reals: ...
    def largest_valid(self, places: npt.ArrayLike, nodes: Optional[npt.ArrayLike] = None) -> float: ...
    def checkpoint(self) -> Any: ...
    def restore(self, checkpoint: Any) -> None: ...

def read(
    path: PathLike, *, zone: int = 0, regions: str = "", time: str = "", repair: bool = False, show: bool = False
) -> Mesh:
    """Read a mesh file.

    Parameters
    ----------
    path : str or os.PathLike
        SU2, Gmsh, CGNS, VTK, OpenFOAM, ...: docs/formats.md. The content decides the format.
    zone : int
        Number of the zone, of files that have several; 0: the first.
    regions : str
        Cell array of a VTK file whose whole numbers are the regions; "": one of the known names.
    time : str
        Time of an OpenFOAM case whose points have moved: "latest", or the name of its folder.
    repair : bool
        Mend the mesh first: points in one place, elements given twice or without area, ...
    show : bool
        Read what can be shown of a file that is no sound mesh. For pictures and measures alone.

    Returns
    -------
    Mesh

    Raises
    ------
    InputError
        The file cannot be read, or its content is wrong: `file`, `line` and `byte` say where.
    UsageError
        A zone or an array that the file does not have.

    Warns
    -----
    MeshWarning
        What the reader has to say; also in `Mesh.warnings`.
    """

def write(
    mesh: MeshLike, path: PathLike, *, binary: Optional[bool] = None, gmsh_version: str = "",
    cgns_container: str = "", overwrite: bool = False
) -> List[str]:
    """Write a mesh file; its extension says the format.

    To a file of the format that the mesh was read from, everything else goes back as it was: comments,
    tags, the order and the words of the file.

    Parameters
    ----------
    mesh : Mesh
        Or whatever else is a mesh: see `as_mesh`.
    path : str or os.PathLike
        The file. It is written whole or not at all.
    binary : bool, optional
        Binary or text, where the format has both; None: as the source.
    gmsh_version : str
        "2.2" or "4.1"; "": that of the source, else 4.1.
    cgns_container : str
        "hdf5" or "adf"; "": that of the source, else hdf5.
    overwrite : bool
        Allow the file that the mesh was read from.

    Returns
    -------
    list of str
        What was lost.

    Raises
    ------
    OutputError
        The file cannot be written; it is as it was.
    UsageError
        An unknown extension, elements that the format cannot hold, the file that the mesh is from.
    """

def convert(
    source: MeshLike, path: PathLike, *, binary: Optional[bool] = None, gmsh_version: str = "",
    cgns_container: str = "", **reading: Any
) -> List[str]:
    """Write a mesh file in another format: `read` and `write` in one.

    Parameters
    ----------
    source : str, os.PathLike or Mesh
        The mesh to read.
    path : str or os.PathLike
        The file to write; its extension says the format.
    binary, gmsh_version, cgns_container
        As of `write`.
    **reading
        The options of `read`: zone, regions, time, repair.

    Returns
    -------
    list of str
        What was lost.
    """

def smooth(
    mesh: MeshLike, *, formulation: Literal["variational", "pointwise"] = "variational",
    targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
    raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
    untangle: Literal["auto", "picard", "energy"] = "auto",
    vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
    vcv_updates: int = 0,
    linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
    linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30, damping: float = 0.3,
    adapt_damping: bool = True, acceleration: int = 15, clip: Literal["auto", "on", "off"] = "auto",
    max_iterations: int = 1000, tolerance: Optional[float] = None, threads: int = 0,
    keep_outside_radius: Optional[float] = None, keep_outside_centre: Optional[Sequence[float]] = None,
    keep_outside_corner: Optional[Sequence[float]] = None, keep_outside_opposite: Optional[Sequence[float]] = None,
    slide: Union[str, Sequence[str]] = (), fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40,
    slide_features: bool = False, surface_first: bool = False, reference_surface: Optional[PathLike] = None,
    slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
    hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
    periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
    allow_inverted: bool = False, config: Optional[PathLike] = None,
    progress: Optional[Callable[[Iteration], Any]] = None
) -> Result:
    """Smooth the interior of a mesh, the boundary held.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).

    Smoothing
    ---------
    formulation : Literal["variational", "pointwise"], default variational
        Equations solved over the virtual control volumes.
        'variational': an energy with a barrier against inversion, minimised by Newton's method through
        valid meshes only
        'pointwise': the paper's operator, node by node, for comparison
    targets : Union[str, Dict[str, float]], default default
        Variational: shapes that the elements are driven towards, alone or blended.
        'default': keep for motions, auto for everything else
        'auto': regular elements where the mesh is isotropic, each element's own shape where it is
        stretched like its neighbours
        'element': equilateral triangles, square corners everywhere; for isotropic meshes only
        'vcv': the virtual control volumes, with their angles and edge lengths
        'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
        'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
        from becoming worse
    exponent : float, default 8
        Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
        count alike; larger: better worst elements, more iterations.
    knee : float, default 1.78
        Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
        than 1). Raise it to let well-shaped elements alone.
    raise_worst : bool, default false
        Variational: after the solution, make the worst element as good as it can be, at the expense of
        the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
        Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
        iterations, in drags too.
    outer : Literal["auto", "newton", "descent", "picard"], default auto
        Outer iteration.
        'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
        where that does not end converged
        'newton': Newton's method; boundary motions through valid meshes
        'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
        are slow; variational, volume meshes only
        'picard': the paper's damped iteration, coefficients frozen (pointwise only)
    untangle : Literal["auto", "picard", "energy"], default auto
        How inverted elements are untangled before Newton's method begins. Choose one of them if the
        other wastes time.
        'auto': scrambles by energy first, moved boundaries by picard, then the other
        'picard': the paper's damped iteration, negative weights clipped
        'energy': the variational form with a regularised determinant
    vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
        Pointwise form and targets vcv: virtual control volumes of the interior nodes.
        'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
        'equal': each triangle of a star has the same angle
        'existing': the solid angles of the mesh as given; volume meshes only
        'adjusted': the mean of equal and existing solid angles; volume meshes only
        'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
        meshes only
    vcv_lengths : float, default 0
        VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
        unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
        draws nodes to a body, or where sizes jump.
    vcv_updates : int, default 0
        Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
        the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
        mesh as given is tangled.
    linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
        How the linear systems are solved; the converged mesh is the same.
        'automatic': The fastest for the size and the symmetry of the matrix.
        'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
        'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
        'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
        'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
        'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
    linear_tolerance : float, default 0.001
        Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
        outer iteration corrects what is left, and Newton's method on the energy chooses its own between
        1e-2 and 1e-6: tighten it only if outer iterations stall.
    linear_max_iterations : int, default 200
        Limit of sweeps or Krylov iterations for one linear system (1 or more).
    linear_restart : int, default 30
        Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
        memory.
    damping : float, default 0.3
        Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
        safer and slower: lower it where the iteration swings or the mesh does not untangle.
    adapt_damping : bool, default true
        Fixed point: halve the damping where the iteration makes no progress.
    acceleration : int, default 15
        Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
        plain iteration of the paper (0 to 100).
    clip : Literal["auto", "on", "off"], default auto
        Fixed point: whether negative weights of the operator are set to zero. Without them no node is
        drawn out of its neighbours.
        'auto': while the mesh is tangled
        'on': in every iteration
        'off': not at all
    max_iterations : int, default 1000
        Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
        attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
    tolerance : Optional[float], default 1e-10; volume meshes: 1e-4
        Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
        is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
        too.
    threads : int, default 0
        Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
    keep_outside_radius : Optional[float]
        Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
        For a change near a body in a large mesh.
    keep_outside_centre : Optional[Sequence[float]]
        Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
        bounding box of all that moves, or of the walls that get layers, units of the mesh.
    keep_outside_corner : Optional[Sequence[float]]
        Nodes outside the box with this corner and the one opposite stay where they are, units of the
        mesh.
    keep_outside_opposite : Optional[Sequence[float]]
        Of the box outside which nodes stay, units of the mesh.
    slide : Union[str, Sequence[str]]
        Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
        variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
        draws the mesh along.
    fixed : Union[str, Sequence[str]]
        Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
        cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
        their places: the body then goes as far as the elements at its foot allow.
    feature_angle : float, default 40
        Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
        degrees (0 to 180).
    slide_features : bool, default false
        In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
        staying.
    surface_first : bool, default false
        Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
        within them; without, all at once. For elements of the boundary that are as good as they can be
        by themselves.
    reference_surface : Optional[PathLike]
        In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
        mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
        stands for, or tangled.
    slide_spacing : Literal["auto", "held", "free"], default auto
        Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
        as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
        walls; free where they may go where the mesh draws them.
        'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
        long as high or more
        'held': For all sliding markers
        'free': For none
    hold_spacing : Union[str, Sequence[str]]
        Sliding markers whose spacing is held whatever is chosen for the others.
    hold_node : Sequence[int]
        Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
        mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
        probe.
    smooth_node : Sequence[int]
        Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
        turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
        the shape does not have.
    periodic : Sequence[Tuple[str, str]]
        Two markers of which one is the image of the other by a translation or a rotation: their nodes
        move together and keep matching; variational form only. The sides of a passage: they give way to
        a blade that turns.
    periodic_from_file : bool, default false
        Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
        of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
        configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
        instead.
    interfaces : Literal["auto", "held", "slide", "free"], default auto
        What nodes do in which regions of the mesh meet: the physical groups or references of its
        elements. Slide where elements beside an interface should get better and the interface must keep
        its shape.
        'auto': Held while a mesh is smoothed, free in a motion
        'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
        motion has it anyway
        'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
        mesh has there; corners and places where more than two regions meet stay
        'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
        anyway

    Other Parameters
    ----------------
    allow_inverted : bool, default False
        Return a mesh with inverted elements, too, instead of raising.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
    progress : Optional[Callable[[Iteration], Any]], default None
        Called with each iteration; returning False cancels, an exception ends the run and propagates.

    Returns
    -------
    Result

    Raises
    ------
    IncompleteMotion
        The result has inverted elements, or the motion could not be completed; has `result`.
    UsageError
        An unknown option, one out of range, or one that does not suit the mesh.
    Cancelled, NumericError, InputError
        The callback said so; no solution was found; a file that an option names cannot be read.
    """

def untangle(
    mesh: MeshLike, **options: Any
) -> Mesh:
    """Smooth a mesh if it has inverted elements; else it is returned as it is.

    Parameters
    ----------
    mesh : Mesh
        As of `smooth`.
    **options
        Those of `smooth`; `untangle` chooses the method.

    Returns
    -------
    Mesh
        Without inverted elements.

    Raises
    ------
    IncompleteMotion
        Inverted elements are left; has the result.
    """

def move(
    mesh: MeshLike, markers: Optional[Names] = None, *, bodies: Optional[Bodies] = None, rotate: float = 0,
    axis: Optional[Sequence[float]] = None, pivot: Optional[Sequence[float]] = None,
    translate: Sequence[float] = (0, 0), increments: int = 0, smooth_after: bool = True,
    formulation: Literal["variational", "pointwise"] = "variational",
    targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
    raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
    untangle: Literal["auto", "picard", "energy"] = "auto",
    vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
    vcv_updates: int = 0,
    linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
    linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30, damping: float = 0.3,
    adapt_damping: bool = True, acceleration: int = 15, clip: Literal["auto", "on", "off"] = "auto",
    max_iterations: int = 1000, tolerance: Optional[float] = None, threads: int = 0,
    keep_outside_radius: Optional[float] = None, keep_outside_centre: Optional[Sequence[float]] = None,
    keep_outside_corner: Optional[Sequence[float]] = None, keep_outside_opposite: Optional[Sequence[float]] = None,
    slide: Union[str, Sequence[str]] = (), fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40,
    slide_features: bool = False, surface_first: bool = False, reference_surface: Optional[PathLike] = None,
    slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
    hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
    periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
    reference: Optional[MeshLike] = None, allow_incomplete: bool = False, hold_layers: Union[str, Sequence[str]] = (),
    min_quality: Optional[Dict[str, float]] = None, allow_inverted: bool = False, config: Optional[PathLike] = None,
    progress: Optional[Callable[[Iteration], Any]] = None
) -> Result:
    """Move bodies rigidly, and the mesh with them.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move together; * stands for any characters.
    bodies : sequence of dict
        In place of `markers`: bodies that move at the same time, each a dict with `markers` and the
        options rotate, translate, pivot, axis.

    Motion
    ------
    rotate : float, default 0
        Angle about the pivot, counter-clockwise positive; in space about the axis, degrees.
    axis : Optional[Sequence[float]]
        Direction of the axis through the pivot, for volume meshes: the rotation is counter-clockwise
        seen from where it points to.
    pivot : Optional[Sequence[float]]
        Point about which it turns; not given: the centre of the bounding box of all that moves, units
        of the mesh.
    translate : Sequence[float], default 0 0
        Shift, after the rotation, units of the mesh.
    increments : int, default 0
        Steps in which the boundary moves, each followed by smoothing; 0: along the path of valid
        meshes, in steps as long as they can be (fixed point: at once and, if that ends tangled, in 8
        and then in 32 steps); 1: at once, as in the paper (0 to 1e+06).
    smooth_after : bool, default true
        Smooth the interior after the boundary has moved.

    Smoothing
    ---------
    formulation : Literal["variational", "pointwise"], default variational
        Equations solved over the virtual control volumes.
        'variational': an energy with a barrier against inversion, minimised by Newton's method through
        valid meshes only
        'pointwise': the paper's operator, node by node, for comparison
    targets : Union[str, Dict[str, float]], default default
        Variational: shapes that the elements are driven towards, alone or blended.
        'default': keep for motions, auto for everything else
        'auto': regular elements where the mesh is isotropic, each element's own shape where it is
        stretched like its neighbours
        'element': equilateral triangles, square corners everywhere; for isotropic meshes only
        'vcv': the virtual control volumes, with their angles and edge lengths
        'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
        'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
        from becoming worse
    exponent : float, default 8
        Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
        count alike; larger: better worst elements, more iterations.
    knee : float, default 1.78
        Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
        than 1). Raise it to let well-shaped elements alone.
    raise_worst : bool, default false
        Variational: after the solution, make the worst element as good as it can be, at the expense of
        the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
        Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
        iterations, in drags too.
    outer : Literal["auto", "newton", "descent", "picard"], default auto
        Outer iteration.
        'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
        where that does not end converged
        'newton': Newton's method; boundary motions through valid meshes
        'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
        are slow; variational, volume meshes only
        'picard': the paper's damped iteration, coefficients frozen (pointwise only)
    untangle : Literal["auto", "picard", "energy"], default auto
        How inverted elements are untangled before Newton's method begins. Choose one of them if the
        other wastes time.
        'auto': scrambles by energy first, moved boundaries by picard, then the other
        'picard': the paper's damped iteration, negative weights clipped
        'energy': the variational form with a regularised determinant
    vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
        Pointwise form and targets vcv: virtual control volumes of the interior nodes.
        'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
        'equal': each triangle of a star has the same angle
        'existing': the solid angles of the mesh as given; volume meshes only
        'adjusted': the mean of equal and existing solid angles; volume meshes only
        'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
        meshes only
    vcv_lengths : float, default 0
        VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
        unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
        draws nodes to a body, or where sizes jump.
    vcv_updates : int, default 0
        Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
        the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
        mesh as given is tangled.
    linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
        How the linear systems are solved; the converged mesh is the same.
        'automatic': The fastest for the size and the symmetry of the matrix.
        'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
        'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
        'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
        'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
        'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
    linear_tolerance : float, default 0.001
        Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
        outer iteration corrects what is left, and Newton's method on the energy chooses its own between
        1e-2 and 1e-6: tighten it only if outer iterations stall.
    linear_max_iterations : int, default 200
        Limit of sweeps or Krylov iterations for one linear system (1 or more).
    linear_restart : int, default 30
        Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
        memory.
    damping : float, default 0.3
        Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
        safer and slower: lower it where the iteration swings or the mesh does not untangle.
    adapt_damping : bool, default true
        Fixed point: halve the damping where the iteration makes no progress.
    acceleration : int, default 15
        Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
        plain iteration of the paper (0 to 100).
    clip : Literal["auto", "on", "off"], default auto
        Fixed point: whether negative weights of the operator are set to zero. Without them no node is
        drawn out of its neighbours.
        'auto': while the mesh is tangled
        'on': in every iteration
        'off': not at all
    max_iterations : int, default 1000
        Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
        attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
    tolerance : Optional[float], default 1e-10; volume meshes: 1e-4
        Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
        is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
        too.
    threads : int, default 0
        Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
    keep_outside_radius : Optional[float]
        Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
        For a change near a body in a large mesh.
    keep_outside_centre : Optional[Sequence[float]]
        Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
        bounding box of all that moves, or of the walls that get layers, units of the mesh.
    keep_outside_corner : Optional[Sequence[float]]
        Nodes outside the box with this corner and the one opposite stay where they are, units of the
        mesh.
    keep_outside_opposite : Optional[Sequence[float]]
        Of the box outside which nodes stay, units of the mesh.
    slide : Union[str, Sequence[str]]
        Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
        variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
        draws the mesh along.
    fixed : Union[str, Sequence[str]]
        Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
        cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
        their places: the body then goes as far as the elements at its foot allow.
    feature_angle : float, default 40
        Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
        degrees (0 to 180).
    slide_features : bool, default false
        In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
        staying.
    surface_first : bool, default false
        Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
        within them; without, all at once. For elements of the boundary that are as good as they can be
        by themselves.
    reference_surface : Optional[PathLike]
        In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
        mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
        stands for, or tangled.
    slide_spacing : Literal["auto", "held", "free"], default auto
        Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
        as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
        walls; free where they may go where the mesh draws them.
        'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
        long as high or more
        'held': For all sliding markers
        'free': For none
    hold_spacing : Union[str, Sequence[str]]
        Sliding markers whose spacing is held whatever is chosen for the others.
    hold_node : Sequence[int]
        Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
        mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
        probe.
    smooth_node : Sequence[int]
        Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
        turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
        the shape does not have.
    periodic : Sequence[Tuple[str, str]]
        Two markers of which one is the image of the other by a translation or a rotation: their nodes
        move together and keep matching; variational form only. The sides of a passage: they give way to
        a blade that turns.
    periodic_from_file : bool, default false
        Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
        of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
        configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
        instead.
    interfaces : Literal["auto", "held", "slide", "free"], default auto
        What nodes do in which regions of the mesh meet: the physical groups or references of its
        elements. Slide where elements beside an interface should get better and the interface must keep
        its shape.
        'auto': Held while a mesh is smoothed, free in a motion
        'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
        motion has it anyway
        'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
        mesh has there; corners and places where more than two regions meet stay
        'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
        anyway

    Other Parameters
    ----------------
    reference : Optional[MeshLike], default None
        Mesh of the same connectivity whose element shapes motions keep, in place of `mesh`: the mesh
        before the first of several motions.
    allow_incomplete : bool, default False
        Return the last valid mesh of a motion that could not be completed.
    hold_layers : Union[str, Sequence[str]], default ()
        Walls whose layers, as the mesh has them, keep their heights.
    min_quality : Optional[Dict[str, float]], default None
        Limits by the names of metrics: the motion ends before any element is worse.
    allow_inverted : bool, default False
        Return a mesh with inverted elements, too, instead of raising.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
    progress : Optional[Callable[[Iteration], Any]], default None
        Called with each iteration; returning False cancels, an exception ends the run and propagates.

    Returns
    -------
    Result

    Raises
    ------
    IncompleteMotion
        The result has inverted elements, or the motion could not be completed; has `result`.
    UsageError
        An unknown option, one out of range, or one that does not suit the mesh.
    Cancelled, NumericError, InputError
        The callback said so; no solution was found; a file that an option names cannot be read.
    """

def deform(
    mesh: MeshLike, markers: Optional[Names] = None, *, displacements: Any = None, positions: Any = None,
    nodes: Optional[npt.ArrayLike] = None, sine: Optional[Dict[str, Any]] = None, increments: int = 0,
    smooth_after: bool = True, formulation: Literal["variational", "pointwise"] = "variational",
    targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
    raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
    untangle: Literal["auto", "picard", "energy"] = "auto",
    vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
    vcv_updates: int = 0,
    linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
    linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30, damping: float = 0.3,
    adapt_damping: bool = True, acceleration: int = 15, clip: Literal["auto", "on", "off"] = "auto",
    max_iterations: int = 1000, tolerance: Optional[float] = None, threads: int = 0,
    keep_outside_radius: Optional[float] = None, keep_outside_centre: Optional[Sequence[float]] = None,
    keep_outside_corner: Optional[Sequence[float]] = None, keep_outside_opposite: Optional[Sequence[float]] = None,
    slide: Union[str, Sequence[str]] = (), fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40,
    slide_features: bool = False, surface_first: bool = False, reference_surface: Optional[PathLike] = None,
    slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
    hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
    periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
    reference: Optional[MeshLike] = None, allow_incomplete: bool = False, hold_layers: Union[str, Sequence[str]] = (),
    min_quality: Optional[Dict[str, float]] = None, allow_inverted: bool = False, config: Optional[PathLike] = None,
    progress: Optional[Callable[[Iteration], Any]] = None
) -> Result:
    """Change the shape of bodies, or prescribe single nodes, and move the mesh with them.

    Give one of `displacements`, `positions` and `sine`.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move. Nodes of them without a row stay. None: any node may be prescribed.
    displacements : array_like (k, dimension), or a CSV file
        How far the nodes move.
    positions : array_like (k, dimension), or a CSV file
        Where the nodes are afterwards, to the bit.
    nodes : array_like (k,)
        Ids of the nodes of the rows. None: the rows are all nodes of the mesh, of which those of
        `markers` are taken; or the nodes of `markers`, ascending (`mesh.markers[name]`).
    sine : dict
        A sine wave along the body: amplitude, waves, direction, along, fade, fade_length.

    Motion
    ------
    increments : int, default 0
        Steps in which the boundary moves, each followed by smoothing; 0: along the path of valid
        meshes, in steps as long as they can be (fixed point: at once and, if that ends tangled, in 8
        and then in 32 steps); 1: at once, as in the paper (0 to 1e+06).
    smooth_after : bool, default true
        Smooth the interior after the boundary has moved.

    Smoothing
    ---------
    formulation : Literal["variational", "pointwise"], default variational
        Equations solved over the virtual control volumes.
        'variational': an energy with a barrier against inversion, minimised by Newton's method through
        valid meshes only
        'pointwise': the paper's operator, node by node, for comparison
    targets : Union[str, Dict[str, float]], default default
        Variational: shapes that the elements are driven towards, alone or blended.
        'default': keep for motions, auto for everything else
        'auto': regular elements where the mesh is isotropic, each element's own shape where it is
        stretched like its neighbours
        'element': equilateral triangles, square corners everywhere; for isotropic meshes only
        'vcv': the virtual control volumes, with their angles and edge lengths
        'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
        'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
        from becoming worse
    exponent : float, default 8
        Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
        count alike; larger: better worst elements, more iterations.
    knee : float, default 1.78
        Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
        than 1). Raise it to let well-shaped elements alone.
    raise_worst : bool, default false
        Variational: after the solution, make the worst element as good as it can be, at the expense of
        the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
        Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
        iterations, in drags too.
    outer : Literal["auto", "newton", "descent", "picard"], default auto
        Outer iteration.
        'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
        where that does not end converged
        'newton': Newton's method; boundary motions through valid meshes
        'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
        are slow; variational, volume meshes only
        'picard': the paper's damped iteration, coefficients frozen (pointwise only)
    untangle : Literal["auto", "picard", "energy"], default auto
        How inverted elements are untangled before Newton's method begins. Choose one of them if the
        other wastes time.
        'auto': scrambles by energy first, moved boundaries by picard, then the other
        'picard': the paper's damped iteration, negative weights clipped
        'energy': the variational form with a regularised determinant
    vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
        Pointwise form and targets vcv: virtual control volumes of the interior nodes.
        'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
        'equal': each triangle of a star has the same angle
        'existing': the solid angles of the mesh as given; volume meshes only
        'adjusted': the mean of equal and existing solid angles; volume meshes only
        'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
        meshes only
    vcv_lengths : float, default 0
        VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
        unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
        draws nodes to a body, or where sizes jump.
    vcv_updates : int, default 0
        Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
        the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
        mesh as given is tangled.
    linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
        How the linear systems are solved; the converged mesh is the same.
        'automatic': The fastest for the size and the symmetry of the matrix.
        'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
        'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
        'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
        'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
        'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
    linear_tolerance : float, default 0.001
        Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
        outer iteration corrects what is left, and Newton's method on the energy chooses its own between
        1e-2 and 1e-6: tighten it only if outer iterations stall.
    linear_max_iterations : int, default 200
        Limit of sweeps or Krylov iterations for one linear system (1 or more).
    linear_restart : int, default 30
        Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
        memory.
    damping : float, default 0.3
        Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
        safer and slower: lower it where the iteration swings or the mesh does not untangle.
    adapt_damping : bool, default true
        Fixed point: halve the damping where the iteration makes no progress.
    acceleration : int, default 15
        Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
        plain iteration of the paper (0 to 100).
    clip : Literal["auto", "on", "off"], default auto
        Fixed point: whether negative weights of the operator are set to zero. Without them no node is
        drawn out of its neighbours.
        'auto': while the mesh is tangled
        'on': in every iteration
        'off': not at all
    max_iterations : int, default 1000
        Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
        attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
    tolerance : Optional[float], default 1e-10; volume meshes: 1e-4
        Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
        is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
        too.
    threads : int, default 0
        Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
    keep_outside_radius : Optional[float]
        Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
        For a change near a body in a large mesh.
    keep_outside_centre : Optional[Sequence[float]]
        Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
        bounding box of all that moves, or of the walls that get layers, units of the mesh.
    keep_outside_corner : Optional[Sequence[float]]
        Nodes outside the box with this corner and the one opposite stay where they are, units of the
        mesh.
    keep_outside_opposite : Optional[Sequence[float]]
        Of the box outside which nodes stay, units of the mesh.
    slide : Union[str, Sequence[str]]
        Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
        variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
        draws the mesh along.
    fixed : Union[str, Sequence[str]]
        Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
        cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
        their places: the body then goes as far as the elements at its foot allow.
    feature_angle : float, default 40
        Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
        degrees (0 to 180).
    slide_features : bool, default false
        In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
        staying.
    surface_first : bool, default false
        Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
        within them; without, all at once. For elements of the boundary that are as good as they can be
        by themselves.
    reference_surface : Optional[PathLike]
        In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
        mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
        stands for, or tangled.
    slide_spacing : Literal["auto", "held", "free"], default auto
        Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
        as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
        walls; free where they may go where the mesh draws them.
        'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
        long as high or more
        'held': For all sliding markers
        'free': For none
    hold_spacing : Union[str, Sequence[str]]
        Sliding markers whose spacing is held whatever is chosen for the others.
    hold_node : Sequence[int]
        Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
        mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
        probe.
    smooth_node : Sequence[int]
        Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
        turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
        the shape does not have.
    periodic : Sequence[Tuple[str, str]]
        Two markers of which one is the image of the other by a translation or a rotation: their nodes
        move together and keep matching; variational form only. The sides of a passage: they give way to
        a blade that turns.
    periodic_from_file : bool, default false
        Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
        of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
        configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
        instead.
    interfaces : Literal["auto", "held", "slide", "free"], default auto
        What nodes do in which regions of the mesh meet: the physical groups or references of its
        elements. Slide where elements beside an interface should get better and the interface must keep
        its shape.
        'auto': Held while a mesh is smoothed, free in a motion
        'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
        motion has it anyway
        'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
        mesh has there; corners and places where more than two regions meet stay
        'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
        anyway

    Other Parameters
    ----------------
    reference : Optional[MeshLike], default None
        Mesh of the same connectivity whose element shapes motions keep, in place of `mesh`: the mesh
        before the first of several motions.
    allow_incomplete : bool, default False
        Return the last valid mesh of a motion that could not be completed.
    hold_layers : Union[str, Sequence[str]], default ()
        Walls whose layers, as the mesh has them, keep their heights.
    min_quality : Optional[Dict[str, float]], default None
        Limits by the names of metrics: the motion ends before any element is worse.
    allow_inverted : bool, default False
        Return a mesh with inverted elements, too, instead of raising.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
    progress : Optional[Callable[[Iteration], Any]], default None
        Called with each iteration; returning False cancels, an exception ends the run and propagates.

    Returns
    -------
    Result

    Raises
    ------
    IncompleteMotion
        The result has inverted elements, or the motion could not be completed; has `result`.
    UsageError
        An unknown option, one out of range, or one that does not suit the mesh.
    Cancelled, NumericError, InputError
        The callback said so; no solution was found; a file that an option names cannot be read.
    """

def layers(
    mesh: MeshLike, markers: Optional[Names] = None, *, walls: Optional[Bodies] = None, columns: Optional[Dict[int,
    Dict[str, float]]] = None, y_plus: Optional[float] = None, reynolds: Optional[float] = None,
    reference_length: float = 1, count: int = 15, first: float = 0.001, ratio: float = 1.15, growth: float = 1.01,
    total: Optional[float] = None, match_outside: bool = False, task: Literal["insert", "respace", "hold"] = "insert",
    control: bool = True, height_tolerance: float = 0.002, most_corrections: int = 8, fans: bool = True,
    fan_threshold: float = 60, fan_angle: float = 50, clearance: float = 0.35, crossing: float = 0.35,
    steepest: float = 0.5, scale_all: bool = False, formulation: Literal["variational", "pointwise"] = "variational",
    targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
    raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
    untangle: Literal["auto", "picard", "energy"] = "auto",
    vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
    vcv_updates: int = 0,
    linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
    linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30, damping: float = 0.3,
    adapt_damping: bool = True, acceleration: int = 15, clip: Literal["auto", "on", "off"] = "auto",
    max_iterations: int = 1000, tolerance: Optional[float] = None, threads: int = 0,
    keep_outside_radius: Optional[float] = None, keep_outside_centre: Optional[Sequence[float]] = None,
    keep_outside_corner: Optional[Sequence[float]] = None, keep_outside_opposite: Optional[Sequence[float]] = None,
    slide: Union[str, Sequence[str]] = (), fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40,
    slide_features: bool = False, surface_first: bool = False, reference_surface: Optional[PathLike] = None,
    slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
    hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
    periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
    allow_inverted: bool = False, config: Optional[PathLike] = None,
    progress: Optional[Callable[[Iteration], Any]] = None
) -> Result:
    """Insert viscous layers at walls, or respace or hold those that a mesh has.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Walls.
    walls : sequence of dict
        Walls with heights of their own: `markers`, the options under Heights, and xmin, xmax, ymin,
        ymax for a part of the markers.
    columns : dict
        What single wall nodes are to have: {17: {"columns": 1, "thickness": 0.01}}.
    y_plus, reynolds, reference_length : float
        In place of `first`: the wanted y+ of the first node by the friction of a flat plate, with the
        Reynolds number of the reference length (1).

    Heights
    -------
    count : int, default 15
        Number of layers (1 to 1000).
    first : float, default 0.001
        Height of the layer at the wall, units of the mesh (more than 0).
    ratio : float, default 1.15
        Ratio of the second height to the first (0.5 to 10).
    growth : float, default 1.01
        Factor of the ratio from layer to layer (0.5 to 2).
    total : Optional[float]
        Thickness of all layers; gives the ratio, units of the mesh (more than 0).
    match_outside : bool, default false
        As many layers as it takes until the last is as high as the elements outside.

    Layers
    ------
    task : Literal["insert", "respace", "hold"], default insert
        What is done about layers.
        'insert': new layers: the one command that changes the connectivity
        'respace': the layers that the mesh has get other heights
        'hold': the layers that the mesh has keep their heights from here on
    control : bool, default true
        Ask for the heights through the virtual control volumes; off: smoothing spreads the layers as it
        likes.
    height_tolerance : float, default 0.002
        Relative error of a height above which the VCVs are corrected (more than 0).
    most_corrections : int, default 8
        Limit of smoothing runs after the first that correct heights (0 or more).
    fans : bool, default true
        Several columns at sharp convex corners, such as a trailing edge.
    fan_threshold : float, default 60
        Turning of the wall from which a corner gets a fan, degrees (10 to 180).
    fan_angle : float, default 50
        Angle between neighbouring columns of a fan, degrees (10 to 90).
    clearance : float, default 0.35
        Share of a gap's width that the layers of either side may take (more than 0, less than 0.5).
    crossing : float, default 0.35
        Share of a wall edge's length that has to be left of it at the rim of the layers (more than 0,
        less than 1).
    steepest : float, default 0.5
        Largest change of thickness along the wall, per length of wall (more than 0, at most 5).
    scale_all : bool, default false
        Where there is less room than asked, make all layers thinner, the first as well, instead of the
        outer ones.

    Smoothing
    ---------
    formulation : Literal["variational", "pointwise"], default variational
        Equations solved over the virtual control volumes.
        'variational': an energy with a barrier against inversion, minimised by Newton's method through
        valid meshes only
        'pointwise': the paper's operator, node by node, for comparison
    targets : Union[str, Dict[str, float]], default default
        Variational: shapes that the elements are driven towards, alone or blended.
        'default': keep for motions, auto for everything else
        'auto': regular elements where the mesh is isotropic, each element's own shape where it is
        stretched like its neighbours
        'element': equilateral triangles, square corners everywhere; for isotropic meshes only
        'vcv': the virtual control volumes, with their angles and edge lengths
        'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
        'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
        from becoming worse
    exponent : float, default 8
        Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
        count alike; larger: better worst elements, more iterations.
    knee : float, default 1.78
        Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
        than 1). Raise it to let well-shaped elements alone.
    raise_worst : bool, default false
        Variational: after the solution, make the worst element as good as it can be, at the expense of
        the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
        Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
        iterations, in drags too.
    outer : Literal["auto", "newton", "descent", "picard"], default auto
        Outer iteration.
        'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
        where that does not end converged
        'newton': Newton's method; boundary motions through valid meshes
        'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
        are slow; variational, volume meshes only
        'picard': the paper's damped iteration, coefficients frozen (pointwise only)
    untangle : Literal["auto", "picard", "energy"], default auto
        How inverted elements are untangled before Newton's method begins. Choose one of them if the
        other wastes time.
        'auto': scrambles by energy first, moved boundaries by picard, then the other
        'picard': the paper's damped iteration, negative weights clipped
        'energy': the variational form with a regularised determinant
    vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
        Pointwise form and targets vcv: virtual control volumes of the interior nodes.
        'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
        'equal': each triangle of a star has the same angle
        'existing': the solid angles of the mesh as given; volume meshes only
        'adjusted': the mean of equal and existing solid angles; volume meshes only
        'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
        meshes only
    vcv_lengths : float, default 0
        VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
        unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
        draws nodes to a body, or where sizes jump.
    vcv_updates : int, default 0
        Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
        the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
        mesh as given is tangled.
    linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
        How the linear systems are solved; the converged mesh is the same.
        'automatic': The fastest for the size and the symmetry of the matrix.
        'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
        'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
        'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
        'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
        'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
    linear_tolerance : float, default 0.001
        Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
        outer iteration corrects what is left, and Newton's method on the energy chooses its own between
        1e-2 and 1e-6: tighten it only if outer iterations stall.
    linear_max_iterations : int, default 200
        Limit of sweeps or Krylov iterations for one linear system (1 or more).
    linear_restart : int, default 30
        Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
        memory.
    damping : float, default 0.3
        Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
        safer and slower: lower it where the iteration swings or the mesh does not untangle.
    adapt_damping : bool, default true
        Fixed point: halve the damping where the iteration makes no progress.
    acceleration : int, default 15
        Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
        plain iteration of the paper (0 to 100).
    clip : Literal["auto", "on", "off"], default auto
        Fixed point: whether negative weights of the operator are set to zero. Without them no node is
        drawn out of its neighbours.
        'auto': while the mesh is tangled
        'on': in every iteration
        'off': not at all
    max_iterations : int, default 1000
        Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
        attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
    tolerance : Optional[float], default 1e-10; volume meshes: 1e-4
        Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
        is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
        too.
    threads : int, default 0
        Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
    keep_outside_radius : Optional[float]
        Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
        For a change near a body in a large mesh.
    keep_outside_centre : Optional[Sequence[float]]
        Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
        bounding box of all that moves, or of the walls that get layers, units of the mesh.
    keep_outside_corner : Optional[Sequence[float]]
        Nodes outside the box with this corner and the one opposite stay where they are, units of the
        mesh.
    keep_outside_opposite : Optional[Sequence[float]]
        Of the box outside which nodes stay, units of the mesh.
    slide : Union[str, Sequence[str]]
        Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
        variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
        draws the mesh along.
    fixed : Union[str, Sequence[str]]
        Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
        cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
        their places: the body then goes as far as the elements at its foot allow.
    feature_angle : float, default 40
        Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
        degrees (0 to 180).
    slide_features : bool, default false
        In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
        staying.
    surface_first : bool, default false
        Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
        within them; without, all at once. For elements of the boundary that are as good as they can be
        by themselves.
    reference_surface : Optional[PathLike]
        In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
        mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
        stands for, or tangled.
    slide_spacing : Literal["auto", "held", "free"], default auto
        Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
        as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
        walls; free where they may go where the mesh draws them.
        'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
        long as high or more
        'held': For all sliding markers
        'free': For none
    hold_spacing : Union[str, Sequence[str]]
        Sliding markers whose spacing is held whatever is chosen for the others.
    hold_node : Sequence[int]
        Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
        mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
        probe.
    smooth_node : Sequence[int]
        Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
        turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
        the shape does not have.
    periodic : Sequence[Tuple[str, str]]
        Two markers of which one is the image of the other by a translation or a rotation: their nodes
        move together and keep matching; variational form only. The sides of a passage: they give way to
        a blade that turns.
    periodic_from_file : bool, default false
        Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
        of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
        configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
        instead.
    interfaces : Literal["auto", "held", "slide", "free"], default auto
        What nodes do in which regions of the mesh meet: the physical groups or references of its
        elements. Slide where elements beside an interface should get better and the interface must keep
        its shape.
        'auto': Held while a mesh is smoothed, free in a motion
        'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
        motion has it anyway
        'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
        mesh has there; corners and places where more than two regions meet stay
        'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
        anyway

    Other Parameters
    ----------------
    allow_inverted : bool, default False
        Return a mesh with inverted elements, too, instead of raising.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
    progress : Optional[Callable[[Iteration], Any]], default None
        Called with each iteration; returning False cancels, an exception ends the run and propagates.

    Returns
    -------
    Result

    Raises
    ------
    IncompleteMotion
        The result has inverted elements, or the motion could not be completed; has `result`.
    UsageError
        An unknown option, one out of range, or one that does not suit the mesh.
    Cancelled, NumericError, InputError
        The callback said so; no solution was found; a file that an option names cannot be read.
    """

def scramble(
    mesh: MeshLike, *, seed: int = 1, allow_inverted: bool = False, config: Optional[PathLike] = None,
    progress: Optional[Callable[[Iteration], Any]] = None
) -> Result:
    """Put every interior node at a random place: a test of smoothing (needs allow_inverted=True).

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).

    Options
    -------
    seed : int, default 1
        Seed of the random numbers: another seed, other random places (0 or more).

    Other Parameters
    ----------------
    allow_inverted : bool, default False
        Return a mesh with inverted elements, too, instead of raising.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.
    progress : Optional[Callable[[Iteration], Any]], default None
        Called with each iteration; returning False cancels, an exception ends the run and propagates.

    Returns
    -------
    Result

    Raises
    ------
    IncompleteMotion
        The result has inverted elements, or the motion could not be completed; has `result`.
    UsageError
        An unknown option, one out of range, or one that does not suit the mesh.
    Cancelled, NumericError, InputError
        The callback said so; no solution was found; a file that an option names cannot be read.
    """

def replay(
    recipe: PathLike, mesh: MeshLike, **options: Any
) -> Result:
    """Apply the commands of a recipe (docs/recipes.md) to a mesh, in order.

    Parameters
    ----------
    recipe : str or os.PathLike
        The recipe, JSON.
    mesh : Mesh
        The mesh to start from, as of `smooth`.
    **options
        reference, config, progress, allow_inverted, allow_incomplete, as of `move`.

    Returns
    -------
    Result
    """

def sweep(
    mesh: MeshLike, markers: Optional[Names] = None, *, rotate: Optional[Sequence[float]] = None,
    translate: Optional[Sequence[Sequence[float]]] = None, steps: Optional[Sequence[Any]] = None, jobs: int = 1,
    on_step: Optional[Callable[[Step], Any]] = None, keep: bool = True, axis: Optional[Sequence[float]] = None,
    pivot: Optional[Sequence[float]] = None, increments: int = 0, smooth_after: bool = True,
    formulation: Literal["variational", "pointwise"] = "variational",
    targets: Union[str, Dict[str, float]] = "default", exponent: float = 8, knee: float = 1.78,
    raise_worst: bool = False, outer: Literal["auto", "newton", "descent", "picard"] = "auto",
    untangle: Literal["auto", "picard", "energy"] = "auto",
    vcv: Literal["auto", "equal", "existing", "adjusted", "perturbation"] = "auto", vcv_lengths: float = 0,
    vcv_updates: int = 0,
    linear: Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"] = "automatic",
    linear_tolerance: float = 0.001, linear_max_iterations: int = 200, linear_restart: int = 30, damping: float = 0.3,
    adapt_damping: bool = True, acceleration: int = 15, clip: Literal["auto", "on", "off"] = "auto",
    max_iterations: int = 1000, tolerance: Optional[float] = None, threads: int = 0,
    keep_outside_radius: Optional[float] = None, keep_outside_centre: Optional[Sequence[float]] = None,
    keep_outside_corner: Optional[Sequence[float]] = None, keep_outside_opposite: Optional[Sequence[float]] = None,
    slide: Union[str, Sequence[str]] = (), fixed: Union[str, Sequence[str]] = (), feature_angle: float = 40,
    slide_features: bool = False, surface_first: bool = False, reference_surface: Optional[PathLike] = None,
    slide_spacing: Literal["auto", "held", "free"] = "auto", hold_spacing: Union[str, Sequence[str]] = (),
    hold_node: Sequence[int] = (), smooth_node: Sequence[int] = (), periodic: Sequence[Tuple[str, str]] = (),
    periodic_from_file: bool = False, interfaces: Literal["auto", "held", "slide", "free"] = "auto",
    reference: Optional[MeshLike] = None, allow_incomplete: bool = False, hold_layers: Union[str, Sequence[str]] = (),
    min_quality: Optional[Dict[str, float]] = None, config: Optional[PathLike] = None
) -> List[Step]:
    """Move bodies to many places, each from the mesh as given.

    Steps begin from the mesh of their nearest neighbour, so that each needs two or three linear solves.
    The results depend neither on the order nor on `jobs`.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move together.
    rotate : sequence of float
        Angles, degrees.
    translate : sequence of vectors
        Shifts. All combinations of angles and shifts are steps, those of the angles next to each other.
    steps : sequence
        In place of these: a list of bodies for each step, as `bodies` of `move`.
    jobs : int
        Steps at once, each on one thread; 0: all cores.
    on_step : callable
        Called with each `Step` as soon as it has ended, one at a time, from another thread than the
        caller's. Returning False ends the sweep; an exception does, too, and propagates.
    keep : bool
        Whether the steps that are returned keep their meshes: False saves memory where `on_step` has
        done with them.

    Motion
    ------
    axis : Optional[Sequence[float]]
        Direction of the axis through the pivot, for volume meshes: the rotation is counter-clockwise
        seen from where it points to.
    pivot : Optional[Sequence[float]]
        Point about which it turns; not given: the centre of the bounding box of all that moves, units
        of the mesh.
    increments : int, default 0
        Steps in which the boundary moves, each followed by smoothing; 0: along the path of valid
        meshes, in steps as long as they can be (fixed point: at once and, if that ends tangled, in 8
        and then in 32 steps); 1: at once, as in the paper (0 to 1e+06).
    smooth_after : bool, default true
        Smooth the interior after the boundary has moved.

    Smoothing
    ---------
    formulation : Literal["variational", "pointwise"], default variational
        Equations solved over the virtual control volumes.
        'variational': an energy with a barrier against inversion, minimised by Newton's method through
        valid meshes only
        'pointwise': the paper's operator, node by node, for comparison
    targets : Union[str, Dict[str, float]], default default
        Variational: shapes that the elements are driven towards, alone or blended.
        'default': keep for motions, auto for everything else
        'auto': regular elements where the mesh is isotropic, each element's own shape where it is
        stretched like its neighbours
        'element': equilateral triangles, square corners everywhere; for isotropic meshes only
        'vcv': the virtual control volumes, with their angles and edge lengths
        'rest': each element's own shape before the motion, to keep a graded or stretched mesh as it is
        'keep': each element's own shape in the reference mesh, and guards that keep the worst elements
        from becoming worse
    exponent : float, default 8
        Variational: power by which distortion beyond the knee is penalised (1 to 64). 1: all elements
        count alike; larger: better worst elements, more iterations.
    knee : float, default 1.78
        Variational: distortion (1 is perfect) from which the power counts; 0: everywhere (0 or more
        than 1). Raise it to let well-shaped elements alone.
    raise_worst : bool, default false
        Variational: after the solution, make the worst element as good as it can be, at the expense of
        the others. Of quadrilaterals and hexahedra with regular targets this is the smallest scaled
        Jacobian; where targets keep elements stretched there may be nothing to gain. Takes many more
        iterations, in drags too.
    outer : Literal["auto", "newton", "descent", "picard"], default auto
        Outer iteration.
        'auto': newton, after descent in volume meshes of 2,000 free nodes or more; pointwise: picard
        where that does not end converged
        'newton': Newton's method; boundary motions through valid meshes
        'descent': first-order steps (L-BFGS) to the solution, or near it: newton goes on where these
        are slow; variational, volume meshes only
        'picard': the paper's damped iteration, coefficients frozen (pointwise only)
    untangle : Literal["auto", "picard", "energy"], default auto
        How inverted elements are untangled before Newton's method begins. Choose one of them if the
        other wastes time.
        'auto': scrambles by energy first, moved boundaries by picard, then the other
        'picard': the paper's damped iteration, negative weights clipped
        'energy': the variational form with a regularised determinant
    vcv : Literal["auto", "equal", "existing", "adjusted", "perturbation"], default auto
        Pointwise form and targets vcv: virtual control volumes of the interior nodes.
        'auto': adjusted ones of a volume mesh, equal ones of a plane mesh and of one with polyhedra
        'equal': each triangle of a star has the same angle
        'existing': the solid angles of the mesh as given; volume meshes only
        'adjusted': the mean of equal and existing solid angles; volume meshes only
        'perturbation': adjusted ones, found by the paper's random perturbation, for comparison; volume
        meshes only
    vcv_lengths : float, default 0
        VCVs of volume meshes: power of the edge lengths of the mesh as given that their edges have; 0:
        unit edges, 1: those of the mesh (0 to 1). Raise it to 0.25 or 0.5 where the pointwise form
        draws nodes to a body, or where sizes jump.
    vcv_updates : int, default 0
        Adjusted VCVs of volume meshes: how often, at most, they are worked out anew from the mesh that
        the run has led to; 0: from the mesh as given alone (0 to 1000). They are in any case where the
        mesh as given is tangled.
    linear : Literal["automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"], default automatic
        How the linear systems are solved; the converged mesh is the same.
        'automatic': The fastest for the size and the symmetry of the matrix.
        'direct': Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.
        'cg': Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.
        'multigrid': Conjugate gradients with multigrid: for large meshes; symmetric systems only.
        'gmres': Restarted GMRES with incomplete LU: less memory than direct on large meshes.
        'point-implicit': Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.
    linear_tolerance : float, default 0.001
        Relative residual at which an iterative linear solver stops (more than 0, less than 1). The
        outer iteration corrects what is left, and Newton's method on the energy chooses its own between
        1e-2 and 1e-6: tighten it only if outer iterations stall.
    linear_max_iterations : int, default 200
        Limit of sweeps or Krylov iterations for one linear system (1 or more).
    linear_restart : int, default 30
        Krylov vectors that GMRES keeps before it restarts (1 or more). More: fewer iterations, more
        memory.
    damping : float, default 0.3
        Fixed point: share of each linear solution that is taken (more than 0, at most 1). Smaller is
        safer and slower: lower it where the iteration swings or the mesh does not untangle.
    adapt_damping : bool, default true
        Fixed point: halve the damping where the iteration makes no progress.
    acceleration : int, default 15
        Fixed point: earlier iterates that Anderson acceleration combines once the mesh is valid; 0: the
        plain iteration of the paper (0 to 100).
    clip : Literal["auto", "on", "off"], default auto
        Fixed point: whether negative weights of the operator are set to zero. Without them no node is
        drawn out of its neighbours.
        'auto': while the mesh is tangled
        'on': in every iteration
        'off': not at all
    max_iterations : int, default 1000
        Limit of outer iterations: variational: of all stages of a command together; pointwise: of each
        attempt at a motion (0 or more). Raise it if a run ends valid but not converged.
    tolerance : Optional[float], default 1e-10
        Largest scaled residual at which the mesh counts as converged (more than 0, less than 1). 1e-4
        is enough for the eye. Drags and sweeps begin from other meshes and take 1e-10 in volume meshes
        too.
    threads : int, default 0
        Threads; 0: all cores, or one under MPI. The result does not depend on it (0 to 4096).
    keep_outside_radius : Optional[float]
        Nodes farther than this from the centre stay where they are, units of the mesh (more than 0).
        For a change near a body in a large mesh.
    keep_outside_centre : Optional[Sequence[float]]
        Of the circle, in space the sphere, outside which nodes stay; not given: the centre of the
        bounding box of all that moves, or of the walls that get layers, units of the mesh.
    keep_outside_corner : Optional[Sequence[float]]
        Nodes outside the box with this corner and the one opposite stay where they are, units of the
        mesh.
    keep_outside_opposite : Optional[Sequence[float]]
        Of the box outside which nodes stay, units of the mesh.
    slide : Union[str, Sequence[str]]
        Markers whose nodes may slide along the boundary, which keeps its shape: corners stay;
        variational form only. Far fields, walls of a channel and planes of symmetry that a moving body
        draws the mesh along.
    fixed : Union[str, Sequence[str]]
        Markers that stay where a moving body stands on them; without, straight lines, circles, planes,
        cylinders and spheres give way: their nodes slide. Where the nodes of such a marker must keep
        their places: the body then goes as far as the elements at its foot allow.
    feature_angle : float, default 40
        Where a sliding marker turns by more than this is a corner, which stays, in space an edge,
        degrees (0 to 180).
    slide_features : bool, default false
        In space: nodes slide along the edges of sliding markers and of surface meshes, instead of
        staying.
    surface_first : bool, default false
        Smoothing a volume mesh: sliding markers are smoothed as surface meshes, then the interior
        within them; without, all at once. For elements of the boundary that are as good as they can be
        by themselves.
    reference_surface : Optional[PathLike]
        In space: a surface mesh, from CAD or a scan, that nodes slide on instead of the surface of the
        mesh as given; they are put onto it first. Where the mesh is coarser than the shape that it
        stands for, or tangled.
    slide_spacing : Literal["auto", "held", "free"], default auto
        Whether the edges of a sliding curve keep their shares of its length: a closed curve then turns
        as a whole, others follow their ends. Held where nodes are clustered, as at leading edges and
        walls; free where they may go where the mesh draws them.
        'auto': Held for walls: markers around a body, and those whose elements are flat, three times as
        long as high or more
        'held': For all sliding markers
        'free': For none
    hold_spacing : Union[str, Sequence[str]]
        Sliding markers whose spacing is held whatever is chosen for the others.
    hold_node : Sequence[int]
        Nodes that stay where they are, of the boundary or inside; counted from 0 in the order of the
        mesh file (0 or more). Where a node would slide that belongs to a place: a trailing edge, a
        probe.
    smooth_node : Sequence[int]
        Nodes of sliding markers and of surface meshes that are no corners, however much the boundary
        turns there: they slide on what runs through them (0 or more). For a kink of a coarse mesh that
        the shape does not have.
    periodic : Sequence[Tuple[str, str]]
        Two markers of which one is the image of the other by a translation or a rotation: their nodes
        move together and keep matching; variational form only. The sides of a passage: they give way to
        a blade that turns.
    periodic_from_file : bool, default false
        Take all periodic pairs that the mesh file names: $Periodic of Gmsh, NPERIODIC= and SEND_RECEIVE
        of SU2, Periodic_t of CGNS; winslow quality lists them. SU2 of today names them in its
        configuration file (MARKER_PERIODIC=) and not in the mesh: choose these two markers as a pair
        instead.
    interfaces : Literal["auto", "held", "slide", "free"], default auto
        What nodes do in which regions of the mesh meet: the physical groups or references of its
        elements. Slide where elements beside an interface should get better and the interface must keep
        its shape.
        'auto': Held while a mesh is smoothed, free in a motion
        'held': Nodes in which regions of the mesh meet stay where they are, as smoothing without a
        motion has it anyway
        'slide': Nodes in which regions of the mesh meet slide along the curve or the surface that the
        mesh has there; corners and places where more than two regions meet stay
        'free': Nodes in which regions of the mesh meet move as any other node, as motions have it
        anyway

    Other Parameters
    ----------------
    reference : Optional[MeshLike], default None
        Mesh of the same connectivity whose element shapes motions keep, in place of `mesh`: the mesh
        before the first of several motions.
    allow_incomplete : bool, default False
        Return the last valid mesh of a motion that could not be completed.
    hold_layers : Union[str, Sequence[str]], default ()
        Walls whose layers, as the mesh has them, keep their heights.
    min_quality : Optional[Dict[str, float]], default None
        Limits by the names of metrics: the motion ends before any element is worse.
    config : Optional[PathLike], default None
        Configuration file of SU2: its markers of symmetry slide, its periodic ones move together.

    Returns
    -------
    list of Step
        In the order of the steps. A step that fails does not end the others and raises nothing.

    Raises
    ------
    UsageError
        Before anything is solved: an option out of range, a step that is no motion of this mesh.
    Cancelled
        `on_step` returned False.
    """

def quality(
    mesh: MeshLike, *, worst: int = 10, bins: int = 20, threads: int = 0
) -> Quality:
    """Measure a mesh.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    worst : int
        How many of the worst elements to list for each metric.
    bins : int
        Bins of the histograms.
    threads : int
        Threads; 0: all cores.

    Returns
    -------
    Quality
        A dict as `winslow quality --report` writes it.
    """

def values(
    mesh: MeshLike, field: str, *, before: Optional[MeshLike] = None
) -> Reals:
    """A number for each element.

    Parameters
    ----------
    mesh : Mesh
        As of `quality`.
    field : str
        "normalized_jacobian", "aspect_ratio", ...: `fields(mesh)` lists them.
    before : Mesh, optional
        An earlier mesh, for "first_height_ratio".

    Returns
    -------
    numpy.ndarray (elements,) float64
        NaN for elements without a value.
    """

def fields(
    mesh: MeshLike
) -> List[str]:
    """The names that `values` and the colours of pictures take for a mesh: a list of str."""

def render(
    mesh: MeshLike, path: Optional[PathLike] = None, **options: Any
) -> Optional[bytes]:
    """Draw a mesh as a picture. Inverted elements are red.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    path : str or os.PathLike, optional
        File to write: .png, .svg or .pdf. None: the bytes of a PNG are returned.
    size : (int, int), default (1200, 900)
        Width and height in pixels.
    color : str
        Colour elements by a field, one of `fields(mesh)`; "none": plain, the default of plane meshes.
    range, percentiles : (float, float)
        Values at the ends of the colours; or percentiles of the values.
    map : str, default "automatic"
        Colours: viridis, cividis, glacier, plasma, magma, inferno, neutral, puor.
    axis : str, default "automatic"
        Spread the colours over differences ("linear") or ratios ("log") of values.
    title : str
        Line above the picture.
    dark, wireframe, legend : bool
        Dark background; edges of elements; colour bar.
    vcv : sequence of int
        Nodes whose virtual control volumes are drawn over the mesh.
    bounds : (float, float, float, float)
        Plane meshes: x0, y0, x1, y1 of the part to show.
    view : str
        Meshes in space: the side that they are seen from.
    up : str, default "z"
        Axis that is up on screen.
    azimuth, elevation : float
        Degrees, in place of those of `view`.
    perspective : bool
    centre : (float, float, float)
        Point in the middle of the picture.
    half_width : float
        Half of the width that is shown.
    cuts : sequence of (point, normal)
        Volume meshes: planes; what their normals point to is taken away. []: no cut. Default: through
        the middle of the bodies.
    crinkle : bool
        Cuts leave whole elements.
    isolate : float
        Show whole the elements whose field is worse than this.
    show, hide, see_through : str or sequence of str
        Markers to draw alone, not at all, or so that one sees through.

    Returns
    -------
    bytes or None
        A PNG; None where a file was written.

    Raises
    ------
    UsageError
        An option that is unknown, out of range, or not for this kind of mesh.
    Error
        There is no OpenGL (EGL), or the build has no graphics.
    """

def plot(
    mesh: MeshLike, **options: Any
) -> Picture:
    """The mesh as a picture that a notebook shows: `render` with its options."""

def as_mesh(
    value: MeshLike, show: bool = False
) -> Mesh:
    """A mesh from what a function was given: a mesh, a file, a foreign mesh, or (points, cells[, sets]).

    show: as of `read`.
    """

def from_meshio(
    m: Any
) -> Mesh:
    """A mesh from a meshio mesh.

    Cell sets of lines (in volume meshes of triangles and quads) become markers, sets of elements
    regions; without sets the names of `field_data` with "gmsh:physical" do. Points with one z are a
    plane mesh. All sets, data and the order of the cells are kept for `to_meshio()`.

    Parameters
    ----------
    m : meshio.Mesh
        Or anything with `points`, `cells`, `cell_sets`, `cell_data`, `point_data`.

    Returns
    -------
    Mesh
    """

def to_meshio(
    mesh: Mesh
) -> Any:
    """The mesh as a `meshio.Mesh`: with everything that came with it, if it came from one."""

def from_pyvista(
    grid: Any
) -> Mesh:
    """A mesh from a `pyvista.UnstructuredGrid`.

    Markers are the lines (in volume meshes the triangles, quads and polygons) of the grid by the cell
    array `marker`, with names from the field arrays `marker:NAME`, as winslow writes them to VTK files;
    else by `gmsh:physical` or `CellEntityIds`. Regions likewise. All arrays are kept for `to_pyvista()`.

    Parameters
    ----------
    grid : pyvista.UnstructuredGrid
        Or anything with `points`, `cells`, `celltypes`, `point_data`, `cell_data` in VTK's layout.

    Returns
    -------
    Mesh
    """

def to_pyvista(
    mesh: Mesh
) -> Any:
    """The mesh as a `pyvista.UnstructuredGrid`: with everything that came with it, if it came from one."""
