#pragma once

#include <string>
#include <vector>

namespace winslow {

/// Problems that a mesh can be smoothed by: "variational", "pointwise".
std::vector<std::string> formulation_names();

}  // namespace winslow
