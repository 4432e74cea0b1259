#include "gui/settings/kept_view_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace winslow::gui {

namespace {

using nlohmann::json;

std::optional<double> number_in(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_number()) return std::nullopt;
  const auto value = it->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<std::array<double, 3>> vector_in(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end() || !it->is_array() || it->size() != 3) return std::nullopt;
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(*it)[k].is_number()) return std::nullopt;
    v[k] = (*it)[k].get<double>();
    if (!std::isfinite(v[k])) return std::nullopt;
  }
  return v;
}

bool flag_in(const json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_boolean() && it->get<bool>();
}

std::vector<CutPlane> cuts_in(const json& object) {
  std::vector<CutPlane> cuts;
  const auto it = object.find("cuts");
  if (it == object.end() || !it->is_array()) return cuts;
  for (const json& entry : *it) {
    if (!entry.is_object() || cuts.size() == most_cuts) continue;
    const auto point = vector_in(entry, "point"), normal = vector_in(entry, "normal");
    if (!point || !normal || *normal == std::array<double, 3>{0, 0, 0}) continue;
    cuts.push_back({*point, *normal, flag_in(entry, "on")});
  }
  return cuts;
}

Peel peel_in(const json& object) {
  Peel peel;
  const auto it = object.find("peel");
  if (it == object.end() || !it->is_object()) return peel;
  const auto marker = it->find("marker");
  const auto from = number_in(*it, "from"), to = number_in(*it, "to");
  if (marker == it->end() || !marker->is_string() || !from || !to) return peel;
  if (!(*from >= 1 && *from <= *to && *to < 1e9)) return peel;
  return {flag_in(*it, "on"), marker->get<std::string>(), static_cast<int>(*from),
          static_cast<int>(*to)};
}

std::optional<KeptView> view_in(const json& entry) {
  if (!entry.is_object()) return std::nullopt;
  const auto mesh = entry.find("mesh");
  const auto centre = vector_in(entry, "centre");
  const auto height = number_in(entry, "height"), azimuth = number_in(entry, "azimuth"),
             elevation = number_in(entry, "elevation"), up = number_in(entry, "up");
  if (mesh == entry.end() || !mesh->is_string() || !centre || !height || !(*height > 0) ||
      !azimuth || !elevation || !(std::abs(*elevation) <= 90) || !up || !(*up >= 0 && *up < 3))
    return std::nullopt;
  return KeptView{mesh->get<std::string>(),
                  *centre,
                  *height,
                  *azimuth,
                  *elevation,
                  number_in(entry, "roll").value_or(0),
                  static_cast<int>(*up),
                  cuts_in(entry),
                  peel_in(entry)};
}

}  // namespace

json write_kept_views(const std::vector<KeptView>& views) {
  json list = json::array();
  for (const KeptView& view : views) {
    json cuts = json::array();
    for (const CutPlane& cut : view.cuts)
      cuts.push_back({{"point", cut.point}, {"normal", cut.normal}, {"on", cut.on}});
    list.push_back({{"mesh", view.mesh},
                    {"centre", view.centre},
                    {"height", view.height},
                    {"azimuth", view.azimuth},
                    {"elevation", view.elevation},
                    {"roll", view.roll},
                    {"up", view.up},
                    {"cuts", std::move(cuts)},
                    {"peel",
                     {{"on", view.peel.on},
                      {"marker", view.peel.marker},
                      {"from", view.peel.from},
                      {"to", view.peel.to}}}});
  }
  return list;
}

std::vector<KeptView> read_kept_views(const json& list) {
  std::vector<KeptView> views;
  if (!list.is_array()) return views;
  for (const json& entry : list) {
    if (views.size() == most_kept_views) break;
    if (auto view = view_in(entry)) views.push_back(std::move(*view));
  }
  return views;
}

}  // namespace winslow::gui
