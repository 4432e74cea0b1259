#pragma once

#include "io/cgns/tree.h"
#include "io/text/source.h"

namespace winslow::io::cgns {

/// The two ways in which a CGNS file can hold its tree.
enum class Container { hdf5, adf };

struct TreeFile {
  NodePtr root;
  Container container = Container::hdf5;
};

/// By the signature at the beginning of a file, which in HDF5 may follow 512, 1024, 2048, ... bytes
/// of the user's own; nothing: it is neither.
std::optional<Container> container_of(std::string_view bytes);

/// Reads the whole tree, by libcgns. One thread at a time, for libcgns can do no more; others wait.
/// Throws InputError for what libcgns cannot read, and for data that the file is too small for.
TreeFile read_tree(Source& source);

/// The bytes of a file that holds the tree. Throws OutputError.
std::string write_tree(const Node& root, Container container);

/// Why there is none of this in this build of the program; empty: there is.
extern const std::string_view no_library;

}  // namespace winslow::io::cgns
