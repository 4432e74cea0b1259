#include "gui/files/assets.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

void Workbench::on(const action::StartDemo& a) {
  const Demo* demo = find_demo(a.id);
  if (!demo) return;
  const Document* document = session_.document();
  if (document && (document->modified() || session_.in_motion()) && !a.discard_changes) {
    session_.messages().ask(
        {Prompt::Kind::question,
         "Discard the changes?",
         document->name() + " has changes that are not saved. The demo opens another mesh.",
         {{"Discard and play", {action::StartDemo{a.id, true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  welcome_.close();
  demo_.start(*demo, options_.demo_meshes.empty() ? assets_folder() : options_.demo_meshes,
              session_, actions_);
}

/// The page goes when another mesh is opened.
void Workbench::on(const action::ShowWelcome&) { welcome_.toggle(); }

bool Workbench::shows_welcome() const { return !session_.document() || welcome_.wanted(); }

}  // namespace winslow::gui
