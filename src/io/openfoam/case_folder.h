#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Where an OpenFOAM case keeps its mesh, and what a path of the command line names.
///
/// A case has a mesh in constant/polyMesh. A mesh that moves has its points in folders of times,
/// 0.5/polyMesh/points, and each other file in the newest folder that is not later than that time
/// and holds it, at the latest in constant. Meshes of regions lie one folder deeper:
/// constant/REGION/polyMesh.
namespace winslow::io::openfoam {

/// The folder of a mesh in its case: root / instance / region / polyMesh.
struct MeshPlace {
  std::filesystem::path root;
  std::string instance;  ///< "constant", or the name of a time, as "0.5"; empty: in no case
  std::string region;    ///< empty: the case has one mesh

  std::filesystem::path folder() const;
  /// The same mesh at another time.
  MeshPlace at(const std::string& other) const { return {root, other, region}; }
};

/// The value of a name that is a time: "0.5", "1e-3".
std::optional<double> time_of(const std::string& name);

/// The names of the time folders of a case that hold a file of the mesh ("points" or "points.gz"),
/// or if `file` is empty, of all; by time.
std::vector<std::string> times_of(const MeshPlace& place, const std::string& file);

/// The file of a mesh as OpenFOAM finds it: that of the newest time that is not later than
/// place.instance, else that of constant. Plain or with ".gz"; empty if there is none.
std::filesystem::path find_file(const MeshPlace& place, const std::string& file);

/// The mesh that a path stands for when it is read: a case, its folder constant or of a time, a
/// folder polyMesh, or a file NAME.foam in the case. time: "latest" or the name of a time; empty:
/// that of the path, else constant. Nothing if the path is no folder and no .foam file, or if
/// there is no mesh. Throws UsageError for a time that the case does not have.
std::optional<MeshPlace> place_to_read(const std::filesystem::path& path, const std::string& time);

/// A sentence on meshes of times, where a path names none: which there are, and how to open them.
/// Empty: there are none, or the path names one.
std::string about_times(const std::filesystem::path& path, const MeshPlace& place);

/// True if a path names a folder to write a mesh to: a folder polyMesh, a case, a time of a case.
/// of_case: the mesh comes from a case; then any folder and any name without an extension does.
bool is_folder_to_write(const std::filesystem::path& path, bool of_case);

/// The mesh that a path stands for when it is written. source: that of the case that is read; null:
/// none. Throws UsageError for a file .foam, which is no mesh, and where a mesh in constant would
/// be replaced that was read and that the path does not name itself. The messages say what to
/// write.
MeshPlace place_to_write(const std::filesystem::path& path, const MeshPlace* source);

}  // namespace winslow::io::openfoam
