#include "gui/picture/capture/film_meshes.h"

#include "core/command/motion_frames.h"
#include "core/motion/meshes_between.h"

namespace winslow::gui {

void FilmMeshes::clear() {
  taken_ = Coordinates();
  moved_.clear();
}

/// What the job moves is kept until its last mesh is taken: that comes some frames after it has
/// ended.
void FilmMeshes::follow_motion(const Session& session) {
  const JobRunner& job = session.job();
  if (!job.active()) return;
  moved_.clear();
  if (!job.held()) moved_ = moved_as_body(job.command(), *session.topology());
}

std::vector<Coordinates> FilmMeshes::take(const Session& session, bool between) {
  follow_motion(session);
  const Coordinates& now = session.coordinates();
  std::vector<Coordinates> meshes;
  if (between && taken_.size() == now.size())
    meshes = meshes_between(*session.topology(), moved_, taken_, now);
  meshes.push_back(now);
  if (!session.job().active() && taken_ == now) moved_.clear();
  taken_ = now;
  return meshes;
}

}  // namespace winslow::gui
