#include "gui/document/jobs/layer_preview.h"

#include <exception>
#include <utility>

#include "core/layers/sound_plan.h"

namespace winslow::gui {

bool LayerPreview::update(const Mesh* mesh) {
  bool news = false;
  if (auto outcome = worker_.poll()) {
    done_ = std::move(*outcome);
    made_ = making_;
    news = true;
  }
  key_ = mesh ? mesh->coordinates.values().data() : nullptr;
  present_ = key_ && key_ == made_;
  if (!mesh || !wanted_ || fits() || worker_.busy()) return news;
  making_ = key_;
  worker_.start([mesh = *mesh, options = *wanted_] {
    Outcome outcome{mesh, options, nullptr, {}};
    try {
      outcome.plan =
          std::make_shared<const LayerStack>(sound_plan(mesh, with_counts(options, mesh)));
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    return outcome;
  });
  return news;
}

}  // namespace winslow::gui
