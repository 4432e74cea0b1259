#pragma once

#include "io/cgns/tree.h"

/// CGNS trees in HDF5 files. HDF5 itself reads them, because libcgns copies the attributes of nodes
/// to arrays of 33 bytes without asking how long they are. How libcgns stores a tree says "CGNS
/// File Mapping Manual", chapter "HDF5": a node is a group with the attributes "name", "label" and
/// "type", its values are the dataset " data", its children are the groups without a leading blank.
namespace winslow::io::cgns {

/// Reads the tree of an HDF5 file without writing a copy of the file. Other threads must not call
/// libcgns or HDF5 at the same time. Throws InputError for a file that HDF5 cannot read, for one
/// without the attributes of CGNS, for attributes of another kind than libcgns writes, and for
/// names and labels of more than 32 characters.
NodePtr read_hdf5_tree(Source& source);

}  // namespace winslow::io::cgns
