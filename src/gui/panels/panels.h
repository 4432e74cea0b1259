#pragma once

#include "gui/menu/panel_context.h"

/// The panels of the studio, each in its own source file; gui/shell/workbench/panel_list.cpp lists
/// them. Panels without state are functions.
namespace winslow::gui {

/// The menu bar: the table of commands (gui/menu/user_command.h), one menu per group.
void draw_menu_bar(const PanelContext& context);
/// The row of buttons beneath the menu: the most frequent commands.
void draw_toolbar(const PanelContext& context);
/// One line: the mesh, its quality, the solver's activity.
void draw_status(const PanelContext& context);

// The column on the left.
void draw_zone(const PanelContext& context);
DrawPanel markers_panel();
DrawPanel cuts_panel();
DrawPanel motion_panel();
/// The bodies that are listed to move together: a click on one selects it, a cross takes it out,
/// and buttons carry all motions out or clear the list. Nothing while the list is empty.
void draw_body_list(const PanelContext& context);
/// "12\xC2\xB0 about (0.5, 0), moves by (0.1, 0)".
std::string motion_summary(const RigidMotion& motion, bool in_space);
/// What motions keep, for the motion panel: "Motions keep the mesh as smoothed (step 3)". Empty
/// where the options of the solver refer to no mesh.
std::string reference_text(const Session& session);
DrawPanel shape_panel();
DrawPanel layers_panel();
DrawPanel solver_panel();
DrawPanel mesh_panel();
DrawPanel measures_panel();

// The column on the right.
/// The quality table as in the paper: minimum, average and maximum of each metric, before and now
/// side by side.
void draw_quality(const PanelContext& context);
/// The deviation of a surface mesh from the mesh as opened, and its enclosed volume. Nothing for
/// other meshes.
void draw_deviation(const PanelContext& context);
/// Measures of the cells at walls that matter to flow solvers, before and now. Nothing for a mesh
/// without walls.
void draw_walls(const PanelContext& context);
DrawPanel go_to_panel();
DrawPanel worst_panel();
void draw_isolation(const PanelContext& context);
void draw_view(const PanelContext& context);
DrawPanel vcv_panel();
DrawPanel sphere_panel();
DrawPanel history_panel();

DrawPanel convergence_panel();
/// True if no step of the history has iterations to show: the panel then needs only a strip.
bool convergence_empty(const PanelContext& context);

// Over the mesh.
/// Warnings about the mesh, in a strip above it: inverted elements, not converged.
void draw_banner(const PanelContext& context);
inline constexpr float banner_padding = 14;  ///< at the sides of the strip, at scale 1
/// Height of the strip for a given width, in pixels: one line, or more if necessary.
float banner_height(const PanelContext& context, float width);
/// The card of the demo being played: its step, what to look at, and present values.
void draw_demo(const PanelContext& context);
/// Height of the card for a given width, in pixels.
float demo_height(const PanelContext& context, float width);
/// The recording in progress: number of frames, progress of the film.
void draw_recording(const PanelContext& context);

}  // namespace winslow::gui
