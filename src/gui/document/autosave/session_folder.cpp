#include "gui/document/autosave/session_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/error.h"
#include "gui/document/autosave/step_file.h"
#include "io/file/atomic_file.h"
#include "io/recipe/recipe.h"
#include "io/text/text_file.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr int format_version = 1;
constexpr int deepest = 100;                // deeper than any session
constexpr std::size_t longest_name = 4096;  // of a path

std::string step_name(std::uint64_t generation, std::uint64_t revision) {
  return "step-" + std::to_string(generation) + "-" + std::to_string(revision) + ".bin";
}

/// Keeps the extension of the source, which determines the format.
std::string mesh_name(const SessionRecord& session) {
  return "mesh-" + std::to_string(session.generation) + session.source.extension().string();
}

constexpr const char* start_prefix = "start-";

/// The mesh as opened, in the format of a step.
std::string start_name(const SessionRecord& session) {
  return start_prefix + std::to_string(session.generation) + ".bin";
}

/// Copies the opened mesh file. False if the file has changed since.
bool copy_unchanged(const SessionRecord& session, const fs::path& to) {
  if (!session.stamp || stamp_of(session.mesh) != session.stamp) return false;
  std::error_code error;
  fs::copy_file(session.mesh, to, fs::copy_options::overwrite_existing, error);
  if (!error && stamp_of(session.mesh) == session.stamp) return true;
  fs::remove(to, error);
  return false;
}

/// The mesh as opened. If the file had changed, data of its format other than the mesh are lost.
Document::Loaded read_start(const fs::path& file, const io::ReadOptions& reading) {
  if (!file.filename().string().starts_with(start_prefix)) return Document::load(file, reading);
  Document::Loaded loaded;
  loaded.state = read_step(file, MeshState{}).state;
  loaded.file.mesh = loaded.state.mesh;
  examine(loaded);
  return loaded;
}

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &parts);
  return text.data();
}

json manifest_of(const SessionRecord& session, const std::string& start) {
  json steps = json::array();
  for (std::size_t k = 1; k < session.history.size(); ++k)
    steps.push_back({{"file", step_name(session.generation, session.tags[k].revision)},
                     {"command", io::to_json(session.history.command(k))},
                     {"seconds", session.tags[k].seconds}});
  return {{"winslow_session", format_version},
          {"source", session.source.string()},
          {"path", session.path.string()},
          {"mesh", start},
          {"zone", session.reading.zone},
          {"regions", session.reading.regions},
          {"repair", session.reading.defects == io::Defects::repair},
          {"time", local_time()},
          {"position", session.history.position()},
          {"steps", std::move(steps)}};
}

json read_manifest(const fs::path& folder) {
  const fs::path path = folder / manifest_name;
  const std::string text = io::read_text_file(path);
  if (io::nested_deeper(text, deepest))
    throw InputError(path.string() + ": found more than " + std::to_string(deepest) +
                     " lists in each other, expected a saved session");
  json document = json::parse(text, nullptr, false);
  if (document.is_discarded() || !document.is_object())
    throw InputError(path.string() + ": found no JSON object, expected a saved session");
  return document;
}

[[noreturn]] void refuse(const char* key, const fs::path& folder) {
  throw InputError((folder / manifest_name).string() + ": found no fitting \"" + key +
                   "\", expected a saved session");
}

/// A value of the manifest. Throws InputError naming what is missing or of the wrong type.
template <class Value>
Value value_of(const json& object, const char* key, const fs::path& folder) {
  try {
    Value value = object.at(key).get<Value>();
    if constexpr (std::is_same_v<Value, std::string>)
      // No file has such a name.
      if (value.size() > longest_name || value.find('\0') != std::string::npos) refuse(key, folder);
    return value;
  } catch (const json::exception&) {
    refuse(key, folder);
  }
}

/// A file in the folder; the path cannot lead outside it.
fs::path file_of(const json& object, const char* key, const fs::path& folder) {
  return folder / fs::path(value_of<std::string>(object, key, folder)).filename();
}

/// How the mesh was read; a session of an earlier version says less.
io::ReadOptions reading_of(const json& manifest, const fs::path& folder) {
  io::ReadOptions reading;
  if (manifest.contains("zone")) reading.zone = value_of<int>(manifest, "zone", folder);
  if (manifest.contains("regions"))
    reading.regions = value_of<std::string>(manifest, "regions", folder);
  if (manifest.contains("repair") && value_of<bool>(manifest, "repair", folder))
    reading.defects = io::Defects::repair;
  return reading;
}

