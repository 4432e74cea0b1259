#include "core/formulation/formulation_names.h"

namespace winslow {

std::vector<std::string> formulation_names() { return {"variational", "pointwise"}; }

}  // namespace winslow
