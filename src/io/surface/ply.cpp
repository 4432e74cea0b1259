#include "io/surface/surface.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::surface {
namespace {

enum class Encoding { ascii, little_endian, big_endian };

std::optional<BinaryNumber> number_type(std::string_view name) {
  struct Named {
    std::string_view name, other_name;
    BinaryNumber type;
  };
  static constexpr std::array<Named, 8> all{{{"char", "int8", {false, true, 1}},
                                             {"uchar", "uint8", {false, false, 1}},
                                             {"short", "int16", {false, true, 2}},
                                             {"ushort", "uint16", {false, false, 2}},
                                             {"int", "int32", {false, true, 4}},
                                             {"uint", "uint32", {false, false, 4}},
                                             {"float", "float32", {true, true, 4}},
                                             {"double", "float64", {true, true, 8}}}};
  for (const Named& known : all)
    if (name == known.name || name == known.other_name) return known.type;
  return std::nullopt;
}

struct Property {
  std::string name;
  BinaryNumber type;
  std::optional<BinaryNumber> list_size;  ///< set: a list with a size of this type before it
};

struct Element {
  std::string name;
  Index count = 0;
  std::size_t count_offset = 0;
  std::vector<Property> properties;
};

class Reader {
 public:
  explicit Reader(Source& source) : source_(source), scan_(source), builder_(source) {}

  ParsedMesh read() {
    read_header();
    for (const Element& element : elements_) check_count(element);
    for (const Element& element : elements_) {
      for (Index i = 0; i < element.count; ++i) read_entry(element, i);
    }
    return builder_.finish(encoding_ != Encoding::ascii);
  }

 private:
  void read_header() {
    if (trimmed(scan_.line()) != "ply") source_.fail(0, "another first line", "ply");
    bool have_format = false;
    for (;;) {
      const std::size_t offset = scan_.offset();
      const auto word = scan_.word();
      if (word == "format") {
        read_format();
        have_format = true;
      } else if (word == "element") {
        read_element();
      } else if (word == "property") {
        read_property(offset);
      } else if (word == "end_header") {
        scan_.line();
        break;
      } else if (word != "comment" && word != "obj_info") {
        scan_.fail(word, "element, property or end_header");
      }
      scan_.line();
    }
    if (!have_format) source_.fail(0, "no line \"format\"", "format ascii 1.0 or the like");
    if (encoding_ != Encoding::ascii) source_.set_binary_from(scan_.offset());
  }

