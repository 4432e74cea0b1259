#include "io/recipe/option_fields.h"

namespace winslow::io {

namespace {

using nlohmann::json;

/// Shares that are not named are 0, as on the command line.
void read_shares(const json& value, const std::string& path, const SharesOption& shares) {
  ObjectReader reader(value, path);
  for (const auto& part : shares.parts) *part.share = 0;
  for (const auto& part : shares.parts) reader.field(std::string(part.name).c_str(), *part.share);
  reader.finish();
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
  const json* value = option.required ? &reader.at(key.c_str()) : reader.find(key.c_str());
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

/// The rows of a table that stand in one object.
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
        // An object of numbers of which none is set says nothing.
        if (std::ranges::all_of(rows,
                                [](const Option& o) { return write_value(o.value).is_null(); }))
          return;
        writer.object(std::string(object).c_str(), [&](ObjectWriter& within) {
          for (const Option& option : rows) write(within, option);
        });
      });
}

}  // namespace winslow::io
