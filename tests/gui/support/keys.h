#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

/// Keys that scripts press.
namespace winslow::gui::test::keys {

inline constexpr int control = GLFW_KEY_LEFT_CONTROL;
inline constexpr int alt = GLFW_KEY_LEFT_ALT;
inline constexpr int shift = GLFW_KEY_LEFT_SHIFT;
inline constexpr int escape = GLFW_KEY_ESCAPE;
inline constexpr int space = GLFW_KEY_SPACE;
inline constexpr int tab = GLFW_KEY_TAB;
inline constexpr int enter = GLFW_KEY_ENTER;
inline constexpr int f12 = GLFW_KEY_F12;
inline constexpr int f1 = GLFW_KEY_F1;
inline constexpr int f2 = GLFW_KEY_F2;
inline constexpr int a = GLFW_KEY_A;
inline constexpr int e = GLFW_KEY_E;
inline constexpr int f = GLFW_KEY_F;
inline constexpr int n = GLFW_KEY_N;
inline constexpr int o = GLFW_KEY_O;
inline constexpr int p = GLFW_KEY_P;
inline constexpr int q = GLFW_KEY_Q;
inline constexpr int r = GLFW_KEY_R;
inline constexpr int s = GLFW_KEY_S;
inline constexpr int w = GLFW_KEY_W;
inline constexpr int z = GLFW_KEY_Z;

}  // namespace winslow::gui::test::keys
