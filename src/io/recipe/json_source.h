#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"

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

}  // namespace winslow::io
