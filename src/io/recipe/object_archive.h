#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/command/command.h"
#include "core/error.h"
#include "core/options/option.h"

namespace winslow::io {

/// A value in a JSON file that is not what it should be. what() starts with where it is
/// ("commands[1].smooth.damping: found ..., expected ...").
class JsonValueError : public InputError {
 public:
  JsonValueError(std::string path, const std::string& message)
      : InputError(path.empty() ? message : path + ": " + message), path_(std::move(path)) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A JSON document that knows on which line each value stands.
struct JsonSource {
  nlohmann::json document;
  std::map<std::string, int> lines;  ///< by path, as in JsonValueError

  /// Line of a value or, if the file does not have it, of the nearest thing around it.
  int line_of(std::string path) const;
};

/// Parses strictly: no comments, no key twice in an object. Throws InputError "FILE:LINE: ...".
JsonSource read_json(const std::filesystem::path& file);

/// Throws JsonValueError "PATH: found ..., expected ...".
[[noreturn]] void refuse(const nlohmann::json& found, const std::string& path,
                         const std::string& expected);

/// Reads the fields of a JSON object strictly: types are checked, and finish() refuses keys that
/// nobody asked for. A function that names all fields of a struct once serves both this and
/// ObjectWriter, so what is written can be read.
class ObjectReader {
 public:
  /// path: where the object stands, as in JsonValueError. Throws JsonValueError if it is none.
  ObjectReader(const nlohmann::json& object, std::string path);

  /// A field that may be missing; the value then stays as it is.
  template <class Value>
  void field(const char* key, Value& value) {
    if (const nlohmann::json* json = find(key)) read(*json, path_of(key), value);
  }
  /// A field that must be there.
  template <class Value>
  void required(const char* key, Value& value) {
    read(needed(key), path_of(key), value);
  }
  /// An object within; `fields` is called with a reader of it.
  template <class Fields>
  void object(const char* key, const Fields& fields) {
    if (const nlohmann::json* json = find(key)) {
      ObjectReader inner(*json, path_of(key));
      fields(inner);
      inner.finish();
    }
  }
  /// Throws JsonValueError for a key that was not asked for.
  void finish() const;

  bool has(const char* key) const { return object_.contains(key); }
  /// The raw value, null if it is missing; finish() knows its key from then on.
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

/// Writes the same fields.
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

/// A vector of two numbers or of three. Throws JsonValueError.
GivenVector read_vector(const nlohmann::json& value, const std::string& path);
/// As many numbers as it was given by; `otherwise` of them if the program found it.
nlohmann::json vector_json(const GivenVector& vector, int otherwise = 3);

/// Reads the options of a table from the keys that it says; what is not there stays as it is, but
/// for what is required. Throws JsonValueError for values of the wrong type or out of range.
void read_options(ObjectReader& reader, const OptionTable& table);
/// Writes all of them. What is not set is left out.
void write_options(ObjectWriter& writer, const OptionTable& table);

}  // namespace winslow::io
