#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <variant>

#include "gui/settings/picture_spec.h"

/// Pictures and recordings. Carried out by Capture.
namespace winslow::gui::action {

/// The window as it is.
struct TakeScreenshot {
  std::filesystem::path path;  ///< empty: a new name in the working folder
  bool overwrite = false;
};
/// The whole of the settings, as a dialog that was accepted has them.
struct SetPictureSpec {
  PictureSpec spec;
};
/// A picture by the settings of SetPictureSpec: .png, or the mesh alone as .svg or .pdf.
struct SavePicture {
  std::filesystem::path path;
  bool overwrite = false;
};
/// As SetPictureSpec.
struct SetRecordingSpec {
  RecordingSpec spec;
};
/// Records the mesh from now on, by the settings of SetRecordingSpec.
struct StartRecording {
  std::filesystem::path path;       ///< .mp4 or .gif: a film; else a folder of PNG frames
  std::optional<std::size_t> step;  ///< carry out this step of the history again, and record that
  bool overwrite = false;
};
struct StopRecording {};    ///< what was recorded is written
struct CancelRecording {};  ///< what was recorded is thrown away

}  // namespace winslow::gui::action

namespace winslow::gui {

using PictureAction =
    std::variant<action::TakeScreenshot, action::SetPictureSpec, action::SavePicture,
                 action::SetRecordingSpec, action::StartRecording, action::StopRecording,
                 action::CancelRecording>;

}  // namespace winslow::gui
