#include "gui/shell/headless/script.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <fstream>
#include <map>
#include <utility>

#include "core/error.h"

namespace winslow::gui {

namespace {

struct Arity {
  std::size_t least, most;
};

/// Words that follow the first.
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
    // GLFW numbers the keys of printable characters as ASCII does.
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
  // A plus at the end is the key of that name.
  for (std::size_t end; (end = text.find('+', start)) + 1 < text.size() && end != text.npos;
       start = end + 1)
    keys.push_back(key_code(text.substr(start, end - start)));
  keys.push_back(key_code(text.substr(start)));
  return keys;
}

Script read_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": this script cannot be read");
  Script script{file, {}};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = file.string() + ":" + std::to_string(++number) + ": ";
    auto words = split(line, where);
    if (words.empty()) continue;
    check(words, where);
    script.lines.push_back({number, std::move(words)});
  }
  if (in.bad()) throw InputError(file.string() + ": this script cannot be read");
  return script;
}

}  // namespace winslow::gui
