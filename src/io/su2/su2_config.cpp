#include "io/su2/su2.h"

#include "io/text/source.h"

namespace winslow::io::su2 {
namespace {

/// One option of the file: "NAME= ( a, b )", which may go on in lines after one that ends in '\'.
struct ConfigOption {
  std::string name, value;
  std::size_t place = 0;
};

std::vector<ConfigOption> options_of(const Source& source) {
  std::vector<ConfigOption> options;
  Scanner scan(source);
  bool goes_on = false;
  while (!scan.at_end()) {
    const std::size_t place = scan.offset();
    std::string_view line = scan.line();
    line = trimmed(line.substr(0, line.find('%')));
    const bool continued = line.ends_with('\\');
    if (continued) line.remove_suffix(1);
    if (goes_on) {
      options.back().value += ' ';
      options.back().value += line;
    } else if (const auto equals = line.find('='); equals != std::string_view::npos) {
      options.push_back({std::string(trimmed(line.substr(0, equals))),
                         std::string(line.substr(equals + 1)), place});
    }
    goes_on = continued && !options.empty();
  }
  return options;
}

/// The words of a list in brackets, which blanks or commas separate.
std::vector<std::string> words_of(const Source& source, const ConfigOption& option) {
  const std::string_view text = trimmed(option.value);
  if (text == "NONE") return {};
  if (text.size() < 2 || text.front() != '(' || text.back() != ')')
    source.fail(option.place, option.name + "= " + in_quotes(text), "a list in brackets");
  std::vector<std::string> words(1);
  for (const char c : text.substr(1, text.size() - 2)) {
    const bool separates = c == ',' || c == ' ' || c == '\t' || c == ';';
    if (!separates)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  if (words == std::vector<std::string>{"NONE"}) words.clear();
  return words;
}

}  // namespace

MarkerRoles read_config(const std::filesystem::path& path) {
  constexpr std::size_t each = 11;  // two markers, nine numbers
  const Source source = Source::load(path);
  MarkerRoles roles;
  for (const ConfigOption& option : options_of(source)) {
    if (option.name == "MARKER_SYM") {
      for (std::string& name : words_of(source, option))
        roles.symmetry.emplace_back(std::move(name), option.name);
    } else if (option.name == "MARKER_PERIODIC") {
      const std::vector<std::string> words = words_of(source, option);
      if (words.size() % each != 0)
        source.fail(option.place,
                    "MARKER_PERIODIC= with " + std::to_string(words.size()) + " words",
                    "two markers and nine numbers for each pair");
      for (std::size_t k = 0; k < words.size(); k += each)
        roles.pairs.emplace_back(words[k], words[k + 1]);
    }
  }
  return roles;
}

}  // namespace winslow::io::su2
