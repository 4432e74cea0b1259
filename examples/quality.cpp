// Measures a mesh: statistics of every metric that reports have, the worst elements, and the values
// of all elements for a plot of one's own.
//
//     ./quality coarse/wing.su2.gz
#include <winslow/winslow.h>

#include <algorithm>
#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: quality MESH\n");
    return 2;
  }
  try {
    const winslow::Mesh mesh = winslow::io::read_mesh(argv[1]).mesh;
    winslow::QualityOptions options;
    options.worst = 3;
    const winslow::QualityReport report = winslow::measure_quality(mesh, options);
    std::printf("%d elements, %d inverted\n", report.elements, report.inverted);

    for (const winslow::Metric metric : winslow::reported_metrics(report.cell_dimension)) {
      const auto& measured = report.of(metric);
      std::printf("%-22s min %10.4g  avg %10.4g  max %10.4g  worst:",
                  std::string(winslow::metric_name(metric)).c_str(), measured.statistics.min,
                  measured.statistics.avg, measured.statistics.max);
      for (const winslow::WorstElement& worst : measured.worst) std::printf(" %d", worst.element);
      std::printf("\n");
    }

    const std::vector<double> values =
        winslow::element_values(mesh, winslow::Metric::normalized_jacobian);
    const auto poor = std::count_if(values.begin(), values.end(), [](double v) { return v < 0.2; });
    std::printf("%d elements below 0.2\n", static_cast<int>(poor));
    return report.inverted == 0 ? 0 : 4;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
