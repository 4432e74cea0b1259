#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "gui/document/jobs/run_settings.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"
#include "soak.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

const std::vector<Soak::Choice>& Soak::choices() {
  static const std::vector<Choice> all{{24, "click", &Soak::click_anything},
                                       {8, "fill", &Soak::fill_anything},
                                       {10, "keys", &Soak::press_keys},
                                       {6, "click in the picture", &Soak::click_in_picture},
                                       {10, "drag", &Soak::drag_in_picture},
                                       {5, "wheel", &Soak::wheel_somewhere},
                                       {8, "move", &Soak::move_selection},
                                       {6, "select", &Soak::select_something},
                                       {14, "walk the history", &Soak::walk_history},
                                       {3, "change the history", &Soak::change_history},
                                       {8, "solve", &Soak::solve},
                                       {4, "options", &Soak::set_options},
                                       {4, "write", &Soak::write_files},
                                       {2, "read", &Soak::read_files},
                                       {2, "resize", &Soak::resize_window},
                                       {8, "settle", &Soak::settle_down},
                                       {2, "layers", &Soak::insert_layers},
                                       {1, "crash", &Soak::crash}};
  return all;
}

/// Where the handles of the selection are.
ScreenPoint Soak::at_pivot() const {
  const Vec3 pivot = rig_->session().selection().space_pivot();
  return rig_->bench->view_control().view().project(pivot).at;
}

ScreenPoint Soak::somewhere() { return ScreenPoint(between(0, width_), between(0, height_)); }

void Soak::click_anything() {
  std::vector<std::string> ids;
  for (const auto& [id, rect] : rig_->bench->widgets().all()) {
    const ScreenPoint at = rect.centre();
    const bool on_screen = at.x() >= 0 && at.y() >= 0 && at.x() < width_ && at.y() < height_;
    if (rect.enabled && on_screen && safe(id)) ids.push_back(id);
  }
  if (ids.empty()) return;
  const std::string& id = ids[static_cast<std::size_t>(pick(static_cast<int>(ids.size())))];
  note("  " + id);
  const ScreenPoint at = rig_->bench->widgets().find(id)->centre();
  if (chance(10)) {
    rig_->move(at);
    rig_->press(MouseButton::right);
    rig_->release(MouseButton::right);
  } else {
    rig_->click(at);
  }
}

void Soak::fill_anything() {
  static const std::array<const char*, 14> texts{"0",   "1",   "0.1",  "-0.2", "15",
                                                 "-30", "90",  "1e-6", "1e99", "-1e-9",
                                                 "nan", "abc", "2000", ""};
  std::vector<std::string> ids;
  for (const auto& [id, rect] : rig_->bench->widgets().all())
    for (const char* group : {"motion/", "solver/", "edit/", "view/", "vcv/", "goto"})
      if (id.starts_with(group) && rect.enabled && safe(id)) ids.push_back(id);
  if (ids.empty()) return;
  const std::string& id = ids[static_cast<std::size_t>(pick(static_cast<int>(ids.size())))];
  const char* text = texts[static_cast<std::size_t>(pick(texts.size()))];
  note("  " + id + " = " + text);
  rig_->fill(id, text);
}

