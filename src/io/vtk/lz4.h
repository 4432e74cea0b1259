#pragma once

#include <span>
#include <string_view>

namespace winslow::io::vtk {

/// Unpacks one block of LZ4 ("LZ4 Block Format Description", github.com/lz4/lz4), as
/// vtkLZ4DataCompressor writes it. unpacked: must have the size that the data have unpacked.
/// Returns false if the block is damaged or has another size.
///
///     std::string data(size, '\0');
///     if (!unpack_lz4(packed, data)) ...
bool unpack_lz4(std::string_view packed, std::span<char> unpacked);

}  // namespace winslow::io::vtk
