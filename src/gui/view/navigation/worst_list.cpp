#include "gui/view/navigation/worst_list.h"

#include <algorithm>

namespace winslow::gui {

std::vector<ElementField> rankings(int cell_dimension) {
  std::vector<ElementField> fields;
  for (const Metric metric : reported_metrics(cell_dimension))
    fields.emplace_back(metric, cell_dimension);
  if (cell_dimension == 2)
    fields.insert(fields.end(), all_wall_fields().begin(), all_wall_fields().end());
  return fields;
}

ElementField worst_field(const ViewOptions& view) {
  // The view suits the mesh: what it is coloured or ranked by says which kind of elements it has.
  const bool in_space = (view.worst_by && view.worst_by->cell_dimension() == 3) ||
                        (view.color && view.color->cell_dimension() == 3);
  const std::vector<ElementField> fields = rankings(in_space ? 3 : 2);
  for (const std::optional<ElementField>& field : {view.worst_by, view.color})
    if (field && std::ranges::find(fields, *field) != fields.end()) return *field;
  return fields.front();
}

std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view) {
  const auto& measured = session.quality().latest();
  if (!measured) return {};
  const ElementField field = worst_field(view);
  const std::span<const WorstElement> all = field.wall()
                                                ? measured->report.worst_by(*field.wall())
                                                : measured->report.of(*field.metric()).worst;
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
