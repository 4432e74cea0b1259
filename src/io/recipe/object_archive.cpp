#include "io/recipe/object_archive.h"

#include <algorithm>
#include <utility>

namespace winslow::io {
namespace {

using nlohmann::json;

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
