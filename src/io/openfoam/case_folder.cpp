#include "io/openfoam/case_folder.h"

#include <system_error>

#include "core/error.h"
#include "io/openfoam/openfoam.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::openfoam {

namespace fs = std::filesystem;

namespace {

constexpr const char* mesh_folder = "polyMesh";
constexpr const char* constant = "constant";

/// The path without a separator at its end and without dots.
fs::path tidied(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

/// A file, or the same with ".gz"; empty if there is neither.
fs::path existing(const fs::path& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) return file;
  fs::path packed = file;
  packed += ".gz";
  return fs::is_regular_file(packed, error) ? packed : fs::path();
}

bool is_instance(const std::string& name) { return name == constant || time_of(name); }

/// The name of the last folder of a path, also of "." and "..".
std::string name_of(const fs::path& path) {
  std::string name = tidied(path).filename().string();
  if (!name.empty() && name != "." && name != "..") return name;
  std::error_code error;
  return tidied(fs::absolute(path, error)).filename().string();
}

fs::path parent_of(const fs::path& path) {
  const fs::path tidy = tidied(path);
  if (tidy.empty() || tidy == "." || tidy.filename() == "..") return tidied(tidy / "..");
  const fs::path parent = tidy.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// The place of a folder polyMesh.
MeshPlace place_of_mesh_folder(const fs::path& folder) {
  const fs::path above = parent_of(folder);
  if (is_instance(name_of(above))) return {parent_of(above), name_of(above), {}};
  const fs::path instance = parent_of(above);
  if (is_instance(name_of(instance)))
    return {parent_of(instance), name_of(instance), name_of(above)};
  return {above, {}, {}};
}

/// The folder polyMesh that a path names, at its own time.
MeshPlace place_named(const fs::path& path) {
  const fs::path folder = tidied(path.extension() == ".foam" ? parent_of(path) : path);
  const std::string name = name_of(folder);
  if (name == mesh_folder) return place_of_mesh_folder(folder);
  // The name of a case may be a number, too.
  if (is_folder(folder / constant)) return {folder, constant, {}};
  if (is_instance(name)) return {parent_of(folder), name, {}};
  if (is_instance(name_of(parent_of(folder))) && is_folder(folder / mesh_folder))
    return place_of_mesh_folder(folder / mesh_folder);
  if (!existing(folder / mesh_folder / "points").empty()) return {folder, {}, {}};
  return {folder, constant, {}};
}

bool names_a_time(const fs::path& path) {
  MeshPlace place = place_named(path);
  const std::string name = name_of(path);
  return name == mesh_folder || name == constant || place.region == name ||
         (!place.instance.empty() && name == place.instance);
}

}  // namespace

fs::path MeshPlace::folder() const {
  fs::path path = instance.empty() ? root : root / instance;
  if (!region.empty()) path /= region;
  return (path / mesh_folder).lexically_normal();
}

std::optional<double> time_of(const std::string& name) {
  if (name.empty() || std::string_view("0123456789+-.").find(name[0]) == std::string_view::npos)
    return std::nullopt;
  const auto value = parse_number(name);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string> times_of(const MeshPlace& place, const std::string& file) {
  std::vector<std::string> names;
  if (place.instance.empty()) return names;
  std::error_code error;
  for (fs::directory_iterator it(place.root, error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!time_of(name) || !is_folder(it->path())) continue;
    if (file.empty() || !existing(place.at(name).folder() / file).empty()) names.push_back(name);
  }
  std::ranges::sort(names, {},
                    [](const std::string& name) { return std::pair(*time_of(name), name); });
  return names;
}

fs::path find_file(const MeshPlace& place, const std::string& file) {
  if (fs::path own = existing(place.folder() / file); !own.empty()) return own;
  const auto now = time_of(place.instance);
  if (!now) return {};
  std::vector<std::string> times = times_of(place, file);
  std::erase_if(times, [&](const std::string& name) { return *time_of(name) > *now; });
  return existing(place.at(times.empty() ? constant : times.back()).folder() / file);
}

namespace {

/// The name of a time of the case, as --time says it.
std::string instance_at(const MeshPlace& place, const std::string& time) {
  if (time == constant) return constant;
  std::vector<std::string> times = times_of(place, {});
  if (time == "latest") return times.empty() ? constant : times.back();
  const auto wanted = time_of(time);
  if (!wanted)
    throw UsageError("--time: found " + in_quotes(time) + ", expected latest, constant or a time");
  for (const std::string& name : times)
    if (*time_of(name) == *wanted) return name;
  const std::string known = list_of(times, [](const std::string& name) { return name; });
  throw UsageError(place.root.string() + ": has no time " + time + ", expected " +
                   (known.empty() ? "constant: there are no others" : "one of " + known));
}

}  // namespace

std::optional<MeshPlace> place_to_read(const fs::path& path, const std::string& time) {
  const bool by_name = path.extension() == ".foam" && !is_folder(path);
  if (!by_name && !is_folder(path)) return std::nullopt;
  MeshPlace place = place_named(path);
  if (!time.empty()) {
    if (place.instance.empty())
      throw UsageError(path.string() + ": lies in no case, so it has no times (--time)");
    place.instance = instance_at(place, time);
  }
  // A .foam file is empty, so the missing item can only be the folder that it stands for.
  const bool exists = !find_file(place, "points").empty() || is_folder(place.folder());
  return by_name || exists ? std::optional(place) : std::nullopt;
}

std::string about_times(const fs::path& path, const MeshPlace& place) {
  if (place.instance != constant || names_a_time(path)) return {};
  const std::vector<std::string> times = times_of(place, "points");
  if (times.empty()) return {};
  constexpr std::size_t most_named = 5;
  const std::string which =
      times.size() <= most_named
          ? list_of(times, [](const std::string& name) { return name; })
          : std::to_string(times.size()) + " times from " + times.front() + " to " + times.back();
  return "the mesh of constant is read, and the case has moved points at " + which +
         ": --time latest, or the folder " + times.back() + " in place of the case, reads the last";
}

bool is_folder_to_write(const fs::path& path, bool of_case) {
  std::string name = tidied(path).filename().string();
  if (name == mesh_folder || is_folder(path / constant) || is_folder(path / "system")) return true;
  if (time_of(name) && is_folder(parent_of(path) / constant)) return true;
  const bool plain = !path.has_filename() || !path.has_extension() || time_of(name);
  return of_case && !path.empty() && (plain || is_folder(path));
}

MeshPlace place_to_write(const fs::path& path, const MeshPlace* source) {
  if (path.extension() == ".foam" && !is_folder(path)) {
    const fs::path folder = parent_of(path);
    throw UsageError(path.string() +
                     ": is no mesh but the empty file by which ParaView opens a case; expected a "
                     "folder: " +
                     (folder / constant / mesh_folder).lexically_normal().string() +
                     " for a whole mesh, " + (folder / "0.5").lexically_normal().string() +
                     " for the moved points of a time");
  }
  MeshPlace place = place_named(path);
  if (source == nullptr || place.instance != constant || name_of(path) == mesh_folder) return place;
  std::error_code error;
  if (fs::weakly_canonical(place.folder(), error) !=
          fs::weakly_canonical(source->folder(), error) &&
      fs::weakly_canonical(place.folder(), error) !=
          fs::weakly_canonical(source->at(constant).folder(), error))
    return place;
  throw UsageError(
      path.string() + ": the mesh of this case, which is read, would be replaced; expected -o " +
      place.at("0.5").folder().parent_path().string() + " or another time, another folder, or -o " +
      place.folder().string() + " to replace it");
}

}  // namespace winslow::io::openfoam
