#include "gui/demos/demo.h"

namespace winslow::gui {

namespace {

const MotionOptions boundary_alone{0, false};

using Markers = std::vector<std::string>;
using Area = std::array<double, 4>;

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

LayersCommand layers(const Markers& markers, int count, double first, bool control) {
  LayersCommand command;
  LayerWall wall{markers, {}};
  wall.spacing.count = count;
  wall.spacing.first = first;
  command.layers.walls = {wall};
  command.control = control;
  return command;
}

/// A step that sets the view: of an area in the plane, or of a place in space.
DemoStep seen(const char* title, const char* text, const Area& view, const Markers& select = {}) {
  return {.title = title, .text = text, .select = select, .view = view};
}
DemoStep seen(const char* title, const char* text, const SpaceLook& view,
              const Markers& select = {}) {
  return {.title = title, .text = text, .select = select, .space = view};
}

/// Adds the command of a step: on the present mesh, or on the mesh as opened.
DemoStep with(DemoStep step, Command command) {
  step.command = std::move(command);
  return step;
}
DemoStep afresh(DemoStep step, Command command) {
  step.afresh = true;
  return with(std::move(step), std::move(command));
}

/// A step that smooths towards regular elements.
DemoStep smoothed(DemoStep step) {
  step.regular = true;
  return with(std::move(step), SmoothCommand{});
}

DemoStep over_angles(const char* title, const char* text, VcvKind kind, const SpaceLook& view) {
  DemoStep step = afresh(seen(title, text, view), SmoothCommand{});
  step.pointwise_over = kind;
  return step;
}

Demo case_a() {
  const RigidMotion motion{-90, Vec2(0.5, 0), Vec2(2, -2)};
  const Area view{-1.0, -4.0, 4.0, 1.5};
  return {"A",
          "Rotated by 90 degrees, moved down and aft",
          "naca0012.su2",
          {seen("The mesh",
                "Triangles around a NACA 0012, the far field 100 chords away. The colours show the "
                "smallest sine of each element's angles: 0.87 is an equilateral triangle, 0 has no "
                "area.",
                view, {"airfoil"}),
           afresh(seen("The boundary alone",
                       "The aerofoil is turned by 90 degrees and moved by two chords; the interior "
                       "stays where it was. Red elements are inverted: this is what the smoothing "
                       "of the paper is given.",
                       view, {"airfoil"}),
                  move("airfoil", motion, boundary_alone)),
           afresh(seen("The mesh follows",
                       "The same motion, smoothed on virtual control volumes. No element is "
                       "inverted, and the mesh around the aerofoil is about as good as it was. The "
                       "plot shows each iteration.",
                       view, {"airfoil"}),
                  move("airfoil", motion))}};
}

Demo case_b() {
  const RigidMotion motion{178, Vec2(0.5, 0), Vec2(0, 0)};
  const Area view{-1.0, -1.3, 2.0, 1.3};
  return {
      "B",
      "Rotated by 178 degrees in place",
      "naca0012.su2",
      {seen("The mesh",
            "The same mesh. Now the aerofoil is turned almost once about, the far field held: each "
            "ring of elements has to take its share of the shear.",
            view, {"airfoil"}),
       with(seen("Half a turn",
                 "The rotation is followed as a rotation, through valid meshes only. Look at the "
                 "rings: they wind around the aerofoil, and still no angle comes near zero.",
                 view, {"airfoil"}),
            move("airfoil", motion))}};
}

Demo case_c() {
  const Area view{-0.2, -0.55, 1.25, 0.55};
  return {"C",
          "Interior scrambled, then smoothed",
          "three_element.su2",
          {seen("The mesh", "Triangles around a slat, a main element and a flap.", view),
           with(seen("Scrambled",
                     "Every interior node is put at a random place. Nothing is left of the mesh "
                     "but its connections.",
                     view),
                ScrambleCommand{1}),
           smoothed(seen("Smoothed back",
                         "The connections are enough: smoothing untangles the mesh and ends at the "
                         "same mesh, whatever the scramble was.",
                         view))}};
}

Demo case_d() {
  const RigidMotion motion{-40, Vec2(0.848, -0.036), Vec2(0, 0)};
  const Area view{0.65, -0.35, 1.15, 0.1};
  return {"D",
          "Flap rotated by 40 degrees down",
          "three_element.su2",
          {seen("The flap",
                "The gap between main element and flap is a fiftieth of a chord wide, a few "
                "elements across.",
                view, {"flap"}),
           with(seen("Turned about its hinge",
                     "The flap turns by 40 degrees about a hinge in its nose. Look at the gap and "
                     "at the trailing edge of the main element, where the shear is strongest. The "
                     "paper's smallest sine there is 0.04.",
                     view, {"flap"}),
                move("flap", motion))}};
}

Demo case_e() {
  const Area view{-2.05, -1.55, 2.05, 1.55}, near{-1.5, -0.7, 0.1, 0.7};
  return {"E",
          "Layers of quadrilaterals, pure smoothing",
          "quads.su2",
          {seen("The mesh",
                "Quadrilaterals in a box around a circle and an ellipse. Five rings of them were "
                "inserted along every boundary: they are thin, and crowd at the walls.",
                view),
           seen("The rings", "Each ring is as high as it was made, whatever lies beside it.", near),
           smoothed(seen("Smoothed",
                         "No spacing is asked for, every element is to be square: smoothing "
                         "spreads the rings as evenly as it can.",
                         near)),
           seen("The whole mesh", "Compare it with the first step: Shift+G shows both.", view)}};
}

Demo case_f() {
  const Area whole{-0.9, -0.75, 0.9, 0.75}, near{0.28, 0.28, 0.5, 0.5};
  return {"F",
          "Viscous layers at a circle, their spacing held",
          "circle.su2",
          {seen("The mesh", "Triangles between two circles.", whole, {"circle"}),
           with(seen("Fifteen layers",
                     "Fifteen layers of quadrilaterals are inserted at the circle: the first 0.001 "
                     "high, each higher than the last by a ratio that begins with 1.15 and grows "
                     "by 1.01. The triangles make room.",
                     near, {"circle"}),
                layers({"circle"}, 15, 0.001, true)),
           seen("From afar",
                "The virtual control volumes of the layers ask for exactly these heights, and hold "
                "them whatever moves. The panel \"Layers\" plots the heights wanted and realised.",
                whole, {"circle"})}};
}

Demo case_g() {
  const Area view{-0.2, -0.55, 1.25, 0.55};
  return {"G",
          "Main element deformed by a sine",
          "three_element.su2",
          {seen("The main element", "Bodies need not be rigid.", view, {"main"}),
           afresh(seen("The boundary alone",
                       "Four waves of a sine bend the main element; the interior stays where it "
                       "was. Red elements are inverted.",
                       view, {"main"}),
                  wave("main", -0.04, 4, boundary_alone)),
           afresh(seen("The mesh follows",
                       "The same deformation, smoothed. Slat and flap stay in place, and the gaps "
                       "stay open.",
                       view, {"main"}),
                  wave("main", -0.04, 4))}};
}

CutPlane cut(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
  return {point, normal, true};
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
  return {"I",
          "A cube turned by 60 degrees and moved",
          "cube.su2.gz",
          {seen("The mesh",
                "Tetrahedra around a cube with sharp edges, cut in the plane y = 0: drag the "
                "arrow's foot to move the cut, its ball to turn it.",
                view, {"cube"}),
           afresh(seen("The boundary alone",
                       "The cube is turned by 60 degrees about the y axis and moved; the interior "
                       "stays where it was. Red elements are inverted.",
                       view, {"cube"}),
                  move("cube", motion, boundary_alone)),
           afresh(seen("The mesh follows",
                       "The same motion, smoothed, through valid meshes only. Shift+G shows the "
                       "mesh as opened beside it.",
                       view, {"cube"}),
                  move("cube", motion))}};
}

Demo wing() {
  const SpaceLook whole{35, 20, 1, {0.5, 0, 0.35}, 0.8, {cut({0, 0, 0.5}, {0, 0, 1})}};
  const SpaceLook gap{12, 10, 1, {0.87, -0.05, 0.5}, 0.13, {cut({0, 0, 0.5}, {0, 0, 1})}};
  const RigidMotion motion{-15, Vec3(0.848, -0.036, 0), Vec3(0, 0, 0), Vec3(0.2755, 0.018, 1.5)};
  return {"J",
          "A wing's flap turned, and a cut through its gap",
          "wing.su2.gz",
          {seen("The wing",
                "A swept, tapered wing with slat, main element and flap, cut across its span.",
                whole, {"flap"}),
           seen("The gap",
                "Between main element and flap, in the plane of the cut: a few elements across.",
                gap, {"flap"}),
           with(seen("Turned about its hinge line",
                     "The flap turns by 15 degrees down about its hinge, which is swept as the "
                     "wing is. The mesh in the gap follows.",
                     whole, {"flap"}),
                move("flap", motion)),
           seen("The gap again", "It is open still, and no element in it is inverted.", gap,
                {"flap"})}};
}

}  // namespace

const std::vector<Demo>& demos() {
  static const std::vector<Demo> all{case_a(), case_b(), case_c(), case_d(), case_e(),
                                     case_f(), case_g(), sphere(), cube(),   wing()};
  return all;
}

const Demo* find_demo(const std::string& id) {
  const auto it = std::ranges::find(demos(), id, &Demo::id);
  return it == demos().end() ? nullptr : &*it;
}

}  // namespace winslow::gui
