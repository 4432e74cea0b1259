#include "gui/document/jobs/periodic_sides.h"

namespace winslow::gui {

std::optional<std::string> partner_of(const SlideOptions& slide, const std::string& marker) {
  const std::vector<std::string>& pairs = slide.periodic;
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
    if (pairs[k] == marker) return pairs[k + 1];
    if (pairs[k + 1] == marker) return pairs[k];
  }
  return slide.file_pairs.wanted ? partner_in_file(slide, marker) : std::nullopt;
}

std::optional<std::string> partner_in_file(const SlideOptions& slide, const std::string& marker) {
  if (!slide.file_pairs.found) return std::nullopt;
  for (const GivenPairs& given : slide.file_pairs.found->pairs) {
    if (given.halo || !given.fault.empty()) continue;
    if (given.first == marker) return given.second;
    if (given.second == marker) return given.first;
  }
  return std::nullopt;
}

void take_out(SlideOptions& slide, const std::string& marker) {
  slide.periodic = pairs_without(slide.periodic, marker);
  if (!slide.file_pairs.wanted || !partner_in_file(slide, marker)) return;
  slide.file_pairs.wanted = false;
  for (const GivenPairs& given : slide.file_pairs.found->pairs)
    if (!given.halo && given.first != given.second && given.first != marker &&
        given.second != marker && !partner_of(slide, given.first))
      slide.periodic.insert(slide.periodic.end(), {given.first, given.second});
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
