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
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <mutex>

#include "core/error.h"
#include "io/cgns/hdf5_tree.h"
#include "io/cgns/tree_limits.h"
#include "io/file/atomic_file.h"
#include "io/file/scratch_file.h"

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

/// True for the characters that ADF allows in names.
bool allowed_in_name(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f;
}

/// Reads the tree of an ADF file.
class TreeReader {
 public:
  TreeReader(Source& source, const OpenFile& file)
      : file_(file.number()), limits_(source, Container::adf) {}

  NodePtr read(double root_id) {
    const auto root = read_node(root_id, "", 0);
    resolve_links(root, links_);
    return root;
  }

 private:
  void require(int error, const std::string& path) {
    if (error == 0) return;
    limits_.fail(path, "a damaged node (" + library_error() + ")", "one that can be read");
  }

  std::shared_ptr<Node> read_node(double id, const std::string& parent, int depth) {
    auto node = std::make_shared<Node>();
    std::array<char, CGIO_MAX_NAME_LENGTH + 2> text{};
    require(cgio_get_name(file_, id, text.data()), parent);
    node->name = text.data();
    const std::string path = depth == 0 ? "" : child_path(parent, node->name);
    if (!std::all_of(node->name.begin(), node->name.end(), allowed_in_name))
      limits_.fail(path, "a name with characters that ADF does not allow", "ASCII");
    limits_.count_node(path, depth);
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
      limits_.fail(path, "a link of " + std::to_string(path_length) + " characters", "a path");
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
    if (count < 0 || count > TreeLimits::most_dimensions)
      limits_.fail(path, std::to_string(count) + " dimensions", "at most 12");
    node.dims.assign(dims.begin(), dims.begin() + count);
    node.data.resize(limits_.count_data(path, node.type, node.dims));
    if (!node.data.empty()) require(cgio_read_all_data(file_, id, node.data.data()), path);
  }

  void read_children(double id, const std::string& path, int depth, Node& node) {
    int count = 0;
    require(cgio_number_children(file_, id, &count), path);
    if (count < 0 || !limits_.has_room_for(static_cast<std::size_t>(count))) {
      limits_.fail(path, std::to_string(count) + " nodes below it",
                   "no more than the file can hold");
    }
    if (count == 0) return;
    Handles children(file_);
    std::vector<double> ids(static_cast<std::size_t>(count));
    int found = 0;
    require(cgio_children_ids(file_, id, 1, count, &found, ids.data()), path);
    children.ids.assign(ids.begin(), ids.begin() + std::clamp(found, 0, count));
    if (found != count) {
      limits_.fail(path, std::to_string(found) + " nodes below it",
                   std::to_string(count) + " as it says");
    }
    for (const double child : children.ids)
      node.children.push_back(read_node(child, path, depth + 1));
  }

  int file_;
  TreeLimits limits_;
  std::vector<std::shared_ptr<Node>> links_;
};

/// The header of an ADF file says how its numbers are stored. libcgns stops the program where these
/// two letters are none that it knows.
void check_adf_header(Source& source) {
  constexpr std::size_t format_place = 100, size_place = 101;
  constexpr std::string_view formats = "BLCN", sizes = "BL";
  const std::string_view text = source.text();
  const auto knows = [&](std::string_view letters, std::size_t place) {
    return place < text.size() && letters.find(text[place]) != std::string_view::npos;
  };
  source.set_binary_from(0);
  source.set_part({});
  if (!knows(formats, format_place)) {
    source.fail(format_place, "no letter for the format of numbers in the header of an ADF file",
                "B, L, C or N");
  }
  if (!knows(sizes, size_place)) {
    source.fail(size_place, "no letter for the size of numbers in the header of an ADF file",
                "B or L");
  }
  source.set_part("/");
}

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

/// A file for libcgns to write. libcgns makes it by name; remove_name() then takes the name away,
/// so that nothing stays if the program is stopped. Until then no signal stops the program.
class NamelessOutput {
 public:
  NamelessOutput() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &signals_);
    try {
      folder_ = std::make_unique<TemporaryFolder>();
    } catch (...) {
      ::pthread_sigmask(SIG_SETMASK, &signals_, nullptr);
      throw;
    }
  }
  ~NamelessOutput() {
    remove_name();
    if (file_ >= 0) ::close(file_);
  }
  NamelessOutput(const NamelessOutput&) = delete;
  NamelessOutput& operator=(const NamelessOutput&) = delete;

  /// Call before remove_name().
  std::filesystem::path path() const { return *folder_ / "out.cgns"; }

  void remove_name() {
    if (!folder_) return;
    file_ = ::open(path().c_str(), O_RDONLY | O_CLOEXEC);
    folder_.reset();
    ::pthread_sigmask(SIG_SETMASK, &signals_, nullptr);
  }

  /// What was written. Call after libcgns has closed the file. Throws OutputError.
  std::string bytes() const {
    struct stat status {};
    std::string bytes;
    if (file_ >= 0 && ::fstat(file_, &status) == 0)
      bytes.resize(static_cast<std::size_t>(status.st_size));
    std::size_t got = 0;
    while (got < bytes.size()) {
      const ssize_t n = ::read(file_, bytes.data() + got, bytes.size() - got);
      if (n == 0 || (n < 0 && errno != EINTR)) break;
      if (n > 0) got += static_cast<std::size_t>(n);
    }
    if (bytes.empty() || got < bytes.size())
      throw OutputError("CGNS cannot be written: the temporary file cannot be read again");
    return bytes;
  }

 private:
  sigset_t signals_{};  // blocked before
  std::unique_ptr<TemporaryFolder> folder_;
  int file_ = -1;
};

}  // namespace

TreeFile read_tree(Source& source) {
  const auto container = container_of(source.text());
  if (!container) {
    throw InputError(source.name() +
                     ": found neither an HDF5 nor an ADF file, expected a CGNS file");
  }
  const std::scoped_lock lock(library_mutex());
  keep_hdf5_quiet();
  if (*container == Container::hdf5) return {read_hdf5_tree(source), *container};
  check_adf_header(source);
  const ScratchFile copy(source.text());
  const OpenFile file(copy.path(), CGIO_MODE_READ, CGIO_FILE_ADF);
  if (file.failed()) {
    throw InputError(source.name() +
                     ": cannot be read as a CGNS file, it is damaged or none: " + file.error());
  }
  return {TreeReader(source, file).read(file.root()), *container};
}

std::string write_tree(const Node& root, Container container) {
  const std::scoped_lock lock(library_mutex());
  keep_hdf5_quiet();
  NamelessOutput output;
  OpenFile file(output.path(), CGIO_MODE_WRITE,
                container == Container::hdf5 ? CGIO_FILE_HDF5 : CGIO_FILE_ADF);
  if (file.failed()) throw OutputError("CGNS cannot be written: " + file.error());
  output.remove_name();
  TreeWriter(file.number()).write_children(file.root(), root);
  if (!file.close()) throw OutputError("CGNS cannot be written: " + library_error());
  return output.bytes();
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
