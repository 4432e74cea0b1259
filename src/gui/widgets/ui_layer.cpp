#include "gui/widgets/ui_layer.h"

#include <imgui_internal.h>

#include <limits>
#include <utility>

namespace winslow::gui {

namespace {

void map_keys(ImGuiIO& io) {
  constexpr std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                               {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                               {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                               {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                               {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                               {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                               {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                               {ImGuiKey_Home, GLFW_KEY_HOME},
                                               {ImGuiKey_End, GLFW_KEY_END},
                                               {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                               {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                               {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                               {ImGuiKey_Space, GLFW_KEY_SPACE},
                                               {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                               {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                               {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                               {ImGuiKey_A, GLFW_KEY_A},
                                               {ImGuiKey_C, GLFW_KEY_C},
                                               {ImGuiKey_V, GLFW_KEY_V},
                                               {ImGuiKey_X, GLFW_KEY_X},
                                               {ImGuiKey_Y, GLFW_KEY_Y},
                                               {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [imgui, glfw] : keys) io.KeyMap[imgui] = glfw;
}

/// Makes Dear ImGui forget the undo steps of a text field that lost the focus. It would apply them
/// when the field is entered again; with a shorter text, undo would then make its length negative.
void forget_field_that_was_left(ImGuiContext& context) {
  if (context.ActiveId != context.InputTextState.ID) context.InputTextState.ID = 0;
}

}  // namespace

std::optional<WidgetMap::Rect> WidgetMap::find(std::string_view id) const {
  const auto it = rects_.find(id);
  if (it == rects_.end()) return std::nullopt;
  return it->second;
}

UiLayer::UiLayer(float scale) : context_(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendPlatformName = "winslow";
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.UserData = this;
  map_keys(io);
  theme_ = make_theme(scale);
  renderer_ = std::make_unique<ImGuiRenderer>();
}

UiLayer::~UiLayer() {
  ImGui::SetCurrentContext(context_);
  renderer_.reset();
  ImGui::DestroyContext(context_);
}

void UiLayer::set_scale(float scale) {
  if (scale == theme_.scale) return;
  ImGui::SetCurrentContext(context_);
  ImGui::GetIO().Fonts->Clear();
  theme_ = make_theme(scale, *palette_);
  renderer_->upload_fonts();
}

bool UiLayer::rested_on(const ScreenBox& item) {
  constexpr double rest = 0.35;
  if (item_ != item) rested_ = 0;
  item_ = item;
  over_item_ = true;
  return rested_ >= rest;
}

bool UiLayer::take_reveal(std::string_view id) {
  if (revealed_.empty() || revealed_ != id) return false;
  revealed_.clear();
  return true;
}

UiLayer& UiLayer::current() { return *static_cast<UiLayer*>(ImGui::GetIO().UserData); }

void UiLayer::begin(const InputState& input, int width, int height, double seconds) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  constexpr float away = -std::numeric_limits<float>::max();
  io.MousePos = input.mouse_inside ? ImVec2(static_cast<float>(input.mouse.x()),
                                            static_cast<float>(input.mouse.y()))
                                   : ImVec2(away, away);
  for (std::size_t b = 0; b < input.buttons.size(); ++b) io.MouseDown[b] = input.buttons[b];
  io.MouseWheel = static_cast<float>(input.wheel.y());
  io.MouseWheelH = static_cast<float>(input.wheel.x());
  for (std::size_t k = 0; k < input.keys.size(); ++k) io.KeysDown[k] = input.keys[k];
  io.KeyCtrl = input.control();
  io.KeyShift = input.shift();
  io.KeyAlt = input.alt();
  io.KeySuper = input.super();
  for (char32_t c : input.text) io.AddInputCharacter(static_cast<unsigned>(c));
  if (!std::exchange(over_item_, false)) item_.reset();
  rested_ = item_ ? rested_ + seconds : 0;
  widgets_.clear();
  use_palette(*palette_);
  ImGui::NewFrame();
}

void UiLayer::want_keyboard(std::string_view field) {
  keyboard_wanted_ = field;
  keyboard_frames_ = 4;
}

void UiLayer::end() {
  if (keyboard_frames_ > 0 && --keyboard_frames_ == 0) keyboard_wanted_.clear();
  forget_field_that_was_left(*context_);
  ImGui::Render();
}

void UiLayer::paint() {
  ImGui::SetCurrentContext(context_);
  if (ImDrawData* data = ImGui::GetDrawData()) renderer_->draw(*data);
}

void UiLayer::make_current() { ImGui::SetCurrentContext(context_); }

void UiLayer::paint_part(float x, float y, float width, float height) {
  ImGui::SetCurrentContext(context_);
  ImDrawData* data = ImGui::GetDrawData();
  if (!data) return;
  const ImVec2 position = data->DisplayPos;
  const ImVec2 size = data->DisplaySize;
  data->DisplayPos = ImVec2(x, y);
  data->DisplaySize = ImVec2(width, height);
  renderer_->draw(*data);
  data->DisplayPos = position;
  data->DisplaySize = size;
}

void UiLayer::resemble(const UiLayer& other) {
  folded_ = other.folded_;
  palette_ = other.palette_;
  const float ratio = theme_.scale / other.theme_.scale;
  for (const ImGuiWindow* theirs : other.context_->Windows) {
    for (ImGuiWindow* ours : context_->Windows) {
      if (ours->ID != theirs->ID) continue;
      ours->ScrollTarget = ImVec2(theirs->Scroll.x * ratio, theirs->Scroll.y * ratio);
      ours->ScrollTargetCenterRatio = ImVec2(0, 0);
    }
  }
}

bool UiLayer::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool UiLayer::wants_keyboard() const { return ImGui::GetIO().WantTextInput; }

int UiLayer::cursor() const { return ImGui::GetMouseCursor(); }

}  // namespace winslow::gui
