#pragma once

#include "gui/menu/panel_context.h"

/// The panels of the studio, for the list of them (gui/shell/workbench/panel_list.cpp), each in a
/// source of its own. Those that keep nothing from frame to frame are functions.
namespace winslow::gui {

/// The menu bar: the table of commands (gui/menu/user_command.h), a menu a group.
void draw_menu_bar(const PanelContext& context);
/// The row of buttons beneath the menu: the most frequent commands.
void draw_toolbar(const PanelContext& context);
/// One line: the mesh, its quality, what the solver does.
void draw_status(const PanelContext& context);

// The column on the left.
void draw_zone(const PanelContext& context);
DrawPanel markers_panel();
DrawPanel cuts_panel();
DrawPanel motion_panel();
DrawPanel shape_panel();
DrawPanel layers_panel();
DrawPanel solver_panel();
DrawPanel mesh_panel();
DrawPanel measures_panel();

// The column on the right.
/// The quality table as in the paper: minimum, average and maximum of each metric, before and now
/// side by side.
void draw_quality(const PanelContext& context);
/// How far a surface mesh is from what it was when it was opened, and the volume that it encloses.
/// Nothing for other meshes.
void draw_deviation(const PanelContext& context);
/// What a flow solver cares for at the walls of bodies, before and now. Nothing for a mesh without
/// walls.
void draw_walls(const PanelContext& context);
DrawPanel go_to_panel();
DrawPanel worst_panel();
void draw_isolation(const PanelContext& context);
void draw_view(const PanelContext& context);
DrawPanel vcv_panel();
DrawPanel sphere_panel();
DrawPanel history_panel();

DrawPanel convergence_panel();
/// No step of the history has iterations to show: a strip is enough for that panel.
bool convergence_empty(const PanelContext& context);

// Over the mesh.
/// What the state of the mesh calls for, in a strip above it: inverted elements, not converged.
void draw_banner(const PanelContext& context);
inline constexpr float banner_padding = 14;  ///< of the strip at its sides, at scale 1
/// Height that the strip needs at a width, in pixels: one line, or more where there is no room.
float banner_height(const PanelContext& context, float width);
/// The card of the demo being played: what happens, what to look at, the numbers as they are now.
void draw_demo(const PanelContext& context);
/// What the card needs at a width, in pixels.
float demo_height(const PanelContext& context, float width);
/// The recording under way: how many frames there are, how far the film is.
void draw_recording(const PanelContext& context);

}  // namespace winslow::gui
