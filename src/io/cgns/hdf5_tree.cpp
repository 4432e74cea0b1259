#include "io/cgns/hdf5_tree.h"

#ifdef WINSLOW_HAS_CGNS

#include <dlfcn.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "io/cgns/tree_limits.h"

namespace winslow::io::cgns {
namespace {

/// The part of HDF5 (1.10 or later) that is used. Its functions are looked up at run time, because
/// libcgns brings the library but not its headers.
struct Hdf5 {
  using Id = std::int64_t;  // hid_t
  using Size = unsigned long long;
  using Visit = int (*)(Id group, const char* name, const void* link, void* data);

  int (*version)(unsigned*, unsigned*, unsigned*);
  int (*silence)(Id, const void*, void*);
  Id (*create_list)(Id kind);
  int (*close_list)(Id);
  int (*use_core)(Id list, std::size_t increment, int backing_store);
  int (*set_image)(Id list, void* bytes, std::size_t size);
  Id (*open_file)(const char*, unsigned flags, Id list);
  int (*close_file)(Id);
  Id (*open_group)(Id, const char*, Id list);
  int (*close_group)(Id);
  int (*visit)(Id group, int index, int order, Size* from, Visit, void* data);
  int (*link_exists)(Id, const char*, Id list);
  int (*attribute_exists)(Id, const char*);
  Id (*open_attribute)(Id, const char*, Id list);
  Id (*attribute_type)(Id);
  Id (*attribute_space)(Id);
  int (*read_attribute)(Id, Id type, void*);
  int (*close_attribute)(Id);
  int (*type_class)(Id);
  std::size_t (*type_size)(Id);
  int (*is_variable)(Id);
  int (*close_type)(Id);
  Id (*open_data)(Id, const char*, Id list);
  Id (*data_space)(Id);
  int (*read_data)(Id, Id type, Id memory, Id file, Id list, void*);
  int (*close_data)(Id);
  std::int64_t (*values_of)(Id space);
  int (*dimensions)(Id space, Size*, Size* most);
  int (*dimension_count)(Id space);
  int (*close_space)(Id);
  const Id *file_access, *chars, *uchars, *int32, *int64, *uint32, *uint64, *reals32, *reals64;

