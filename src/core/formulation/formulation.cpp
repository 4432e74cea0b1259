#include "core/formulation/formulation.h"

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"

namespace winslow {

std::vector<std::string> formulation_names() { return {"pointwise"}; }

std::unique_ptr<Formulation> make_formulation(std::string_view name,
                                              const VirtualControlVolumes& vcv, int threads) {
  if (name == "pointwise") return std::make_unique<PointwiseWinslow>(vcv, threads);
  throw UsageError("unknown formulation '" + std::string(name) + "', expected: pointwise");
}

}  // namespace winslow
