#include "core/motion/motion_options.h"

namespace winslow {

OptionTable option_table(RigidMotionRequest& motion) {
  return {
      {.key = "rotate",
       .value = RealOption{&motion.rotate},
       .label = "Rotate",
       .help = "Angle about the pivot, counter-clockwise positive; in space about the axis",
       .unit = "degrees"},
      {.key = "axis",
       .value = SpaceVectorOption{&motion.axis},
       .label = "Axis",
       .help = "Direction of the axis through the pivot, for volume meshes: the rotation is "
               "counter-clockwise seen from where it points to",
       .applies = motion.axis.has_value()},
      {.key = "pivot",
       .value = OptionalVectorOption{&motion.pivot, &motion.pivot_z},
       .label = "Pivot",
       .help = "Point about which it turns; not given: the centre of the bounding box of all that "
               "moves",
       .unit = "units of the mesh",
       .applies = motion.pivot.has_value()},
      {.key = "translate",
       .value = VectorOption{&motion.translate, &motion.translate_z},
       .label = "Translate",
       .help = "Shift, after the rotation",
       .unit = "units of the mesh"},
  };
}

OptionTable option_table(SineDeformation& sine) {
  return {
      {.key = "amplitude",
       .value = RealOption{&sine.amplitude},
       .label = "Amplitude",
       .help = "Largest displacement",
       .unit = "units of the mesh",
       .required = true,
       .on_command_line = OnCommandLine::no},
      {.key = "waves",
       .value = RealOption{&sine.waves},
       .label = "Waves",
       .help = "Full periods over the length of the body",
       .required = true,
       .on_command_line = OnCommandLine::no},
      {.key = "direction",
       .value = VectorOption{&sine.direction, &sine.direction_z},
       .label = "Direction",
       .help = "Direction of the displacement; its length does not matter"},
      {.key = "along",
       .value = SpaceVectorOption{&sine.along},
       .label = "Along",
       .help = "Way in which the wave runs over the body, for volume meshes; not given: at right "
               "angles to the direction and to the z axis",
       .applies = sine.along.has_value()},
      {.key = "fade",
       .value = ChoiceOption(sine.fade, {{"none", "Nowhere"},
                                         {"start", "At the start"},
                                         {"end", "At the end"},
                                         {"both", "At both ends"}}),
       .label = "Fade",
       .help = "Ends of the body at which the wave fades to zero"},
      {.key = "fade_length",
       .value = RealOption{&sine.fade_length, {.low = 0, .high = 0.5, .low_included = false}},
       .label = "Fade length",
       .help = "Share of the body's length over which it fades",
       .applies = sine.fade != Fade::none},
  };
}

}  // namespace winslow
