#include "gui/demos/volume_demos.h"

#include <utility>

namespace winslow::gui {

namespace {

CutPlane cut(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
  return {point, normal, true};
}

MoveCommand move(const char* marker, const SpaceMotion& motion, const MotionOptions& how = {}) {
  return {{marker}, motion, how, {}};
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
  SpaceMotion motion;
  motion.rotate = 60;
  motion.axis = Vec3(0, 1, 0);
  motion.translate = Vec3(1, 0, 0.5);
  DemoStep alone = seen("The boundary alone",
                        "The cube is turned by 60 degrees about the y axis and moved; the interior "
                        "stays where it was. Red elements are inverted.",
                        view, {"cube"});
  alone.command = move("cube", motion, unsmoothed);
  alone.afresh = true;
  DemoStep follows = seen("The mesh follows",
                          "The same motion, smoothed, through valid meshes only. Shift+G shows the "
                          "mesh as opened beside it.",
                          view, {"cube"});
  follows.command = move("cube", motion);
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
  SpaceMotion motion;
  motion.rotate = -15;
  motion.axis = Vec3(0.2755, 0.018, 1.5);
  motion.pivot = Vec3(0.848, -0.036, 0);
  DemoStep turned = seen("Turned about its hinge line",
                         "The flap turns by 15 degrees down about its hinge, which is swept as the "
                         "wing is. The mesh in the gap follows.",
                         whole, {"flap"});
  turned.command = move("flap", motion);
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
