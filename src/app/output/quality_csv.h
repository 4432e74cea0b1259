#pragma once

#include "core/mesh/mesh.h"
#include "core/quality/quality.h"

namespace winslow::app {

/// The quality of meshes as the columns of a CSV file:
///
///     std::string text = csv_line(quality_columns());
///     for (const Mesh& mesh : meshes) text += csv_line(quality_values(mesh,
///     measure_quality(mesh)));
///
/// The columns are the same for every mesh: "nodes", "elements", "inverted", then of each metric of
/// plane and of volume meshes NAME_min, NAME_mean and NAME_max, the number of the worst element
/// (NAME_worst_element) and its centre (NAME_worst_x, _y, _z), then minimum, median and maximum of
/// the first heights at walls.
std::vector<std::string> quality_columns();

/// The values of a mesh, in the order of quality_columns(); empty for metrics, heights and
/// components that the mesh does not have, and for numbers that are not finite. quality: with at
/// least one of the worst elements (QualityOptions::worst).
std::vector<std::string> quality_values(const Mesh& mesh, const QualityReport& quality);

/// A field of a CSV file: quoted if it has commas, quotation marks or line ends (RFC 4180).
std::string csv_field(const std::string& field);
/// Fields with commas between them and a line end, each as by csv_field().
std::string csv_line(const std::vector<std::string>& fields);

}  // namespace winslow::app
