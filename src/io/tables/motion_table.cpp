#include "io/tables/motion_table.h"

#include "core/error.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io {

namespace {

constexpr std::array<std::string_view, 12> column_names{
    "step",   "marker", "rotate", "pivot_x",     "pivot_y",     "pivot_z",
    "axis_x", "axis_y", "axis_z", "translate_x", "translate_y", "translate_z"};

struct Field {
  std::string text;
  std::size_t offset = 0;  ///< in the file
};

/// Splits a line at separators that are not within quotes. Blanks around fields are left out, and
/// so are the quotes.
std::vector<Field> split(std::string_view line, std::size_t offset, char separator) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  bool quoted = false;
  const auto finish = [&](std::size_t end) {
    std::string_view text = trimmed(line.substr(begin, end - begin));
    const bool in_quotes = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    if (in_quotes) text = trimmed(text.substr(1, text.size() - 2));
    const bool between_blanks = separator == ' ' && text.empty() && !in_quotes;
    if (!between_blanks) fields.push_back({std::string(text), offset + begin});
    begin = end + 1;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (!quoted && (line[i] == separator || (separator == ' ' && line[i] == '\t'))) finish(i);
  }
  finish(line.size());
  return fields;
}

char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

/// A line without its comment.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return line.substr(0, i);
  }
  return line;
}

std::vector<std::string> names_in(const std::string& field) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= field.size();) {
    const std::size_t end = std::min(field.find(',', begin), field.size());
    names.emplace_back(trimmed(std::string_view(field).substr(begin, end - begin)));
    begin = end + 1;
  }
  return names;
}

class MotionReader {
  // The places of these in column_names, of vectors that of the first component.
  enum Column : std::size_t { step, marker, rotate, pivot, axis = 6, translate = 9, columns = 12 };

 public:
  MotionReader(const Source& source, const MovingBody& otherwise)
      : source_(source), otherwise_(otherwise) {}

  std::vector<MotionStep> read() {
    Scanner scan(source_);
    for (int number = 1; !scan.at_end(); ++number) {
      const std::size_t offset = scan.offset();
      const std::string_view line = without_comment(scan.line());
      if (trimmed(line).empty()) continue;
      const std::size_t begin = source_.offset_of(line);
      if (place_.empty()) {
        separator_ = separator_of(line);
        read_names(split(line, begin, separator_), offset);
      } else {
        read_row(split(line, begin, separator_), offset, number);
      }
    }
    if (place_.empty()) source_.fail(source_.text().size(), "no line of names", expected_names());
    if (steps_.empty())
      source_.fail(source_.text().size(), "no row", "a row for each motion below the names");
    return std::move(steps_);
  }

 private:
  static std::string expected_names() {
    return "names of columns out of " +
           list_of(column_names, [](std::string_view name) { return std::string(name); });
  }

