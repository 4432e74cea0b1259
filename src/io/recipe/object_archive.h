#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/command/command.h"
#include "core/error.h"
#include "core/options/option.h"

namespace winslow::io {

/// An invalid value in a JSON file. what() starts with the path of the value
/// ("commands[1].smooth.damping: found ..., expected ...").
class JsonValueError : public InputError {
 public:
  JsonValueError(std::string path, const std::string& message)
      : InputError(path.empty() ? message : path + ": " + message), path_(std::move(path)) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A JSON document with the line number of each value.
struct JsonSource {
  nlohmann::json document;
  std::map<std::string, int> lines;  ///< by path, as in JsonValueError

  /// Line of a value or, if the file does not have it, of the innermost enclosing value.
  int line_of(std::string path) const;
};

/// Parses strictly: no comments, no duplicate keys in an object. Throws InputError "FILE:LINE:
/// ...".
JsonSource read_json(const std::filesystem::path& file);

/// Throws JsonValueError "PATH: found ..., expected ...".
[[noreturn]] void refuse(const nlohmann::json& found, const std::string& path,
                         const std::string& expected);

/// Reads the fields of a JSON object strictly: types are checked, and finish() rejects keys that
/// were not read. One function that names all fields of a struct serves both ObjectReader and
/// ObjectWriter, so that written files can be read.
class ObjectReader {
 public:
  /// path: path of the object, as in JsonValueError. Throws JsonValueError if the value is no
  /// object.
  ObjectReader(const nlohmann::json& object, std::string path);

  /// Reads an optional field; if it is missing, `value` is unchanged.
  template <class Value>
  void field(const char* key, Value& value) {
    if (const nlohmann::json* json = find(key)) read(*json, path_of(key), value);
  }
  /// Reads a mandatory field.
  template <class Value>
  void required(const char* key, Value& value) {
    read(needed(key), path_of(key), value);
  }
  /// Reads a nested object: calls `fields` with a reader of it.
  template <class Fields>
  void object(const char* key, const Fields& fields) {
    if (const nlohmann::json* json = find(key)) {
      ObjectReader inner(*json, path_of(key));
      fields(inner);
      inner.finish();
    }
  }
  /// Throws JsonValueError for a key that was not read.
  void finish() const;

  bool has(const char* key) const { return object_.contains(key); }
  /// The raw value, null if it is missing. finish() then accepts the key.
  const nlohmann::json* find(const char* key);
  /// The raw value; throws JsonValueError if it is missing.
  const nlohmann::json& needed(const char* key);
  std::string path_of(const char* key) const;
  const std::string& path() const { return path_; }

  static void read(const nlohmann::json& json, const std::string& path, double& value);
  static void read(const nlohmann::json& json, const std::string& path, int& value);
  static void read(const nlohmann::json& json, const std::string& path, std::uint64_t& value);
  static void read(const nlohmann::json& json, const std::string& path, bool& value);
  static void read(const nlohmann::json& json, const std::string& path, std::string& value);
  static void read(const nlohmann::json& json, const std::string& path,
                   std::vector<std::string>& value);
  static void read(const nlohmann::json& json, const std::string& path, std::vector<int>& value);
  static void read(const nlohmann::json& json, const std::string& path, std::vector<double>& value);
  static void read(const nlohmann::json& json, const std::string& path, Vec2& value);

 private:
  const nlohmann::json& object_;
  std::string path_;
  std::vector<std::string> known_;
};

/// Writes the fields that ObjectReader reads.
class ObjectWriter {
 public:
  template <class Value>
  void field(const char* key, const Value& value) {
    json_[key] = write(value);
  }
  template <class Value>
  void required(const char* key, const Value& value) {
    json_[key] = write(value);
  }
  template <class Fields>
  void object(const char* key, const Fields& fields) {
    ObjectWriter inner;
    fields(inner);
    json_[key] = std::move(inner.json_);
  }
  nlohmann::json take() { return std::move(json_); }

  template <class Value>
  static nlohmann::json write(const Value& value) {
    return value;
  }
  static nlohmann::json write(const Vec2& value) {
    return nlohmann::json::array({value.x(), value.y()});
  }

 private:
  nlohmann::json json_ = nlohmann::json::object();
};

/// Reads a vector of two or three numbers. Throws JsonValueError.
GivenVector read_vector(const nlohmann::json& value, const std::string& path);
/// Writes as many numbers as the user gave; `otherwise` numbers if the program found the vector.
nlohmann::json vector_json(const GivenVector& vector, int otherwise = 3);

/// Reads the options of a table by their keys; missing options are unchanged. Throws JsonValueError
/// for missing required options and for values of the wrong type or out of range.
void read_options(ObjectReader& reader, const OptionTable& table);
/// Writes all options of a table except those that are not set.
void write_options(ObjectWriter& writer, const OptionTable& table);

}  // namespace winslow::io
