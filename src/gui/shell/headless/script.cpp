#include "gui/shell/headless/headless_studio.h"

#include <cctype>
#include <charconv>
#include <sstream>

#include "core/error.h"
#include "gui/picture/figure/vector_figure.h"
#include "io/recipe/recipe.h"
#include "io/text/text_file.h"

namespace winslow::gui {

namespace {

struct Arity {
  std::size_t least, most;
};

/// Number of words after the first one.
const std::map<std::string, Arity, std::less<>>& known_words() {
  static const std::map<std::string, Arity, std::less<>> words{
      {"open", {1, 1}},        {"replay", {1, 1}},       {"click", {1, 3}},
      {"right-click", {1, 3}}, {"double-click", {1, 3}}, {"hover", {1, 3}},
      {"drag", {4, 6}},        {"press", {1, 3}},        {"move", {2, 3}},
      {"release", {0, 0}},     {"away", {0, 0}},         {"wheel", {3, 4}},
      {"key", {1, 1}},         {"type", {1, 1}},         {"fill", {2, 2}},
      {"look", {3, 4}},        {"wait", {0, 1}},         {"size", {2, 2}},
      {"screenshot", {1, 1}},  {"picture", {1, 5}},      {"film", {1, 3}},
      {"widgets", {0, 1}}};
  return words;
}

std::vector<std::string> split(const std::string& line, const std::string& where) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < line.size();) {
    if (std::isspace(static_cast<unsigned char>(line[at]))) {
      ++at;
      continue;
    }
    if (line[at] == '#') break;
    const bool quoted = line[at] == '"';
    std::string word;
    if (quoted) ++at;
    while (at < line.size() &&
           (quoted ? line[at] != '"' : !std::isspace(static_cast<unsigned char>(line[at]))))
      word += line[at++];
    if (quoted && at == line.size()) throw InputError(where + "a quote that does not end");
    if (quoted) ++at;
    words.push_back(std::move(word));
  }
  return words;
}

void check(const std::vector<std::string>& words, const std::string& where) {
  const auto known = known_words().find(words.front());
  if (known == known_words().end()) {
    std::string all;
    for (const auto& [word, arity] : known_words()) all += (all.empty() ? "" : ", ") + word;
    throw InputError(where + "found \"" + words.front() + "\", expected one of " + all);
  }
  const auto [least, most] = known->second;
  const std::size_t count = words.size() - 1;
  if (count >= least && count <= most) return;
  const std::string expected =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  throw InputError(where + "\"" + words.front() + "\" with " + std::to_string(count) +
                   " words after it, expected " + expected);
}

int key_code(const std::string& name) {
  static const std::map<std::string, int, std::less<>> names{
      {"Ctrl", GLFW_KEY_LEFT_CONTROL}, {"Shift", GLFW_KEY_LEFT_SHIFT},
      {"Alt", GLFW_KEY_LEFT_ALT},      {"Space", GLFW_KEY_SPACE},
      {"Enter", GLFW_KEY_ENTER},       {"Escape", GLFW_KEY_ESCAPE},
      {"Tab", GLFW_KEY_TAB},           {"Delete", GLFW_KEY_DELETE},
      {"Home", GLFW_KEY_HOME},         {"Backspace", GLFW_KEY_BACKSPACE},
      {"End", GLFW_KEY_END},           {"Left", GLFW_KEY_LEFT},
      {"Right", GLFW_KEY_RIGHT},       {"Up", GLFW_KEY_UP},
      {"Down", GLFW_KEY_DOWN},         {"PageUp", GLFW_KEY_PAGE_UP},
      {"PageDown", GLFW_KEY_PAGE_DOWN}};
  if (name.size() == 1) {
    const int c = std::toupper(static_cast<unsigned char>(name[0]));
    // GLFW's codes of printable characters are those of ASCII.
    if (c > ' ' && c < 127) return c;
  }
  if (const auto found = names.find(name); found != names.end()) return found->second;
  if (name.size() >= 2 && name[0] == 'F' && name.find_first_not_of("0123456789", 1) == name.npos) {
    const int n = std::atoi(name.c_str() + 1);
    if (n >= 1 && n <= 12) return GLFW_KEY_F1 + n - 1;
  }
  throw UsageError("unknown key \"" + name + "\"");
}

}  // namespace

std::vector<int> parse_keys(const std::string& text) {
  std::vector<int> keys;
  std::size_t start = 0;
  // A final "+" is the key "+".
  for (std::size_t end; (end = text.find('+', start)) + 1 < text.size() && end != text.npos;
       start = end + 1)
    keys.push_back(key_code(text.substr(start, end - start)));
  keys.push_back(key_code(text.substr(start)));
  return keys;
}