void Soak::press_keys() {
  using namespace keys;
  struct Press {
    int key;
    std::vector<int> modifiers;
  };
  static const std::vector<Press> presses{{space, {}},
                                          {n, {}},
                                          {n, {shift}},
                                          {z, {control}},
                                          {z, {control, shift}},
                                          {r, {control}},
                                          {e, {control}},
                                          {o, {control}},
                                          {s, {control, shift}},
                                          {escape, {}},
                                          {escape, {}},
                                          {escape, {}},
                                          {f, {}},
                                          {f, {shift}},
                                          {w, {}},
                                          {f1, {}},
                                          {f2, {}},
                                          {tab, {}},
                                          {enter, {}},
                                          {GLFW_KEY_L, {}},
                                          {GLFW_KEY_F3, {}},
                                          {GLFW_KEY_F4, {}},
                                          {GLFW_KEY_D, {control}},
                                          {GLFW_KEY_P, {control}},
                                          {GLFW_KEY_UP, {}},
                                          {GLFW_KEY_LEFT, {shift}},
                                          {GLFW_KEY_DELETE, {}}};
  const Press& press = presses[static_cast<std::size_t>(pick(static_cast<int>(presses.size())))];
  note("  key " + std::to_string(press.key));
  // Enter in a dialog may write where it stands.
  if (press.key == enter && !inside(rig_->bench->dialogs().file_dialog().folder())) return;
  rig_->key(press.key, press.modifiers);
}

void Soak::click_in_picture() {
  const Area& v = rig_->bench->layout().viewport;
  const ScreenPoint at(v.x + between(0, v.width), v.y + between(0, v.height));
  const auto button = static_cast<MouseButton>(pick(3));
  rig_->move(at);
  rig_->press(button);
  rig_->release(button);
}

void Soak::drag_in_picture() {
  ScreenPoint from = somewhere();
  if (rig_->session().document() && chance(70)) {
    // On a body most often: at its pivot, where the handles are, or at a node of the boundary.
    from = at_pivot();
    if (chance(50)) from = from + ScreenVector(between(-60, 60), between(-60, 60));
  }
  const auto button = chance(75) ? MouseButton::left : static_cast<MouseButton>(pick(3));
  rig_->drag(from, from + ScreenVector(between(-120, 120), between(-90, 90)), 1 + pick(10), button);
  if (chance(20)) rig_->key(keys::escape);
  if (chance(10)) rig_->key(keys::z, {keys::control});
  rig_->frames(pick(6));
  rig_->release(button);
}

void Soak::wheel_somewhere() { rig_->wheel(somewhere(), chance(50) ? 1 : -1); }

void Soak::move_selection() {
  const double reach = rig_->session().in_space() ? 0.1 : 0.3;
  const auto& selection = rig_->session().selection();
  RigidMotion motion{chance(50) ? between(-40, 40) : 0, selection.pivot(),
                     Vec2(between(-reach, reach), between(-reach, reach))};
  if (rig_->session().in_space())
    motion = {motion.rotate, selection.space_pivot(),
              reach * Vec3(between(-1, 1), between(-1, 1), 0),
              Vec3(between(-1, 1), between(-1, 1), 1)};
  rig_->bench->apply(action::ApplyMotion{motion});
  rig_->frames(pick(10));
}

void Soak::select_something() {
  if (!rig_->session().document()) return;
  const auto count = static_cast<int>(rig_->mesh().topology->markers().size());
  if (count == 0) return;  // files of some formats keep no markers
  rig_->bench->apply(action::SelectMarkers{{static_cast<Index>(pick(count))}, chance(25)});
  rig_->frames(1);
}

void Soak::walk_history() {
  if (!rig_->session().document()) return;
  const int way = pick(5);
  if (way < 2) {
    rig_->bench->apply(action::Undo{});
  } else if (way < 4) {
    rig_->bench->apply(action::Redo{});
  } else {
    const auto size = static_cast<int>(rig_->document().history().size());
    rig_->bench->apply(action::GoToStep{static_cast<std::size_t>(pick(size))});
  }
  rig_->frames(1);
}

void Soak::change_history() {
  if (!rig_->session().document()) return;
  const History& history = rig_->document().history();
  if (history.size() < 2) return;
  const auto position = 1 + static_cast<std::size_t>(pick(static_cast<int>(history.size()) - 1));
  const int way = pick(5);
  if (way == 0) {
    rig_->bench->apply(action::DeleteStep{position});
  } else if (way == 1) {
    rig_->bench->apply(action::ShowStepEditor{position});
  } else if (way == 2 && !rig_->document().edits().kept().empty()) {
    rig_->bench->apply(action::BringBack{
        static_cast<std::size_t>(pick(static_cast<int>(rig_->document().edits().kept().size())))});
  } else {
    Command command = history.command(position);
    if (auto* move = std::get_if<MoveCommand>(&command))
      move->bodies.front().motion.rotate += between(-10, 10);
    rig_->bench->apply(action::EditStep{position, command});
  }
  rig_->frames(pick(8));
}

