#include "io/cgns/tree.h"

namespace winslow::io::cgns {

std::optional<Container> container_of(std::string_view bytes) {
  constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n", adf = "ADF Database Version";
  constexpr std::size_t first = 512, last = std::size_t{1} << 20;
  // The signature comes after four other bytes.
  if (bytes.size() > 4 && bytes.substr(4).starts_with(adf)) return Container::adf;
  if (bytes.starts_with(hdf5)) return Container::hdf5;
  for (std::size_t place = first; place <= last && place < bytes.size(); place *= 2)
    if (bytes.substr(place).starts_with(hdf5)) return Container::hdf5;
  return std::nullopt;
}

}  // namespace winslow::io::cgns

#ifdef WINSLOW_HAS_CGNS

#include <cgns_io.h>
#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <utility>

#include "core/error.h"
#include "io/file/atomic_file.h"

namespace winslow::io::cgns {

constinit const std::string_view no_library = {};

namespace {

/// libcgns and HDF5 keep their state in global variables.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// HDF5 cleans up when a program ends, and prints errors if a damaged file was read. This switches
/// the cleanup off; we close what we open. The function is looked up at run time because only
/// libcgns needs the headers of HDF5, which may not be installed. Call this before any other
/// function of HDF5.
void keep_hdf5_quiet() {
  static const bool done = [] {
    if (void* function = ::dlsym(RTLD_DEFAULT, "H5dont_atexit"))
      reinterpret_cast<int (*)()>(function)();
    return true;
  }();
  static_cast<void>(done);
}

std::string library_error() {
  std::array<char, CGIO_MAX_ERROR_LENGTH + 1> text{};
  cgio_error_message(text.data());
  return text.data();
}

/// A file opened by libcgns.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int mode, int type) {
    failed_ = cgio_open_file(path.c_str(), mode, type, &number_) != 0;
    failed_ = failed_ || cgio_get_root_id(number_, &root_) != 0;
    if (failed_) error_ = library_error();
  }
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool failed() const { return failed_; }
  const std::string& error() const { return error_; }
  int number() const { return number_; }
  double root() const { return root_; }
  /// False if not everything could be written.
  bool close() {
    if (number_ == 0) return true;
    const bool good = cgio_close_file(number_) == 0;
    number_ = 0;
    return good;
  }

 private:
  int number_ = 0;
  double root_ = 0;
  bool failed_ = false;
  std::string error_;
};

/// Handles of nodes, released by the destructor.
struct Handles {
  explicit Handles(int open_file) : file(open_file) {}
  ~Handles() {
    for (const double id : ids) cgio_release_id(file, id);
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  int file;
  std::vector<double> ids;
};

bool printable(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f;
}

/// Path of a node for messages; in damaged files, names may hold any bytes.
std::string child_path(const std::string& parent, const std::string& name) {
  std::string path = parent + '/' + name;
  std::replace_if(
      path.begin(), path.end(), [](char c) { return !printable(c); }, '?');
  return path;
}

class TreeReader {
 public:
  TreeReader(Source& source, const OpenFile& file, Container container)
      : source_(source),
        file_(file.number()),
        container_(container),
        nodes_left_(source.text().size() / smallest_node + some_nodes),
        // HDF5 can hold compressed data; deflate compresses by a factor of at most 1032.
        bytes_left_(source.text().size() * (container == Container::hdf5 ? 1032 : 1)) {}

  NodePtr read(double root_id) {
    const auto root = read_node(root_id, "", 0);
    resolve_links(root, links_);
    return root;
  }

 private:
  static constexpr std::size_t smallest_node = 64, some_nodes = 100;
  static constexpr int deepest = 40;  // libcgns itself goes down 20 levels

  [[noreturn]] void fail(const std::string& path, const std::string& found,
                         const std::string& expected) {
    source_.set_part(path.empty() ? "/" : path);
    source_.fail(0, found, expected);
  }
  void require(int error, const std::string& path) {
    if (error != 0) fail(path, "a damaged node (" + library_error() + ")", "one that can be read");
  }

