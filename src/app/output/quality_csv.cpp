#include "app/output/quality_csv.h"

#include "io/text/numbers.h"

namespace winslow::app {
namespace {

/// The reported metrics of plane meshes, then those that only volume meshes have.
std::vector<Metric> metrics_of_columns() {
  std::vector<Metric> metrics = reported_metrics(2);
  for (const Metric metric : reported_metrics(3))
    if (std::ranges::find(metrics, metric) == metrics.end()) metrics.push_back(metric);
  return metrics;
}

constexpr std::array<const char*, 7> columns_of_metric{
    "_min", "_mean", "_max", "_worst_element", "_worst_x", "_worst_y", "_worst_z"};

std::string text_of(double number) {
  std::string text;
  if (std::isfinite(number)) io::append_number(text, number);
  return text;
}

/// Appends the values of columns_of_metric.
void add_metric(std::vector<std::string>& values, const QualityReport& quality, Metric metric) {
  const auto& own = reported_metrics(quality.cell_dimension);
  std::vector<std::string> texts(columns_of_metric.size());
  if (std::ranges::find(own, metric) != own.end()) {
    const QualityReport::PerMetric& measured = quality.of(metric);
    texts[0] = text_of(measured.statistics.min);
    texts[1] = text_of(measured.statistics.avg);
    texts[2] = text_of(measured.statistics.max);
    if (!measured.worst.empty()) {
      const WorstElement& worst = measured.worst.front();
      texts[3] = std::to_string(worst.element);
      for (int k = 0; k < quality.space_dimension; ++k)
        texts[4 + static_cast<std::size_t>(k)] = text_of(worst.centre[k]);
    }
  }
  values.insert(values.end(), texts.begin(), texts.end());
}

}  // namespace

std::vector<std::string> quality_columns() {
  std::vector<std::string> columns{"nodes", "elements", "inverted"};
  for (const Metric metric : metrics_of_columns())
    for (const char* column : columns_of_metric)
      columns.push_back(std::string(metric_name(metric)) + column);
  for (const char* column : {"first_height_min", "first_height_median", "first_height_max"})
    columns.emplace_back(column);
  return columns;
}

std::vector<std::string> quality_values(const Mesh& mesh, const QualityReport& quality) {
  std::vector<std::string> values{std::to_string(mesh.topology->node_count()),
                                  std::to_string(mesh.topology->element_count()),
                                  std::to_string(quality.inverted)};
  for (const Metric metric : metrics_of_columns()) add_metric(values, quality, metric);
  const Quantiles& heights = quality.walls.first_height;
  for (const double height : {heights.min, heights.median, heights.max})
    values.push_back(heights.count > 0 ? text_of(height) : "");
  return values;
}

std::string csv_field(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string text = "\"";
  for (const char c : field) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += ',';
    line += csv_field(field);
  }
  return line + '\n';
}

}  // namespace winslow::app
