#pragma once

#include "gui/picture/figure/vector_figure.h"

namespace winslow::gui {

/// True for .svg and .pdf.
bool is_vector_format(const std::filesystem::path& path);
/// Throws UsageError for a name that ends in none of .png, .svg and .pdf: what is written would not
/// be what its name says.
void check_picture_name(const std::filesystem::path& path);

/// Writes a figure as one page of SVG or PDF, by the ending of the file's name, fonts embedded. The
/// page is the camera's viewport with figure_margins() around it. Written to a temporary name and
/// renamed. Throws OutputError, UsageError for another ending.
void write_figure(const std::filesystem::path& path, const VectorFigure& figure);

}  // namespace winslow::gui
