// Smooths a square of 4 x 4 cells whose interior was scrambled; exits with 0 if it comes out
// regular.
#include <winslow/winslow.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

int main(int argc, char**) {
  if (argc > 1) return std::puts(WINSLOW_VERSION) < 0;  // the version of the headers
  constexpr winslow::Index n = 5;
  winslow::MeshData data;
  for (winslow::Index j = 0; j < n; ++j) {
    for (winslow::Index i = 0; i < n; ++i) {
      data.coordinates.push_xy(winslow::Vec2(0.25 * i, 0.25 * j));
    }
  }
  for (winslow::Index j = 0; j + 1 < n; ++j) {
    for (winslow::Index i = 0; i + 1 < n; ++i) {
      const std::array<winslow::Index, 4> quad{j * n + i, j * n + i + 1, (j + 1) * n + i + 1,
                                               (j + 1) * n + i};
      data.add_element(winslow::ElementType::quadrilateral, quad);
    }
  }
  const auto scrambled =
      winslow::execute(winslow::ScrambleCommand{7}, winslow::make_state(winslow::make_mesh(data)));
  const auto result = winslow::execute(winslow::SmoothCommand{}, scrambled.state);
  double error = 0;
  for (winslow::Index node = 0; node < n * n; ++node) {
    const winslow::Vec2 expected(0.25 * (node % n), 0.25 * (node / n));
    error = std::max(error, (result.state.mesh.coordinates.xy(node) - expected).norm());
  }
  std::printf("converged %d, inverted %d, error %.1e\n", result.smooth.converged,
              result.smooth.inverted, error);
  return result.smooth.converged && result.smooth.inverted == 0 && error < 1e-8 ? 0 : 1;
}
