#include "gui/menu/user_command.h"

#include <imgui.h>

#include <cctype>

namespace winslow::gui {

UserCommand entry(std::string id, std::string label, std::vector<Chord> keys, std::string tooltip,
                  UserCommand::Run run, UserCommand more) {
  more.id = std::move(id);
  more.label = std::move(label);
  more.keys = std::move(keys);
  more.tooltip = std::move(tooltip);
  more.run = std::move(run);
  return more;
}

UserCommand submenu(std::string id, std::string label, std::string tooltip,
                    UserCommand::Items items, UserCommand more) {
  more.items = std::move(items);
  return entry(std::move(id), std::move(label), {}, std::move(tooltip), {}, std::move(more));
}

UserCommand::Text unless(UserCommand::Test can, std::string reason) {
  return [can = std::move(can), reason = std::move(reason)](const PanelContext& c) {
    return can(c) ? std::string() : reason;
  };
}

UserCommand::Text first_of(std::vector<UserCommand::Text> reasons) {
  return [reasons = std::move(reasons)](const PanelContext& c) {
    std::string reason;
    for (std::size_t k = 0; k < reasons.size() && reason.empty(); ++k) reason = reasons[k](c);
    return reason;
  };
}

const std::vector<UserCommand>& user_commands() {
  static const std::vector<UserCommand> all = [] {
    const std::array<std::pair<CommandGroup, std::vector<UserCommand>>, 9> tables{
        {{CommandGroup::file, file_commands()},
         {CommandGroup::edit, edit_commands()},
         {CommandGroup::motion, motion_commands()},
         {CommandGroup::layers, layer_commands()},
         {CommandGroup::solver, solver_commands()},
         {CommandGroup::view, view_commands()},
         {CommandGroup::view, space_commands()},
         {CommandGroup::help, help_commands()},
         {CommandGroup::help, demo_commands()}}};
    std::vector<UserCommand> commands;
    for (const auto& [group, table] : tables)
      for (const UserCommand& command : table) commands.emplace_back(command).group = group;
    return commands;
  }();
  return all;
}

const UserCommand& user_command(std::string_view id) {
  const auto& all = user_commands();
  const auto it = std::find_if(all.begin(), all.end(), [id](const auto& c) { return c.id == id; });
  if (it == all.end()) throw std::logic_error("no user command \"" + std::string(id) + "\"");
  return *it;
}

std::string_view group_label(CommandGroup group) {
  constexpr std::array<std::string_view, command_groups.size()> labels{
      "File", "Edit", "Motion", "Layers", "Solver", "View", "Help"};
  return labels[static_cast<std::size_t>(group)];
}

namespace {

/// Why a command for such meshes is unavailable for the open one, a sentence; empty: it is
/// available, or no mesh is open.
std::string why_not_served(MeshKinds serves, const PanelContext& context) {
  const MeshKind kind = context.session.kind();
  if (!context.session.document() || serves.contains(kind)) return {};
  const bool of_surfaces = serves.contains(MeshKind::surface);
  const bool of_volumes = serves.contains(MeshKind::volume);
  if (kind == MeshKind::plane)
    return of_surfaces ? "Only for surface and volume meshes." : "Only for volume meshes.";
  if (kind == MeshKind::volume) return "Not for volume meshes yet.";
  if (!of_volumes) return "Not for surface meshes.";
  return serves.contains(MeshKind::plane)
             ? "Not for surface meshes: the surface keeps its shape, and nodes move on it."
             : "Only for volume meshes: a surface mesh has nothing inside.";
}

}  // namespace

std::string why_blocked(const UserCommand& command, const PanelContext& context) {
  if (std::string reason = why_not_served(command.serves, context); !reason.empty()) return reason;
  return command.blocked ? command.blocked(context) : std::string();
}

std::string label_of(const UserCommand& command, const PanelContext& context) {
  return command.label_now ? command.label_now(context) : command.label;
}

std::string tooltip_of(const UserCommand& command) {
  const std::string keys = chords_text(command.keys);
  const std::string text = command.tooltip.empty() ? command.label : command.tooltip;
  return keys.empty() ? text : text + " (" + keys + ")";
}

std::string without_mesh(const PanelContext& context) {
  return context.session.document() ? "" : "No mesh is open.";
}

std::string while_busy(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.in_motion() ? "The solver is at work." : "";
}

namespace {

std::string key_name(int key) {
  constexpr std::array<std::pair<int, const char*>, 20> names{
      {{GLFW_KEY_SPACE, "Space"},
       {GLFW_KEY_ESCAPE, "Esc"},
       {GLFW_KEY_ENTER, "Enter"},
       {GLFW_KEY_TAB, "Tab"},
       {GLFW_KEY_BACKSPACE, "Backspace"},
       {GLFW_KEY_DELETE, "Delete"},
       {GLFW_KEY_INSERT, "Insert"},
       {GLFW_KEY_LEFT, "Left"},
       {GLFW_KEY_RIGHT, "Right"},
       {GLFW_KEY_UP, "Up"},
       {GLFW_KEY_DOWN, "Down"},
       {GLFW_KEY_HOME, "Home"},
       {GLFW_KEY_END, "End"},
       {GLFW_KEY_PAGE_UP, "Page Up"},
       {GLFW_KEY_PAGE_DOWN, "Page Down"},
       {GLFW_KEY_EQUAL, "plus"},
       {GLFW_KEY_MINUS, "minus"},
       {GLFW_KEY_KP_ADD, "keypad plus"},
       {GLFW_KEY_KP_SUBTRACT, "keypad minus"},
       {GLFW_KEY_KP_0, "keypad 0"}}};
  for (const auto& [code, name] : names)
    if (code == key) return name;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  return {static_cast<char>(key)};  // letters, digits and signs have the codes of ASCII
}

}  // namespace

std::string chord_text(const Chord& chord) {
  if (chord.key == 0) return {static_cast<char>(chord.character)};
  return std::string(chord.control ? "Ctrl+" : "") + (chord.alt ? "Alt+" : "") +
         (chord.shift ? "Shift+" : "") + key_name(chord.key);
}

std::string chords_text(const std::vector<Chord>& chords) {
  std::string text;
  for (const Chord& chord : chords) text += (text.empty() ? "" : ", ") + chord_text(chord);
  return text;
}

bool pressed(const Chord& chord) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool control_held = io.KeyCtrl || io.KeySuper;
  if (chord.key == 0) {
    const auto& typed = io.InputQueueCharacters;
    return !control_held && std::find(typed.begin(), typed.end(),
                                      static_cast<ImWchar>(chord.character)) != typed.end();
  }
  // On many keyboards "+" is the key "=" with Shift.
  const bool shift_fits = io.KeyShift == chord.shift || chord.key == GLFW_KEY_EQUAL;
  return ImGui::IsKeyPressed(chord.key, false) && control_held == chord.control && shift_fits &&
         io.KeyAlt == chord.alt;
}

