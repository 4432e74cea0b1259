#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/motion/rigid_motion.h"
#include "core/options/option.h"

namespace winslow {

/// A prescribed motion of boundary nodes.
class Motion {
 public:
  virtual ~Motion() = default;
  /// Nodes that move, ascending.
  virtual std::span<const Index> nodes() const = 0;
  /// Writes the positions of nodes() when `fraction` (0 to 1) of the motion is done. `rest`: all
  /// nodes before the motion. Rotations are followed as rotations.
  virtual void apply(const Coordinates& rest, double fraction, Coordinates& out) const = 0;
  /// The same without what goes along with the bodies because it lies between them.
  virtual const Motion& of_bodies() const { return *this; }
  /// The motions of single bodies that make up this one; empty: it is that of one body.
  virtual std::span<const std::unique_ptr<Motion>> bodies() const { return {}; }
};

/// What moves as one rigid body.
struct MovingBody {
  std::vector<std::string> markers;
  RigidMotion motion;

  bool operator==(const MovingBody&) const = default;
};

enum class Fade { none, start, end, both };

/// x -> x + amplitude f(s) sin(2 pi waves s) direction, where s in [0, 1] runs along the body at
/// right angles to `direction` (for direction (0, 1): from its smallest x to its largest) and f
/// fades smoothly from 1 to 0 over `fade_length` at the chosen ends.
///
/// In space s runs along `along`, from where the body begins to where it ends in that direction,
/// and the displacement does not change at right angles to it. Without `along` it is direction x
/// (0, 0, 1), which for a direction in the plane z = 0 is the way it runs in the plane; a direction
/// along z leaves that open.
struct SineDeformation {
  double amplitude = 0;         ///< in units of the mesh
  double waves = 1;             ///< full periods over the body
  GivenVector direction{0, 1};  ///< of the displacement; need not be normalised
  Fade fade = Fade::none;
  double fade_length = 0.2;        ///< share of the body's length, (0, 0.5]
  std::optional<Vec3> along = {};  ///< in space, of any length but zero

  bool operator==(const SineDeformation&) const = default;
};

/// One row of a displacement file: a node by its index (0-based, order of the file) or by where it
/// is, and how far it moves. A plane mesh takes no notice of third components.
struct DisplacementEntry {
  std::optional<Index> node;
  GivenVector position;  ///< where node is empty
  GivenVector displacement;
  int line = 0;  ///< of the file it came from, for messages; 0: unknown
};

/// Displacements of single nodes. Nodes of the markers that have no entry stay.
struct DisplacementTable {
  std::vector<DisplacementEntry> entries;
  std::string source;  ///< the file it came from, for messages
};

/// The motions of plane meshes and of volume meshes. Each throws UsageError: no marker, an unknown
/// one, an entry that matches no node of the markers or one twice, an amplitude that is not finite,
/// a component too few or too many, ...
///
/// A rigid motion without a pivot turns about body_centre() of its markers.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table);

/// Bodies that move together: at each fraction every one has done that much of its own motion.
/// Throws UsageError as above, for no body, for a marker that is given to two bodies, and, naming
/// the markers, for a node that two bodies share and would take to different places.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    std::span<const MovingBody> bodies);

/// The nodes of the markers that are to move, ascending. Throws UsageError if there is no marker,
/// an unknown one, or no node.
std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers);
/// Throws UsageError unless the number is finite. what: "the amplitude", as the message is to
/// begin.
void require_finite(double value, const char* what);

/// All that a user can set of a motion, but for the markers that move.
OptionTable option_table(RigidMotion& motion);
OptionTable option_table(SineDeformation& sine);

}  // namespace winslow
