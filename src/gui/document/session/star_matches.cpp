#include "gui/document/session/star_matches.h"

#include <exception>
#include <utility>

namespace winslow::gui {

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
  // While the mesh is on its way, that of the history stays as it was.
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
  // One that was given up is not whole.
  if (answer->question == asked_) answer_ = std::move(answer);
  return true;
}

}  // namespace winslow::gui
