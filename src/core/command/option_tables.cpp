#include "core/command/option_tables.h"

#include "core/layers/layer_plan.h"
#include "core/motion/motion.h"

namespace winslow {

OptionTable option_table(QualityFloor& floor) {
  OptionTable rows;
  for (std::size_t m = 0; m < floor.limits.size(); ++m) {
    const Metric metric = limited_metrics()[m];
    const bool plane = m < rating_metrics(2).size();
    const FieldInfo& info = metric_info(metric, plane ? 2 : 3).field;
    // The command line has one flag for all of them: --min-quality METRIC=VALUE.
    rows.push_back({.key = info.name,
                    .value = OptionalRealOption{&floor.limits[m]},
                    .label = info.label,
                    .help = info.larger_is_better
                                ? "The motion ends before this is less for any element"
                                : "The motion ends before this is more for any element",
                    .unit = info.unit,
                    .object = "min_quality",
                    .applies = floor.limits[m].has_value(),
                    .on_command_line = OnCommandLine::no});
  }
  return rows;
}

OptionTable option_table(MotionOptions& how) {
  OptionTable rows{
      {.key = "increments",
       .value = IntegerOption{&how.increments, between(0, 1000000)},
       .label = "Steps",
       .help =
           "Steps in which the boundary moves, each followed by smoothing; 0: along the path of "
           "valid meshes, in steps as long as they can be (fixed point: at once and, if that ends "
           "tangled, in 8 and then in 32 steps); 1: at once, as in the paper"},
      {.key = "smooth_after",
       .value = SwitchOption{&how.smooth_after, "no-smooth", "Move the boundary only"},
       .label = "Smooth afterwards",
       .help = "Smooth the interior after the boundary has moved"},
  };
  return joined(std::move(rows), option_table(how.floor));
}

OptionTable option_table(SmoothCommand&) { return {}; }

OptionTable option_table(MoveCommand& command) {
  OptionTable motion;
  if (command.bodies.size() == 1) motion = option_table(command.bodies.front().motion);
  return joined(std::move(motion), option_table(command.how));
}

OptionTable option_table(DeformCommand& command) { return option_table(command.how); }

OptionTable option_table(ScrambleCommand& command) {
  return {{.key = "seed",
           .value = SeedOption{&command.seed},
           .label = "Seed",
           .help = "Seed of the random numbers: another seed, other random places"}};
}

OptionTable option_table(EditVcvCommand&) { return {}; }

OptionTable option_table(LayersCommand& command) {
  OptionTable own{
      {.key = "task",
       .value = ChoiceOption(
           command.task,
           {{"insert", "Insert", "new layers: the one command that changes the connectivity"},
            {"respace", "Space anew", "the layers that the mesh has get other heights"},
            {"hold", "Hold", "the layers that the mesh has keep their heights from here on"}}),
       .label = "Task",
       .help = "What is done about layers",
       .on_command_line = OnCommandLine::no},
      {.key = "control",
       .value = SwitchOption{&command.control, "no-control",
                             "Smooth the new connectivity as it is, without holding heights"},
       .label = "Hold the spacing",
       .help =
           "Ask for the heights through the virtual control volumes; off: smoothing spreads the "
           "layers as it likes",
       .applies = command.task == LayerTask::insert},
      {.key = "height_tolerance",
       .value = RealOption{&command.tolerance, above(0)},
       .label = "Height tolerance",
       .help = "Relative error of a height above which the VCVs are corrected",
       .applies = command.control},
      {.key = "most_corrections",
       .value = IntegerOption{&command.most_corrections, at_least(0)},
       .label = "Corrections",
       .help = "Limit of smoothing runs after the first that correct heights",
       .applies = command.control},
  };
  OptionTable corners = option_table(command.layers);
  for (Option& option : corners) {
    // Existing layers keep their columns.
    if (option.key.starts_with("fan"))
      option.applies = option.applies && command.task == LayerTask::insert;
  }
  return joined(std::move(own), std::move(corners));
}

}  // namespace winslow
