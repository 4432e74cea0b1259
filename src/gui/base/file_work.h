#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

/// What the session's work on files has in common.
namespace winslow::gui {

/// `work`, whose failure is text rather than an exception. Running out of memory on a huge file is
/// an error like another.
template <class Work>
std::string error_of(Work&& work) {
  try {
    work();
    return {};
  } catch (const std::bad_alloc&) {
    return "There is not enough memory.";
  } catch (const std::exception& error) {
    return error.what();
  }
}

inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace winslow::gui