  /// Null: the library is missing or too old.
  static const Hdf5* find();
};

template <class Symbol>
bool look_up(Symbol& symbol, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (void* address = ::dlsym(RTLD_DEFAULT, name)) {
      symbol = reinterpret_cast<Symbol>(address);
      return true;
    }
  }
  return false;
}

bool look_up_handles(Hdf5& h) {
  return look_up(h.open_file, {"H5Fopen"}) && look_up(h.close_file, {"H5Fclose"}) &&
         look_up(h.open_group, {"H5Gopen2"}) && look_up(h.close_group, {"H5Gclose"}) &&
         look_up(h.open_attribute, {"H5Aopen"}) && look_up(h.close_attribute, {"H5Aclose"}) &&
         look_up(h.open_data, {"H5Dopen2"}) && look_up(h.close_data, {"H5Dclose"}) &&
         look_up(h.create_list, {"H5Pcreate"}) && look_up(h.close_list, {"H5Pclose"}) &&
         look_up(h.close_type, {"H5Tclose"}) && look_up(h.close_space, {"H5Sclose"});
}

bool look_up_calls(Hdf5& h) {
  // From 1.12 on the first name is that of a macro; the arguments that are used here are the same.
  return look_up(h.visit, {"H5Literate", "H5Literate2", "H5Literate1"}) &&
         look_up(h.silence, {"H5Eset_auto2"}) && look_up(h.use_core, {"H5Pset_fapl_core"}) &&
         look_up(h.set_image, {"H5Pset_file_image"}) && look_up(h.link_exists, {"H5Lexists"}) &&
         look_up(h.attribute_exists, {"H5Aexists"}) && look_up(h.attribute_type, {"H5Aget_type"}) &&
         look_up(h.attribute_space, {"H5Aget_space"}) && look_up(h.read_attribute, {"H5Aread"}) &&
         look_up(h.type_class, {"H5Tget_class"}) && look_up(h.type_size, {"H5Tget_size"}) &&
         look_up(h.is_variable, {"H5Tis_variable_str"}) &&
         look_up(h.data_space, {"H5Dget_space"}) && look_up(h.read_data, {"H5Dread"}) &&
         look_up(h.values_of, {"H5Sget_simple_extent_npoints"}) &&
         look_up(h.dimensions, {"H5Sget_simple_extent_dims"}) &&
         look_up(h.dimension_count, {"H5Sget_simple_extent_ndims"});
}

bool look_up_types(Hdf5& h) {
  return look_up(h.file_access, {"H5P_CLS_FILE_ACCESS_ID_g"}) &&
         look_up(h.chars, {"H5T_NATIVE_SCHAR_g"}) && look_up(h.uchars, {"H5T_NATIVE_UCHAR_g"}) &&
         look_up(h.int32, {"H5T_NATIVE_INT32_g"}) && look_up(h.int64, {"H5T_NATIVE_INT64_g"}) &&
         look_up(h.uint32, {"H5T_NATIVE_UINT32_g"}) && look_up(h.uint64, {"H5T_NATIVE_UINT64_g"}) &&
         look_up(h.reals32, {"H5T_NATIVE_FLOAT_g"}) && look_up(h.reals64, {"H5T_NATIVE_DOUBLE_g"});
}

const Hdf5* Hdf5::find() {
  static Hdf5 hdf5{};
  static const bool found = [] {
    unsigned major = 0, minor = 0, release = 0;
    int (*open)() = nullptr;
    if (!look_up(hdf5.version, {"H5get_libversion"}) || !look_up(open, {"H5open"})) return false;
    // Handles had another size before.
    if (hdf5.version(&major, &minor, &release) < 0 || std::pair(major, minor) < std::pair(1U, 10U))
      return false;
    const bool all =
        open() >= 0 && look_up_handles(hdf5) && look_up_calls(hdf5) && look_up_types(hdf5);
    if (all) hdf5.silence(0, nullptr, nullptr);
    return all;
  }();
  return found ? &hdf5 : nullptr;
}

/// A handle of HDF5, closed by the destructor.
class Handle {
 public:
  Handle(Hdf5::Id id, int (*close)(Hdf5::Id)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool good() const { return id_ >= 0; }
  operator Hdf5::Id() const { return id_; }

 private:
  Hdf5::Id id_;
  int (*close_)(Hdf5::Id);
};

constexpr Hdf5::Id by_default = 0;  // H5P_DEFAULT, H5S_ALL

/// A link of a group: how it leads to its object, and its name.
struct GroupLink {
  int kind;  ///< 0: the object is part of the group
  std::string name;
};
using GroupLinks = std::vector<GroupLink>;

int collect(Hdf5::Id, const char* name, const void* link, void* links) {
  static_cast<GroupLinks*>(links)->push_back({*static_cast<const int*>(link), name});
  return 0;
}

class Reader {
 public:
  Reader(const Hdf5& hdf5, Source& source, Hdf5::Id file)
      : h_(hdf5), file_(file), limits_(source, Container::hdf5) {
    // libcgns of old did not turn the dimensions over; this dataset tells.
    first_is_fastest_ = h_.link_exists(file, " version", by_default) > 0;
  }

  NodePtr read() {
    const Handle root(h_.open_group(file_, "/", by_default), h_.close_group);
    if (!root.good()) limits_.fail("", "no root group", "a sound HDF5 file");
    auto node = read_node(root, "", "", 0);
    resolve_links(node, links_);
    return node;
  }

 private:
  static constexpr std::size_t longest_name = 32, longest_link = 4096;

  std::shared_ptr<Node> read_node(Hdf5::Id group, const std::string& parent,
                                  const std::string& link, int depth) {
    const std::string path = depth == 0 ? "" : child_path(parent, link);
    limits_.count_node(path, depth);
    auto node = std::make_shared<Node>();
    node->name = text_attribute(group, path, "name", longest_name);
    node->type = text_attribute(group, path, "type", 2);
    if (node->type == "LK") {
      node->link_path = text_data(group, path, " path");
      if (h_.link_exists(group, " file", by_default) > 0)
        node->link_file = text_data(group, path, " file");
      links_.push_back(node);
      return node;
    }
    node->label = text_attribute(group, path, "label", longest_name);
    if (node->type != "MT") read_values(group, path, *node);
    read_children(group, path, depth, *node);
    return node;
  }

