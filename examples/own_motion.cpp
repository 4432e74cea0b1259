// A motion of one's own: displacements of single nodes, as a structural solver hands them over.
// Here a body is bent, the more the farther a node is from its nose.
//
//     ./own_motion naca0012.su2 airfoil bent.su2
#include <winslow/winslow.h>

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: own_motion MESH BODY OUT\n");
    return 2;
  }
  try {
    const winslow::io::MeshFile file = winslow::io::read_mesh(argv[1]);
    const winslow::Coordinates& x = file.mesh.coordinates;

    winslow::DeformCommand deform;
    deform.markers = {argv[2]};
    // Nodes of the body, by their numbers; those that are not in the table stay.
    const auto nodes = file.mesh.topology->markers().nodes_of(deform.markers);
    double nose = x.xy(nodes.front()).x();
    for (const winslow::Index node : nodes) nose = std::min(nose, x.xy(node).x());
    winslow::DisplacementTable table;
    for (const winslow::Index node : nodes) {
      const double back = x.xy(node).x() - nose;
      winslow::DisplacementEntry entry;
      entry.node = node;
      entry.displacement.y() = -0.15 * back * back;
      table.entries.push_back(entry);
    }
    deform.shape = table;

    const auto result = winslow::execute(deform, winslow::make_state(file.mesh));
    if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1) {
      std::fprintf(stderr, "not written: %s\n", winslow::why_incomplete(result.smooth).c_str());
      return 4;
    }
    winslow::io::write_mesh(argv[3], result.state.mesh, file.details.get());
    std::printf("%d nodes moved, %d linear solves\n", static_cast<int>(nodes.size()),
                result.smooth.linear_solves);
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
