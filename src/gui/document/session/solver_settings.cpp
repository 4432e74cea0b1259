#include "gui/document/session/solver_settings.h"

#include "core/error.h"
#include "core/geometry/periodic_pairs.h"
#include "core/strategy/smooth_options.h"
#include "gui/document/jobs/run_settings.h"
#include "io/tables/file_defaults.h"

namespace winslow::gui {

const GivenPeriodicity* SolverSettings::file_pairs() const {
  const Document* document = mesh_.document();
  return document && document->source().details ? document->source().details->periodic.get()
                                                : nullptr;
}

ResolveFiles SolverSettings::resolver() const {
  return [files = references_,
          details = mesh_.document()->source().details](const SlideOptions& slide) {
    return io::resolve_files(slide, details.get(),
                             [&](const auto& file) { return files->read(file); });
  };
}

SmoothOptions SolverSettings::smooth_for_motion(const std::vector<std::string>& markers) const {
  SmoothOptions smooth = smooth_;
  if (const Document* document = mesh_.document())
    leave_to_motion(smooth.slide, file_pairs(), *document->state().mesh.topology, markers);
  return smooth;
}

MoveCommand SolverSettings::move_command(const std::vector<std::string>& markers,
                                         RigidMotion motion) const {
  return move_together({{markers, std::move(motion)}});
}

MoveCommand SolverSettings::move_together(std::vector<MovingBody> bodies) const {
  std::vector<std::string> markers;
  for (MovingBody& body : bodies) {
    markers.insert(markers.end(), body.markers.begin(), body.markers.end());
    // Fixes the number of components, so that recipes show as many as the mesh has dimensions.
    body.motion.translate = Vec3(body.motion.translate);
  }
  return MoveCommand{std::move(bodies), motion_, smooth_for_motion(markers)};
}

void SolverSettings::on(const action::PairMarkers& a) {
  if (!mesh_.document()) return;
  try {
    const Mesh& mesh = mesh_.document()->state().mesh;
    SlideOptions slide = smooth_.slide;
    const std::string done = pair_sides(slide, file_pairs(), mesh, a.first, a.second);
    smooth_.slide = std::move(slide);
    messages_.tell(Notice::Kind::information, done);
  } catch (const UsageError& error) {
    messages_.report_error("These markers are not periodic", error.what());
  }
}

void SolverSettings::on(const action::OverrideNode& a) {
  const Document* document = mesh_.document();
  if (document && a.node >= 0 && a.node < document->state().mesh.topology->node_count())
    overrides_.set(smooth_.slide, a.node, a.to, document->edits().revision());
}

void SolverSettings::on(const action::StepOverride& a) {
  const std::string what =
      a.again ? overrides_.redo(smooth_.slide) : overrides_.undo(smooth_.slide);
  messages_.tell(Notice::Kind::information, (a.again ? "Done again: " : "Undone: ") + what);
}

void SolverSettings::on(const action::ChooseReference& a) {
  reference_.drop();
  if (a.file.empty()) {
    smooth_.slide.reference.clear();
    return;
  }
  if (mesh_.document() && in_space(mesh_))
    reference_.choose(a.file, mesh_.shared(), smooth_.slide.markers, references_);
}

void SolverSettings::forget_mesh() {
  smooth_.keep_outside = {};
  smooth_.slide = {};
  overrides_.clear();
  reference_.drop();
  const Document* document = mesh_.document();
  if (document && is_surface(*document->state().mesh.topology)) settle_for_surface(smooth_);
  if (!document || document->source().details == nullptr) return;
  const io::MeshFile file{
      document->state().mesh, document->source().details->format, document->source().details, {}};
  if (const std::string said = io::add_file_defaults(smooth_, {}, file); !said.empty())
    messages_.remark("Slides and moves together as the file says", {said});
}

bool SolverSettings::poll() {
  const auto read = reference_.poll();
  if (!read || !mesh_.document()) return false;
  if (!read->error.empty()) {
    messages_.report_error(
        read->file.filename().string() + " cannot be used as a reference surface", read->error);
    return true;
  }
  smooth_.slide.reference = read->file.string();
  messages_.tell(is_coarse(*read) ? Notice::Kind::warning : Notice::Kind::success, describe(*read));
  return true;
}

}  // namespace winslow::gui