Script read_script(const std::filesystem::path& file) {
  std::istringstream in(io::read_text_file(file));
  Script script{file, {}};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = file.string() + ":" + std::to_string(++number) + ": ";
    auto words = split(line, where);
    if (words.empty()) continue;
    check(words, where);
    script.lines.push_back({number, std::move(words)});
  }
  return script;
}

namespace {

constexpr int drag_steps = 12;
constexpr int longest_wait = 100000;  // frames

class ScriptPlayer {
 public:
  ScriptPlayer(HeadlessStudio& studio, std::filesystem::path script_folder,
               std::filesystem::path out, std::function<void(const std::string&)> say)
      : studio_(studio),
        near_(std::move(script_folder)),
        out_(std::move(out)),
        say_(std::move(say)) {}

  void play(const std::vector<std::string>& words) {
    const std::string& what = words[0];
    if (what == "open") return studio_.open(near_ / words[1]);
    if (what == "replay") return studio_.replay(io::read_recipe(near_ / words[1]).commands);
    if (what == "click") return click(target(words, 1));
    if (what == "right-click") return click(target(words, 1), MouseButton::right);
    if (what == "double-click") {
      const ScreenPoint at = target(words, 1);
      click(at);
      return click(at);
    }
    if (what == "hover" || what == "move") return move(target(words, 1));
    if (what == "drag") return drag(mesh_point(words, 1), mesh_point(words, 1 + coordinates()));
    if (what == "press") return press(target(words, 1));
    if (what == "release") return release();
    if (what == "away") return away();
    if (what == "wheel") return wheel(mesh_point(words, 1), number(words.back()));
    if (what == "key") return key(words[1]);
    if (what == "type") return type(words[1]);
    if (what == "fill") return fill(words[1], words[2]);
    if (what == "look") return look(words);
    if (what == "wait") return wait(words);
    if (what == "size")
      return studio_.resize(whole_number(words[1], 320), whole_number(words[2], 240));
    if (what == "screenshot") return picture({words[0], words[1]});
    if (what == "picture") return picture(words);
    if (what == "film") return film(words);
    widgets(words.size() > 1 ? words[1] : "");
  }

 private:
  Workbench& bench() { return studio_.bench(); }
  InputQueue& input() { return studio_.input(); }

  static std::optional<double> to_number(const std::string& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      return std::nullopt;
    return value;
  }
  static double number(const std::string& word) {
    if (const auto value = to_number(word)) return *value;
    throw UsageError("found \"" + word + "\", expected a number");
  }
  static int whole_number(const std::string& word, int least) {
    const double value = number(word);
    if (value != std::round(value) || value < least || value > longest_wait)
      throw UsageError("found \"" + word + "\", expected a whole number from " +
                       std::to_string(least));
    return static_cast<int>(value);
  }

  /// Number of coordinates of a point of the open mesh.
  std::size_t coordinates() {
    return static_cast<std::size_t>(bench().session().coordinates().dimension());
  }

  /// A point of the mesh, z = 0 in the plane.
  Vec3 point(const std::vector<std::string>& words, std::size_t first) {
    if (words.size() < first + coordinates())
      throw UsageError("a point of this mesh has " + std::to_string(coordinates()) +
                       " coordinates");
    Vec3 p(0, 0, 0);
    for (std::size_t k = 0; k < coordinates(); ++k)
      p[static_cast<Index>(k)] = number(words[first + k]);
    return p;
  }
  /// Pixel of a point of the mesh.
  ScreenPoint mesh_point(const std::vector<std::string>& words, std::size_t first) {
    return bench().view_control().view().project(point(words, first)).at;
  }
  void look(const std::vector<std::string>& words) {
    const Vec3 at = point(words, 1);
    const double radius = number(words.back());
    bench().apply(action::LookAt{at, radius});
  }

  /// Pixel of a widget or, for numbers, of a point of the mesh.
  ScreenPoint target(const std::vector<std::string>& words, std::size_t first) {
    return words.size() > first + 1 ? mesh_point(words, first) : widget(words[first]);
  }
  ScreenPoint widget(const std::string& id) {
    auto found = bench().widgets().find(id);
    if (found && !found->shown) {
      bench().widgets().want(id);
      studio_.frames(3);  // request, scroll, layout
      bench().widgets().want({});
      found = bench().widgets().find(id);
    }
    if (!found) throw UsageError("there is no widget \"" + id + "\" on screen");
    // A click at that place would hit another widget.
    if (!found->shown) throw UsageError("the widget \"" + id + "\" cannot be scrolled into sight");
    return found->centre();
  }

