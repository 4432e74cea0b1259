#pragma once

#include "gui/base/background.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/history/document.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/selection.h"

namespace winslow::gui {

/// Opens, closes, saves and exports the mesh, and asks before changes are lost. Reads and writes
/// mesh files on background threads.
class Files {
 public:
  Files(LiveMesh& mesh, MessageBoard& messages, Selection& selection, SolverSettings& settings,
        Jobs& jobs)
      : mesh_(mesh), messages_(messages), selection_(selection), settings_(settings), jobs_(jobs) {}

  /// Collects the threads' results since the last call. True if anything changed.
  bool poll();
  bool busy() const { return loader_.busy() || saver_.busy() || csv_writer_.busy(); }

  bool loading() const { return loader_.busy(); }
  const std::filesystem::path& loading_path() const { return loading_path_; }
  bool saving() const { return saver_.busy(); }
  bool quit_accepted() const { return quit_; }
  /// The open mesh has unsaved changes.
  bool unsaved() const;
  /// Asks whether to save the open mesh. discard: the action if the user declines. After a save,
  /// take_next() returns `next`.
  void ask_to_save(Action next, Action discard);
  /// The action that waited for the mesh to be saved; none until the save is done.
  std::optional<Action> take_next();
  /// Replaces the open mesh by a session recovered after a crash.
  void restore(RestoredSession restored);

  void on(const action::OpenMesh& a);
  void on(const action::SaveMesh& a);
  void on(const action::CloseMesh& a);
  void on(const action::ExportMesh& a);
  void on(const action::ExportMarkers& a);
  void on(const action::ExportRecipe& a);
  void on(const action::ExportConvergence& a);
  void on(const action::Quit& a);

 private:
  struct LoadOutcome {
    action::OpenMesh request;
    std::shared_ptr<Document::Loaded> loaded;
    std::string error;
    bool mendable = false;  // the file opens if its mesh is repaired
  };

  void start_saver(const std::filesystem::path& path, bool copy, bool proceed = false);
  bool poll_loader();
  void offer_repair(const LoadOutcome& outcome);
  bool poll_saver();
  bool poll_csv();
  void adopt(Document::Loaded loaded);

  struct SaveOutcome {
    std::filesystem::path path;
    std::uint64_t generation = 0, revision = 0;
    std::vector<std::string> warnings;
    std::string error;
    bool copy = false;     // the document keeps its path
    bool proceed = false;  // see action::SaveMesh
  };
  struct CsvOutcome {
    std::filesystem::path path;
    std::size_t rows = 0;
    std::string error;
  };

  LiveMesh& mesh_;
  MessageBoard& messages_;
  Selection& selection_;
  SolverSettings& settings_;
  Jobs& jobs_;
  bool quit_ = false;
  std::optional<Action> asked_;              // what to do once the mesh is saved
  bool saved_ = false;                       // the mesh is saved
  std::optional<action::SaveMesh> waiting_;  // save that waits for the solver
  std::filesystem::path loading_path_;
  std::optional<action::OpenMesh> next_;  // requested while another mesh was being read
  Background<LoadOutcome> loader_;
  Background<SaveOutcome> saver_;
  Background<CsvOutcome> csv_writer_;
};

}  // namespace winslow::gui
