#include "io/recipe/object_archive.h"

#include <iterator>
#include <set>

#include "io/text/source.h"
#include "io/text/text_file.h"

namespace winslow::io {
namespace {

using nlohmann::json;

/// Deeper than any recipe; protects the parser from a stack overflow on "[[[[...".
constexpr int deepest = 100;

/// Line of the character that was read last.
struct LineCount {
  int line = 1;
  bool ended = false;  ///< a newline; counted later, since the parser reads it to end a number
};

/// Reads characters and counts lines. All copies of one iterator share the count.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(pointer position, LineCount* count) : position_(position), count_(count) {}
  reference operator*() const { return *position_; }
  CountingIterator& operator++() {
    if (count_->ended) ++count_->line;
    count_->ended = *position_ == '\n';
    ++position_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return position_ == other.position_; }

 private:
  pointer position_;
  LineCount* count_;
};

/// Parser callback that tracks the path and line of each value.
class Tracker {
 public:
  Tracker(const LineCount* count, std::map<std::string, int>* lines)
      : count_(count), lines_(lines) {}

  bool operator()(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        enter(event == json::parse_event_t::array_start);
        break;
      case json::parse_event_t::key:
        add_key(parsed.get<std::string>());
        break;
      case json::parse_event_t::value:
        begin_item();
        break;
      default:
        stack_.pop_back();
        break;
    }
    return true;
  }

 private:
  struct Level {
    bool array;
    int count = 0;
    std::string key;
    std::set<std::string> keys;
    std::string path;  ///< path of the object or array
  };

  std::string item_path() const {
    const Level& level = stack_.back();
    if (level.array) return level.path + '[' + std::to_string(level.count - 1) + ']';
    return level.path + (level.path.empty() ? "" : ".") + level.key;
  }

  /// Called when a value begins; in an array no key has been recorded for it.
  void begin_item() {
    if (stack_.empty() || !stack_.back().array) return;
    ++stack_.back().count;
    (*lines_)[item_path()] = count_->line;
  }

  void enter(bool array) {
    begin_item();
    const std::string path = stack_.empty() ? "" : item_path();
    if (stack_.size() >= deepest) throw JsonValueError(path, "nested too deeply");
    stack_.push_back({array, 0, {}, {}, path});
  }

  void add_key(std::string key) {
    Level& level = stack_.back();
    level.key = std::move(key);
    const std::string path = item_path();
    (*lines_)[path] = count_->line;
    if (!level.keys.insert(level.key).second) {
      throw JsonValueError(path, "found this key twice, expected it once");
    }
  }

  const LineCount* count_;
  std::map<std::string, int>* lines_;
  std::vector<Level> stack_;
};

/// The parser's message without its own prefix "[json.exception...] parse error at line 3, ...: ".
std::string plain(const std::string& message) {
  const std::size_t end = message.find("syntax error");
  return end == std::string::npos ? message.substr(message.find("] ") + 2) : message.substr(end);
}

}  // namespace

int JsonSource::line_of(std::string path) const {
  for (;;) {
    if (const auto found = lines.find(path); found != lines.end()) return found->second;
    const std::size_t cut = path.find_last_of(".[");
    if (cut == std::string::npos) return 1;
    path.resize(cut);
  }
}

JsonSource read_json(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  const auto fail = [&](int line, const std::string& message) {
    throw InputError(file.string() + ':' + std::to_string(line) + ": " + message);
  };
  JsonSource source;
  LineCount count;
  Tracker tracker(&count, &source.lines);
  try {
    const char* begin = text.data();
    source.document = json::parse(
        CountingIterator(begin, &count), CountingIterator(begin + text.size(), &count),
        [&](int, json::parse_event_t event, json& parsed) { return tracker(event, parsed); });
  } catch (const json::parse_error& error) {
    const auto bytes = static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    // The error is at the last character read; a newline belongs to the line that it ends.
    const auto end = text.begin() + std::max<std::ptrdiff_t>(0, bytes - 1);
    fail(1 + static_cast<int>(std::count(text.begin(), end, '\n')), plain(error.what()));
  } catch (const json::exception& error) {
    fail(count.line, plain(error.what()));
  } catch (const JsonValueError& error) {
    fail(source.line_of(error.path()), error.what());
  }
  return source;
}

namespace {

template <class Value>
void read_list(const json& value, const std::string& path, const char* expected,
               std::vector<Value>& out) {
  if (!value.is_array()) refuse(value, path, expected);
  out.clear();
  for (std::size_t i = 0; i < value.size(); ++i) {
    ObjectReader::read(value[i], path + '[' + std::to_string(i) + ']', out.emplace_back());
  }
}

}  // namespace

