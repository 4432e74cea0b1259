// Reads a report that the program has written, and decides by it, as a script around a flow solver
// would. docs/command-line.md lists the keys.
//
//     winslow move three_element.su2 -o moved.su2 --marker flap --rotate -10 --report report.json
//     ./read_report report.json
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: read_report REPORT\n");
    return 2;
  }
  try {
    std::ifstream file(argv[1]);
    if (!file) {
      std::fprintf(stderr, "%s cannot be read\n", argv[1]);
      return 1;
    }
    const nlohmann::json report = nlohmann::json::parse(file);
    for (const nlohmann::json& command : report.at("commands")) {
      std::printf("%s: %s after %d iterations\n",
                  command.at("description").get<std::string>().c_str(),
                  command.at("converged").get<bool>() ? "converged" : "not converged",
                  command.at("outer_iterations").get<int>());
      const nlohmann::json& contact = command.at("contact");
      if (!contact.is_null())
        std::printf("  blocked by contact at %.1f %% of the way\n",
                    100 * contact.at("fraction").get<double>());
    }
    const nlohmann::json& sine = report.at("quality").at("normalized_jacobian");
    const int inverted = report.at("inverted").get<int>();
    std::printf("smallest sine %.3f, %d inverted elements\n", sine.at("min").get<double>(),
                inverted);
    return inverted == 0 && !report.at("output").is_null() ? 0 : 4;  // null: nothing was written
  } catch (const nlohmann::json::exception& error) {                 // no JSON, or no report
    std::fprintf(stderr, "%s: %s\n", argv[1], error.what());
    return 1;
  }
}
