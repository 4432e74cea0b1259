#pragma once

#include <variant>
#include <vector>

#include "gui/document/actions/demo_actions.h"
#include "gui/document/actions/dialog_actions.h"
#include "gui/document/actions/file_actions.h"
#include "gui/document/actions/history_actions.h"
#include "gui/document/actions/job_actions.h"
#include "gui/document/actions/message_actions.h"
#include "gui/document/actions/motion_actions.h"
#include "gui/document/actions/picture_actions.h"
#include "gui/document/actions/selection_actions.h"
#include "gui/document/actions/shell_actions.h"
#include "gui/document/actions/vcv_actions.h"
#include "gui/document/actions/view_actions.h"

/// What a user can ask for. Panels and the viewport emit actions; those who are named in the
/// actions' headers carry them out. Nothing else changes the state of the studio.
///
/// TO ADD AN ACTION, add it to the header of its group. It compiles once its handler has a function
/// on() for it (see Dispatch).
namespace winslow::gui {

/// Actions on the open mesh; they need no window.
using DocumentAction = std::variant<FileAction, SelectionAction, MotionAction, VcvAction, JobAction,
                                    HistoryAction, MessageAction>;

using Action =
    std::variant<DocumentAction, ViewAction, PictureAction, DialogAction, ShellAction, DemoAction>;

using ActionQueue = std::vector<Action>;

}  // namespace winslow::gui
