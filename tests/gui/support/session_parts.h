#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "gui/document/session/files.h"
#include "gui/document/session/history_editor.h"
#include "gui/document/session/motions.h"
#include "gui/support/meshes.h"

namespace winslow::gui::test {

/// No mesh is open.
struct NothingOpen {
  OngoingWork work{};
  LiveMesh mesh{work};
};

/// The parts of a session, put together by hand so that a test can get at each of them.
struct SessionParts {
  explicit SessionParts(const Mesh& opened) {
    mesh.open(std::make_unique<Document>(Document::load(write(folder, opened))));
    jobs.show_position();
  }

  Index marker(const std::string& name) const { return *mesh.topology()->markers().find(name); }
  /// A node that is on no boundary.
  Index free_node() const {
    Index node = 0;
    while (mesh.topology()->on_boundary(node)) ++node;
    return node;
  }
  const History& done() const { return mesh.document()->history(); }
  /// Until the solver has nothing left to do.
  void finish() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    do {
      jobs.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      REQUIRE(std::chrono::steady_clock::now() < end);
    } while (mesh.in_motion());
  }
  std::string notice() const { return messages.notice() ? messages.notice()->text : ""; }

  TemporaryFolder folder;
  OngoingWork work{};
  LiveMesh mesh{work};
  MessageBoard messages{mesh};
  Selection selection{mesh, messages};
  SolverSettings settings{mesh, messages};
  Jobs jobs{work, mesh, messages, selection, settings};
  Motions motions{work, mesh, messages, selection, settings, jobs};
  VcvEditor vcvs{work, mesh, messages, settings, jobs};
  HistoryEditor history{mesh, messages, settings, jobs, motions};
};

}  // namespace winslow::gui::test