  std::string text_attribute(Hdf5::Id group, const std::string& path, const char* name,
                             std::size_t longest) const {
    const std::string what = std::string("the attribute \"") + name + '"';
    if (h_.attribute_exists(group, name) <= 0) limits_.fail(path, "no " + what.substr(4), "one");
    const Handle attribute(h_.open_attribute(group, name, by_default), h_.close_attribute);
    const Handle type(attribute.good() ? h_.attribute_type(attribute) : -1, h_.close_type);
    const Handle space(attribute.good() ? h_.attribute_space(attribute) : -1, h_.close_space);
    if (!type.good() || !space.good())
      limits_.fail(path, "a damaged node (" + what + " cannot be read)", "one that can be read");
    constexpr int string_class = 3, longest_stored = 4096;
    const std::size_t size = h_.type_size(type);
    const bool text = h_.type_class(type) == string_class && h_.is_variable(type) == 0;
    if (!text) {
      limits_.fail(path, what + " as " + kind_of(type),
                   "a string of fixed length, as libcgns has it");
    }
    if (h_.values_of(space) != 1 || size > longest_stored)
      limits_.fail(path, what + " with several values", "one string");
    std::string value(size, '\0');
    if (h_.read_attribute(attribute, type, value.data()) < 0)
      limits_.fail(path, "a damaged node (" + what + " cannot be read)", "one that can be read");
    value.resize(std::min(value.find('\0'), value.size()));
    if (value.size() > longest) {
      limits_.fail(path, what + " with " + std::to_string(value.size()) + " characters",
                   "at most " + std::to_string(longest));
    }
    return value;
  }

  std::string kind_of(Hdf5::Id type) const {
    constexpr std::array kinds{"a whole number", "a real number", "a time",     "a string",
                               "bits",           "bytes",         "a compound", "a reference",
                               "an enumeration", "a list",        "an array"};
    const int number = h_.type_class(type);
    if (number == 3) return "a string of variable length";
    return number >= 0 && at(number) < kinds.size() ? kinds[at(number)] : "an unknown type";
  }

  const Hdf5::Id* memory_type(std::string_view type) const {
    const std::array<std::pair<std::string_view, const Hdf5::Id*>, 8> types{{{"C1", h_.chars},
                                                                             {"B1", h_.uchars},
                                                                             {"I4", h_.int32},
                                                                             {"I8", h_.int64},
                                                                             {"U4", h_.uint32},
                                                                             {"U8", h_.uint64},
                                                                             {"R4", h_.reals32},
                                                                             {"R8", h_.reals64}}};
    for (const auto& [name, id] : types)
      if (name == type) return id;
    return nullptr;
  }

  void read_values(Hdf5::Id group, const std::string& path, Node& node) {
    const Hdf5::Id* type = memory_type(node.type);
    if (type == nullptr)
      limits_.fail(path, "data of type " + in_quotes(node.type), "a type of CGNS");
    const Handle data(h_.link_exists(group, " data", by_default) > 0
                          ? h_.open_data(group, " data", by_default)
                          : -1,
                      h_.close_data);
    const Handle space(data.good() ? h_.data_space(data) : -1, h_.close_space);
    const int count = space.good() ? h_.dimension_count(space) : -1;
    if (count < 0)
      limits_.fail(path, "a damaged node (no values of type " + node.type + ")", "its values");
    if (count > TreeLimits::most_dimensions)
      limits_.fail(path, std::to_string(count) + " dimensions", "at most 12");
    std::vector<Hdf5::Size> sizes(at(count));
    if (count > 0 && h_.dimensions(space, sizes.data(), nullptr) != count)
      limits_.fail(path, "a damaged node (its dimensions)", "one that can be read");
    if (!first_is_fastest_) std::reverse(sizes.begin(), sizes.end());
    // A size that is no signed number becomes negative, which is refused.
    for (const Hdf5::Size size : sizes) node.dims.push_back(static_cast<std::int64_t>(size));
    node.data.resize(limits_.count_data(path, node.type, node.dims));
    if (node.data.empty()) return;
    // HDF5 converts the values to the type that the node declares.
    if (h_.read_data(data, *type, by_default, by_default, by_default, node.data.data()) < 0)
      limits_.fail(path, "a damaged node (its values cannot be read)", "one that can be read");
  }

