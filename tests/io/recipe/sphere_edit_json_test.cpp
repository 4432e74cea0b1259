#include <doctest/doctest.h>

#include "core/error.h"
#include "io/recipe/recipe.h"

using namespace winslow;

TEST_CASE("edits of VCVs in space come back as they were written, and what is wrong is named") {
  EditVcvCommand command;
  command.edits = {{7,
                    {3, 9, 4, 12},
                    {},
                    {1, 0.1 + 0.2, 2, 1},
                    {{1.0 / 3, 0, 0.5}, {0, 1, 0}, {-1, -0.7, 1e-3}, {0, 0, -1}}},
                   {8, {}, {}, {}}};
  const auto json = io::to_json(command);
  CHECK(json["nodes"][0]["directions"][1] == nlohmann::json{0.0, 1.0, 0.0});
  CHECK_FALSE(json["nodes"][1].contains("directions"));
  const auto back = std::get<EditVcvCommand>(io::command_from_json(json, "."));
  CHECK(back.edits == command.edits);
  const auto complaint = [&](const nlohmann::json& directions) {
    auto bad = json;
    bad["nodes"][0]["directions"] = directions;
    try {
      io::command_from_json(bad, ".", "here");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(complaint(3).find("nodes[0].directions: expected a list of directions") !=
        std::string::npos);
  CHECK(complaint({{1, 2}}).find("nodes[0].directions[0]: expected three numbers") !=
        std::string::npos);
  CHECK(complaint({{1, 2, "x"}}).find("nodes[0].directions[0][2]: found \"x\"") !=
        std::string::npos);
}
