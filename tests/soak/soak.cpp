#include "soak.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "gui/panels/files/file_dialog.h"
#include "gui/shell/studio.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

Soak::Soak(std::uint64_t seed) : random_(seed) {
  return_freed_memory();  // as the program does
  // Wherever the studio looks for a place of its own, it finds this folder.
  fs::current_path(folder_.path());
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_CACHE_HOME"})
    setenv(name, folder_.path().c_str(), 1);
  sources_ = {
      write(folder_, ring_mesh(), "ring.su2"),
      write(folder_, ring_mesh(60, 16), "fine.su2"),
      write(folder_,
            make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)),
            "cavity.su2"),
      write(folder_, two_body_mesh(), "bodies.su2"),
      write(folder_, make_mesh(winslow::test::cube_with_cavity(3, winslow::test::Volumes::mixed)),
            "mixed.su2"),
      write(folder_, tangled_mesh(), "tangled.su2")};
  rig_ = std::make_unique<Rig>(width_, height_, folder_ / "profile");
  open_next();
}

void Soak::step() {
  ++operations_;
  if (++since_open_ > 150) {
    open_next();
    return check();
  }
  int total = 0;
  for (const Choice& choice : choices()) total += choice.weight;
  int at = pick(total);
  for (const Choice& choice : choices()) {
    if (at < choice.weight) {
      note(choice.name);
      (this->*choice.run)();
      break;
    }
    at -= choice.weight;
  }
  answer_dialogs();
  if (rig_->session().files().quit_accepted()) return begin_again();
  check();
}

void Soak::note(const std::string& what) {
  trail_.push_back(what);
  if (trail_.size() > 60) trail_.erase(trail_.begin());
}

/// Another mesh.
void Soak::open_next() {
  since_open_ = 0;
  const fs::path path = sources_[static_cast<std::size_t>(meshes_) % sources_.size()];
  note("open " + path.filename().string());
  rig_->release(MouseButton::left);
  rig_->bench->apply(action::CancelSolver{});
  rig_->bench->apply(action::OpenMesh{path, true});
  rig_->frames();
  settle_down();
  answer_dialogs();
  ++meshes_;
  if (meshes_ % static_cast<int>(sources_.size()) == 0) sample_running();
}

/// Of a studio that shows the mesh as at a first start: buffers of what is drawn, and of the
/// window, take up to 60 MB.
void Soak::sample_running() {
  const ViewOptions view = rig_->bench->view_control().options();
  const int width = width_, height = height_;
  rig_->bench->apply(action::EditView{whole(ViewOptions{})});
  resize(first_width, first_height);
  settle_down();
  answer_dialogs();
  rig_->bench->pictures().picture();  // the driver keeps the buffers of the last thing it has drawn
  rig_->frames(60);
  known_.clear();
  generation_ = 0;
  running_.sample();
  rig_->bench->apply(action::EditView{whole(view)});
  resize(width, height);
}

/// Whatever is asked is answered, most often so that work goes on.
void Soak::answer_dialogs() {
  for (int tries = 0; tries < 12 && rig_->session().messages().prompt(); ++tries) {
    const auto& choices = rig_->session().messages().prompt()->choices;
    if (choices.empty()) throw std::runtime_error("a prompt without an answer");
    const auto& choice = choices[static_cast<std::size_t>(pick(static_cast<int>(choices.size())))];
    const std::string label = choice.label;
    note("answer " + label);
    rig_->frames(3);
    const auto button = rig_->bench->widgets().find("prompt/" + label);
    // Another dialog goes first.
    if (!button) {
      note("  it is not shown");
      rig_->key(keys::escape);
      continue;
    }
    const ScreenPoint at = button->centre();
    if (at.x() >= width_ || at.y() >= height_)
      throw std::runtime_error("the answer " + label + " is out of reach, at " +
                               std::to_string(at.x()) + ", " + std::to_string(at.y()) + " of " +
                               std::to_string(width_) + " by " + std::to_string(height_));
    rig_->click(at);
  }
  if (rig_->session().messages().prompt()) {
    throw std::runtime_error("prompts do not go away");
  }
}

bool Soak::inside(const fs::path& folder) const {
  const auto relative =
      fs::weakly_canonical(folder).lexically_relative(fs::weakly_canonical(folder_.path()));
  return !relative.empty() && *relative.begin() != "..";
}

/// Not to leave the studio, nor the temporary folder.
bool Soak::safe(const std::string& widget) const {
  for (const char* word : {"quit", "dialog/up", "dialog/home", "dialog/folder", "dialog/place"})
    if (widget.find(word) != std::string::npos) return false;
  if (widget == "dialog/accept") return inside(rig_->bench->dialogs().file_dialog().folder());
  return true;
}

void Soak::check() {
  const Session& session = rig_->session();
  const Document* document = session.document();
  if (!document || session.in_motion() || session.files().loading()) return;
  if (generation_ != session.generation()) {
    generation_ = session.generation();
    known_.clear();
  }
  const Coordinates& shown = session.coordinates();
  const auto [it, fresh] = known_.try_emplace(document->edits().revision(), shown);
  if (!fresh) {
    ++comparisons_;
    if (!(it->second == shown))
      throw std::runtime_error("position " + std::to_string(document->history().position()) +
                               " of the history is not the mesh that it was");
    return;
  }
  const std::size_t position = document->history().position();
  if (position == 0) return;
  if (!(document->state().mesh.coordinates == shown))
    throw std::runtime_error("the mesh on screen is not that of the history");
  const Index inverted = check_validity(*document->topology(), shown).inverted;
  const std::string what = describe(document->history().command(position)) + ": ";
  if (inverted > 0 && !session.messages().banner() && !session.messages().banner_dismissed())
    throw std::runtime_error(what + std::to_string(inverted) +
                             " inverted elements were accepted in silence");
  if (inverted != document->history().result(position).inverted)
    throw std::runtime_error(what + "the history says another number of inverted elements");
}

}  // namespace winslow::gui::test
