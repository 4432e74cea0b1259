#include "app/output/reference.h"

#include <array>

#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "core/layers/layer_option_tables.h"
#include "core/motion/motion_options.h"
#include "io/format/mesh_format.h"

namespace winslow::app {
namespace {

std::string code(const std::string& text) { return text.empty() ? "" : '`' + text + '`'; }

template <class Item>
std::string item_text(const Item& item) {
  return "; " + code(std::string(item.name)) +
         (item.help.empty() ? "" : ": " + std::string(item.help));
}

/// What is said of an option, with what there is to choose from.
std::string meaning(const Option& option) {
  std::string text(option.help);
  std::string items;
  if (const auto* choice = std::get_if<ChoiceOption>(&option.value)) {
    for (const ChoiceItem& item : choice->items()) items += item_text(item);
  } else if (const auto* shares = std::get_if<SharesOption>(&option.value)) {
    for (const auto& part : shares->parts) items += item_text(part);
  }
  if (!items.empty()) text += ": " + items.substr(2);
  if (!option.unit.empty()) text += " (" + std::string(option.unit) + ")";
  return text + '.' + (option.advice.empty() ? "" : ' ' + std::string(option.advice));
}

/// The names of a choice stand in its meaning.
std::string range_text(const Option& option) {
  return std::holds_alternative<ChoiceOption>(option.value) ? "" : expected_text(option);
}

void print_flags(std::ostream& out, const OptionTable& table) {
  out << "| option | in a recipe | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Option& option : table) {
    const bool flag = option.on_command_line == OnCommandLine::yes;
    out << "| " << (flag ? code(flag_of(option)) : "") << " | " << code(path_of(option)) << " | "
        << (option.required ? "required" : code(value_text(option))) << " | " << range_text(option)
        << " | " << meaning(option) << " |\n";
  }
}

/// The table of a struct, with its defaults.
template <class Options>
void print_table(std::ostream& out) {
  Options defaults;
  print_flags(out, option_table(defaults));
}

void print_fields(std::ostream& out) {
  out << "| field | in the report | meaning |\n|---|---|---|\n";
  std::vector<ElementField> fields = all_element_fields();
  for (const ElementField& field : all_element_fields(MeshKind::surface))
    if (field.surface()) fields.push_back(field);
  for (const ElementField& field : fields) {
    if (field.layer()) continue;  // a mesh file says nothing of layers
    const bool reported = field.metric() && metric_info(*field.metric()).reported;
    const FieldInfo& info = field_info(field);
    out << "| " << code(std::string(info.name)) << " | " << (reported ? "yes" : "") << " | "
        << info.help << " |\n";
  }
}

void print_formats(std::ostream& out) {
  out << "| format | extension | encodings | markers | regions | quadrilaterals | volumes |\n"
         "|---|---|---|---|---|---|---|\n";
  for (const io::MeshFormat* format : io::mesh_formats()) {
    out << "| " << format->title << (format->versions.empty() ? "" : ", ") << format->versions
        << " | " << code('.' + std::string(format->name)) << " | " << format->encodings << " | "
        << format->markers << " | " << format->regions << " | " << format->quadrilaterals << " | "
        << format->volumes << " |\n";
  }
}

struct Reference {
  const char* name;
  void (*print)(std::ostream& out);
};

constexpr std::array references{Reference{"smoothing", print_table<SmoothOptions>},
                                Reference{"motion", print_table<MotionOptions>},
                                Reference{"rigid", print_table<RigidMotionRequest>},
                                Reference{"sine", print_table<SineDeformation>},
                                Reference{"spacing", print_table<LayerSpacing>},
                                Reference{"layers", print_table<LayersCommand>},
                                Reference{"scramble", print_table<ScrambleCommand>},
                                Reference{"fields", print_fields},
                                Reference{"formats", print_formats}};

}  // namespace

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const Reference& reference : references) names.emplace_back(reference.name);
  return names;
}

void print_reference(std::ostream& out, const std::string& name) {
  for (const Reference& reference : references) {
    if (name == reference.name) return reference.print(out);
  }
  throw UsageError("no reference table is called \"" + name + '"');
}

}  // namespace winslow::app
