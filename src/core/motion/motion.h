#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
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
};

/// x -> pivot + R(angle) (x - pivot) + translate.
struct RigidMotion {
  double rotate = 0;     ///< degrees, counter-clockwise positive
  Vec2 pivot{0, 0};      ///< in units of the mesh
  Vec2 translate{0, 0};  ///< in units of the mesh
};

/// The same in space: R turns about `axis`, counter-clockwise seen from where it points to.
struct SpaceMotion {
  double rotate = 0;        ///< degrees
  Vec3 axis{0, 0, 1};       ///< of any length but zero
  Vec3 pivot{0, 0, 0};      ///< in units of the mesh
  Vec3 translate{0, 0, 0};  ///< in units of the mesh
};

/// A rigid motion as it is asked for: where it turns may be left open.
struct RigidMotionRequest {
  double rotate = 0;          ///< as in RigidMotion
  std::optional<Vec2> pivot;  ///< none: the centre of what moves, see body_centre()
  Vec2 translate{0, 0};       ///< as in RigidMotion
  // In space: the axis, and the third components.
  std::optional<Vec3> axis;
  std::optional<double> pivot_z, translate_z;

  RigidMotionRequest() = default;
  RigidMotionRequest(double degrees, std::optional<Vec2> about, const Vec2& by)
      : rotate(degrees), pivot(std::move(about)), translate(by) {}
  /// That very motion.
  RigidMotionRequest(const RigidMotion& motion)
      : rotate(motion.rotate), pivot(motion.pivot), translate(motion.translate) {}
  RigidMotionRequest(const SpaceMotion& motion)
      : rotate(motion.rotate),
        pivot(motion.pivot.head<2>()),
        translate(motion.translate.head<2>()),
        axis(motion.axis),
        pivot_z(motion.pivot.z()),
        translate_z(motion.translate.z()) {}

  bool operator==(const RigidMotionRequest&) const = default;
  /// The motion of a plane mesh, about `centre` unless a pivot is named. Throws UsageError if it
  /// leaves the plane.
  RigidMotion about(const Vec2& centre) const;
  /// The motion of a volume mesh. Throws UsageError for a rotation without an axis.
  SpaceMotion in_space(const Vec3& centre) const;
};

/// Throws UsageError for a motion that meshes of this dimension (2 or 3) do not have.
void require_fits(const RigidMotionRequest& motion, int dimension);

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
  double amplitude = 0;  ///< in units of the mesh
  double waves = 1;      ///< full periods over the body
  Vec2 direction{0, 1};  ///< of the displacement; need not be normalised
  Fade fade = Fade::none;
  double fade_length = 0.2;  ///< share of the body's length, (0, 0.5]
  // In space.
  std::optional<double> direction_z = {};
  std::optional<Vec3> along = {};  ///< of any length but zero

  bool operator==(const SineDeformation&) const = default;
};

/// One row of a displacement file: a node by its index (0-based, order of the file) or by where it
/// is, and how far it moves.
struct DisplacementEntry {
  std::optional<Index> node;
  Vec2 position{0, 0};  ///< where node is empty
  Vec2 displacement{0, 0};
  int line = 0;  ///< of the file it came from, for messages; 0: unknown
  // In space; a plane mesh takes no notice of them.
  std::optional<double> position_z = {}, displacement_z = {};
};

/// Displacements of single nodes. Nodes of the markers that have no entry stay.
struct DisplacementTable {
  std::vector<DisplacementEntry> entries;
  std::string source;  ///< the file it came from, for messages
};

/// RigidMotion is for plane meshes, SpaceMotion for volume meshes, the others for both. Each throws
/// UsageError: no marker, an unknown one, an entry that matches no node of the markers or one
/// twice, an amplitude that is not finite, a component too few or too many, ...
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const RigidMotion& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SpaceMotion& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const SineDeformation& options);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table);

/// The nodes of the markers that are to move, ascending. Throws UsageError if there is no marker,
/// an unknown one, or no node.
std::vector<Index> moving_nodes(const Topology& topology, const std::vector<std::string>& markers);
/// Throws UsageError unless the number is finite. what: "the amplitude", as the message is to
/// begin.
void require_finite(double value, const char* what);

/// All that a user can set of a motion, but for the markers that move.
OptionTable option_table(RigidMotionRequest& motion);
OptionTable option_table(SineDeformation& sine);

}  // namespace winslow
