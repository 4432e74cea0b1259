#pragma once

#include <pybind11/stl.h>

#include "app/job/edit_job.h"
#include "core/error.h"
#include "python/mesh_value.h"

/// Arguments of functions that come as a dict of keywords.
namespace winslow::python {

/// Takes a keyword out of a dict; None if it is not there.
inline pybind11::object taken(pybind11::dict& keywords, const char* name) {
  return keywords.contains(name) ? keywords.attr("pop")(name).cast<pybind11::object>()
                                 : pybind11::object(pybind11::none());
}

/// Takes a value out of a dict, if it is there and not None. Throws UsageError for one of another
/// type: "size: found ..., expected ...".
template <class Value>
void take(pybind11::dict& keywords, const char* name, Value& to, const char* expected) {
  const pybind11::object given = taken(keywords, name);
  if (given.is_none()) return;
  try {
    to = given.cast<Value>();
  } catch (const pybind11::cast_error&) {
    throw UsageError(std::string(name) + ": found " + pybind11::repr(given).cast<std::string>() +
                     ", expected " + expected);
  }
}

/// What every function that moves or smooths takes besides its command.
struct RunArguments {
  MeshPointer reference;        ///< whose shapes motions keep; null: the mesh itself
  std::string config;           ///< configuration of SU2 for the mesh; empty: none
  bool accept_partial = false;  ///< go as far as possible
  pybind11::object progress = pybind11::none();
};
/// Takes them out of the keywords, of a motion all of them, else config and progress. Throws
/// UsageError for a callback that cannot be called.
RunArguments run_arguments(pybind11::dict& keywords, bool motion);

/// Names of the keywords that run_arguments() takes, and of a table.
std::vector<std::string> known_keywords(const OptionTable& table,
                                        std::initializer_list<const char*> more = {});

/// Bodies from a list of {"markers": ..., "rotate": ..., ...}. Throws UsageError.
std::vector<MovingBody> bodies_of(const pybind11::handle& given);

/// A sine wave from {"amplitude": ..., "waves": ..., ...}. Throws UsageError.
SineDeformation sine_of(const pybind11::object& given);

/// The options of a motion, but for the limits of the quality.
OptionTable motion_table(MotionOptions& how);
/// Takes what all motions have: min_quality, the options of motion and smoothing, and those of
/// `more`; refuses other keywords.
void set_motion(MotionOptions& how, SmoothOptions& smooth, const OptionTable& more,
                pybind11::dict& keywords);

/// A zone of a job: a mesh with one command or more, whose names are checked, with what the file
/// says of its boundary and the files that the commands need. remarks: what was taken over.
app::ZoneRun prepared_zone(const MeshValue& mesh, std::vector<Command> commands,
                           const RunArguments& arguments, std::vector<std::string>& remarks);

}  // namespace winslow::python
