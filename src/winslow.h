#pragma once

/// All of winslow that other programs use. winslow::core: meshes, commands and their history,
/// drags, a solver thread, quality, layers and what an inspection shows. winslow::io, where it is
/// installed: mesh files, recipes, boundaries and displacements as tables.

#include "core/command/command.h"
#include "core/command/history.h"
#include "core/command/option_tables.h"
#include "core/command/series.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "core/inspect/nodal_view.h"
#include "core/job/solver_thread.h"
#include "core/layers/layer_detection.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "core/problem/smoothing_problem.h"
#include "core/quality/metric.h"
#include "core/quality/openfoam_measures.h"
#include "core/quality/quality.h"
#include "core/sensitivity/mesh_sensitivity.h"
#include "core/session/deformer.h"
#include "core/strategy/run.h"
#include "core/version.h"

#if __has_include("io/format/mesh_file.h")
#include "io/format/mesh_file.h"
#if __has_include(<nlohmann/json_fwd.hpp>)
#include "io/recipe/recipe.h"
#endif
#include "io/tables/motion_table.h"
#include "io/tables/slide_files.h"
#include "io/tables/table_files.h"
#endif
