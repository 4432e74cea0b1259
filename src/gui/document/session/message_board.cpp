#include "gui/document/session/message_board.h"

#include <cctype>

#include "core/strategy/sliding.h"
#include "gui/base/background.h"
#include "gui/base/text.h"
#include "gui/files/assets.h"

namespace winslow::gui {

void MessageBoard::report_error(std::string title, std::string text) {
  ask({Prompt::Kind::error, std::move(title), std::move(text), {{"OK", {}, true}}});
}

bool MessageBoard::may_write(const std::filesystem::path& path) {
  if (!bundled(path)) return true;
  tell(Notice::Kind::warning, bundled_text);
  return false;
}

bool MessageBoard::may_replace(const std::filesystem::path& path, bool overwrite,
                               const std::string& why, Action again) {
  if (overwrite || !is_there(path)) return true;
  ask({Prompt::Kind::question,
       "Replace the file?",
       path.filename().string() + " exists already." + why,
       {{"Replace", {std::move(again)}, false}, {"Cancel", {}, true}}});
  return false;
}

void MessageBoard::tell(Notice::Kind kind, std::string text) {
  notice_ = Notice{kind, std::move(text), std::chrono::steady_clock::now()};
}

bool MessageBoard::banner_dismissed() const {
  const Document* document = mesh_.document();
  return document && dismissed_ == std::pair(mesh_.generation(), document->edits().revision());
}

void MessageBoard::set_banner(Banner::Kind kind, std::string text) {
  banner_ = Banner{kind, std::move(text), {}};
}

void MessageBoard::remark(const std::string& what, const std::vector<std::string>& warnings) {
  constexpr std::size_t most = 4;  // largest number of lines, so that the mesh remains visible
  std::string text = what + ":";
  for (std::size_t k = 0; k < std::min(most, warnings.size()); ++k)
    text += (warnings.size() == 1 ? " " : "\n- ") + warnings[k];
  if (warnings.size() > most) text += "\nand " + std::to_string(warnings.size() - most) + " more.";
  if (banner_)
    banner_->text += '\n' + text;
  else
    set_banner(Banner::Kind::remark, std::move(text));
}

void MessageBoard::set_banner_of_position() {
  const Document& document = *mesh_.document();
  const History& history = document.history();
  banner_.reset();
  if (history.position() > 0) return set_banner_of_result(history.result(history.position()));
  const Index inverted = document.loaded_quality().inverted;
  if (inverted == 0) return set_banner_of_folds(document.loaded_quality().folds);
  set_banner(
      Banner::Kind::inverted_input,
      "This mesh has " + counted(inverted, "inverted element") + ". Smoothing usually repairs it.");
  banner_->worst = worst_place({});
}

void MessageBoard::set_banner_of_folds(const SurfaceFolds& folds) {
  if (!folds.any()) return;
  std::string text = describe(folds);
  text.front() = 'T';
  set_banner(Banner::Kind::remark,
             text +
                 ". They do not count as inverted: the shape to stay on is that of this mesh. "
                 "With a reference surface without folds, smoothing turns them back.");
  if (!folds.behind.empty())
    banner_->worst = MeshItem{MeshItem::Kind::element, folds.behind.front()};
}

void MessageBoard::set_banner_of_result(const SmoothResult& smooth) {
  const Damage damage = damage_of_last_command();
  if (banner_ && banner_->kind == Banner::Kind::partial_motion && smooth.inverted == 0) {
    if (!damage.text.empty()) banner_->text += ' ' + damage.text;
  } else if (smooth.inverted > 0) {
    set_banner(Banner::Kind::inverted_result, "The result has " +
                                                  counted(smooth.inverted, "inverted element") +
                                                  ". A flow solver cannot use this mesh.");
  } else if (!smooth.converged) {
    set_banner(Banner::Kind::not_converged,
               "Stopped after " + counted(smooth.outer_iterations, "iteration") +
                   " at a residual of " + short_number(smooth.residual) +
                   ": valid, but not converged." + (damage.text.empty() ? "" : ' ' + damage.text));
  } else if (!damage.text.empty()) {
    set_banner(Banner::Kind::damaged, damage.text);
  } else if (const Document* document = mesh_.document(); document && !banner_) {
    set_banner_of_folds(find_folds(document->state().mesh));
  }
  // A residual concerns all nodes and has no place.
  const bool of_a_place = !damage.text.empty() || smooth.inverted > 0 ||
                          (banner_ && banner_->kind == Banner::Kind::partial_motion);
  if (banner_ && of_a_place) banner_->worst = worst_place(damage);
}

/// The damage done by the command that led to the present mesh, with a sentence about it.
Damage MessageBoard::damage_of_last_command() const {
  const Document* document = mesh_.document();
  if (!document || document->history().position() == 0 || document->boundary()) return {};
  const History& history = document->history();
  if (asks_for_heights(history.command(history.position()))) return {};
  Damage damage = find_damage(history.state(history.position() - 1).mesh,
                              history.state(history.position()).mesh);
  std::string& text = damage.text;
  if (text.empty()) return damage;
  const Command& last = history.command(history.position());
  const SmoothOptions* smooth = smooth_options(last);
  const std::vector<std::string> moving = markers_of(last);
  const std::string marker =
      smooth && smooth->formulation == Formulation::variational && !moving.empty()
          ? fixed_marker_at(*history.state(history.position()).mesh.topology, damage, moving,
                            smooth->slide)
          : std::string();
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (!marker.empty()) text += "; " + marker + " may slide instead of being fixed";
  const bool keeps = smooth && !std::holds_alternative<SmoothCommand>(last) &&
                     (smooth->targets.keep > 0 || smooth->targets.by_command());
  text += keeps ? "."
                : "; targets that keep the elements' own shapes, such as \"Keep the mesh as it "
                  "is\", avoid that.";
  return damage;
}

std::optional<MeshItem> MessageBoard::worst_place(const Damage& damage) const {
  if (damage.element) return MeshItem{MeshItem::Kind::element, *damage.element};
  if (damage.node) return MeshItem{MeshItem::Kind::node, *damage.node};
  const Document* document = mesh_.document();
  if (!document) return std::nullopt;
  if (!document->boundary())
    return MeshItem{MeshItem::Kind::element,
                    worst_element(document->state().mesh, Metric::normalized_jacobian)};
  // Only the mesh as opened has been measured; other meshes would have to be measured now.
  const auto& worst = document->loaded_quality().of(Metric::normalized_jacobian).worst;
  if (document->history().position() > 0 || worst.empty()) return std::nullopt;
  return MeshItem{MeshItem::Kind::element, worst.front().element};
}

void MessageBoard::on(const action::DismissPrompt&) {
  if (!prompts_.empty()) prompts_.pop_front();
}

void MessageBoard::on(const action::DismissBanner&) {
  if (banner_ && mesh_.document())
    dismissed_ = std::pair(mesh_.generation(), mesh_.document()->edits().revision());
  banner_.reset();
}

}  // namespace winslow::gui
