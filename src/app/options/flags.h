#pragma once

#include <CLI/CLI.hpp>

#include "core/command/command.h"
#include "core/layers/layer_plan.h"
#include "core/options/option.h"
#include "io/format/mesh_file.h"

namespace winslow::app {

/// "; did you mean X?" for the name in `known` that is nearest to `unknown`, "" if none is near.
std::string suggest(std::string_view unknown, const std::vector<std::string>& known);

/// "a, b, c".
std::string join(const std::vector<std::string>& names);
/// The parts of a text between separators, empty ones included.
std::vector<std::string> split(const std::string& text, char separator);

/// Accepts one of some names; the error for others lists the names and suggests the nearest.
CLI::Validator one_of(std::vector<std::string> names);
/// Accepts any text; shell completion offers these words (words_of()).
CLI::Validator words_to_offer(const std::vector<std::string>& words);
/// The words of an option's one_of() or words_to_offer(); empty if it has neither.
std::vector<std::string> words_of(CLI::Option& option);

/// Declares flags under one heading of the help.
class FlagGroup {
 public:
  explicit FlagGroup(CLI::App& app, std::string heading = "Options")
      : app_(app), heading_(std::move(heading)) {}

  /// A flag with a value. Help and messages call the type of the value `takes`.
  template <class Value>
  CLI::Option* value(const char* names, Value& to, const char* takes, const std::string& help) {
    return app_.add_option(names, to, help)->type_name(takes)->group(heading_);
  }
  /// A flag with a value, described in the help only by `takes`: "N [500]".
  template <class Value>
  CLI::Option* value_as(const char* names, Value& to, const std::string& takes,
                        const std::string& help) {
    return app_.add_option(names, to, help)->option_text(takes)->group(heading_);
  }
  CLI::Option* on(const char* name, bool& to, const std::string& help) {
    return app_.add_flag(name, to, help)->group(heading_);
  }
  /// A flag without a value that does something.
  CLI::Option* on(const char* name, std::function<void()> act, const std::string& help) {
    return app_.add_flag_callback(name, std::move(act), help)->group(heading_);
  }

