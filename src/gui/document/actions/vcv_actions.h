#pragma once

#include <variant>
#include <vector>

#include "core/command/command.h"

/// Changes of virtual control volumes. Carried out by VcvEditor.
namespace winslow::gui::action {

/// Changes VCVs and smooths. under_mouse: the mesh follows every further EditVcvs, which replaces
/// the edits before, until EndVcvEdit.
struct EditVcvs {
  std::vector<VcvEdit> edits;
  bool under_mouse = false;
};
struct EndVcvEdit {};
struct CancelVcvEdit {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using VcvAction = std::variant<action::EditVcvs, action::EndVcvEdit, action::CancelVcvEdit>;

}  // namespace winslow::gui
