#pragma once

#include "core/mesh/topology.h"
#include "core/strategy/slide_options.h"
#include "core/types.h"

namespace winslow::gui {

/// The user's override of a boundary node's detected role.
enum class NodeOverride : std::uint8_t {
  none,  ///< detected role
  hold,  ///< fixed although detected as sliding
  slide  ///< slides although detected as a corner
};

NodeOverride override_of(const SlideOptions& slide, Index node);

/// Removes `slide` overrides of nodes on no sliding marker (in a surface mesh all nodes slide), and
/// `hold` overrides of nodes on moving markers.
void drop_stale_overrides(SlideOptions& slide, const Topology& topology,
                          const std::vector<std::string>& moving = {});

/// The sequence of overrides of single nodes, for undo and redo between the commands of the
/// history. Each belongs to the revision of the mesh on which it was made.
class NodeOverrides {
 public:
  void set(SlideOptions& slide, Index node, NodeOverride to, std::uint64_t revision);

  /// The override to undo or redo at this mesh: "Hold node 5"; empty: none.
  std::string undoable(std::uint64_t revision) const;
  std::string redoable(std::uint64_t revision) const;
  /// Return the text of undoable() or redoable(), which must not be empty.
  std::string undo(SlideOptions& slide);
  std::string redo(SlideOptions& slide);

  /// Clears the redo list, after a command was carried out.
  void forget_undone() { undone_.clear(); }
  void clear() {
    done_.clear();
    undone_.clear();
  }

 private:
  struct Change {
    std::uint64_t revision;
    Index node;
    NodeOverride before, after;
  };
  static std::string describe(const Change& change);
  static std::string step(std::vector<Change>& from, std::vector<Change>& to);
  static std::string top_of(const std::vector<Change>& changes, std::uint64_t revision);

  std::vector<Change> done_, undone_;
};

/// Nodes of interest to the user: one inspected, one under the mouse, any number pinned.
class NodeSelection {
 public:
  const std::optional<Index>& inspected() const { return inspected_; }
  const std::optional<Index>& hovered() const { return hovered_; }
  /// Ascending.
  const std::vector<Index>& pinned() const { return pinned_; }
  bool pinned(Index node) const;

  void inspect(std::optional<Index> node) { inspected_ = node; }
  void hover(std::optional<Index> node) { hovered_ = node; }
  void pin(const std::vector<Index>& nodes);
  void unpin(const std::vector<Index>& nodes);
  /// Drops all nodes for which `keep` is false.
  void keep_if(const std::function<bool(Index)>& keep);

 private:
  std::optional<Index> inspected_, hovered_;
  std::vector<Index> pinned_;
};

}  // namespace winslow::gui
