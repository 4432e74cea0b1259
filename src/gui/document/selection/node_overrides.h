#pragma once

#include "core/mesh/topology.h"
#include "core/strategy/slide_options.h"
#include "core/types.h"

namespace winslow::gui {

/// What a node of the boundary was told to do instead of what was found of it.
enum class NodeOverride : std::uint8_t {
  none,  ///< as found
  hold,  ///< stays, though it would slide
  slide  ///< slides, though it is a corner
};

NodeOverride override_of(const SlideOptions& slide, Index node);

/// Lets go of smooth nodes that no sliding marker has any more (of a surface mesh all nodes slide)
/// and of held ones of markers that a motion takes.
void drop_stale_overrides(SlideOptions& slide, const Topology& topology,
                          const std::vector<std::string>& moving = {});

/// The overrides of single nodes as they were made, to be undone and redone among the commands of
/// the history: each belongs to the mesh on which it was made, by its revision.
class NodeOverrides {
 public:
  void set(SlideOptions& slide, Index node, NodeOverride to, std::uint64_t revision);

  /// What would be undone or redone at this mesh: "Hold node 5"; empty: nothing.
  std::string undoable(std::uint64_t revision) const;
  std::string redoable(std::uint64_t revision) const;
  /// Only where undoable(), redoable() say something, which they return.
  std::string undo(SlideOptions& slide);
  std::string redo(SlideOptions& slide);

  /// A command was carried out: there is nothing to be done again.
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

/// Nodes that the user looks at: one in the inspector, one under the mouse, any number pinned.
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
  /// Lets go of all other nodes.
  void keep_if(const std::function<bool(Index)>& keep);

 private:
  std::optional<Index> inspected_, hovered_;
  std::vector<Index> pinned_;
};

}  // namespace winslow::gui
