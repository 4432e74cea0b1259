// A drag, as of a mouse: every position is answered at once by a valid mesh near the solution,
// while a thread solves for it. When the mouse is let go, a command does for good what was shown.
//
//     ./drag three_element.su2 flap
#include <winslow/winslow.h>

#include <chrono>
#include <cstdio>
#include <thread>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: drag MESH BODY\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    winslow::DragGrip grip;
    grip.markers = {argv[2]};
    const winslow::SmoothOptions options;

    winslow::RigidMotion motion;
    {
      winslow::DragSession drag(state, grip, options);
      for (int frame = 0; frame <= 20; ++frame) {
        motion.translate.y() = -0.0005 * frame;
        const auto& shown = drag.to(motion);  // returns at once; draw shown.coordinates
        if (frame % 10 == 0)
          std::printf("frame %d: %s, smallest sine %.3f\n", frame,
                      shown.held ? "held at the last valid mesh" : "there", shown.min_sine);
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
      }
      if (!drag.error().empty()) throw winslow::Error(drag.error());
    }  // the session's thread ends here

    const auto command = winslow::drag_command(grip, motion, {}, options);
    const auto result = winslow::execute(command, state);
    std::printf("%s: %d linear solves\n", winslow::describe(command).c_str(),
                result.smooth.linear_solves);
    return result.smooth.inverted == 0 ? 0 : 4;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