RestoredSession::Step read_one(const json& step, const fs::path& folder, const MeshState& before) {
  const fs::path file = file_of(step, "file", folder);
  RestoredSession::Step result;
  result.result = read_step(file, before);
  result.command =
      io::command_from_json(value_of<json>(step, "command", folder), folder, "command");
  result.seconds = value_of<double>(step, "seconds", folder);
  return result;
}

}  // namespace

void SessionFolder::make() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  const auto stamp = std::chrono::duration_cast<std::chrono::microseconds>(since).count();
  const fs::path path = root_ / (std::to_string(::getpid()) + "-" + std::to_string(stamp));
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw OutputError(path.string() + ": cannot be made: " + error.message());
  lock_ = FolderLock::acquire(path);
  if (!lock_) throw OutputError(path.string() + ": cannot be locked");
  path_ = path;
}

/// Writes the mesh as opened unless it is already written. Returns the name of its file.
std::string SessionFolder::keep_start(const SessionRecord& session) {
  std::string copy = mesh_name(session), own = start_name(session);
  if (written_.contains(copy)) return copy;
  if (written_.contains(own)) return own;
  const bool copied = copy_unchanged(session, path_ / copy);
  if (!copied) write_step(path_ / own, session.history.state(0), MeshState{}, SmoothResult{});
  return *written_.insert(copied ? copy : own).first;
}

void SessionFolder::write(const SessionRecord& session) {
  if (path_.empty()) make();
  const std::string start = keep_start(session);
  std::set<std::string> needed{start};
  for (std::size_t k = 1; k < session.history.size(); ++k) {
    const std::string name = step_name(session.generation, session.tags[k].revision);
    needed.insert(name);
    if (written_.contains(name)) continue;
    write_step(path_ / name, session.history.state(k), session.history.state(k - 1),
               session.history.result(k));
    written_.insert(name);
  }
  std::string text;
  try {
    text = manifest_of(session, start).dump(1);
  } catch (const json::exception&) {
    throw OutputError("a name in the session is not UTF-8 text");
  }
  io::write_atomically(path_ / manifest_name, [&](std::ostream& out) { out << text << '\n'; });
  std::erase_if(written_, [&](const std::string& name) {
    if (needed.contains(name)) return false;
    std::error_code ignored;
    fs::remove(path_ / name, ignored);
    return true;
  });
}

void SessionFolder::remove() {
  if (path_.empty()) return;
  std::error_code ignored;
  // Without a manifest the folder is no session, even if the other files cannot be removed.
  fs::remove(path_ / manifest_name, ignored);
  fs::remove_all(path_, ignored);
  lock_.reset();
  path_.clear();
  written_.clear();
}

SessionSummary read_summary(const fs::path& folder) {
  const json manifest = read_manifest(folder);
  if (value_of<int>(manifest, "winslow_session", folder) != format_version)
    throw InputError((folder / manifest_name).string() +
                     ": found the session of another version of winslow");
  SessionSummary summary;
  summary.name = fs::path(value_of<std::string>(manifest, "source", folder)).filename().string();
  summary.commands = value_of<json::array_t>(manifest, "steps", folder).size();
  summary.time = value_of<std::string>(manifest, "time", folder);
  return summary;
}

fs::path kept_mesh(const fs::path& folder) {
  return file_of(read_manifest(folder), "mesh", folder);
}

RestoredSession read_session(const fs::path& folder) {
  read_summary(folder);  // checks the version
  const json manifest = read_manifest(folder);
  RestoredSession session;
  session.loaded = read_start(file_of(manifest, "mesh", folder), reading_of(manifest, folder));
  session.loaded.path = value_of<std::string>(manifest, "source", folder);
  session.path = value_of<std::string>(manifest, "path", folder);
  const auto steps = value_of<json::array_t>(manifest, "steps", folder);
  for (const json& step : steps) {
    try {
      const MeshState& before =
          session.steps.empty() ? session.loaded.state : session.steps.back().result.state;
      session.steps.push_back(read_one(step, folder, before));
    } catch (const Error& error) {
      session.damage = "Step " + std::to_string(session.steps.size() + 1) + " of " +
                       std::to_string(steps.size()) +
                       " and those after it are lost: " + error.what();
      break;
    }
  }
  session.position =
      std::min(value_of<std::size_t>(manifest, "position", folder), session.steps.size());
  return session;
}

std::optional<FolderLock> FolderLock::acquire(const std::filesystem::path& folder) {
  const int descriptor = ::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return std::nullopt;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    return std::nullopt;
  }
  return FolderLock(descriptor);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace winslow::gui
