#include "gui/view/navigation/worst_list.h"

#include <algorithm>

namespace winslow::gui {

std::vector<ElementField> rankings(MeshKind kind) {
  const int dimension = cell_dimension_of(kind);
  std::vector<ElementField> fields;
  for (const Metric metric : reported_metrics(dimension)) fields.emplace_back(metric, dimension);
  if (kind == MeshKind::plane)
    fields.insert(fields.end(), all_wall_fields().begin(), all_wall_fields().end());
  if (kind == MeshKind::surface) fields.emplace_back(SurfaceField::deviation);
  return fields;
}

ElementField worst_field(const ViewOptions& view, MeshKind kind) {
  const std::vector<ElementField> fields = rankings(kind);
  for (const std::optional<ElementField>& field : {view.worst_by, view.color})
    if (field && std::ranges::find(fields, *field) != fields.end()) return *field;
  return fields.front();
}

namespace {

std::span<const WorstElement> worst_by(const QualityMonitor::Measured& measured,
                                       const ElementField& field) {
  if (field.wall()) return measured.report.worst_by(*field.wall());
  if (field.metric()) return measured.report.of(*field.metric()).worst;
  if (!measured.deviation) return {};
  return measured.deviation->worst;
}

}  // namespace

std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view) {
  const auto& measured = session.quality().latest();
  if (!measured || !session.document()) return {};
  const std::span<const WorstElement> all = worst_by(*measured, worst_field(view, session.kind()));
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