  /// The text of a dataset of characters.
  std::string text_data(Hdf5::Id group, const std::string& path, const char* name) const {
    const Handle data(h_.open_data(group, name, by_default), h_.close_data);
    const Handle space(data.good() ? h_.data_space(data) : -1, h_.close_space);
    const std::int64_t size = space.good() ? h_.values_of(space) : -1;
    if (size < 0) limits_.fail(path, "a damaged link", "one that can be read");
    if (static_cast<std::size_t>(size) > longest_link)
      limits_.fail(path, "a link of " + std::to_string(size) + " characters", "a path");
    std::string text(static_cast<std::size_t>(size), '\0');
    if (size > 0 &&
        h_.read_data(data, *h_.chars, by_default, by_default, by_default, text.data()) < 0)
      limits_.fail(path, "a damaged link", "one that can be read");
    text.resize(std::min(text.find('\0'), text.size()));
    return text;
  }

  /// The links of a group, by their creation where the file records it, else by name.
  GroupLinks links_of(Hdf5::Id group, const std::string& path) const {
    constexpr int by_name = 0, by_creation = 1, ascending = 0;
    GroupLinks links;
    if (h_.visit(group, by_creation, ascending, nullptr, collect, &links) >= 0) return links;
    links.clear();
    if (h_.visit(group, by_name, ascending, nullptr, collect, &links) < 0)
      limits_.fail(path, "a damaged node (its children cannot be listed)", "one that can be read");
    return links;
  }

  void read_children(Hdf5::Id group, const std::string& path, int depth, Node& node) {
    GroupLinks links = links_of(group, path);
    std::erase_if(links, [](const GroupLink& link) { return link.name.starts_with(' '); });
    if (!limits_.has_room_for(links.size())) {
      limits_.fail(path, std::to_string(links.size()) + " nodes below it",
                   "no more than the file can hold");
    }
    for (const GroupLink& link : links) {
      const Handle child(link.kind == 0 ? h_.open_group(group, link.name.c_str(), by_default) : -1,
                         h_.close_group);
      if (!child.good()) {
        limits_.fail(child_path(path, link.name), "what is no group of HDF5",
                     "a node of CGNS, which is one");
      }
      node.children.push_back(read_node(child, path, link.name, depth + 1));
    }
  }

  const Hdf5& h_;
  Hdf5::Id file_;
  TreeLimits limits_;
  bool first_is_fastest_ = false;
  std::vector<std::shared_ptr<Node>> links_;
};

}  // namespace

NodePtr read_hdf5_tree(Source& source) {
  const Hdf5* hdf5 = Hdf5::find();
  if (hdf5 == nullptr) {
    throw InputError(source.name() +
                     ": the libcgns of this winslow brings no HDF5 of version 1.10 or later, "
                     "which this file needs; write it in ADF (cgnsconvert -a)");
  }
  const Handle list(hdf5->create_list(*hdf5->file_access), hdf5->close_list);
  const bool ready =
      list.good() && hdf5->use_core(list, 1 << 20, 0) >= 0 &&
      // The bytes are copied; the argument is not const for want of care.
      hdf5->set_image(list, const_cast<char*>(source.text().data()), source.text().size()) >= 0;
  const Handle file(ready ? hdf5->open_file("cgns", 0, list) : -1, hdf5->close_file);
  if (!file.good()) {
    throw InputError(source.name() +
                     ": cannot be read as a CGNS file, it is damaged or none: HDF5 does not open "
                     "it");
  }
  {
    const Handle root(hdf5->open_group(file, "/", by_default), hdf5->close_group);
    if (!root.good() || hdf5->attribute_exists(root, "label") <= 0) {
      throw InputError(source.name() +
                       ": found an HDF5 file without the nodes of CGNS, expected a CGNS file");
    }
  }
  return Reader(*hdf5, source, file).read();
}

}  // namespace winslow::io::cgns

#endif
