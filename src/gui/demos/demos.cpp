#include <algorithm>
#include <utility>

#include "gui/demos/demo.h"
#include "gui/demos/volume_demos.h"

namespace winslow::gui {

namespace {

const MotionOptions boundary_alone{0, false};

MoveCommand move(const char* marker, const RigidMotion& motion, const MotionOptions& how = {}) {
  return {{marker}, motion, how, {}};
}

DeformCommand wave(const char* marker, double amplitude, double waves,
                   const MotionOptions& how = {}) {
  SineDeformation sine;
  sine.amplitude = amplitude;
  sine.waves = waves;
  return {{marker}, sine, how, {}};
}

Demo case_a() {
  const RigidMotion motion{-90, Vec2(0.5, 0), Vec2(2, -2)};
  const std::array<double, 4> view{-1.0, -4.0, 4.0, 1.5};
  return {
      "A",
      "Rotated by 90 degrees, moved down and aft",
      "naca0012.su2",
      {{"The mesh",
        "Triangles around a NACA 0012, the far field 100 chords away. The colours "
        "show the smallest sine of each element's angles: 0.87 is an equilateral "
        "triangle, 0 has no area.",
        {"airfoil"},
        {},
        false,
        view},
       {"The boundary alone",
        "The aerofoil is turned by 90 degrees and moved by two chords; the interior stays where "
        "it was. Red elements are inverted: this is what the smoothing of the paper is given.",
        {"airfoil"},
        move("airfoil", motion, boundary_alone),
        true,
        view},
       {"The mesh follows",
        "The same motion, smoothed on virtual control volumes. No element is inverted, and the "
        "mesh around the aerofoil is about as good as it was. The plot shows each iteration.",
        {"airfoil"},
        move("airfoil", motion),
        true,
        view}}};
}

Demo case_b() {
  const RigidMotion motion{178, Vec2(0.5, 0), Vec2(0, 0)};
  const std::array<double, 4> view{-1.0, -1.3, 2.0, 1.3};
  return {"B",
          "Rotated by 178 degrees in place",
          "naca0012.su2",
          {{"The mesh",
            "The same mesh. Now the aerofoil is turned almost once about, the far field "
            "held: each ring of elements has to take its share of the shear.",
            {"airfoil"},
            {},
            false,
            view},
           {"Half a turn",
            "The rotation is followed as a rotation, through valid meshes only. Look at the rings: "
            "they wind around the aerofoil, and still no angle comes near zero.",
            {"airfoil"},
            move("airfoil", motion),
            false,
            view}}};
}

Demo case_c() {
  const std::array<double, 4> view{-0.2, -0.55, 1.25, 0.55};
  return {"C",
          "Interior scrambled, then smoothed",
          "three_element.su2",
          {{"The mesh", "Triangles around a slat, a main element and a flap.", {}, {}, false, view},
           {"Scrambled",
            "Every interior node is put at a random place. Nothing is left of the mesh but its "
            "connections.",
            {},
            ScrambleCommand{1},
            false,
            view},
           {"Smoothed back",
            "The connections are enough: smoothing untangles the mesh and ends at the same mesh, "
            "whatever the scramble was.",
            {},
            SmoothCommand{},
            false,
            view,
            true}}};
}

Demo case_d() {
  const RigidMotion motion{-40, Vec2(0.848, -0.036), Vec2(0, 0)};
  const std::array<double, 4> view{0.65, -0.35, 1.15, 0.1};
  return {"D",
          "Flap rotated by 40 degrees down",
          "three_element.su2",
          {{"The flap",
            "The gap between main element and flap is a fiftieth of a chord wide, a few "
            "elements across.",
            {"flap"},
            {},
            false,
            view},
           {"Turned about its hinge",
            "The flap turns by 40 degrees about a hinge in its nose. Look at the gap and at the "
            "trailing edge of the main element, where the shear is strongest. The paper's smallest "
            "sine there is 0.04.",
            {"flap"},
            move("flap", motion),
            false,
            view}}};
}

LayersCommand layers(const std::vector<std::string>& markers, int count, double first,
                     bool control) {
  LayersCommand command;
  LayerWall wall{markers, {}};
  wall.spacing.count = count;
  wall.spacing.first = first;
  command.layers.walls = {wall};
  command.control = control;
  return command;
}

Demo case_e() {
  const std::array<double, 4> view{-2.05, -1.55, 2.05, 1.55};
  const std::array<double, 4> near{-1.5, -0.7, 0.1, 0.7};
  return {
      "E",
      "Layers of quadrilaterals, pure smoothing",
      "quads.su2",
      {{"The mesh",
        "Quadrilaterals in a box around a circle and an ellipse. Five rings of them were inserted "
        "along every boundary: they are thin, and crowd at the walls.",
        {},
        {},
        false,
        view},
       {"The rings",
        "Each ring is as high as it was made, whatever lies beside it.",
        {},
        {},
        false,
        near},
       {"Smoothed",
        "No spacing is asked for, every element is to be square: smoothing spreads the rings as "
        "evenly as it can.",
        {},
        SmoothCommand{},
        false,
        near,
        true},
       {"The whole mesh",
        "Compare it with the first step: Shift+G shows both.",
        {},
        {},
        false,
        view}}};
}

Demo case_f() {
  const std::array<double, 4> whole{-0.9, -0.75, 0.9, 0.75};
  const std::array<double, 4> near{0.28, 0.28, 0.5, 0.5};
  return {
      "F",
      "Viscous layers at a circle, their spacing held",
      "circle.su2",
      {{"The mesh", "Triangles between two circles.", {"circle"}, {}, false, whole},
       {"Fifteen layers",
        "Fifteen layers of quadrilaterals are inserted at the circle: the first 0.001 high, "
        "each higher than the last by a ratio that begins with 1.15 and grows by 1.01. The "
        "triangles make room.",
        {"circle"},
        layers({"circle"}, 15, 0.001, true),
        false,
        near},
       {"From afar",
        "The virtual control volumes of the layers ask for exactly these heights, and hold them "
        "whatever moves. The panel \"Layers\" plots the heights wanted and realised.",
        {"circle"},
        {},
        false,
        whole}}};
}

Demo case_g() {
  const std::array<double, 4> view{-0.2, -0.55, 1.25, 0.55};
  return {"G",
          "Main element deformed by a sine",
          "three_element.su2",
          {{"The main element", "Bodies need not be rigid.", {"main"}, {}, false, view},
           {"The boundary alone",
            "Four waves of a sine bend the main element; the interior stays where it was. Red "
            "elements are inverted.",
            {"main"},
            wave("main", -0.04, 4, boundary_alone),
            true,
            view},
           {"The mesh follows",
            "The same deformation, smoothed. Slat and flap stay in place, and the gaps stay open.",
            {"main"},
            wave("main", -0.04, 4),
            true,
            view}}};
}

}  // namespace

const std::vector<Demo>& demos() {
  static const std::vector<Demo> all = [] {
    std::vector<Demo> demos{case_a(), case_b(), case_c(), case_d(), case_e(), case_f(), case_g()};
    for (Demo& demo : volume_demos()) demos.push_back(std::move(demo));
    return demos;
  }();
  return all;
}

const Demo* find_demo(const std::string& id) {
  const auto it =
      std::find_if(demos().begin(), demos().end(), [&](const Demo& demo) { return demo.id == id; });
  return it == demos().end() ? nullptr : &*it;
}

}  // namespace winslow::gui
