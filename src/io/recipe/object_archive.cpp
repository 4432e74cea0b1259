#include "io/recipe/object_archive.h"

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace winslow::io {
namespace {

using nlohmann::json;

/// Deeper than any recipe; keeps the parser from running out of stack on "[[[[...".
constexpr int deepest = 100;

/// Line of the character that was read last.
struct LineCount {
  int line = 1;
  bool ended = false;  ///< that character was a newline: a number is known to end only after it
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

/// Follows the parser: the path and line of what it reads.
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
    std::string path;  ///< of the object or array
  };

  std::string item_path() const {
    const Level& level = stack_.back();
    if (level.array) return level.path + '[' + std::to_string(level.count - 1) + ']';
    return level.path + (level.path.empty() ? "" : ".") + level.key;
  }

  /// A value begins: in an array it has no key that was noted before.
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

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string() + ": found a folder, expected a file");
  }
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (in && in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad()) throw InputError(file.string() + ": cannot be read");
  return text.str();
}

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
  const std::string text = read_text(file);
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
    // The offender is the last character read: a newline in it belongs to the line it ends.
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

const json& ObjectReader::at(const char* key) {
  const json* found = find(key);
  if (!found) throw JsonValueError(path_, "the key \"" + std::string(key) + "\" is missing");
  return *found;
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::string list;
    for (const std::string& name : known_) list += (list.empty() ? "" : ", ") + name;
    throw JsonValueError(path_of(key.c_str()), "unknown key, expected one of " + list);
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

}  // namespace winslow::io
