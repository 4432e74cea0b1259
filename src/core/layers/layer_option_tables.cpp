#include "core/layers/layer_option_tables.h"

namespace winslow {

OptionTable option_table(LayerSpacing& spacing) {
  return {
      {.key = "count",
       .value = IntegerOption{&spacing.count, between(1, most_layers)},
       .label = "Count",
       .help = "Number of layers"},
      {.key = "first",
       .value = RealOption{&spacing.first, above(0)},
       .label = "First height",
       .help = "Height of the layer at the wall",
       .unit = "units of the mesh"},
      {.key = "ratio",
       .value = RealOption{&spacing.ratio, between(0.5, 10)},
       .label = "Ratio",
       .help = "Ratio of the second height to the first"},
      {.key = "growth",
       .value = RealOption{&spacing.growth, between(0.5, 2)},
       .label = "Growth",
       .help = "Factor of the ratio from layer to layer"},
      {.key = "total",
       .value = OptionalRealOption{&spacing.total, above(0)},
       .label = "Thickness",
       .help = "Thickness of all layers; gives the ratio",
       .unit = "units of the mesh"},
      {.key = "match_outside",
       .value = SwitchOption{&spacing.match_outside},
       .label = "Match the elements outside",
       .help = "As many layers as it takes until the last is as high as the elements outside"},
  };
}

OptionTable option_table(LayerOptions& options) {
  return {
      {.key = "fans",
       .value = SwitchOption{&options.fans, "no-fans",
                             "One column at sharp convex corners, too, instead of a fan"},
       .label = "Fans at sharp corners",
       .help = "Several columns at sharp convex corners, such as a trailing edge"},
      {.key = "fan_threshold",
       .value = RealOption{&options.fan_threshold, between(10, 180)},
       .label = "Fan threshold",
       .help = "Turning of the wall from which a corner gets a fan",
       .unit = "degrees",
       .applies = options.fans},
      {.key = "fan_angle",
       .value = RealOption{&options.fan_angle, between(10, 90)},
       .label = "Fan angle",
       .help = "Angle between neighbouring columns of a fan",
       .unit = "degrees",
       .applies = options.fans},
      {.key = "clearance",
       .value = RealOption{&options.clearance, inside(0, 0.5)},
       .label = "Clearance",
       .help = "Share of a gap's width that the layers of either side may take"},
      {.key = "crossing",
       .value = RealOption{&options.crossing, inside(0, 1)},
       .label = "Crossing",
       .help = "Share of a wall edge's length that has to be left of it at the rim of the layers"},
      {.key = "steepest",
       .value = RealOption{&options.steepest, {.low = 0, .high = 5, .low_included = false}},
       .label = "Steepest",
       .help = "Largest change of thickness along the wall, per length of wall"},
      {.key = "scale_all",
       .value = SwitchOption{&options.scale_all},
       .label = "Scale all heights",
       .help = "Where there is less room than asked, make all layers thinner, the first as well, "
               "instead of the outer ones"},
  };
}

}  // namespace winslow