  std::shared_ptr<Node> read_node(double id, const std::string& parent, int depth) {
    auto node = std::make_shared<Node>();
    std::array<char, CGIO_MAX_NAME_LENGTH + 2> text{};
    require(cgio_get_name(file_, id, text.data()), parent);
    node->name = text.data();
    const std::string path = depth == 0 ? "" : child_path(parent, node->name);
    if (container_ == Container::adf &&
        !std::all_of(node->name.begin(), node->name.end(), printable))
      fail(path, "a name with characters that ADF does not allow", "ASCII");
    if (depth > deepest) fail(path, "nodes in nodes without end", "at most 40 levels");
    if (nodes_left_-- == 0) fail(path, "more nodes than the file has room for", "a sound file");
    int link_length = 0;
    require(cgio_is_link(file_, id, &link_length), path);
    if (link_length > 0) {
      read_link(id, path, *node);
      links_.push_back(node);
      return node;
    }
    require(cgio_get_label(file_, id, text.data()), path);
    node->label = text.data();
    require(cgio_get_data_type(file_, id, text.data()), path);
    node->type = text.data();
    if (node->type != "MT") read_data(id, path, *node);
    read_children(id, path, depth, *node);
    return node;
  }

  void read_link(double id, const std::string& path, Node& node) {
    int file_length = 0, path_length = 0;
    require(cgio_link_size(file_, id, &file_length, &path_length), path);
    if (file_length < 0 || file_length > CGIO_MAX_FILE_LENGTH || path_length < 0 ||
        path_length > CGIO_MAX_LINK_LENGTH) {
      fail(path, "a link of " + std::to_string(path_length) + " characters", "a path");
    }
    std::string file(static_cast<std::size_t>(file_length) + 1, '\0');
    std::string link(static_cast<std::size_t>(path_length) + 1, '\0');
    require(cgio_get_link(file_, id, file.data(), link.data()), path);
    node.type = "LK";
    node.link_file = file.c_str();
    node.link_path = link.c_str();
  }

  void read_data(double id, const std::string& path, Node& node) {
    int count = 0;
    std::array<cgsize_t, CGIO_MAX_DIMENSIONS + 1> dims{};
    require(cgio_get_dimensions(file_, id, &count, dims.data()), path);
    if (count < 0 || count > CGIO_MAX_DIMENSIONS)
      fail(path, std::to_string(count) + " dimensions", "at most 12");
    const std::size_t size = size_of(node.type);
    if (size == 0) fail(path, "data of type " + in_quotes(node.type), "a type of CGNS");
    std::size_t bytes = count == 0 ? 0 : size;
    for (int k = 0; k < count; ++k) {
      const std::int64_t dim = dims[static_cast<std::size_t>(k)];
      if (dim < 0 || (dim > 0 && bytes > bytes_left_ / static_cast<std::size_t>(dim))) {
        fail(path, "data of dimension " + std::to_string(dim), "no more than the file can hold");
      }
      bytes *= static_cast<std::size_t>(dim);
      node.dims.push_back(dim);
    }
    bytes_left_ -= bytes;
    node.data.resize(bytes);
    if (bytes == 0) return;
    // HDF5 may store another type than the node declares. This call converts to the declared type;
    // a plain read would write past the end of the buffer.
    require(container_ == Container::hdf5
                ? cgio_read_all_data_type(file_, id, node.type.c_str(), node.data.data())
                : cgio_read_all_data(file_, id, node.data.data()),
            path);
  }

  void read_children(double id, const std::string& path, int depth, Node& node) {
    int count = 0;
    require(cgio_number_children(file_, id, &count), path);
    if (count < 0 || static_cast<std::size_t>(count) > nodes_left_)
      fail(path, std::to_string(count) + " nodes below it", "no more than the file can hold");
    if (count == 0) return;
    Handles children(file_);
    std::vector<double> ids(static_cast<std::size_t>(count));
    int found = 0;
    require(cgio_children_ids(file_, id, 1, count, &found, ids.data()), path);
    children.ids.assign(ids.begin(), ids.begin() + std::clamp(found, 0, count));
    if (found != count) {
      fail(path, std::to_string(found) + " nodes below it", std::to_string(count) + " as it says");
    }
    for (const double child : children.ids)
      node.children.push_back(read_node(child, path, depth + 1));
  }

  Source& source_;
  int file_;
  Container container_;
  std::size_t nodes_left_, bytes_left_;
  std::vector<std::shared_ptr<Node>> links_;
};

/// A name for libcgns, which always writes 33 bytes into HDF5, even for shorter text.
class Text {
 public:
  explicit Text(const std::string& text) {
    static_assert(CGIO_MAX_NAME_LENGTH == CGIO_MAX_LABEL_LENGTH);
    std::copy_n(text.begin(), std::min(text.size(), bytes_.size() - 1), bytes_.begin());
  }
  const char* data() const { return bytes_.data(); }

