#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

/// A command that looks from a direction.
UserCommand look_from(const char* name, int key_code, const char* label) {
  return {.id = std::string("look_from/") + name,
          .label = label,
          .group = CommandGroup::view,
          .keys = {key(key_code)},
          .tooltip = "Look at what is in the middle of the view from there.",
          .words = "camera direction axis view orbit",
          .blocked = without_mesh,
          .run = [name](const PanelContext& c) { c.emit(action::LookFrom{name}); }};
}

/// A command that turns a part of how space is seen on and off.
UserCommand space_toggle(bool SpaceOptions::*part, UserCommand command) {
  command.group = CommandGroup::view;
  command.blocked = without_mesh;
  command.checked = [part](const PanelContext& c) { return c.view.space.*part; };
  command.run = [part](const PanelContext& c) {
    c.edit_view([part](ViewOptions& view) { view.space.*part = !(view.space.*part); });
  };
  return command;
}

UserCommand add_cut() {
  return {.id = "add_cut",
          .label = "Add a cut",
          .group = CommandGroup::view,
          .keys = {key(GLFW_KEY_C)},
          .tooltip =
              "Cut the mesh through what is in the middle of the view; what lies towards you "
              "is taken away. Its handle moves and turns it.",
          .words = "slice section plane inside clip",
          .blocked = [](const PanelContext& c) -> std::string {
            if (std::string reason = without_mesh(c); !reason.empty()) return reason;
            return c.view.space.cuts.size() < most_cuts ? "" : "There are six cuts already.";
          },
          .run = [](const PanelContext& c) { c.emit(action::AddCutAcrossView{}); }};
}

UserCommand remove_cuts() {
  return {.id = "remove_cuts",
          .label = "Take all cuts away",
          .group = CommandGroup::view,
          .keys = {shift(key(GLFW_KEY_C))},
          .tooltip = "The mesh is whole again.",
          .words = "slice section plane inside clip",
          .blocked = [](const PanelContext& c) -> std::string {
            if (std::string reason = without_mesh(c); !reason.empty()) return reason;
            return c.view.space.cuts.empty() ? "There are no cuts." : "";
          },
          .run =
              [](const PanelContext& c) {
                c.emit(action::HoldCut{});
                c.edit_view([](ViewOptions& view) { view.space.cuts.clear(); });
              }};
}

}  // namespace

std::vector<UserCommand> space_commands() {
  std::vector<UserCommand> all{
      look_from("+x", GLFW_KEY_1, "Look from +x"),     look_from("-x", GLFW_KEY_2, "Look from -x"),
      look_from("+y", GLFW_KEY_3, "Look from +y"),     look_from("-y", GLFW_KEY_4, "Look from -y"),
      look_from("+z", GLFW_KEY_5, "Look from +z"),     look_from("-z", GLFW_KEY_6, "Look from -z"),
      look_from("iso", GLFW_KEY_7, "Look from aslant")};
  all.front().starts_section = true;
  all.push_back(space_toggle(&SpaceOptions::perspective,
                             {.id = "perspective",
                              .label = "Perspective",
                              .keys = {key(GLFW_KEY_P)},
                              .tooltip = "What is nearer is larger; or all is seen parallel.",
                              .words = "orthographic parallel projection camera"}));
  all.push_back(space_toggle(&SpaceOptions::axes, {.id = "axes",
                                                   .label = "Axes",
                                                   .tooltip = "Where the axes point, in a corner.",
                                                   .words = "triad"}));
  all.push_back(space_toggle(
      &SpaceOptions::free_orbit,
      {.id = "free_orbit",
       .label = "Turn freely",
       .keys = {key(GLFW_KEY_T)},
       .tooltip = "The mouse turns the view about any axis; else as on a turntable, on which the "
                  "upright axis stays upright.",
       .words = "orbit trackball tumble rotate turntable"}));
  all.push_back(add_cut());
  all.push_back(remove_cuts());
  all.push_back(space_toggle(&SpaceOptions::crinkle,
                             {.id = "crinkle",
                              .label = "Cuts leave whole elements",
                              .keys = {key(GLFW_KEY_K)},
                              .tooltip = "Those of which some part lies behind every cut.",
                              .words = "crinkled slice section"}));
  all.push_back(space_toggle(
      &SpaceOptions::worst,
      {.id = "worst_through",
       .label = "Worst elements through the mesh",
       .tooltip = "Draw the elements of the list of worst ones through what hides them.",
       .words = "bad quality"}));
  for (UserCommand& command : all) {
    const bool cuts =
        command.id == "add_cut" || command.id == "remove_cuts" || command.id == "crinkle";
    command.serves = cuts ? volume_meshes : meshes_in_space;
  }
  return all;
}

}  // namespace winslow::gui