 private:
  CLI::App& app_;
  std::string heading_;
};

/// The name of an output file that stands for the standard output.
inline constexpr std::string_view standard_output = "-";

/// Files and output options of a job that changes a mesh.
struct JobFiles {
  std::string input;
  io::ReadOptions reading;             ///< of the input; zone 0: all zones
  std::string config;                  ///< configuration file of SU2 for the input; empty: none
  std::string reference_mesh;          ///< whose shapes motions keep; empty: the input
  std::vector<std::string> also_read;  ///< other files that are read: a recipe, tables
  std::string output;
  std::string report;       ///< JSON; "-": to the standard output; empty: none
  std::string history;      ///< CSV; empty: none
  std::string save_recipe;  ///< JSON; empty: none
  bool allow_inverted = false;
  bool accept_partial = false;  ///< write the last valid mesh of an incomplete motion
  bool quiet = false;
  bool memory = false;  ///< say what took the memory of the run
  io::WriteOptions encoding;
};

void add_input(CLI::App& app, std::string& input);
/// Declares one input or more.
void add_inputs(CLI::App& app, std::vector<std::string>& inputs);
/// Declares --zone; `without`: text for the help on what happens without it.
void add_zone_flag(CLI::App& app, int& zone, const std::string& without);
/// Declares --zone, --time, --regions and --repair. without_zone: text for the help on what happens
/// without --zone.
void add_reading_flags(CLI::App& app, io::ReadOptions& reading, const std::string& without_zone);
/// Declares --config.
void add_config_flag(CLI::App& app, std::string& config);
/// Declares those of add_reading_flags, --config, -o, --report, --history, --memory,
/// --allow-inverted, --accept-partial, --quiet and those of add_encoding_flags.
void add_job_flags(CLI::App& app, JobFiles& files);
/// Declares --reference-mesh.
void add_reference_mesh_flag(CLI::App& app, JobFiles& files);
/// Declares --save-recipe.
void add_recipe_flag(CLI::App& app, JobFiles& files);
/// Declares --binary, --ascii, --gmsh-version, --cgns-container.
void add_encoding_flags(CLI::App& app, io::WriteOptions& encoding);
void add_quiet_flag(CLI::App& app, bool& quiet);

/// Checks an output path before a long solve. Throws UsageError if the extension of a mesh is
/// unknown, OutputError if the folder does not exist or is not writable. input: the mesh that is
/// read; empty: unknown. Accepts an empty path.
void check_mesh_output(const std::string& path, const std::string& input = {});
/// Checks the path of any other output file in the same way. Accepts standard_output.
void check_output(const std::string& path);
/// Throws UsageError for standard_output: `flag` takes the name of a file.
void check_is_file(const std::string& path, const char* flag);
/// Throws UsageError if two output files have the same path.
void check_distinct(const std::vector<std::string>& paths);
/// Throws UsageError if an output is the same file as one that is read, which it would replace.
/// Empty paths and standard_output are no files.
void check_inputs_kept(const std::vector<std::string>& outputs,
                       const std::vector<std::string>& inputs);

/// Declares a flag for each option of a table that has one; values are checked during parsing. The
/// object bound to the table must outlive the parsing.
void add_option_flags(CLI::App& app, const OptionTable& table, const std::string& group);

/// The help text right after a flag: "N [500]", "auto|on|off [auto]".
std::string flag_text(const Option& option);
/// The help text of an option, including its choices.
std::string flag_help(const Option& option);

/// Declares a flag for each option of smoothing. `options` must outlive the parsing.
void add_smooth_flags(CLI::App& app, SmoothOptions& options);

/// Declares --min-quality, which may be given several times.
void add_min_quality_flag(CLI::App& app, QualityFloor& floor);

/// Declares --direct.
void add_direct_flag(CLI::App& app, MotionOptions& options);

/// Declares --sine and the flags of its options. Returns --sine.
CLI::Option* add_sine_flags(CLI::App& app, SineDeformation& sine);

/// Declares --marker, which may be given several times.
CLI::Option* add_marker_flag(CLI::App& app, std::vector<std::string>& markers);

/// Declares --body, given once for each of the bodies that move together. Throws UsageError during
/// parsing.
void add_body_flag(CLI::App& app, std::vector<MovingBody>& bodies);
/// Reads the words after one --body: {"flap,tab", "rotate=12", "pivot=0.8,0"}. Keys are those of
/// the option table of RigidMotion. Throws UsageError.
MovingBody parse_body(const std::vector<std::string>& words);
/// Throws UsageError if a flag of a single body was given together with --body: names the flags,
/// and says what to write in their place.
void refuse_single_body_flags(const CLI::App& app);

/// Flags for the walls, heights and columns of layers.
class LayerFlags {
 public:
  /// Declares --marker, --wall, --count, --first, ... This object must outlive the parsing.
  void declare(CLI::App& app);
  /// Copies the parsed walls and overrides into the options. Throws UsageError.
  void finish(LayerOptions& options) const;

 private:
  std::vector<std::string> markers_, walls_, columns_;
  LayerSpacing spacing_;
  std::optional<double> y_plus_, reynolds_;
  double length_ = 1;
};

/// Declares --hold-layers: walls whose layers keep their heights while bodies move.
void add_hold_layers_flag(CLI::App& app, std::vector<std::string>& markers);
/// The command, preceded by one that detects and holds the layers at the named walls, if any.
std::vector<Command> holding_layers(const std::vector<std::string>& markers,
                                    const SmoothOptions& smooth, Command command);

/// "NAME[,NAME]:count=20,first=1e-5,...", missing keys as in `common`. Keys are those of
/// LayerSpacing and of WallPart. Throws UsageError.
LayerWall parse_wall(const std::string& text, const LayerSpacing& common);
/// "NODE:columns=3,thickness=0.01", either value may be missing. Throws UsageError.
ColumnOverride parse_column(const std::string& text);

}  // namespace winslow::app
