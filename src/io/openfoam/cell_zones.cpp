#include "io/openfoam/cell_zones.h"

namespace winslow::io::openfoam {
namespace {

class ZoneReader {
 public:
  ZoneReader(Source& source, Source::Range range, ParsedMesh& mesh)
      : source_(source), range_(range), position_(range.begin), mesh_(mesh) {}

  void read() {
    if (peek() == "FoamFile") read_header();
    const std::int64_t zones = integer("the number of zones");
    if (zones == 0) return;
    expect("(");
    auto& of = mesh_.data.element_region;
    of.assign(at(mesh_.data.element_count()), -1);
    for (std::int64_t k = 0; k < zones; ++k) read_zone();
    expect(")");
    if (mesh_.data.regions.empty()) of.clear();
    if (twice_ > 0)
      mesh_.warnings.push_back(std::to_string(twice_) + (twice_ == 1 ? " cell is" : " cells are") +
                               " in several cell zones: the first counts");
  }

 private:
  std::string_view text() const { return source_.text().substr(0, range_.end); }

  void skip() {
    const auto all = text();
    while (position_ < all.size()) {
      const auto rest = all.substr(position_);
      if (rest.starts_with("//")) {
        position_ += std::min(rest.find('\n'), rest.size());
      } else if (rest.starts_with("/*")) {
        const auto end = rest.find("*/");
        if (end == std::string_view::npos) source_.fail(position_, "a comment without end", "*/");
        position_ += end + 2;
      } else if (std::string_view(" \t\r\n").find(rest.front()) != std::string_view::npos) {
        ++position_;
      } else {
        return;
      }
    }
  }

  /// The next word or sign of punctuation; empty at the end.
  std::string_view next() {
    skip();
    const auto rest = text().substr(std::min(position_, text().size()));
    if (rest.empty()) return {};
    constexpr std::string_view signs = "(){};";
    std::size_t size = 1;
    if (signs.find(rest.front()) == std::string_view::npos)
      size = std::min(rest.find_first_of(" \t\r\n(){};"), rest.size());
    position_ += size;
    return rest.substr(0, size);
  }
  std::string_view peek() {
    const std::size_t here = position_;
    const auto word = next();
    position_ = here;
    return word;
  }

  [[noreturn]] void fail(std::string_view word, const std::string& expected) const {
    source_.fail(word.empty() ? range_.end : source_.offset_of(word),
                 word.empty() ? "the end of the file" : in_quotes(word), expected);
  }
  void expect(std::string_view wanted) {
    const auto word = next();
    if (word != wanted) fail(word, in_quotes(wanted));
  }
  std::int64_t integer(const std::string& expected) {
    const auto word = next();
    const auto value = parse_integer(word);
    if (!value || *value < 0) fail(word, expected);
    return *value;
  }

  void read_header() {
    next();
    expect("{");
    for (auto key = next(); key != "}"; key = next()) {
      if (key.empty()) fail(key, "'}'");
      std::string value;
      for (auto word = next(); word != ";"; word = next()) {
        if (word.empty()) fail(word, "';'");
        value.append(word).append(1, ' ');
      }
      if (key == "format") binary_ = value.starts_with("binary");
      // arch "LSB;label=64;scalar=64": ';' ends a word here, so that the rest are keys.
      if (key.find("label=64") != std::string_view::npos) label_bytes_ = 8;
    }
  }

  void read_zone() {
    const auto name = next();
    if (name.empty() || name == ")") fail(name, "the name of a cell zone");
    const std::string zone(name);
    expect("{");
    for (auto key = next(); key != "}"; key = next()) {
      if (key.empty()) fail(key, "'}' at the end of zone " + in_quotes(zone));
      if (key == "cellLabels") {
        read_cells(zone);
        continue;
      }
      for (auto word = next(); word != ";"; word = next())
        if (word.empty()) fail(word, "';'");
    }
  }

  /// List<label> 3 ( 0 1 2 ), or 3 { 7 } for a value that all have.
  void read_cells(const std::string& zone) {
    if (peek().starts_with("List<")) next();
    const std::size_t place = position_;
    const std::int64_t count = integer("the number of cells of zone " + in_quotes(zone));
    const bool bytes = binary_ && peek() == "(";
    if (count > static_cast<std::int64_t>(mesh_.data.element_count()))
      source_.fail(place, std::to_string(count) + " cells in zone " + in_quotes(zone),
                   "at most the " + std::to_string(mesh_.data.element_count()) + " of the mesh");
    region_ = -1;
    if (bytes) {
      read_bytes(zone, static_cast<std::size_t>(count));
    } else if (peek() == "{") {
      next();
      add(zone, position_, integer("a cell"));
      expect("}");
    } else if (peek() == "(") {
      next();
      for (std::int64_t k = 0; k < count; ++k)
        add(zone, position_, integer("a cell of zone " + in_quotes(zone)));
      expect(")");
    }
    expect(";");
  }

  void read_bytes(const std::string& zone, std::size_t count) {
    next();
    if (count > (range_.end - position_) / label_bytes_)
      source_.fail(range_.end, "the end of the file",
                   std::to_string(count) + " labels of " + std::to_string(label_bytes_) +
                       " bytes for zone " + in_quotes(zone));
    const BinaryNumber kind{false, true, label_bytes_};
    for (std::size_t k = 0; k < count; ++k, position_ += label_bytes_)
      add(zone, position_, number_at<std::int64_t>(source_.text().data() + position_, kind, false));
    expect(")");
  }

  void add(const std::string& zone, std::size_t place, std::int64_t cell) {
    MeshData& data = mesh_.data;
    if (cell < 0 || cell >= static_cast<std::int64_t>(data.element_count()))
      source_.fail(place, "cell " + std::to_string(cell) + " in zone " + in_quotes(zone),
                   "0 to " + std::to_string(data.element_count() - 1));
    if (region_ < 0) {
      region_ = static_cast<Index>(data.regions.size());
      data.regions.push_back({zone, region_ + 1});
    }
    Index& of = data.element_region[static_cast<std::size_t>(cell)];
    if (of < 0)
      of = region_;
    else
      twice_ += of == region_ ? 0 : 1;
  }

  Source& source_;
  Source::Range range_;
  std::size_t position_;
  ParsedMesh& mesh_;
  bool binary_ = false;
  std::size_t label_bytes_ = 4;
  Index region_ = -1;  // of the zone being read; -1: it has no cell yet
  Index twice_ = 0;    // cells of a zone that another zone has, too
};

}  // namespace

void read_cell_zones(Source& source, const std::filesystem::path& folder, ParsedMesh& mesh) {
  for (const char* name : {"cellZones", "cellZones.gz"}) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(folder / name, error)) continue;
    const Source::Range range = source.append(folder / name);
    ZoneReader(source, range, mesh).read();
    return;
  }
}

}  // namespace winslow::io::openfoam