void Soak::solve() {
  switch (pick(7)) {
    case 0:
      rig_->bench->apply(action::Scramble{static_cast<std::uint64_t>(pick(1000))});
      break;
    case 1:
      rig_->bench->apply(action::PauseSolver{});
      break;
    case 2:
      rig_->bench->apply(action::CancelSolver{});
      break;
    case 3:
      rig_->bench->apply(action::StepSolver{1 + pick(5)});
      break;
    default:
      rig_->bench->apply(action::RunSmooth{});
  }
  rig_->frames(pick(10));
}

void Soak::set_options() {
  SmoothOptions smooth;
  MotionOptions motion;
  // The defaults half of the time, or nothing would ever converge.
  if (chance(50)) {
    use_method(chance(50) ? Method::direct : Method::path, smooth, motion);
    smooth.max_iterations = 20 + pick(300);
    smooth.damping = between(0.1, 1);
    smooth.clip = static_cast<Clip>(pick(3));
    smooth.untangle = static_cast<Untangle>(pick(3));
    if (chance(20)) motion.increments = 8;
    if (chance(10)) motion.smooth_after = false;
  }
  rig_->bench->apply(action::EditSmoothOptions{whole(smooth)});
  rig_->bench->apply(action::EditMotionOptions{whole(motion)});
  rig_->bench->apply(action::SetPace{chance(70) ? 0.0 : 30.0});
  rig_->frames(1);
}

void Soak::write_files() {
  static const std::array<const char*, 5> names{"out.su2", "out.vtu", "out.msh", "out.vtk",
                                                "out.ply"};
  switch (pick(4)) {
    case 0:
      rig_->bench->apply(
          action::ExportRecipe{folder_ / ("recipe" + std::to_string(pick(3)) + ".json"), true});
      break;
    case 1:
      rig_->bench->apply(action::ExportConvergence{folder_ / "iterations.csv", true});
      break;
    case 2:
      rig_->bench->apply(action::TakeScreenshot{folder_ / "picture.png", true});
      break;
    default:
      rig_->bench->apply(action::SaveMesh{
          folder_ / names[static_cast<std::size_t>(pick(names.size()))], true, chance(50)});
  }
  rig_->frames(4);
}

/// Another connectivity. A mesh that has layers gets no more, or it would grow for ever.
void Soak::insert_layers() {
  const Document* document = rig_->session().document();
  if (!document || rig_->session().in_space() || document->state().layers ||
      document->topology()->markers().empty())
    return;
  const auto& markers = document->topology()->markers();
  LayersCommand command;
  LayerWall wall{{markers[static_cast<std::size_t>(pick(static_cast<int>(markers.size())))].name},
                 {}};
  wall.spacing.count = 1 + pick(6);
  wall.spacing.first = between(0.001, 0.02);
  command.layers.walls = {wall};
  command.control = chance(80);
  rig_->bench->apply(action::RunCommand{command, chance(20)});
  rig_->frames(4);
}

void Soak::read_files() {
  const int way = pick(3);
  if (way == 0) {
    rig_->bench->apply(
        action::ReplayRecipe{folder_ / ("recipe" + std::to_string(pick(3)) + ".json")});
  } else if (way == 1) {
    rig_->input.drop({sources_[static_cast<std::size_t>(pick(static_cast<int>(sources_.size())))]});
  } else {
    rig_->bench->apply(action::OpenMesh{folder_ / "recipe0.json", chance(50)});
  }
  rig_->frames(6);
}

