#include "gui/document/jobs/periodic_sides.h"

namespace winslow::gui {

std::optional<std::string> partner_of(const SlideOptions& slide, const std::string& marker) {
  const std::vector<std::string>& pairs = slide.periodic;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    if (pairs[k] == marker) return pairs[k + 1];
    if (pairs[k + 1] == marker) return pairs[k];
  }
  return std::nullopt;
}

std::vector<std::string> pairs_without(const std::vector<std::string>& pairs,
                                       const std::string& marker) {
  std::vector<std::string> kept;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2)
    if (pairs[k] != marker && pairs[k + 1] != marker)
      kept.insert(kept.end(), {pairs[k], pairs[k + 1]});
  return kept;
}

}  // namespace winslow::gui
