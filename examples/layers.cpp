// Inserts viscous layers at a wall, says how well they came out, and has them keep their heights
// when the body moves.
//
//     ./layers circle.su2 circle
#include <winslow/winslow.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: layers MESH WALL\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);

    winslow::LayersCommand insert;
    winslow::LayerWall wall;
    wall.markers = {argv[2]};
    wall.spacing.count = 8;
    wall.spacing.first = 0.002;  // height of the first layer, in units of the mesh
    wall.spacing.ratio = 1.2;    // of each height to the one below
    insert.layers.walls = {wall};
    const winslow::CommandResult layered = winslow::execute(insert, state);

    const winslow::Mesh& mesh = layered.state.mesh;
    const auto measures = winslow::measure_layers(*layered.state.layers, mesh.coordinates);
    std::printf("%d elements before, %d with layers; first height %.5f to %.5f\n",
                state.mesh.topology->element_count(), mesh.topology->element_count(),
                measures.first_height.min, measures.first_height.max);

    winslow::MoveCommand move;  // the layers are the state's: they go along
    move.bodies[0].markers = {argv[2]};
    move.bodies[0].motion.rotate = 30;
    const winslow::CommandResult moved = winslow::execute(move, layered.state);
    const auto after = winslow::measure_layers(*moved.state.layers, moved.state.mesh.coordinates);
    std::printf("after the motion: heights off by %.2f %% at most, %d elements inverted\n",
                100 * after.spacing_error.max, moved.smooth.inverted);
    return moved.smooth.inverted == 0 ? 0 : 4;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
