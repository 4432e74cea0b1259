#pragma once

#include "core/mesh/mesh.h"

namespace winslow::app {

struct ZoneRun;

/// What holds the nodes of a mesh in which a body moved and no other node followed.
struct HeldMotion {
  Index nodes = 0;  ///< used nodes that belong to no moving marker: none of them moved
  struct Holder {
    std::string name;  ///< "marker front", "no marker", ...
    Index nodes = 0;
    bool operator==(const Holder&) const = default;
  };
  std::vector<Holder> holders;  ///< most nodes first; a node may be in several
  std::string slides;           ///< a marker whose nodes could slide; empty: none
};

/// Nothing if no body moved, or any node outside the moving markers moved, or there is none.
/// before and after: of the same connectivity. moving: names of the markers that moved.
std::optional<HeldMotion> find_held_motion(const Mesh& before, const Mesh& after,
                                           const std::vector<std::string>& moving);
/// The same for the commands of a zone that move bodies.
std::optional<HeldMotion> find_held_motion(const ZoneRun& zone);

/// "no node but those of flap moved: the other 12 are held by the markers front (8) and back (8);
/// --slide front lets its nodes move along it".
std::string describe(const HeldMotion& held, const std::vector<std::string>& moving);

/// Names of the markers that the commands of a zone move, and that other nodes are to follow.
std::vector<std::string> moving_markers(const ZoneRun& zone);

}  // namespace winslow::app
