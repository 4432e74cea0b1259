#include "io/cgns/tree_limits.h"

namespace winslow::io::cgns {
namespace {

constexpr std::size_t smallest_node = 64, some_nodes = 100;
constexpr int deepest = 40;  // libcgns itself goes down 20 levels
// HDF5 can hold compressed data; deflate compresses by a factor of at most 1032.
constexpr std::size_t most_compressed = 1032;

bool printable(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f;
}

}  // namespace

std::string child_path(const std::string& parent, const std::string& name) {
  std::string path = parent + '/' + name;
  std::replace_if(
      path.begin(), path.end(), [](char c) { return !printable(c); }, '?');
  return path;
}

TreeLimits::TreeLimits(Source& source, Container container)
    : source_(source),
      nodes_left_(source.text().size() / smallest_node + some_nodes),
      bytes_left_(source.text().size() * (container == Container::hdf5 ? most_compressed : 1)) {}

void TreeLimits::fail(const std::string& path, const std::string& found,
                      const std::string& expected) const {
  source_.set_part(path.empty() ? "/" : path);
  source_.fail(0, found, expected);
}

void TreeLimits::count_node(const std::string& path, int depth) {
  if (depth > deepest) fail(path, "nodes in nodes without end", "at most 40 levels");
  if (nodes_left_-- == 0) fail(path, "more nodes than the file has room for", "a sound file");
}

std::size_t TreeLimits::count_data(const std::string& path, std::string_view type,
                                   const std::vector<std::int64_t>& dims) {
  const std::size_t size = size_of(type);
  if (size == 0) fail(path, "data of type " + in_quotes(type), "a type of CGNS");
  std::size_t bytes = dims.empty() ? 0 : size;
  for (const std::int64_t dim : dims) {
    if (dim < 0 || (dim > 0 && bytes > bytes_left_ / static_cast<std::size_t>(dim)))
      fail(path, "data of dimension " + std::to_string(dim), "no more than the file can hold");
    bytes *= static_cast<std::size_t>(dim);
  }
  bytes_left_ -= bytes;
  return bytes;
}

}  // namespace winslow::io::cgns
