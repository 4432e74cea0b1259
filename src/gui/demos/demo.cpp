#include "gui/demos/demo.h"

namespace winslow::gui {

namespace {

const MotionOptions boundary_alone{0, false};

MoveCommand move(const char* marker, const RigidMotion& motion, const MotionOptions& how = {}) {
  return {{{{marker}, motion}}, how, {}};
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

namespace {

CutPlane cut(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
  return {point, normal, true};
}

MoveCommand moved(const char* marker, const RigidMotion& motion, const MotionOptions& how = {}) {
  return {{{{marker}, motion}}, how, {}};
}

const MotionOptions unsmoothed{0, false};

DemoStep over_angles(const char* title, const char* text, VcvKind kind, const SpaceLook& view) {
  DemoStep step{title, text};
  step.command = SmoothCommand{};
  step.afresh = true;
  step.space = view;
  step.pointwise_over = kind;
  return step;
}

DemoStep seen(const char* title, const char* text, const SpaceLook& view,
              std::vector<std::string> select = {}) {
  DemoStep step{title, text, std::move(select)};
  step.space = view;
  return step;
}

Demo sphere() {
  const SpaceLook view{-66, 22, 2, {0, 0, 0}, 3.6, {cut({0, 0, 0}, {0, -1, 0})}};
  return {"H",
          "A sphere, by three kinds of solid angles",
          "sphere.su2.gz",
          {seen("The mesh",
                "Tetrahedra around a sphere, cut through its middle. What the virtual control "
                "volumes of a node ask for is solid angles: those of the faces around it, seen "
                "from the node.",
                view),
           over_angles("Equal angles",
                       "Every face at a node is to have the same solid angle. That draws the nodes "
                       "towards the body, however fine the mesh was there, and inverts elements "
                       "(red).",
                       VcvKind::equal, view),
           over_angles("Existing angles",
                       "The angles that the mesh has as given. It stays nearly as it was, and its "
                       "long elements grow longer.",
                       VcvKind::existing, view),
           over_angles("Adjusted angles",
                       "The mean of both: the spacing of the mesh is kept, and its elements become "
                       "better. This is what the program takes unless told otherwise.",
                       VcvKind::adjusted, view)}};
}

Demo cube() {
  const SpaceLook view{-66, 22, 2, {0.3, 0, 0.2}, 3.2, {cut({0, 0, 0}, {0, -1, 0})}};
  const RigidMotion motion{60, Vec3(0, 0, 0), Vec3(1, 0, 0.5), Vec3(0, 1, 0)};
  DemoStep alone = seen("The boundary alone",
                        "The cube is turned by 60 degrees about the y axis and moved; the interior "
                        "stays where it was. Red elements are inverted.",
                        view, {"cube"});
  alone.command = moved("cube", motion, unsmoothed);
  alone.afresh = true;
  DemoStep follows = seen("The mesh follows",
                          "The same motion, smoothed, through valid meshes only. Shift+G shows the "
                          "mesh as opened beside it.",
                          view, {"cube"});
  follows.command = moved("cube", motion);
  follows.afresh = true;
  return {"I",
          "A cube turned by 60 degrees and moved",
          "cube.su2.gz",
          {seen("The mesh",
                "Tetrahedra around a cube with sharp edges, cut in the plane y = 0: drag the "
                "arrow's foot to move the cut, its ball to turn it.",
                view, {"cube"}),
           alone, follows}};
}

Demo wing() {
  const SpaceLook whole{35, 20, 1, {0.5, 0, 0.35}, 0.8, {cut({0, 0, 0.5}, {0, 0, 1})}};
  const SpaceLook gap{12, 10, 1, {0.87, -0.05, 0.5}, 0.13, {cut({0, 0, 0.5}, {0, 0, 1})}};
  const RigidMotion motion{-15, Vec3(0.848, -0.036, 0), Vec3(0, 0, 0), Vec3(0.2755, 0.018, 1.5)};
  DemoStep turned = seen("Turned about its hinge line",
                         "The flap turns by 15 degrees down about its hinge, which is swept as the "
                         "wing is. The mesh in the gap follows.",
                         whole, {"flap"});
  turned.command = moved("flap", motion);
  return {"J",
          "A wing's flap turned, and a cut through its gap",
          "wing.su2.gz",
          {seen("The wing",
                "A swept, tapered wing with slat, main element and flap, cut across its span.",
                whole, {"flap"}),
           seen("The gap",
                "Between main element and flap, in the plane of the cut: a few elements across.",
                gap, {"flap"}),
           turned,
           seen("The gap again", "It is open still, and no element in it is inverted.", gap,
                {"flap"})}};
}

}  // namespace

std::vector<Demo> volume_demos() { return {sphere(), cube(), wing()}; }

}  // namespace winslow::gui
