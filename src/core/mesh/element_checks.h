#pragma once

#include "core/mesh/mesh_data.h"

namespace winslow {

/// Throws MeshError naming an element: of another dimension than the first or than the space has
/// room for, with another number of corners than its type has, with a corner that is no node, or
/// one twice. Also if there is no element.
void check_elements(const MeshData& data);

}  // namespace winslow
