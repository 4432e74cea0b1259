#include "gui/document/session/inspection.h"

#include "core/inspect/nodal_view.h"
#include "core/strategy/workspace.h"

namespace winslow::gui {

BoundaryRoles::Question BoundaryRoles::question() const {
  Question now;
  now.generation = mesh_.generation();
  // While the mesh is in motion, the history's mesh does not change.
  now.shape = mesh_.in_motion() ? asked_.shape : mesh_.shape();
  now.slide = settings_.smooth_options().slide;
  const Topology& topology = *mesh_.document()->state().mesh.topology;
  drop_stale_overrides(now.slide, topology);  // kept for when their markers slide again
  now.moving = marker_names(topology, selection_.markers());
  return now;
}

std::shared_ptr<const NodeRoles> BoundaryRoles::find() const {
  if (!mesh_.document()) return nullptr;
  asked_ = question();
  if (answer_.question != asked_ && !worker_.busy())
    worker_.start(
        [state = mesh_.document()->state(), question = asked_, files = settings_.resolver()] {
          Answer answer{question, nullptr};
          try {
            answer.roles = std::make_shared<const NodeRoles>(
                node_roles(state, {question.slide, files(question.slide)}, question.moving));
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

void SphereInspector::forget_stale() const {
  const SmoothOptions& options = settings_.smooth_options();
  const History& history = mesh_.document()->history();
  // While the mesh is in motion, the history's mesh does not change.
  const std::uint64_t shape = mesh_.in_motion() ? source_.shape : mesh_.shape();
  Source now{mesh_.generation(), shape,       history.position(),
             history.size(),     options.vcv, options.vcv_lengths,
             mesh_.sphere_vcvs()};
  if (now != source_) {
    source_ = std::move(now);
    vcvs_.clear();
    views_.clear();
  }
  if (shape_ != mesh_.shape()) {
    shape_ = mesh_.shape();
    views_.clear();
  }
}

const NodeVcv& SphereInspector::vcv(Index node) const {
  if (const auto found = vcvs_.find(node); found != vcvs_.end()) return found->second;
  const MeshState& state = mesh_.document()->state();
  const SphereStencil* by_hand = nullptr;
  if (source_.by_hand) {
    const auto found = source_.by_hand->find(node);
    if (found != source_.by_hand->end()) by_hand = &found->second;
  }
  const VolumeVcvOptions options =
      volume_vcv_options(settings_.smooth_options(), *state.mesh.topology);
  return vcvs_
      .emplace(node,
               make_node_vcv(*state.mesh.topology, state.mesh.coordinates, node, options, by_hand))
      .first->second;
}

const VolumeNodalView& SphereInspector::view_of(Index node) const {
  require_inspectable(*mesh_.topology(), node);
  forget_stale();
  if (const auto found = views_.find(node); found != views_.end()) return found->second;
  return views_.emplace(node, inspect_node(*mesh_.topology(), mesh_.coordinates(), vcv(node)))
      .first->second;
}

namespace {

std::vector<Index> candidates_of(const Mesh& mesh, const StarMatches::Wish& wish) {
  std::vector<Index> candidates;
  const Vec3 middle = mesh.coordinates.xyz(wish.node);
  const auto add = [&](Index node) {
    if (!wish.radius || (mesh.coordinates.xyz(node) - middle).norm() <= *wish.radius)
      candidates.push_back(node);
  };
  if (wish.among)
    for (const Index node : *wish.among) add(node);
  else
    for (const Index node : mesh.topology->interior_nodes()) add(node);
  return candidates;
}

StarMatches::Found look(const Mesh& mesh, const StarMatches::Wish& wish,
                        const std::atomic<bool>& stop) {
  try {
    return matching_stars(mesh, wish.node, candidates_of(mesh, wish), &stop);
  } catch (const std::exception&) {
    return {};  // the node has no VCV itself
  }
}

}  // namespace

const StarMatches::Found* StarMatches::find(const Wish& wish) const {
  if (!mesh_.document()) return nullptr;
  // While the mesh is in motion, the history's mesh does not change.
  const std::uint64_t shape = mesh_.in_motion() ? asked_.shape : mesh_.shape();
  Question now{wish, mesh_.generation(), shape};
  if (now != asked_) {
    stop();
    asked_ = std::move(now);
  }
  if (answer_ && answer_->question == asked_) return &answer_->found;
  if (worker_.busy()) return nullptr;
  stop_ = std::make_shared<std::atomic<bool>>(false);
  worker_.start([mesh = mesh_.document()->state().mesh, question = asked_, stop = stop_] {
    return Answer{question, look(mesh, question.wish, *stop)};
  });
  return nullptr;
}

bool StarMatches::poll() {
  auto answer = worker_.poll();
  if (!answer) return false;
  // The result of a cancelled search is incomplete.
  if (answer->question == asked_) answer_ = std::move(answer);
  return true;
}

}  // namespace winslow::gui
