#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/inspect/node_roles.h"
#include "gui/base/background.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

/// What the nodes of the mesh of the history will do in the next run: of markers that slide and of
/// periodic pairs as the solver is set to, of those that are selected. Looked for in the
/// background.
class BoundaryRoles {
 public:
  BoundaryRoles(const LiveMesh& mesh, const Jobs& jobs, const Selection& selection)
      : mesh_(mesh), jobs_(jobs), selection_(selection) {}

  /// The latest that is known of this mesh; null: nothing yet. Asked for in every frame in which it
  /// is shown: what was asked last is looked for.
  std::shared_ptr<const NodeRoles> find() const;
  /// It is what the settings say now.
  bool up_to_date() const { return answer_.roles && answer_.question == asked_; }

  /// True if something new is known.
  bool poll();
  bool busy() const { return worker_.busy(); }

 private:
  struct Question {
    std::uint64_t generation = 0, shape = 0;
    SlideOptions slide;
    std::vector<std::string> moving;
    bool operator==(const Question&) const = default;
  };
  struct Answer {
    Question question;
    std::shared_ptr<const NodeRoles> roles;
  };
  Question question() const;

  const LiveMesh& mesh_;
  const Jobs& jobs_;
  const Selection& selection_;
  mutable Question asked_;
  mutable Answer answer_;
  mutable Background<Answer> worker_;
};

}  // namespace winslow::gui
