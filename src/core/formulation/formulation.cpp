#include "core/formulation/formulation.h"

namespace winslow {

std::vector<std::string> formulation_names() { return {"variational", "pointwise"}; }

}  // namespace winslow
