#pragma once

#include "core/motion/contact.h"

namespace winslow {

/// Finds where the two sides of a sheet without thickness (a crack, a baffle, a sail) first pass
/// through each other.
///
/// The sides of a sheet are boundary faces whose nodes lie in the same places. A node of one side
/// has passed through the other if it lies behind the nearest point of the other side, in the
/// domain there. The sign is that of the angle-weighted normal (J. Baerentzen, H. Aanaes, IEEE
/// Trans. Vis. Comput. Graph. 11, 2005). Nodes whose nearest point is on the rim of the other side
/// lie beside it. Sides that part are allowed, and so are those that move together. A passage of
/// less than 1e-6 of a face and its way is none: tables are written with six or seven digits.
///
/// Looks at 64 meshes of the way and bisects from the first passage. yielding: faces with a node of
/// these are left out. The contact has `one_sheet` set and names the markers of the two sides.
template <int D>
std::optional<Contact> find_passage(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion, std::span<const Index> yielding);

extern template std::optional<Contact> find_passage<2>(const Topology&, const Coordinates&,
                                                       const Motion&, std::span<const Index>);
extern template std::optional<Contact> find_passage<3>(const Topology&, const Coordinates&,
                                                       const Motion&, std::span<const Index>);

}  // namespace winslow