  void read_format() {
    const auto name = scan_.word();
    if (name == "ascii") {
      encoding_ = Encoding::ascii;
    } else if (name == "binary_little_endian") {
      encoding_ = Encoding::little_endian;
    } else if (name == "binary_big_endian") {
      encoding_ = Encoding::big_endian;
    } else {
      scan_.fail(name, "ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_element() {
    Element element;
    element.name = scan_.word();
    element.count_offset = scan_.offset();
    element.count = scan_.index({"the number of entries of an element"});
    elements_.push_back(std::move(element));
  }

  BinaryNumber type() {
    const auto word = scan_.word();
    const auto found = number_type(word);
    if (!found) scan_.fail(word, "a type such as float, double or int");
    return *found;
  }

  void read_property(std::size_t offset) {
    if (elements_.empty()) source_.fail(offset, "a property", "an element before it");
    Property property;
    const std::size_t here = scan_.offset();
    if (scan_.word() == "list") {
      property.list_size = type();
    } else {
      scan_.seek(here);
    }
    property.type = type();
    property.name = scan_.word();
    note_dropped(property.name);
    elements_.back().properties.push_back(std::move(property));
  }

  void note_dropped(std::string_view name) {
    for (const std::string_view colour : {"red", "green", "blue", "alpha", "diffuse_red"}) {
      if (name == colour) return builder_.drops("colours");
    }
    if (name == "nx" || name == "ny" || name == "nz") return builder_.drops("normals");
    const bool own = name == "x" || name == "y" || name == "z" || name.starts_with("vertex_ind");
    if (!own) builder_.drops("property " + in_quotes(name) + " and its values");
  }

  /// Rejects counts that the file cannot hold, before reading anything.
  void check_count(const Element& element) const {
    std::size_t bytes = 0;
    for (const Property& property : element.properties) {
      const auto& first = property.list_size ? *property.list_size : property.type;
      bytes += encoding_ == Encoding::ascii ? 2 : first.bytes;
    }
    if (bytes == 0 && element.count > 0) {
      source_.fail(element.count_offset, "element \"" + element.name + "\" without properties",
                   "some");
    }
    checked_count(source_, element.count_offset, element.count, std::max<std::size_t>(bytes, 1),
                  scan_.bytes_left(), {"the number of entries of an element"});
  }

  double number(const BinaryNumber& type, const Expected& expected) {
    if (encoding_ == Encoding::ascii) return scan_.number(expected);
    return scan_.bytes<double>(type, encoding_ == Encoding::big_endian, {"more data"});
  }

  Index whole_number(BinaryNumber type, const Expected& expected) {
    const std::size_t offset = scan_.offset();
    const double value = number(type, expected);
    const bool fits = value >= 0 && value <= std::numeric_limits<Index>::max();
    if (!fits || value != std::trunc(value)) {
      std::string found;
      append_number(found, value);
      source_.fail(offset, found, expected.text());
    }
    return static_cast<Index>(value);
  }

  void read_entry(const Element& element, Index i) {
    const bool vertex = element.name == "vertex";
    const bool face = element.name == "face";
    if (encoding_ == Encoding::ascii) scan_.skip_space();
    const std::size_t offset = scan_.offset();
    const Expected expected{vertex ? "vertex" : face ? "face" : "entry", i, element.count};
    std::array<double, 3> xyz{};
    for (const Property& property : element.properties) {
      if (property.list_size) {
        const bool corners = face && property.name.starts_with("vertex_ind");
        read_list(property, corners, offset, expected);
        continue;
      }
      const double value = number(property.type, expected);
      if (property.name == "x") xyz[0] = value;
      if (property.name == "y") xyz[1] = value;
      if (property.name == "z") xyz[2] = value;
    }
    if (vertex) builder_.add_vertex(xyz[0], xyz[1], xyz[2], offset);
    if (encoding_ == Encoding::ascii) {
      scan_.end_line({"the end of the line after entry", i, element.count});
    }
  }

  void read_list(const Property& property, bool corners, std::size_t offset,
                 const Expected& expected) {
    const Index size = whole_number(*property.list_size, expected);
    corners_.clear();
    if (corners) builder_.require_corners(static_cast<std::size_t>(size), offset);
    for (Index k = 0; k < size; ++k) {
      if (!corners) {
        number(property.type, expected);
        continue;
      }
      corners_.push_back(whole_number(property.type, expected));
    }
    if (corners) builder_.add_face(corners_, offset);
  }

  Source& source_;
  Scanner scan_;
  Builder builder_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  std::vector<Index> corners_;
};

ParsedMesh read_ply(Source& source) { return Reader(source).read(); }

std::vector<std::string> write_ply(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source, const WriteOptions& options) {
  const bool binary = options.binary;
  static_assert(std::endian::native == std::endian::little);
  TextWriter out(stream);
  const WrittenSurface surface(mesh, source);
  const bool short_lists = std::ranges::all_of(
      surface.faces(), [](const FileCorners& corners) { return corners.size() < 256; });
  out << "ply\nformat " << (binary ? "binary_little_endian" : "ascii") << " 1.0\nelement vertex "
      << surface.node_count()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << surface.faces().size() << "\nproperty list " << (short_lists ? "uchar" : "ushort")
      << " int vertex_indices\nend_header\n";
  for (Index i = 0; i < surface.node_count(); ++i) {
    const Vec3 p = surface.node(i);
    const std::array<double, 3> xyz{p.x(), p.y(), p.z()};
    if (binary) {
      out.raw(xyz);
    } else {
      out << xyz[0] << ' ' << xyz[1] << ' ' << xyz[2] << '\n';
    }
  }
  for (const FileCorners& corners : surface.faces()) {
    if (binary) {
      if (short_lists)
        out.raw(static_cast<std::uint8_t>(corners.size()));
      else
        out.raw(static_cast<std::uint16_t>(corners.size()));
      for (const Index node : corners) out.raw(node);
      continue;
    }
    out << corners.size();
    for (const Index node : corners) out << ' ' << node;
    out << '\n';
  }
  return lost_in_surface(mesh);
}

}  // namespace

const MeshFormat ply_format{
    .name = "ply",
    .title = "Stanford PLY",
    .encodings = "text, binary of either byte order",
    .markers = "lost",
    .regions = "lost",
    .volumes = "boundary only",
    .polygons = true,
    .keeps_markers = false,
    .has_binary = true,
    .recognise = [](const Content& content) { return signature_if(content.first_line == "ply"); },
    .read = read_ply,
    .write = write_ply};

}  // namespace winslow::io::surface
