#include "gui/document/actions/document_actions.h"

#include <doctest/doctest.h>

#include <string>

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/picture/capture/capture.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui::test {

namespace {

struct First {};
struct Second {};
using Both = std::variant<First, Second>;

/// Takes both.
struct Whole {
  std::string log;
  void on(const First&) { log += "first "; }
  void on(const Second&) { log += "second "; }
};

/// Has forgotten one.
struct Half {
  void on(const First&) {}
};

/// Swallows what it has forgotten.
struct Swallower {
  void on(const First&) {}
  template <class Rest>
  void on(const Rest&) {}
};

/// Takes one of them only by turning it into something else.
struct Converter {
  struct Anything {
    Anything(const Second&) {}  // NOLINT(google-explicit-constructor)
  };
  void on(const First&) {}
  void on(const Anything&) {}
};

static_assert(Dispatch::complete<Whole, Both>());
static_assert(!Dispatch::complete<Half, Both>());
static_assert(!Dispatch::complete<Swallower, Both>());
static_assert(!Dispatch::complete<Converter, Both>());

// Every action of the studio has somebody who carries it out.
static_assert(Dispatch::complete<Files, FileAction>());
static_assert(Dispatch::complete<Selection, SelectionAction>());
static_assert(Dispatch::complete<Motions, MotionAction>());
static_assert(Dispatch::complete<VcvEditor, VcvAction>());
static_assert(Dispatch::complete<Jobs, JobAction>());
static_assert(Dispatch::complete<SolverSettings, SettingsAction>());
static_assert(Dispatch::complete<MeshLayers, LayerAction>());
static_assert(Dispatch::complete<HistoryEditor, HistoryAction>());
static_assert(Dispatch::complete<MessageBoard, MessageAction>());
static_assert(Dispatch::complete<Navigator, CameraAction>());
static_assert(Dispatch::complete<ViewControl, ViewAction>());
static_assert(Dispatch::complete<Capture, PictureAction>());
static_assert(Dispatch::complete<Dialogs, DialogAction>());
static_assert(Dispatch::complete<Workbench, ShellAction>());
static_assert(Dispatch::complete<Workbench, DemoAction>());

}  // namespace

TEST_CASE("an action reaches its own function of the handler, and no other") {
  Whole whole;
  Dispatch::to(whole, Both(Second{}));
  CHECK(whole.log == "second ");
  Dispatch::to(whole, Both(First{}));
  CHECK(whole.log == "second first ");
}

TEST_CASE("an action finds its group by itself") {
  const Action undo = action::Undo{};
  REQUIRE(std::holds_alternative<DocumentAction>(undo));
  CHECK(std::holds_alternative<HistoryAction>(std::get<DocumentAction>(undo)));
  CHECK(std::holds_alternative<CameraAction>(Action(action::FitView{})));
  CHECK(std::holds_alternative<ViewAction>(Action(action::AskGoTo{})));
  CHECK(std::holds_alternative<PictureAction>(Action(action::StopRecording{})));
  CHECK(std::holds_alternative<DialogAction>(Action(action::ShowHelp{})));
  CHECK(std::holds_alternative<ShellAction>(Action(action::ClearRecent{})));
  CHECK(std::holds_alternative<DemoAction>(Action(action::EndDemo{})));
}

}  // namespace winslow::gui::test
