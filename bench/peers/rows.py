"""What is measured: the meshes, and the rows of the table."""
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Motion:
    """A rigid motion of markers that move together; vectors have as many numbers as the mesh has dimensions."""

    markers: tuple
    rotate: float  # degrees
    pivot: tuple
    translate: tuple
    axis: tuple = ()  # of motions in space

    def flags(self):
        """The options of winslow move and of elastic_move."""
        out = [word for marker in self.markers for word in ("--marker", marker)]
        out += ["--rotate", self.rotate, "--pivot", *self.pivot, "--translate", *self.translate]
        return [str(word) for word in (*out, *(("--axis", *self.axis) if self.axis else ()))]


@dataclass(frozen=True)
class Mesh:
    """made: name for assets/make_volumes.py; bundled: file below assets. scrambled: its interior nodes are then put
    at random places, always the same."""

    made: str = ""
    bundled: str = ""
    scrambled: bool = False
    volume: bool = True
    tetrahedra: bool = True  # and nothing else; of a volume mesh


@dataclass(frozen=True)
class Row:
    """A run of winslow, and what is known of it. motion: None smooths."""

    name: str
    what: str
    mesh: Mesh
    motion: Motion = None
    options: tuple = ()        # of winslow
    increments: tuple = (1, 5, 10, 50)  # of elasticity
    wall: str = ""             # marker at which the heights of the first layer are measured
    quick: bool = False        # on a bundled mesh, in a second
    peers: tuple = field(default=("elasticity", "gmsh", "openfoam"))


def about_z(marker, degrees, shift=(0, 0, 0)):
    return Motion((marker,), degrees, (0, 0, 0), shift, (0, 0, 1))


SPHERE_60K = Mesh(made="volumes/sphere")
SPHERE_15K = Mesh(made="volumes/sphere_15k")
CUBE = Mesh(made="volumes/cube")
WING = Mesh(made="volumes/wing")
MILLION = Mesh(made="volumes/sphere_1m")
TIGHT_BOX = Mesh(made="volumes/tight_box")
NACA = Mesh(bundled="naca0012.su2", volume=False)
THREE = Mesh(bundled="three_element.su2", volume=False)
COARSE_SPHERE = Mesh(bundled="coarse/sphere.su2.gz", made="coarse/sphere")
COARSE_SCRAMBLED = Mesh(bundled="coarse/sphere.su2.gz", scrambled=True)
COARSE_NACA = Mesh(bundled="coarse/naca0012.su2", volume=False)

FLAP_HINGE = Motion(("flap",), -15, (0.848, -0.036, 0), (0, 0, 0), (0.2755, 0.018, 1.5))
SECTION = ("slat", "main", "flap")


def layer_row(first, layers):
    mesh = Mesh(made=f"volumes/layers_{first}", tetrahedra=False)
    return Row(f"layers-{first}", f"sphere with {layers} layers of prisms, the first {first} high: 45 degrees and half "
               "its radius", mesh, about_z("sphere", 45, (0.5, 0, 0)), wall="sphere")


ROWS = [
    Row("coarse-smooth", "coarse sphere, smoothed", COARSE_SPHERE, quick=True),
    Row("coarse-90", "coarse sphere, 90 degrees and its radius", COARSE_SPHERE, about_z("sphere", 90, (1, 0, 0)),
        increments=(1, 5), quick=True),
    Row("coarse-scrambled", "coarse sphere, scrambled, smoothed", COARSE_SCRAMBLED, quick=True, peers=()),
    Row("coarse-plane-90", "coarse NACA 0012, 90 degrees and moved", COARSE_NACA,
        Motion(("airfoil",), 90, (0.5, 0), (0.5, 0.3)), increments=(1, 5), quick=True),
    Row("sphere-element", "sphere, smoothed, --targets element", SPHERE_60K, options=("--targets", "element"),
        peers=()),
    Row("sphere-auto", "sphere, smoothed", SPHERE_60K, options=("--targets", "auto")),
    Row("sphere-90", "sphere, 90 degrees and its radius", SPHERE_60K, about_z("sphere", 90, (1, 0, 0))),
    Row("sphere-180", "sphere, 180 degrees", SPHERE_60K, about_z("sphere", 180)),
    Row("sphere-scrambled", "sphere, scrambled, smoothed", Mesh(made="volumes/sphere", scrambled=True), peers=()),
    Row("sphere-15k-90", "smaller sphere, 90 degrees and its radius", SPHERE_15K, about_z("sphere", 90, (1, 0, 0))),
    Row("cube-45", "cube, 45 degrees", CUBE, about_z("cube", 45)),
    Row("cube-90", "cube, 90 degrees", CUBE, about_z("cube", 90)),
    Row("box-90", "ellipsoid in a tight box, 90 degrees", TIGHT_BOX, about_z("body", 90)),
    Row("box-90-1", "ellipsoid in a tight box, 90 degrees and 1", TIGHT_BOX, about_z("body", 90, (1, 0, 0))),
    Row("box-180", "ellipsoid in a tight box, 180 degrees", TIGHT_BOX, about_z("body", 180)),
    layer_row("1e-3", 12),
    layer_row("1e-4", 16),
    layer_row("1e-5", 20),
    Row("wing-smooth", "wing, smoothed", WING),
    Row("wing-smooth-1", "wing, smoothed on one thread", WING, options=("--threads", "1"), peers=()),
    Row("wing-flap", "wing, flap by 15 degrees", WING, FLAP_HINGE, increments=(1, 5)),
    Row("million-smooth", "sphere of a million nodes, smoothed", MILLION, peers=()),
    Row("million-45", "sphere of a million nodes, 45 degrees and half its radius", MILLION,
        about_z("sphere", 45, (0.5, 0, 0)), increments=(1, 5)),
    Row("naca-90", "plane: NACA 0012, 90 degrees and moved", NACA, Motion(("airfoil",), 90, (0.5, 0), (0.5, 0.3))),
    Row("naca-178", "plane: NACA 0012, 178 degrees", NACA, Motion(("airfoil",), 178, (0.5, 0), (0, 0))),
    Row("three-90", "plane: three elements, 90 degrees and moved", THREE, Motion(SECTION, 90, (0.5, 0), (0.5, 0.3))),
    Row("three-178", "plane: three elements, 178 degrees", THREE, Motion(SECTION, 178, (0.5, 0), (0, 0))),
    Row("three-flap", "plane: flap of three elements, -40 degrees and moved", THREE,
        Motion(("flap",), -40, (0.862, -0.015), (0.02, -0.02))),
]

# Rows of the same command on meshes of several sizes: CPU over nodes gives an exponent.
SIZES = ("sphere-auto", "wing-smooth", "million-smooth")
# The same run on all threads and on one: wall times give the scaling.
THREADS = ("wing-smooth", "wing-smooth-1")