void refuse(const json& found, const std::string& path, const std::string& expected) {
  constexpr std::size_t longest = 40;
  std::string text = found.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  throw JsonValueError(path, "found " + text + ", expected " + expected);
}

ObjectReader::ObjectReader(const json& object, std::string path)
    : object_(object), path_(std::move(path)) {
  if (!object_.is_object()) refuse(object_, path_, "an object");
}

std::string ObjectReader::path_of(const char* key) const {
  return path_ + (path_.empty() ? "" : ".") + key;
}

const json* ObjectReader::find(const char* key) {
  known_.emplace_back(key);
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

const json& ObjectReader::needed(const char* key) {
  const json* found = find(key);
  if (!found) throw JsonValueError(path_, "the key \"" + std::string(key) + "\" is missing");
  return *found;
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw JsonValueError(path_of(key.c_str()),
                         "unknown key, expected one of " + list_of(known_, std::identity()));
  }
}

void ObjectReader::read(const json& value, const std::string& path, double& out) {
  if (!value.is_number()) refuse(value, path, "a number");
  out = value.get<double>();
}

void ObjectReader::read(const json& value, const std::string& path, int& out) {
  const bool fits = value.is_number_unsigned() ? std::in_range<int>(value.get<std::uint64_t>())
                                               : value.is_number_integer() &&
                                                     std::in_range<int>(value.get<std::int64_t>());
  if (!fits) refuse(value, path, "a whole number");
  out = value.get<int>();
}

void ObjectReader::read(const json& value, const std::string& path, std::uint64_t& out) {
  if (!value.is_number_unsigned()) refuse(value, path, "a whole number from 0 on");
  out = value.get<std::uint64_t>();
}

void ObjectReader::read(const json& value, const std::string& path, bool& out) {
  if (!value.is_boolean()) refuse(value, path, "true or false");
  out = value.get<bool>();
}

void ObjectReader::read(const json& value, const std::string& path, std::string& out) {
  if (!value.is_string()) refuse(value, path, "a text");
  out = value.get<std::string>();
  // The system would end a name there, and open another file than the one that is shown.
  if (out.find('\0') != std::string::npos) refuse(value, path, "a text without null characters");
}

void ObjectReader::read(const json& value, const std::string& path, std::vector<std::string>& out) {
  read_list(value, path, "a list of texts", out);
}

void ObjectReader::read(const json& value, const std::string& path, std::vector<int>& out) {
  read_list(value, path, "a list of whole numbers", out);
}

void ObjectReader::read(const json& value, const std::string& path, std::vector<double>& out) {
  read_list(value, path, "a list of numbers", out);
}

void ObjectReader::read(const json& value, const std::string& path, Vec2& out) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    refuse(value, path, "[x, y]");
  }
  out = Vec2(value[0].get<double>(), value[1].get<double>());
}

namespace {

/// Shares that are not named become 0, as on the command line.
void read_shares(const json& value, const std::string& path, const SharesOption& shares) {
  shares.clear();
  if (shares.may_be_none() && value == shares.none.name) return;
  ObjectReader reader(value, path);
  for (const auto& part : shares.parts) reader.field(std::string(part.name).c_str(), *part.share);
  reader.finish();
  if (shares.is_none()) throw JsonValueError(path, "the shares must not be negative, nor all zero");
}

void read_components(const json& value, const std::string& path, std::span<double> out) {
  const bool fits =
      value.is_array() && value.size() == out.size() &&
      std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); });
  if (!fits) refuse(value, path, "an array of " + std::to_string(out.size()) + " numbers");
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = value[k].get<double>();
}

void read_value(const json& value, const std::string& path, const OptionValue& option) {
  std::visit(
      [&](const auto& of) {
        using Kind = std::decay_t<decltype(of)>;
        if constexpr (std::is_same_v<Kind, ChoiceOption>) {
          if (!value.is_string() || !of.choose(value.template get<std::string>()))
            refuse(value, path, "one of " + of.names());
        } else if constexpr (std::is_same_v<Kind, SharesOption>) {
          read_shares(value, path, of);
        } else if constexpr (std::is_same_v<Kind, VectorOption> ||
                             std::is_same_v<Kind, OptionalVectorOption>) {
          *of.value = read_vector(value, path);
        } else if constexpr (std::is_same_v<Kind, SpaceVectorOption>) {
          Vec3& vector = of.value->emplace();
          read_components(value, path, {vector.data(), 3});
        } else if constexpr (std::is_same_v<Kind, OptionalRealOption>) {
          ObjectReader::read(value, path, of.value->emplace());
        } else {
          ObjectReader::read(value, path, *of.value);
        }
      },
      option);
}

