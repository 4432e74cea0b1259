#include "gui/document/session/before_state.h"

namespace winslow::gui {

std::size_t position_before(const LiveMesh& mesh, BeforeState which) {
  const History& history = mesh.document()->history();
  if (which == BeforeState::loaded) return 0;
  // While a command is being carried out, its own start; else that of the last one.
  if (mesh.in_motion()) return history.position();
  return history.position() > 0 ? history.position() - 1 : 0;
}

}  // namespace winslow::gui