  void move(const ScreenPoint& to) {
    input().move(to);
    studio_.frames(2);
  }
  /// Moves the mouse off the window, so that no tooltip is in a picture.
  void away() {
    input().leave();
    studio_.frames(3);
  }
  void press(const ScreenPoint& at, MouseButton button = MouseButton::left) {
    move(at);
    input().button(button, true);
    studio_.frames(1);
  }
  void release(MouseButton button = MouseButton::left) {
    input().button(button, false);
    studio_.frames();
  }
  void click(const ScreenPoint& at, MouseButton button = MouseButton::left) {
    press(at, button);
    release(button);
  }
  void drag(const ScreenPoint& from, const ScreenPoint& to) {
    press(from);
    for (int k = 1; k <= drag_steps; ++k)
      move(from + (to - from) * (static_cast<double>(k) / drag_steps));
    release();
  }
  void wheel(const ScreenPoint& at, double notches) {
    move(at);
    input().wheel({0, notches});
    studio_.frames();
  }
  void key(const std::string& text) {
    const std::vector<int> keys = parse_keys(text);
    for (const int k : keys) input().key(k, true);
    for (auto k = keys.rbegin(); k != keys.rend(); ++k) input().key(*k, false);
    studio_.frames();
  }
  void type(const std::string& text) {
    for (const char c : text) {
      input().text(static_cast<char32_t>(static_cast<unsigned char>(c)));
      studio_.frames(1);
    }
    studio_.frames();
  }
  void fill(const std::string& id, const std::string& text) {
    click(widget(id));
    key("Ctrl+A");
    type(text);
    key("Tab");
  }

  void wait(const std::vector<std::string>& words) {
    if (words.size() == 1)
      studio_.settle();
    else
      studio_.frames(whole_number(words[1], 1));
  }

  void picture(const std::vector<std::string>& words) {
    PictureSpec spec;
    for (std::size_t k = 2; k < words.size(); ++k) {
      if (words[k] == "mesh-alone")
        spec.panels = false;
      else if (words[k] == "transparent")
        spec.transparent = true;
      else if (words[k] == "no-legend")
        spec.legend = false;
      else if (const auto scale = to_number(words[k]))
        spec.scale = *scale;
      else
        throw UsageError("found \"" + words[k] +
                         "\", expected mesh-alone, transparent, no-legend or a scale");
    }
    const std::filesystem::path path = out_ / words[1];
    check_picture_name(path);
    if (is_vector_format(path))
      write_figure(path, bench().pictures().figure(spec.legend));
    else
      write_png(path, spec == PictureSpec{} ? bench().pictures().picture()
                                            : bench().pictures().picture(spec));
    say_("Wrote " + path.string());
  }

  /// Records a film of one turn of the view around a volume mesh.
  void film(const std::vector<std::string>& words) {
    if (!bench().session().in_space())
      throw UsageError("a film of a turn is of a volume mesh, and none is open");
    RecordingSpec spec;
    spec.when = RecordingSpec::When::turntable;
    for (std::size_t k = 2; k < words.size(); ++k) {
      if (words[k] == "mesh-alone")
        spec.picture.panels = false;
      else
        spec.turn_seconds = number(words[k]);
    }
    if (!(spec.turn_seconds >= 0.1 && spec.turn_seconds <= 600))
      throw UsageError("a turn takes 0.1 to 600 seconds");
    const std::filesystem::path path = out_ / words[1];
    bench().apply(action::SetRecordingSpec{spec});
    bench().apply(action::StartRecording{path, std::nullopt, true});
    studio_.settle();
    if (const Prompt* prompt = bench().session().messages().prompt())
      throw OutputError(prompt->title + ": " + prompt->text);
    say_("Wrote " + path.string());
  }

  void widgets(const std::string& part) {
    for (const auto& [id, rect] : bench().widgets().all())
      if (id.find(part) != std::string::npos) say_(id);
  }

  HeadlessStudio& studio_;
  std::filesystem::path near_, out_;
  std::function<void(const std::string&)> say_;
};

}  // namespace

void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 const std::function<void(const std::string&)>& say) {
  // A pipe has no folder.
  const bool file = std::filesystem::is_regular_file(script.file);
  ScriptPlayer player(studio, file ? script.file.parent_path() : folder, folder, say);
  for (const ScriptLine& line : script.lines) {
    const std::string where = script.file.string() + ":" + std::to_string(line.number) + ": ";
    try {
      player.play(line.words);
    } catch (const OutputError& error) {
      throw OutputError(where + error.what());
    } catch (const Error& error) {
      throw InputError(where + error.what());
    }
  }
}

}  // namespace winslow::gui
