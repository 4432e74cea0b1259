#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::gui {

/// A program of that name in the folders of PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// Another program, started without a shell and watched without waiting for it. Ended, if it still
/// runs, when this object goes.
class ChildProcess {
 public:
  /// Runs a program in a folder; its standard input is empty. Throws Error if it cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads what it has said since. True once it has ended.
  bool poll();
  /// Exit status, 128 + signal if a signal ended it. After it has ended.
  int status() const { return status_; }
  const std::string& output() const { return output_; }
  const std::string& errors() const { return errors_; }

 private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  bool ended_ = false;
  int status_ = 0;
  std::string output_, errors_;
};

}  // namespace winslow::gui
