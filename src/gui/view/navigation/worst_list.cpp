#include "gui/view/navigation/worst_list.h"

#include <algorithm>

namespace winslow::gui {

Metric worst_metric(const ViewOptions& view) {
  if (view.worst_by) return *view.worst_by;
  const Metric* shown = view.color ? view.color->metric() : nullptr;
  return shown && metric_info(*shown).reported ? *shown : Metric::normalized_jacobian;
}

std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view) {
  const auto& measured = session.quality().latest();
  if (!measured) return {};
  const std::span<const WorstElement> all = measured->report.of(worst_metric(view)).worst;
  return all.first(std::min(all.size(), static_cast<std::size_t>(std::max(view.worst_count, 0))));
}

std::optional<MeshItem> next_worst(const Session& session, const ViewOptions& view,
                                   const std::optional<MeshItem>& focus, int by) {
  const auto worst = worst_elements(session, view);
  if (worst.empty()) return std::nullopt;
  const auto here = std::ranges::find_if(worst, [&](const WorstElement& w) {
    return focus && focus->kind == MeshItem::Kind::element && focus->id == w.element;
  });
  const auto last = static_cast<std::ptrdiff_t>(worst.size()) - 1;
  std::ptrdiff_t next = 0;
  if (here != worst.end()) next = std::clamp<std::ptrdiff_t>((here - worst.begin()) + by, 0, last);
  return MeshItem{MeshItem::Kind::element, worst[static_cast<std::size_t>(next)].element};
}

}  // namespace winslow::gui
