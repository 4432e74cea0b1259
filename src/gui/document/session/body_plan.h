#pragma once

#include "core/command/command.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// Bodies that are to move together, each by its own motion: listed by the user, carried out as one
/// command. A motion without a pivot turns its body about the centre of its bounding box.
class BodyPlan {
 public:
  explicit BodyPlan(const LiveMesh& mesh) : mesh_(mesh) {}

  const std::vector<MovingBody>& bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }
  /// The motion listed for exactly these markers; null: none.
  const RigidMotion* find(const std::vector<std::string>& markers) const;
  /// True if the marker belongs to one of the bodies.
  bool contains(const std::string& marker) const;
  /// True if any of the bodies moves.
  bool moves() const;
  /// Why the bodies cannot move together; empty: they can.
  const std::string& fault() const { return found().fault; }
  /// Edges that show the bodies at the ends of their motions, in the mesh on screen. Empty while a
  /// command or a drag is under way.
  const std::vector<std::pair<Vec3, Vec3>>& outline() const { return found().outline; }

  /// Lists a body, or gives the one of exactly these markers another motion. Each marker is in one
  /// body only: it is removed from the others. No markers: no effect.
  void put(MovingBody body);
  void remove(std::size_t number);
  void clear();

  /// Called when the command of all bodies has begun.
  void begin() { begun_ = true; }
  /// Called before a command that has moved bodies is appended to the history. If it is that of the
  /// list, the list ends; else listed pivots move with their bodies.
  void moved(const MoveCommand& move);
  /// Called when the document has moved to another position of its history: the list returns where
  /// its command is undone, and ends where it is done again.
  void follow_history();

 private:
  /// What follows from the bodies and the mesh on screen.
  struct Found {
    std::uint64_t revision = 0, shape = 0;
    std::string fault;
    std::vector<std::pair<Vec3, Vec3>> outline;
  };
  const Found& found() const;
  void add_outline(const MovingBody& body, Found& found) const;
  const std::vector<std::array<Index, 2>>& edges_of(const std::vector<std::string>& names) const;

  const LiveMesh& mesh_;
  std::vector<MovingBody> bodies_;
  std::uint64_t revision_ = 1;    // increases with every change of bodies_
  bool begun_ = false;            // their command is under way
  std::vector<MovingBody> done_;  // as listed when their last command was carried out
  std::size_t done_at_ = 0;       // its position in the history
  mutable std::optional<Found> found_;
  // Edges of the outlines, which depend on the connectivity alone.
  mutable std::map<std::vector<std::string>, std::vector<std::array<Index, 2>>> edges_;
  mutable std::weak_ptr<const Topology> edges_in_;
};

}  // namespace winslow::gui
