#pragma once

#include <deque>

#include "core/quality/mesh_change.h"
#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// What the studio has to say: questions and errors that wait for an answer, the banner over the
/// present mesh, a passing remark.
class MessageBoard {
 public:
  explicit MessageBoard(const LiveMesh& mesh) : mesh_(mesh) {}

  /// The first that waits for an answer; null if none does.
  const Prompt* prompt() const { return prompts_.empty() ? nullptr : &prompts_.front(); }
  void ask(Prompt prompt) { prompts_.push_back(std::move(prompt)); }
  void report_error(std::string title, std::string text);
  /// Nothing is written among the meshes that come with the program: false, and the user is told.
  bool may_write(const std::filesystem::path& path);
  /// False where a file is there that must not be replaced yet: the user is asked, whose consent
  /// does `again`. why: what is to be said of that, after a blank.
  bool may_replace(const std::filesystem::path& path, bool overwrite, const std::string& why,
                   Action again);

  const std::optional<Notice>& notice() const { return notice_; }
  void tell(Notice::Kind kind, std::string text);
  void forget_notice() { notice_.reset(); }

  const std::optional<Banner>& banner() const { return banner_; }
  /// The user has put the banner of the present mesh away.
  bool banner_dismissed() const;
  void set_banner(Banner::Kind kind, std::string text);
  /// Warnings that need no answer, in the banner; those of the mesh itself stay before them.
  void remark(const std::string& what, const std::vector<std::string>& warnings);
  void clear_banner() { banner_.reset(); }
  /// What the mesh at the present position of the history calls for, if anything.
  void set_banner_of_position();
  /// What the result of the last command calls for; a motion that ended early has said so already.
  void set_banner_of_result(const SmoothResult& smooth);

  void on(const action::DismissPrompt&);
  void on(const action::DismissBanner&);
  void on(const action::Remark& a) { tell(Notice::Kind::information, a.text); }

 private:
  Damage damage_of_last_command() const;
  /// Where the mesh has suffered most, or else its worst element.
  std::optional<MeshItem> worst_place(const Damage& damage) const;

  const LiveMesh& mesh_;
  std::deque<Prompt> prompts_;
  std::optional<Banner> banner_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> dismissed_;  // generation and revision
  std::optional<Notice> notice_;
};

}  // namespace winslow::gui