  void read_names(const std::vector<Field>& fields, std::size_t offset) {
    place_.assign(columns, none);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string name = lower_case(fields[i].text);
      const auto known = std::ranges::find(column_names, name);
      if (known == column_names.end())
        source_.fail(offset, "the column " + in_quotes(fields[i].text), expected_names());
      std::size_t& place = place_[static_cast<std::size_t>(known - column_names.begin())];
      if (place != none)
        source_.fail(offset, "the column " + in_quotes(name) + " twice", "each column once");
      place = i;
    }
    count_ = fields.size();
    if (!given(marker) && otherwise_.markers.empty())
      source_.fail(offset, "no column \"marker\"",
                   "one that names the markers that move, or --marker NAME for all rows");
    const bool moves =
        given(rotate) || given(translate) || given(translate + 1) || given(translate + 2);
    if (!moves) source_.fail(offset, "nothing that moves", "a column rotate or translate_x");
    for (const std::size_t first : {std::size_t{pivot}, std::size_t{axis}}) {
      const bool in_plane = first == pivot && given(first) && given(first + 1);
      const bool any = given(first) || given(first + 1) || given(first + 2);
      if (any && !in_plane && !(given(first) && given(first + 1) && given(first + 2)))
        source_.fail(offset, "some of the columns " + vector_name(first), "all of its components");
    }
  }

  void read_row(const std::vector<Field>& fields, std::size_t offset, int line) {
    if (fields.size() != count_)
      source_.fail(offset, std::to_string(fields.size()) + " columns",
                   std::to_string(count_) + " as in the first line");
    fields_ = &fields;
    offset_ = offset;
    MovingBody body = otherwise_;
    if (const std::string names = text(marker); !names.empty()) body.markers = names_in(names);
    if (body.markers.empty() || std::ranges::find(body.markers, "") != body.markers.end())
      source_.fail(offset, "an empty name of a marker", "the name of a marker that moves");
    if (!text(rotate).empty()) body.motion.rotate = number(rotate);
    if (const auto place = vector(pivot)) body.motion.pivot = *place;
    if (const auto direction = vector(axis)) body.motion.axis = Vec3(*direction);
    read_translation(body.motion);
    add(std::move(body), line);
  }

  /// Each component for itself: a motion along x does not need the others.
  void read_translation(RigidMotion& motion) const {
    bool any = false;
    Vec3 way = motion.translate;
    for (std::size_t k = 0; k < 3; ++k) {
      if (text(translate + k).empty()) continue;
      any = true;
      way[static_cast<Eigen::Index>(k)] = number(translate + k);
    }
    if (any) motion.translate = GivenVector::of(given(translate + 2) ? 3 : 2, way);
  }

  void add(MovingBody body, int line) {
    const bool named = given(step);
    const std::string name = named ? text(step) : std::to_string(steps_.size() + 1);
    if (name.empty()) source_.fail(offset_, "an empty field", "a number or name of the step");
    const auto found = named ? std::ranges::find(steps_, name, &MotionStep::name) : steps_.end();
    if (found == steps_.end()) {
      steps_.push_back({name, {std::move(body)}, line});
      return;
    }
    for (const MovingBody& other : found->bodies)
      for (const std::string& twice : body.markers)
        if (std::ranges::find(other.markers, twice) != other.markers.end())
          source_.fail(offset_, "the marker " + in_quotes(twice) + " twice in step " + name,
                       "each marker in one row of a step");
    found->bodies.push_back(std::move(body));
  }

  bool given(std::size_t column) const { return place_[column] != none; }
  std::string text(std::size_t column) const {
    return given(column) ? (*fields_)[place_[column]].text : std::string();
  }
  double number(std::size_t column) const {
    const std::string field = text(column);
    const auto value = parse_number(field);
    if (!value || !std::isfinite(*value))
      source_.fail(offset_,
                   in_quotes(field) + " in the column " + std::string(column_names[column]),
                   "a finite number");
    return *value;
  }
  static std::string vector_name(std::size_t first) { return first == pivot ? "pivot" : "axis"; }

  /// A vector all of whose components are given, or none.
  std::optional<GivenVector> vector(std::size_t first) const {
    const std::size_t numbers = given(first + 2) ? 3 : 2;
    std::size_t empty = 0;
    for (std::size_t k = 0; k < numbers; ++k) empty += text(first + k).empty() ? 1 : 0;
    if (empty == numbers) return std::nullopt;
    if (empty > 0)
      source_.fail(offset_, "an empty field of the " + vector_name(first),
                   "all of its components, or none");
    Vec3 out(0, 0, 0);
    for (std::size_t k = 0; k < numbers; ++k) out[static_cast<Eigen::Index>(k)] = number(first + k);
    return GivenVector::of(static_cast<int>(numbers), out);
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  const Source& source_;
  const MovingBody& otherwise_;
  char separator_ = ',';
  std::vector<std::size_t> place_;  // of each column in a row, or none; empty: names not read yet
  std::size_t count_ = 0;
  const std::vector<Field>* fields_ = nullptr;  // of the row that is read
  std::size_t offset_ = 0;
  std::vector<MotionStep> steps_;
};

}  // namespace

std::vector<MotionStep> read_motions(const std::filesystem::path& path,
                                     const MovingBody& otherwise) {
  const Source source = Source::load(path);
  return MotionReader(source, otherwise).read();
}

}  // namespace winslow::io
