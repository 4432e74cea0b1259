#pragma once

#include <memory>
#include <vector>

#include "gui/document/session/session.h"

namespace winslow::gui {

/// The meshes of a film: those on screen, and between them, where a job moves a body in large
/// steps, those that meshes_between() puts there.
class FilmMeshes {
 public:
  /// Nothing has been shown yet.
  void clear();
  /// The mesh on screen is the one last taken.
  bool has(const Coordinates& x) const { return taken_.size() == x.size() && taken_ == x; }
  /// The mesh on screen, the last, and those on the way to it from the one last taken; that alone
  /// if none is wanted between. All are of the session's topology.
  std::vector<Coordinates> take(const Session& session, bool between = true);

 private:
  void follow_motion(const Session& session);

  Coordinates taken_;
  std::vector<Index> moved_;  // nodes that the job under way moves as one body
};

}  // namespace winslow::gui