void Soak::resize_window() {
  const int width = 480 + pick(1200);
  resize(width, 360 + pick(700));
}

void Soak::resize(int width, int height) {
  width_ = width;
  height_ = height;
  rig_->resize(width, height);
  rig_->frames(1);
}

void Soak::settle_down() {
  const auto done = [this] {
    return rig_->session().messages().prompt() ||
           (rig_->bench->settled() && !rig_->session().job().active() &&
            !rig_->session().files().loading());
  };
  if (rig_->session().job().paused()) rig_->bench->apply(action::ResumeSolver{});
  rig_->bench->apply(action::SetPace{0});
  if (rig_->wait(done, 5)) return;
  note("  cancelled: it took too long");
  rig_->release(MouseButton::left);
  rig_->bench->apply(action::CancelDrag{});
  rig_->bench->apply(action::CancelSolver{});
  rig_->wait(done, 20);
}

/// The studio goes away without being closed; the next one must have the session, to the bit.
/// Some session is below the profile, whole.
bool Soak::kept_somewhere() const {
  const fs::path root = folder_ / "profile" / "autosave";
  std::error_code none;
  return std::ranges::any_of(fs::directory_iterator(root, none), [](const auto& entry) {
    return fs::exists(entry.path() / "session.json");
  });
}

void Soak::crash() {
  settle_down();
  answer_dialogs();
  if (!rig_->session().document() || rig_->session().in_motion()) return;
  if (rig_->session().files().quit_accepted()) return;
  if (!rig_->wait([this] { return !rig_->bench->autosave().busy(); }, 60))
    throw std::runtime_error("the session is never kept");
  const std::string said =
      rig_->session().messages().notice() ? rig_->session().messages().notice()->text : "nothing";
  if (!kept_somewhere())
    throw std::runtime_error("the session is not kept; the studio says: " + said);
  const History before = rig_->document().history();
  note("  of " + rig_->document().source().path.filename().string());
  rig_.reset();
  known_.clear();
  memory_.sample();  // with no studio at all: what is left was leaked, or is kept for the next one
  rig_ = std::make_unique<Rig>(width_, height_, folder_ / "profile");
  if (!rig_->wait([this] { return rig_->session().messages().prompt() != nullptr; }, 60))
    throw std::runtime_error("the session is not offered after a crash");
  rig_->frames(3);
  rig_->click("prompt/Restore");
  if (!rig_->wait([this] { return rig_->session().document() != nullptr; }, 60))
    throw std::runtime_error(
        "the session does not come back: " +
        (rig_->session().messages().prompt() ? rig_->session().messages().prompt()->text : "?"));
  const History& after = rig_->document().history();
  if (after.size() != before.size() || after.position() != before.position())
    throw std::runtime_error("the history that came back is another one");
  for (std::size_t k = 0; k < after.size(); ++k)
    if (!(after.state(k).mesh.coordinates == before.state(k).mesh.coordinates))
      throw std::runtime_error(
          "position " + std::to_string(k) + " of " + std::to_string(after.size()) + " of " +
          rig_->document().source().path.string() + " came back as another mesh");
  ++restored_;
  generation_ = 0;
}

/// The studio was told to end, through the palette for one: the next one has nothing to offer.
void Soak::begin_again() {
  rig_.reset();
  known_.clear();
  memory_.sample();  // with no studio at all: what is left was leaked, or is kept for the next one
  rig_ = std::make_unique<Rig>(width_, height_, folder_ / "profile");
  if (!rig_->wait([this] { return !rig_->bench->autosave().busy(); }, 60))
    throw std::runtime_error("what earlier studios left is never looked at");
  if (rig_->session().messages().prompt())
    throw std::runtime_error("a session is offered after a clean end");
  ++ended_;
  generation_ = 0;
  open_next();
}

}  // namespace winslow::gui::test