namespace {

/// During a drag, digits enter numbers, and X, Y, Z choose axes.
bool means_drag(const Chord& chord) {
  if (chord.control || chord.alt) return false;
  return (chord.key >= GLFW_KEY_0 && chord.key <= GLFW_KEY_9) ||
         (chord.key >= GLFW_KEY_KP_0 && chord.key <= GLFW_KEY_KP_9) ||
         (chord.key >= GLFW_KEY_X && chord.key <= GLFW_KEY_Z);
}

}  // namespace

void handle_shortcuts(const PanelContext& context, bool dragging) {
  for (const UserCommand& command : user_commands()) {
    if (dragging && command.group != CommandGroup::view) continue;
    const auto counts = [dragging](const Chord& chord) {
      return !(dragging && means_drag(chord)) && pressed(chord);
    };
    if (!std::any_of(command.keys.begin(), command.keys.end(), counts)) continue;
    if (why_blocked(command, context).empty()) command.run(context);
  }
}

namespace {

/// How a word was found, in ascending order of rank.
enum class Found { no, word_begins, word, label_begins, label };

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // Non-ASCII UTF-8 bytes belong to words.
    if (std::isalnum(byte) != 0 || byte >= 0x80)
      words.back() += static_cast<char>(std::tolower(byte));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::string_view singular(std::string_view word) {
  if (word.size() > 3 && word.ends_with('s')) word.remove_suffix(1);
  return word;
}

bool has(const std::vector<std::string>& words, std::string_view wanted) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return singular(word) == singular(wanted); });
}

bool has_beginning(const std::vector<std::string>& words, std::string_view wanted) {
  return std::ranges::any_of(
      words, [&](const std::string& word) { return word.starts_with(singular(wanted)); });
}

Found find(std::string_view wanted, const std::vector<std::string>& label,
           const std::vector<std::string>& words) {
  if (has(label, wanted)) return Found::label;
  if (has_beginning(label, wanted)) return Found::label_begins;
  if (has(words, wanted)) return Found::word;
  // One or two letters would match some word in every list.
  return wanted.size() > 2 && has_beginning(words, wanted) ? Found::word_begins : Found::no;
}

}  // namespace

std::optional<int> search_score(std::string_view query, std::string_view label,
                                std::string_view words) {
  const std::vector<std::string> in_label = words_of(label);
  const std::vector<std::string> in_words = words_of(words);
  Found worst = Found::label;
  for (const std::string& wanted : words_of(query))
    worst = std::min(worst, find(wanted, in_label, in_words));
  const std::optional<int> by_letters = fuzzy_score(query, label);
  if (worst == Found::no) return by_letters;
  return static_cast<int>(worst) * found_by_words + by_letters.value_or(0);
}

namespace {

constexpr int letter = 2;
constexpr int begins_text = 12;
constexpr int begins_word = 8;
constexpr int adjoins = 6;
constexpr int none = std::numeric_limits<int>::min() / 2;

bool word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::optional<int> fuzzy_score(std::string_view query, std::string_view text) {
  std::string wanted;
  for (char c : query)
    if (c != ' ') wanted += lower(c);
  if (wanted.empty()) return 0;
  const std::size_t n = text.size();
  // best[j]: best score of the letters so far, with the last of them matched at j.
  std::vector<int> best(n, none);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    std::vector<int> next(n, none);
    int before = i == 0 ? 0 : none;  // best that ends before j - 1
    for (std::size_t j = 0; j < n; ++j) {
      const int beside = j > 0 && i > 0 ? best[j - 1] : none;
      if (lower(text[j]) == wanted[i]) {
        int own = letter;
        if (j == 0)
          own += begins_text;
        else if (!word_character(text[j - 1]))
          own += begins_word;
        const int from = std::max(before, beside == none ? none : beside + adjoins);
        if (from != none) next[j] = from + own;
      }
      before = std::max(before, beside);
    }
    best = std::move(next);
  }
  const int score = n == 0 ? none : *std::max_element(best.begin(), best.end());
  if (score == none) return std::nullopt;
  // Of two equal matches prefer the shorter text, of which the query covers more.
  return 64 * score - static_cast<int>(std::min<std::size_t>(n, 63));
}

}  // namespace winslow::gui