void read_option(ObjectReader& reader, const Option& option) {
  const std::string key(option.key);
  const json* value = option.required ? &reader.needed(key.c_str()) : reader.find(key.c_str());
  if (!value) return;
  const std::string path = reader.path_of(key.c_str());
  read_value(*value, path, option.value);
  if (const std::string fault = fault_of(option); !fault.empty()) throw JsonValueError(path, fault);
}

json write_value(const OptionValue& option) {
  return std::visit(
      [](const auto& of) -> json {
        using Kind = std::decay_t<decltype(of)>;
        if constexpr (std::is_same_v<Kind, ChoiceOption>) {
          return of.name();
        } else if constexpr (std::is_same_v<Kind, SharesOption>) {
          if (of.may_be_none() && of.is_none()) return of.none.name;
          json parts = json::object();
          for (const auto& part : of.parts) parts[std::string(part.name)] = *part.share;
          return parts;
        } else if constexpr (std::is_same_v<Kind, VectorOption>) {
          return vector_json(*of.value, of.numbers);
        } else if constexpr (std::is_same_v<Kind, OptionalVectorOption>) {
          return *of.value ? vector_json(**of.value, of.numbers) : json();
        } else if constexpr (std::is_same_v<Kind, SpaceVectorOption>) {
          if (!*of.value) return json();
          const Vec3& v = **of.value;
          return json::array({v.x(), v.y(), v.z()});
        } else if constexpr (std::is_same_v<Kind, OptionalRealOption>) {
          return *of.value ? json(ObjectWriter::write(**of.value)) : json();
        } else if constexpr (std::is_same_v<Kind, FileOption> ||
                             std::is_same_v<Kind, NodesOption>) {
          return of.value->empty() ? json() : json(*of.value);
        } else {
          return ObjectWriter::write(*of.value);
        }
      },
      option);
}

/// The rows of a table that belong to one object.
OptionTable rows_in(const OptionTable& table, std::string_view object) {
  OptionTable rows;
  for (const Option& option : table)
    if (option.object == object) rows.push_back(option);
  return rows;
}

/// Calls own(row) for each row of the struct itself and inner(object) once for each object.
template <class Own, class Inner>
void for_each_key(const OptionTable& table, const Own& own, const Inner& inner) {
  std::string_view last;
  for (const Option& option : table) {
    if (option.object.empty()) own(option);
    if (!option.object.empty() && option.object != last) inner(option.object);
    last = option.object;
  }
}

}  // namespace

GivenVector read_vector(const json& value, const std::string& path) {
  if (!value.is_array() || value.size() != 3) {
    Vec2 plane;
    ObjectReader::read(value, path, plane);
    return plane;
  }
  Vec3 vector;
  read_components(value, path, {vector.data(), 3});
  return GivenVector::of_three(vector);
}

json vector_json(const GivenVector& vector, int otherwise) {
  json value{vector.x(), vector.y()};
  if (vector.numbers(otherwise) == 3) value.push_back(vector.z());
  return value;
}

void read_options(ObjectReader& reader, const OptionTable& table) {
  for_each_key(
      table, [&](const Option& option) { read_option(reader, option); },
      [&](std::string_view object) {
        reader.object(std::string(object).c_str(), [&](ObjectReader& within) {
          for (const Option& option : rows_in(table, object)) read_option(within, option);
        });
      });
}

void write_options(ObjectWriter& writer, const OptionTable& table) {
  const auto write = [](ObjectWriter& to, const Option& option) {
    const json value = write_value(option.value);
    if (!value.is_null()) to.field(std::string(option.key).c_str(), value);
  };
  for_each_key(
      table, [&](const Option& option) { write(writer, option); },
      [&](std::string_view object) {
        const OptionTable rows = rows_in(table, object);
        // Leave out an object in which no number is set.
        if (std::ranges::all_of(rows,
                                [](const Option& o) { return write_value(o.value).is_null(); }))
          return;
        writer.object(std::string(object).c_str(), [&](ObjectWriter& within) {
          for (const Option& option : rows) write(within, option);
        });
      });
}

}  // namespace winslow::io
