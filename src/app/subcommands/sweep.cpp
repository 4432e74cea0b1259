#include "app/job/sweep_job.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"
#include "core/error.h"

namespace winslow::app {
namespace {

constexpr std::size_t most_steps = 100000;

double number_in(const std::string& word, const std::string& where) {
  double number = 0;
  if (word.empty() || !CLI::detail::lexical_cast(word, number) || !std::isfinite(number))
    throw UsageError(where + ": found \"" + word +
                     "\", expected a number, FROM:TO:STEP, or several with commas between them");
  return number;
}

/// FROM, FROM + STEP, ... up to TO, rounded to twelve digits so that names of files are short.
void add_range(const std::vector<std::string>& words, const std::string& where,
               std::vector<double>& numbers) {
  const double from = number_in(words[0], where), to = number_in(words[1], where),
               step = number_in(words[2], where);
  const double count = (to - from) / step;
  constexpr double rounding = 1e-9;
  if (step == 0 || count < -rounding)
    throw UsageError(where + ": found the step " + words[2] + ", which does not lead from " +
                     words[0] + " to " + words[1] + ": expected one of the other sign");
  if (!(count < static_cast<double>(most_steps)))
    throw UsageError(where + ": found a range of more than " + std::to_string(most_steps) +
                     " numbers, expected a longer step");
  const auto last = static_cast<int>(std::floor(count + rounding));
  for (int k = 0; k <= last; ++k) {
    const double number = std::stod(formatted("%.12g", from + k * step));
    numbers.push_back(number == 0 ? 0 : number);  // no -0
  }
}

/// The numbers of "-30:10:2", of "0,5,15" and of "-30:-10:5,0".
std::vector<double> numbers_of(const std::string& text, const std::string& where) {
  std::vector<double> numbers;
  for (const std::string& item : split(text, ',')) {
    const std::vector<std::string> words = split(item, ':');
    if (words.size() == 3)
      add_range(words, where, numbers);
    else
      numbers.push_back(number_in(item, where));
  }
  return numbers;
}

/// One body by --marker and ranges of its motion, or a table of motions.
class SweepSubcommand : public Subcommand {
 public:
  explicit SweepSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "sweep",
            "Move bodies to many places, each from the mesh as given, and write a mesh for each")) {
    add_input(app(), job_.files.input);
    add_marker_flag(app(), body_.markers)
        ->required(false)
        ->description(
            "Marker that moves; several move together. With --table: of rows without a marker");
    add_motion_flags();
    job_.smooth = independent_of_start(job_.smooth);  // as run_series() does; for the help
    add_smooth_flags(app(), job_.smooth);
    add_reading_flags(app(), job_.files.reading, "the one that has the markers that move");
    add_config_flag(app(), job_.files.config);
    add_output_flags();
  }

  ExitCode run() override {
    job_.steps = table_->count() > 0 ? steps_of_table() : steps_of_ranges();
    return run_sweep_job(job_);
  }

 private:
  void add_motion_flags() {
    FlagGroup motion(app(), "Motion");
    motion.value("--rotate", rotate_, "LIST",
                 "Angles about the pivot, degrees, counter-clockwise positive; in space about the "
                 "axis: FROM:TO:STEP, or numbers with commas between them: -30:10:2, 0,5,15");
    app()
        .add_option("--translate", translate_,
                    "Shifts after the rotation, units of the mesh, each of them a list as of "
                    "--rotate. All combinations are steps")
        ->expected(2, 3)
        ->option_text("LIST LIST [LIST]")
        ->group("Motion");
    OptionTable rest = option_table(body_.motion);
    std::erase_if(rest, [](const Option& option) {
      return option.key == "rotate" || option.key == "translate";
    });
    add_option_flags(app(), rest, "Motion");
    table_ =
        motion.value("--table", job_.table, "FILE.csv",
                     "Motions in place of --rotate and --translate: CSV with the columns step, "
                     "marker, rotate, pivot_x, pivot_y, pivot_z, axis_x, ..., translate_x, "
                     "..., the names in the first line; rows of one step move together");
    add_option_flags(app(), option_table(job_.how), "Motion");
    add_direct_flag(app(), job_.how);
    add_min_quality_flag(app(), job_.how.floor);
    add_hold_layers_flag(app(), job_.held);
    add_reference_mesh_flag(app(), job_.files);
  }