 private:
  std::array<char, CGIO_MAX_NAME_LENGTH + 1> bytes_{};
};

class TreeWriter {
 public:
  explicit TreeWriter(int file) : file_(file) {}

  void write_children(double parent, const Node& node) {
    for (const NodePtr& child : node.children) write_node(parent, *child);
  }

 private:
  void require(int error, const Node& node) {
    if (error == 0) return;
    throw OutputError("the CGNS node " + in_quotes(node.name) +
                      " cannot be written: " + library_error());
  }

  void write_node(double parent, const Node& node) {
    double id = 0;
    if (node.is_link()) {
      require(cgio_create_link(file_, parent, Text(node.name).data(), node.link_file.c_str(),
                               node.link_path.c_str(), &id),
              node);
      cgio_release_id(file_, id);
      return;
    }
    std::vector<cgsize_t> dims;
    for (const std::int64_t dim : node.dims) {
      if (dim > std::numeric_limits<cgsize_t>::max()) {
        throw OutputError("the CGNS node " + in_quotes(node.name) +
                          " is too large for this libcgns");
      }
      dims.push_back(static_cast<cgsize_t>(dim));
    }
    // libcgns cannot write empty data.
    const bool empty = node.data.empty();
    require(cgio_new_node(file_, parent, Text(node.name).data(), Text(node.label).data(),
                          Text(empty ? "MT" : node.type).data(),
                          empty ? 0 : static_cast<int>(dims.size()), dims.data(),
                          empty ? nullptr : node.data.data(), &id),
            node);
    Handles handle(file_);
    handle.ids.push_back(id);
    write_children(id, node);
  }

  int file_;
};

void put_file(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw OutputError(path.string() + ": cannot be written: " + std::strerror(errno));
}

std::string get_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad() || bytes.empty()) throw OutputError(path.string() + ": cannot be read again");
  return bytes;
}

}  // namespace

TreeFile read_tree(Source& source) {
  const auto container = container_of(source.text());
  if (!container) {
    throw InputError(source.name() +
                     ": found neither an HDF5 nor an ADF file, expected a CGNS file");
  }
  const std::scoped_lock lock(library_mutex());
  keep_hdf5_quiet();
  const TemporaryFolder folder;
  const auto path = folder / "in.cgns";
  put_file(path, source.text());
  const OpenFile file(path, CGIO_MODE_READ,
                      *container == Container::hdf5 ? CGIO_FILE_HDF5 : CGIO_FILE_ADF);
  if (file.failed()) {
    throw InputError(source.name() +
                     ": cannot be read as a CGNS file, it is damaged or none: " + file.error());
  }
  std::array<char, CGIO_MAX_LABEL_LENGTH + 2> label{};
  if (cgio_get_label(file.number(), file.root(), label.data()) != 0) {
    throw InputError(source.name() +
                     ": found an HDF5 file without the nodes of CGNS, expected a CGNS file");
  }
  return {TreeReader(source, file, *container).read(file.root()), *container};
}

std::string write_tree(const Node& root, Container container) {
  const std::scoped_lock lock(library_mutex());
  keep_hdf5_quiet();
  const TemporaryFolder folder;
  const auto path = folder / "out.cgns";
  OpenFile file(path, CGIO_MODE_WRITE,
                container == Container::hdf5 ? CGIO_FILE_HDF5 : CGIO_FILE_ADF);
  if (file.failed()) throw OutputError("CGNS cannot be written: " + file.error());
  TreeWriter(file.number()).write_children(file.root(), root);
  if (!file.close()) throw OutputError("CGNS cannot be written: " + library_error());
  return get_file(path);
}

}  // namespace winslow::io::cgns

#else

#include "core/error.h"

namespace winslow::io::cgns {

const std::string_view no_library =
    "this winslow was built without CGNS; install libcgns (Debian: libcgns-dev) and build it again";

TreeFile read_tree(Source& source) {
  throw InputError(source.name() + ": " + std::string(no_library));
}

std::string write_tree(const Node&, Container) { throw UsageError(std::string(no_library)); }

}  // namespace winslow::io::cgns

#endif
