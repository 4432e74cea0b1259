#pragma once

#include "python/keywords.h"

/// The commands that change a mesh, as functions of the module. Each does what the command line
/// does with the same options, from the defaults of the file to the checks of the result, but for
/// files.
namespace winslow::python {

/// Carries out commands on a mesh, and keeps what reports need.
class EditRun {
 public:
  /// name: of the function. Throws the library's errors, and exceptions of the callback.
  EditRun(std::string name, MeshPointer source, std::vector<Command> commands,
          const RunArguments& arguments);

  const MeshPointer& mesh() const { return result_; }
  const std::vector<app::CommandRecord>& commands() const { return report_.commands; }
  Index inverted() const { return report_.commands.back().result.inverted; }
  bool converged() const { return app::all_converged(report_.commands); }
  double fraction_reached() const;
  int linear_solves() const;
  /// Why the motion was not completed, a clause; empty: it was.
  std::string why_incomplete() const;
  /// All iterations of all commands.
  std::vector<IterationRecord> history() const;
  /// Damage, folds and bodies that nothing followed.
  std::vector<std::string> warnings() const { return report_.warnings; }
  /// What the file says of its boundary and the run took over.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// Everything that --report writes, as JSON; measures the quality the first time.
  std::string report();

 private:
  void warn();

  MeshPointer source_, result_;
  app::ZoneRun zone_;
  app::RunReport report_;
  std::vector<std::string> remarks_;
  std::mutex measuring_;  // guards the zone in report()
  bool measured_ = false;
};

/// Adds the class and the functions: smooth, move, deform, layers, scramble, replay.
void bind_commands(pybind11::module_& module);

}  // namespace winslow::python