  void add_output_flags() {
    FlagGroup group(app(), "Output");
    group.value("-o,--output", job_.files.output, "OUT",
                "Meshes to write: a name in which {step}, {rotate}, {translate_x}, {translate_y} "
                "and {translate_z} stand for those of each step, such as 'out/flap_{rotate}.su2'. "
                "Folders are made");
    group.value("--results", job_.results, "FILE.csv",
                "Write a row for each step: motion, file, status, quality, solves, time");
    group
        .value_as("--jobs", job_.jobs, "N [1]",
                  "Steps to carry out at once, each on one thread; 0 for all cores. With 1 a step "
                  "uses --threads")
        ->check(CLI::Range(0, 4096));
    group.on("--allow-inverted", job_.files.allow_inverted,
             "Write meshes with inverted elements, too (the exit status is still 4)");
    group.on("--accept-partial", job_.files.accept_partial,
             "Write the last valid mesh of a motion that could not be completed (the exit status "
             "is still 4)");
    add_encoding_flags(app(), job_.files.encoding);
    add_quiet_flag(app(), job_.files.quiet);
  }

  std::vector<io::MotionStep> steps_of_table() {
    for (const char* flag : {"--rotate", "--translate"})
      if (app().count(flag) > 0)
        throw UsageError(std::string("found --table together with ") + flag +
                         ": expected the motions in the table alone");
    return io::read_motions(job_.table, body_);
  }

  /// All combinations, those of the rotation next to each other.
  std::vector<io::MotionStep> steps_of_ranges() {
    if (rotate_.empty() && translate_.empty())
      throw UsageError(
          "nothing to do: give --rotate FROM:TO:STEP, --translate, or motions by --table FILE.csv");
    if (body_.markers.empty())
      throw UsageError("nothing to move: name it by --marker NAME, or motions by --table FILE.csv");
    const std::vector<double> angles =
        rotate_.empty() ? std::vector<double>{0} : numbers_of(rotate_, "--rotate");
    std::array<std::vector<double>, 3> shifts{{{0}, {0}, {0}}};
    for (std::size_t k = 0; k < translate_.size(); ++k)
      shifts[k] = numbers_of(translate_[k], "--translate");
    const std::size_t count =
        angles.size() * shifts[0].size() * shifts[1].size() * shifts[2].size();
    if (count > most_steps)
      throw UsageError("found " + std::to_string(count) + " steps, expected at most " +
                       std::to_string(most_steps));
    std::vector<io::MotionStep> steps;
    for (const double z : shifts[2])
      for (const double y : shifts[1])
        for (const double x : shifts[0])
          for (const double angle : angles) {
            MovingBody body = body_;
            body.motion.rotate = angle;
            if (!translate_.empty())
              body.motion.translate =
                  GivenVector::of(static_cast<int>(translate_.size()), Vec3(x, y, z));
            steps.push_back({numbered(steps.size() + 1, count), {std::move(body)}});
          }
    return steps;
  }

  /// As many digits as the last number has: files are then listed in order.
  static std::string numbered(std::size_t number, std::size_t count) {
    std::string text = std::to_string(number);
    return text.insert(0, std::to_string(count).size() - text.size(), '0');
  }

  SweepJob job_;
  MovingBody body_;
  std::string rotate_;
  std::vector<std::string> translate_;
  CLI::Option* table_ = nullptr;
};

}  // namespace

std::unique_ptr<Subcommand> make_sweep_subcommand(CLI::App& program) {
  return std::make_unique<SweepSubcommand>(program);
}

}  // namespace winslow::app
