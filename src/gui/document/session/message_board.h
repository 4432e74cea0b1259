#pragma once

#include <deque>

#include "core/quality/mesh_change.h"
#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/live_mesh.h"

namespace winslow::gui {

/// Messages of the studio: questions and errors that wait for an answer, the banner above the
/// present mesh, and a short-lived notice.
class MessageBoard {
 public:
  explicit MessageBoard(const LiveMesh& mesh) : mesh_(mesh) {}

  /// The first prompt that waits for an answer; null if there is none.
  const Prompt* prompt() const { return prompts_.empty() ? nullptr : &prompts_.front(); }
  void ask(Prompt prompt) { prompts_.push_back(std::move(prompt)); }
  void report_error(std::string title, std::string text);
  /// Returns false, and tells the user, for a path among the bundled meshes.
  bool may_write(const std::filesystem::path& path);
  /// Returns false if a file exists that must not be replaced yet; then asks the user and carries
  /// out `again` upon consent. why: an explanation to append, starting with a blank.
  bool may_replace(const std::filesystem::path& path, bool overwrite, const std::string& why,
                   Action again);

  const std::optional<Notice>& notice() const { return notice_; }
  void tell(Notice::Kind kind, std::string text);
  void forget_notice() { notice_.reset(); }

  const std::optional<Banner>& banner() const { return banner_; }
  /// The user has dismissed the banner of the present mesh.
  bool banner_dismissed() const;
  void set_banner(Banner::Kind kind, std::string text);
  /// Shows warnings that need no answer in the banner, after those about the mesh itself.
  void remark(const std::string& what, const std::vector<std::string>& warnings);
  void clear_banner() { banner_.reset(); }
  /// Sets the banner for the mesh at the present position of the history, if it needs one.
  void set_banner_of_position();
  /// Sets the banner for the result of the last command; a motion that ended early has set its own.
  void set_banner_of_result(const SmoothResult& smooth);
  /// Shows where a surface mesh is folded; no banner if it is not.
  void set_banner_of_folds(const SurfaceFolds& folds);

  void on(const action::DismissPrompt&);
  void on(const action::DismissBanner&);
  void on(const action::Remark& a) { tell(Notice::Kind::information, a.text); }

 private:
  Damage damage_of_last_command() const;
  /// The most damaged place of the mesh, or else its worst element.
  std::optional<MeshItem> worst_place(const Damage& damage) const;

  const LiveMesh& mesh_;
  std::deque<Prompt> prompts_;
  std::optional<Banner> banner_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> dismissed_;  // generation and revision
  std::optional<Notice> notice_;
};

}  // namespace winslow::gui
