#include "gui/document/session/boundary_roles.h"

#include <exception>
#include <utility>

namespace winslow::gui {

BoundaryRoles::Question BoundaryRoles::question() const {
  Question now;
  now.generation = mesh_.generation();
  // While the mesh is on its way, that of the history stays as it was.
  now.shape = mesh_.in_motion() ? asked_.shape : mesh_.shape();
  now.slide = jobs_.smooth_options().slide;
  const Topology& topology = *mesh_.document()->state().mesh.topology;
  drop_stale_overrides(now.slide, topology);  // kept for when their markers slide again
  for (const Index m : selection_.markers()) now.moving.push_back(topology.markers()[at(m)].name);
  return now;
}

std::shared_ptr<const NodeRoles> BoundaryRoles::find() const {
  if (!mesh_.document()) return nullptr;
  asked_ = question();
  if (answer_.question != asked_ && !worker_.busy())
    worker_.start([state = mesh_.document()->state(), question = asked_,
                   files = reference_files(mesh_)] {
      Answer answer{question, nullptr};
      try {
        SlideOptions slide = question.slide;
        files->load(slide);
        answer.roles = std::make_shared<const NodeRoles>(node_roles(state, slide, question.moving));
      } catch (const std::exception& error) {
        NodeRoles none;
        none.fault = error.what();
        answer.roles = std::make_shared<const NodeRoles>(std::move(none));
      }
      return answer;
    });
  return answer_.question.generation == mesh_.generation() ? answer_.roles : nullptr;
}

bool BoundaryRoles::poll() {
  auto answer = worker_.poll();
  if (!answer) return false;
  answer_ = std::move(*answer);
  return true;
}

}  // namespace winslow::gui
