#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/motion/rigid_motion.h"
#include "core/options/option.h"

namespace winslow {

/// A node that a motion takes along with other nodes: an image across periodic sides, a node
/// between the ends of a row. If the leaders move by d_i, the node moves by the sum of map_i d_i,
/// to first order.
struct TakenNode {
  struct Leader {
    Index node;
    Eigen::Matrix3d map;
  };
  Index node = -1;
  std::vector<Leader> leaders = {};
};

/// A prescribed motion of nodes, on the boundary or inside.
class Motion {
 public:
  virtual ~Motion() = default;
  /// Nodes that move, ascending.
  virtual std::span<const Index> nodes() const = 0;
  /// Writes the positions of nodes() at `fraction` (0 to 1) of the motion. `rest`: all nodes before
  /// the motion. Rotations are interpolated as rotations.
  virtual void apply(const Coordinates& rest, double fraction, Coordinates& out) const = 0;
  /// False if every node stays where it is, at every fraction. (A rotation by 360 degrees moves.)
  virtual bool moves() const { return true; }
  /// The motion of the bodies alone, without nodes between them that move along.
  virtual const Motion& of_bodies() const { return *this; }
  /// Those of nodes() that go along with others, at the mesh x at the end of the motion. Leaders
  /// that are taken themselves come first.
  virtual std::vector<TakenNode> taken(const Coordinates& /*x*/) const { return {}; }
  /// The motion if all nodes move as one rigid body: complete, see resolve_motion(). Null: they do
  /// not.
  virtual const RigidMotion* rigid() const { return nullptr; }
  /// The motions of the single bodies; empty if there is only one body.
  virtual std::span<const std::unique_ptr<Motion>> bodies() const { return {}; }
};

/// Markers that move together as one rigid body.
struct MovingBody {
  std::vector<std::string> markers;
  RigidMotion motion;

  bool operator==(const MovingBody&) const = default;
};

enum class Fade { none, start, end, both };

/// x -> x + amplitude f(s) sin(2 pi waves s) direction. s in [0, 1] runs along the body at right
/// angles to `direction` (for direction (0, 1): from its smallest x to its largest). f decreases
/// smoothly from 1 to 0 over `fade_length` at the chosen ends.
///
/// In space s runs along `along`, over the extent of the body in that direction; the displacement
/// is constant at right angles to it. The default of `along` is the cross product of direction and
/// (0, 0, 1), as in the plane; it is undefined for a direction along z.
struct SineDeformation {
  double amplitude = 0;         ///< in units of the mesh
  double waves = 1;             ///< full periods over the body
  GivenVector direction{0, 1};  ///< of the displacement; need not be normalised
  Fade fade = Fade::none;
  double fade_length = 0.2;        ///< share of the body's length, (0, 0.5]
  std::optional<Vec3> along = {};  ///< in space, of any length but zero

  bool operator==(const SineDeformation&) const = default;
};

/// Make the motions of plane and volume meshes. Each throws UsageError for no marker, an unknown
/// marker, an amplitude that is not finite, a wrong number of components, ... Tables of single
/// nodes: see node_table.h.
///
/// A rigid motion without a pivot rotates about body_centre() of its markers.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options);
/// A number of a SineDeformation.
enum class SineParameter { amplitude, waves };

/// The velocities of the nodes of the markers (#nodes by 2 or 3; zero at all others) per unit of a
/// number of the deformation. rest, and what it throws: as of make_motion().
Coordinates sine_velocities(const Topology& topology, const Coordinates& rest,
                            const std::vector<std::string>& markers, const SineDeformation& options,
                            SineParameter parameter);
/// Moves nodes in straight lines. nodes: ascending. ways: how far each of them moves. ends: where
/// each is after the whole motion, to the bit; empty: where its way ends.
template <int D>
std::unique_ptr<Motion> straight_motion(std::vector<Index> nodes, std::vector<Vec<D>> ways,
                                        std::vector<Vec<D>> ends = {});

/// Makes the simultaneous motion of bodies: at each fraction every body has gone that far along its
/// own arc. Throws UsageError as above, for no body, for a marker of two bodies, and, naming the
/// markers, for a node that two bodies share and would take to different places on their way.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    std::span<const MovingBody> bodies);

/// The nodes of the markers that move, ascending. Throws UsageError if there is no marker, an
/// unknown one, or no node.
std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers);
/// t^2 (3 - 2 t), but 0 at t < 0 and 1 at t > 1: a step with a continuous slope.
double smooth_step(double t);
/// Throws UsageError unless the number is finite. what: begins the message, e.g. "the amplitude".
void require_finite(double value, const char* what);

/// All options of a motion except the markers that move.
OptionTable option_table(RigidMotion& motion);
OptionTable option_table(SineDeformation& sine);

}  // namespace winslow
