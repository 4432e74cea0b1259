#include "io/recipe/recipe.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"

using namespace winslow;
using nlohmann::json;

namespace {

/// A folder of its own, gone at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "recipe-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// No value is the default of its field, so a field that is forgotten shows.
SmoothOptions odd_smoothing() {
  SmoothOptions s;
  s.linear = {"gmres", 0.1 + 0.2, 77, 11};
  s.damping = 1.0 / 3.0;
  s.adapt_damping = false;
  s.acceleration = 3;
  s.clip = Clip::on;
  s.max_iterations = 1234;
  s.tolerance = 1.7e-11;
  s.threads = 3;
  return s;
}

MotionOptions odd_motion() { return {5, false}; }

void check_equal(const SmoothOptions& a, const SmoothOptions& b) {
  CHECK(a.formulation == b.formulation);
  CHECK(a.linear.solver == b.linear.solver);
  CHECK(a.linear.tolerance == b.linear.tolerance);
  CHECK(a.linear.max_iterations == b.linear.max_iterations);
  CHECK(a.linear.restart == b.linear.restart);
  CHECK(a.damping == b.damping);
  CHECK(a.adapt_damping == b.adapt_damping);
  CHECK(a.acceleration == b.acceleration);
  CHECK(a.clip == b.clip);
  CHECK(a.max_iterations == b.max_iterations);
  CHECK(a.tolerance == b.tolerance);
  CHECK(a.threads == b.threads);
}

void check_equal(const MotionOptions& a, const MotionOptions& b) {
  CHECK(a.increments == b.increments);
  CHECK(a.smooth_after == b.smooth_after);
  CHECK(a.floor == b.floor);
}

/// A command, written to a file and read back.
template <class C>
C round_trip(const C& command) {
  const TemporaryFolder folder;
  io::write_recipe(folder / "r.json", {"in.su2", "out.msh", {command}});
  const io::Recipe recipe = io::read_recipe(folder / "r.json");
  CHECK(recipe.input == "in.su2");
  CHECK(recipe.output == "out.msh");
  REQUIRE(recipe.commands.size() == 1);
  REQUIRE(std::holds_alternative<C>(recipe.commands[0]));
  return std::get<C>(recipe.commands[0]);
}

/// Message of the error that a recipe of this text gives; "" if it is read.
std::string complaint(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.write("r.json", text);
  try {
    io::read_recipe(path);
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::string prefix = path.string() + ':';
    REQUIRE(message.starts_with(prefix));
    return message.substr(prefix.size());
  }
  return "";
}

std::string with_command(const std::string& command) {
  return "{\"winslow_recipe\": 1,\n \"commands\": [\n  " + command + "\n ]}";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("recipe: a smooth command survives") {
  check_equal(round_trip(SmoothCommand{odd_smoothing()}).smooth, odd_smoothing());
  check_equal(round_trip(SmoothCommand{}).smooth, SmoothOptions{});
}

TEST_CASE("recipe: a move command survives") {
  const MoveCommand command{
      {{{"slat", "a \"quoted\" n\xc3\xa4me\n"}, {-40.1, Vec2(0.1, -1e300), {5e-324, 2}}}},
      odd_motion(),
      odd_smoothing()};
  const MoveCommand read = round_trip(command);
  CHECK(read.bodies[0].markers == command.bodies[0].markers);
  CHECK(read.bodies[0].motion.rotate == command.bodies[0].motion.rotate);
  CHECK(read.bodies[0].motion.pivot == command.bodies[0].motion.pivot);
  CHECK(read.bodies[0].motion.translate == command.bodies[0].motion.translate);
  check_equal(read.how, command.how);
  check_equal(read.smooth, command.smooth);
}

TEST_CASE("recipe: several bodies are a list, one is the command itself") {
  MoveCommand command;
  command.bodies = {{{"slat"}, {.rotate = 20, .pivot = Vec2(0.1, 0.2)}},
                    {{"flap", "vane"}, {.rotate = -40, .translate = Vec2(0, -0.05)}},
                    {{"tab"},
                     {10, GivenVector::of_three(Vec3(1, 2, 0)),
                      GivenVector::of_three(Vec3(0, 0, 0)), Vec3(0, 1, 0)}}};
  command.how = odd_motion();
  const nlohmann::json json = io::to_json(command);
  CHECK_FALSE(json.contains("markers"));
  CHECK_FALSE(json.contains("rotate"));
  REQUIRE(json.at("bodies").size() == 3);
  CHECK(json.at("bodies")[0] == nlohmann::json{{"markers", {"slat"}},
                                               {"rotate", 20.0},
                                               {"pivot", {0.1, 0.2}},
                                               {"translate", {0.0, 0.0}}});
  CHECK(json.at("bodies")[2].at("pivot") == nlohmann::json({1.0, 2.0, 0.0}));
  const MoveCommand read = round_trip(command);
  CHECK(read.bodies == command.bodies);
  check_equal(read.how, command.how);
  CHECK(io::to_json(read) == json);

  command.bodies.resize(1);
  const nlohmann::json one = io::to_json(command);
  CHECK_FALSE(one.contains("bodies"));
  CHECK(one.at("markers") == nlohmann::json({"slat"}));
  CHECK(one.at("rotate") == 20.0);
  // A list of one is that very command.
  nlohmann::json listed{{"command", "move"},
                        {"bodies", {{{"markers", {"slat"}}, {"rotate", 20.0}}}}};
  const Command same = io::command_from_json(listed, {});
  CHECK(std::get<MoveCommand>(same).bodies == std::vector<MovingBody>{{{"slat"}, {.rotate = 20}}});
}

TEST_CASE("recipe: the number of components that a motion was given by survives") {
  for (const char* text :
       {R"({"markers": ["a"], "rotate": 1.0, "translate": [1.0, 2.0], "pivot": [0.5, 0.5]})",
        R"({"markers": ["a"], "rotate": 1.0, "translate": [1.0, 2.0, 0.0], "pivot": [0.5, 0.5]})",
        R"({"markers": ["a"], "axis": [0.0, 0.0, 1.0], "translate": [0.0, 0.0],
            "pivot": [0.5, 0.5, 0.0]})"}) {
    nlohmann::json given = nlohmann::json::parse(text);
    given["command"] = "move";
    const nlohmann::json written = io::to_json(io::command_from_json(given, {}));
    for (const auto& [key, value] : given.items()) CHECK(written.at(key) == value);
  }
  // What the program found is of space where it has an axis.
  MoveCommand found;
  found.bodies[0] = {{"a"}, {5, Vec3(1, 2, 0), Vec3(3, 4, 0)}};
  CHECK(io::to_json(found).at("pivot") == nlohmann::json({1.0, 2.0}));
  CHECK(io::to_json(found).at("translate") == nlohmann::json({3.0, 4.0}));
  found.bodies[0].motion.axis = Vec3(0, 0, 1);
  CHECK(io::to_json(found).at("pivot") == nlohmann::json({1.0, 2.0, 0.0}));
  CHECK(io::to_json(found).at("translate") == nlohmann::json({3.0, 4.0, 0.0}));
}

TEST_CASE("recipe: bodies that are written wrongly are refused by their place") {
  const auto refusal = [](const char* command) {
    try {
      io::command_from_json(nlohmann::json::parse(command), {}, "commands[0]");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK(contains(refusal(R"({"command": "move", "bodies": []})"),
                 "commands[0].bodies: expected a list of bodies"));
  CHECK(contains(refusal(R"({"command": "move", "bodies": [{"rotate": 1}]})"),
                 "commands[0].bodies[0]: the key \"markers\" is missing"));
  CHECK(contains(refusal(R"({"command": "move", "rotate": 1, "bodies": [{"markers": ["a"]}]})"),
                 "commands[0].rotate: expected in the objects of \"bodies\""));
  CHECK(contains(refusal(R"({"command": "move", "bodies": [{"markers": ["a"], "smooth": {}}]})"),
                 "commands[0].bodies[0].smooth: unknown key, expected one of markers, rotate"));
}

TEST_CASE("recipe: a pivot at the origin is another one than none") {
  MoveCommand command{{{{"flap"}, {30, Vec2(0, 0), {0, 0}}}}, {}, {}};
  CHECK(io::to_json(command).at("pivot") == nlohmann::json({0.0, 0.0}));
  CHECK(round_trip(command).bodies[0].motion.pivot == Vec2(0, 0));
  command.bodies[0].motion.pivot.reset();
  CHECK_FALSE(io::to_json(command).contains("pivot"));
  CHECK_FALSE(round_trip(command).bodies[0].motion.pivot.has_value());
}

TEST_CASE("recipe: a sine deformation survives") {
  for (const Fade fade : {Fade::none, Fade::start, Fade::end, Fade::both}) {
    const SineDeformation sine{-0.07, 2.5, {0.6, -0.8}, fade, 0.31};
    const DeformCommand read =
        round_trip(DeformCommand{{"main"}, sine, odd_motion(), odd_smoothing()});
    REQUIRE(std::holds_alternative<SineDeformation>(read.shape));
    const auto& shape = std::get<SineDeformation>(read.shape);
    CHECK(shape.amplitude == sine.amplitude);
    CHECK(shape.waves == sine.waves);
    CHECK(shape.direction == sine.direction);
    CHECK(shape.fade == sine.fade);
    CHECK(shape.fade_length == sine.fade_length);
    CHECK(read.markers == std::vector<std::string>{"main"});
    check_equal(read.how, odd_motion());
    check_equal(read.smooth, odd_smoothing());
  }
}

TEST_CASE("recipe: displacements are embedded") {
  DisplacementTable table;
  table.source = "folder/d.csv";
  table.entries.push_back({17, Vec2(0, 0), {0.1, -0.2}, 2});
  table.entries.push_back({{}, {1.0 / 3.0, 2.0 / 7.0}, {1e-17, 0}, 0});
  const DeformCommand read = round_trip(DeformCommand{{"flap"}, table, {}, {}});
  REQUIRE(std::holds_alternative<DisplacementTable>(read.shape));
  const auto& back = std::get<DisplacementTable>(read.shape);
  CHECK(back.source == table.source);
  REQUIRE(back.entries.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(back.entries[i].node == table.entries[i].node);
    CHECK(back.entries[i].position == table.entries[i].position);
    CHECK(back.entries[i].displacement == table.entries[i].displacement);
    CHECK(back.entries[i].line == table.entries[i].line);
  }
}

TEST_CASE("recipe: positions are embedded, and tables need no markers") {
  PositionTable table;
  table.source = "folder/p.csv";
  table.entries.push_back({17, {1.0 / 3.0, -0.2}, 2});
  table.entries.push_back({3, {0.1, 1e-17, 1.0 / 7.0}, 0});
  for (const std::vector<std::string>& markers :
       {std::vector<std::string>{}, std::vector<std::string>{"wet"}}) {
    const DeformCommand read = round_trip(DeformCommand{markers, table, {}, {}});
    CHECK(read.markers == markers);
    REQUIRE(std::holds_alternative<PositionTable>(read.shape));
    const auto& back = std::get<PositionTable>(read.shape);
    CHECK(back.source == table.source);
    REQUIRE(back.entries.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(back.entries[i].node == table.entries[i].node);
      CHECK(back.entries[i].position == table.entries[i].position);
      CHECK(back.entries[i].line == table.entries[i].line);
    }
  }
  const DisplacementTable ways{{{17, Vec2(0, 0), {0.1, -0.2}, 2}}, "d.csv"};
  CHECK(round_trip(DeformCommand{{}, ways, {}, {}}).markers.empty());
}

TEST_CASE("recipe: positions of a file are looked for beside the recipe") {
  const TemporaryFolder folder;
  folder.write("p.csv", "node,x,y\n4,0.5,-0.5\n");
  const auto path = folder.write("r.json", with_command(R"({"command": "deform",
                                 "positions": {"file": "p.csv"}})"));
  const auto recipe = io::read_recipe(path);
  const auto& table = std::get<PositionTable>(std::get<DeformCommand>(recipe.commands.at(0)).shape);
  REQUIRE(table.entries.size() == 1);
  CHECK(table.entries[0].node == 4);
  CHECK(table.entries[0].position == Vec2(0.5, -0.5));
}

TEST_CASE("recipe: deformations in space survive, with their third components") {
  SineDeformation sine{0.1, 1, {0.5, 0, -0.25}};
  sine.along = Vec3(1.0 / 3, 2, -3);
  const DeformCommand wave = round_trip(DeformCommand{{"main"}, sine, {}, {}});
  CHECK(std::get<SineDeformation>(wave.shape) == sine);

  DisplacementTable table;
  table.entries.push_back({17, Vec2(0, 0), {0.1, -0.2, 1.0 / 3}, 0});
  table.entries.push_back({{}, {1, 2, 0.1}, {3, 4, -5e-17}, 0});
  const DeformCommand read = round_trip(DeformCommand{{"flap"}, table, {}, {}});
  const auto& back = std::get<DisplacementTable>(read.shape);
  REQUIRE(back.entries.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(back.entries[i].position == table.entries[i].position);
    CHECK(back.entries[i].displacement == table.entries[i].displacement);
  }
}

TEST_CASE("recipe: a scramble command survives") {
  CHECK(round_trip(ScrambleCommand{18446744073709551615u}).seed == 18446744073709551615u);
}

TEST_CASE("recipe: an insertion of layers survives") {
  LayersCommand command;
  command.task = LayerTask::respace;
  command.layers.walls = {{{"slat", "main"}, {25, 1e-5, 1.2, 1.003, {}, true}},
                          {{"flap"},
                           {7, 2e-5, 1.3, 1.0, 0.01, false},
                           {-1, 0.5, -3, std::numeric_limits<double>::infinity()}}};
  command.layers.fans = false;
  command.layers.fan_threshold = 70;
  command.layers.fan_angle = 33;
  command.layers.clearance = 0.2;
  command.layers.crossing = 0.4;
  command.layers.steepest = 0.7;
  command.layers.scale_all = true;
  command.layers.overrides = {{12, 3, std::nullopt}, {40, std::nullopt, 0.0}, {41, 1, 0.25}};
  command.control = false;
  command.tolerance = 0.03;
  command.most_corrections = 2;
  command.smooth = odd_smoothing();
  const LayersCommand read = round_trip(command);
  CHECK(read.task == command.task);
  CHECK(read.layers == command.layers);
  CHECK(read.control == command.control);
  CHECK(read.tolerance == command.tolerance);
  CHECK(read.most_corrections == command.most_corrections);
  check_equal(read.smooth, command.smooth);
}

TEST_CASE("recipe: displacements of a file are looked for beside the recipe") {
  const TemporaryFolder folder;
  folder.write("d.csv", "node,dx,dy\n4,0.5,-0.5\n");
  const auto path =
      folder.write("r.json", with_command(R"({"command": "deform", "markers": ["flap"],
                                 "displacements": {"file": "d.csv"}})"));
  const auto recipe = io::read_recipe(path);
  const auto& shape = std::get<DeformCommand>(recipe.commands.at(0)).shape;
  const auto& table = std::get<DisplacementTable>(shape);
  REQUIRE(table.entries.size() == 1);
  CHECK(table.entries[0].node == 4);
  CHECK(table.entries[0].displacement == Vec2(0.5, -0.5));
}

TEST_CASE(
    "recipe: a reference surface is looked for beside the recipe, and is that file from then on") {
  const TemporaryFolder folder;
  const auto path = folder.write("r.json", with_command(R"({"command": "smooth",
                                 "smooth": {"slide": {"reference": "fine.obj"}}})"));
  // Read by a relative path, as a user may name it.
  const auto from_here = std::filesystem::relative(path);
  const Command command = io::read_recipe(from_here).commands.at(0);
  const std::filesystem::path name = std::get<SmoothCommand>(command).smooth.slide.reference;
  CHECK(name.is_absolute());
  CHECK(name.lexically_normal() ==
        std::filesystem::absolute(from_here.parent_path() / "fine.obj").lexically_normal());
  // As steps of a session are kept, in another folder.
  const Command kept = io::command_from_json(io::to_json(command), "elsewhere", "step");
  CHECK(std::get<SmoothCommand>(kept).smooth.slide.reference == name);
}

TEST_CASE("recipe: what is left out has its default") {
  const TemporaryFolder folder;
  const auto path =
      folder.write("r.json", with_command(R"({"command": "move", "markers": ["a"]})"));
  const auto recipe = io::read_recipe(path);
  CHECK(recipe.input.empty());
  const auto& move = std::get<MoveCommand>(recipe.commands.at(0));
  CHECK(move.bodies[0].motion.rotate == 0);
  CHECK_FALSE(move.bodies[0].motion.pivot.has_value());
  check_equal(move.how, MotionOptions{});
  check_equal(move.smooth, SmoothOptions{});
}

TEST_CASE("recipe: errors name line and key") {
  struct Case {
    std::string text, expected;
  };
  const std::vector<Case> cases{
      {"", "1: syntax error"},
      {"{\n\"winslow_recipe\": 1,\n}", "3: syntax error"},
      {"{\"winslow_recipe\": 1, \"commands\": []} x", "1: syntax error"},
      {"[]", "1: found [], expected an object"},
      {"{\"commands\": []}", "1: the key \"winslow_recipe\" is missing"},
      {"{\n\n\"winslow_recipe\": 2, \"commands\": []}", "3: winslow_recipe: found version 2"},
      {"{\"winslow_recipe\": 1}", "1: the key \"commands\" is missing"},
      {"{\"winslow_recipe\": 1,\n\"commands\": 3}", "2: commands: expected a list"},
      {"{\"winslow_recipe\": 1, \"commands\": [],\n\n \"inptu\": 1}", "3: inptu: unknown key"},
      {"{\"winslow_recipe\": 1, \"commands\": [],\n \"input\": 1}", "2: input: found 1, expected"},
      {"{\"winslow_recipe\": 1,\n\"winslow_recipe\": 1, \"commands\": []}",
       "2: winslow_recipe: found this key twice"},
      {with_command("7"), "3: commands[0]: found 7, expected an object"},
      {with_command("{}"), "3: commands[0]: the key \"command\" is missing"},
      {with_command(R"({"command": "smoth"})"), "3: commands[0].command: found \"smoth\""},
      {with_command("{\"command\": \"smooth\",\n \"marker\": 1}"),
       "4: commands[0].marker: unknown key"},
      {with_command("{\"command\": \"scramble\",\n\n \"seed\": -1}"),
       "5: commands[0].seed: found -1"},
      {with_command(R"({"command": "scramble", "seed": 1.5})"), "3: commands[0].seed: found 1.5"},
      {with_command(R"({"command": "scramble", "seed": 1e999})"), "3: number overflow"},
      {with_command(R"({"command": "move"})"), "3: commands[0]: the key \"markers\" is missing"},
      {with_command(R"({"command": "move", "markers": "a"})"), "3: commands[0].markers: found"},
      {with_command("{\"command\": \"move\", \"markers\": [\"a\",\n3]}"),
       "4: commands[0].markers[1]: found 3"},
      {with_command(R"({"command": "move", "markers": ["a"], "pivot": [1]})"),
       "3: commands[0].pivot: found [1], expected [x, y]"},
      {with_command(R"({"command": "move", "markers": ["a"], "rotate": "9"})"),
       "3: commands[0].rotate: found \"9\", expected a number"},
      {with_command(R"({"command": "move", "markers": ["a"], "increments": 3000000000})"),
       "3: commands[0].increments: found 3000000000, expected a whole number"},
      {with_command(R"({"command": "move", "markers": ["a"], "smooth_after": 1})"),
       "3: commands[0].smooth_after: found 1, expected true or false"},
      {with_command(R"({"command": "smooth", "smooth": {"clip": "sometimes"}})"),
       "3: commands[0].smooth.clip: found \"sometimes\", expected one of auto, on, off"},
      {with_command(R"({"command": "smooth", "smooth": {"linear": {"solvr": "x"}}})"),
       "3: commands[0].smooth.linear.solvr: unknown key"},
      {with_command(R"({"command": "smooth", "smooth": {"damping": 7}})"),
       "3: commands[0].smooth.damping: found 7, expected more than 0, at most 1"},
      {with_command("{\"command\": \"smooth\", \"smooth\": {\"linear\": {\n\"solver\": \"lu\"}}}"),
       "4: commands[0].smooth.linear.solver: found \"lu\", expected one of automatic, direct"},
      {with_command("{\"command\": \"smooth\", \"smooth\": {\"linear\": {\n\"restart\": 0}}}"),
       "4: commands[0].smooth.linear.restart: found 0, expected 1 or more"},
      {with_command(R"({"command": "smooth", "smooth": {"targets": {"element": 0}}})"),
       "3: commands[0].smooth.targets: the shares must not be negative, nor all zero"},
      {with_command(R"({"command": "deform", "markers": ["a"]})"),
       "3: commands[0]: expected either \"sine\", \"displacements\" or \"positions\""},
      {with_command(R"({"command": "deform", "markers": ["a"], "sine": {"waves": 1}})"),
       "3: commands[0].sine: the key \"amplitude\" is missing"},
      {with_command("{\"command\": \"deform\", \"markers\": [\"a\"], \"displacements\":\n"
                    "{\"entries\": [\n{\"node\": 1, \"displacement\": [0, 0]},\n"
                    "{\"displacement\": [0, 0]}]}}"),
       "6: commands[0].displacements.entries[1]: expected either \"node\" or \"position\""},
  };
  for (const Case& c : cases) {
    CAPTURE(c.text);
    const std::string message = complaint(c.text);
    CAPTURE(message);
    CHECK(message.starts_with(c.expected));
  }
}

TEST_CASE("recipe: deep nesting and folders are refused") {
  CHECK(contains(complaint(std::string(100000, '[')), "nested too deeply"));
  const TemporaryFolder folder;
  CHECK_THROWS_AS(io::read_recipe(folder / "none.json"), InputError);
  CHECK_THROWS_AS(io::read_recipe(folder / "."), InputError);
}

TEST_CASE("recipe: a failed write leaves the old file") {
  const TemporaryFolder folder;
  const auto path = folder.write("r.json", "old");
  const MoveCommand command{{{{"not utf-8: \xff"}, {}}}, {}, {}};
  CHECK_THROWS_AS(io::write_recipe(path, {"", "", {command}}), OutputError);
  std::ifstream in(path);
  std::string text;
  std::getline(in, text);
  CHECK(text == "old");
  CHECK_THROWS_AS(io::write_recipe(folder / "no" / "r.json", {}), OutputError);
}

TEST_CASE("recipe: a command without a file can be read from JSON") {
  const Command command = ScrambleCommand{9};
  const json value = io::to_json(command);
  CHECK(value == json{{"command", "scramble"}, {"seed", 9}});
  CHECK(std::get<ScrambleCommand>(io::command_from_json(value, ".")).seed == 9);
  CHECK_THROWS_WITH_AS(io::command_from_json(json::array(), ".", "here"),
                       "here: found [], expected an object", InputError);
}

TEST_CASE("edits of VCVs come back as they were written") {
  EditVcvCommand command;
  command.edits = {{12, {7, 3, 9}, {100.0 / 3, 360 - 100.0 / 3 - 150, 150}, {1, 0.1 + 0.2, 7}},
                   {4, {}, {}, {1, 2, 3, 4}},
                   {5, {}, {}, {}}};
  command.smooth = odd_smoothing();
  const EditVcvCommand back = round_trip(command);
  CHECK(back.edits == command.edits);
  check_equal(back.smooth, command.smooth);
}

TEST_CASE("what is wrong with an edit of VCVs is named") {
  const auto of = [](const std::string& rest) {
    return complaint(with_command("{\"command\": \"edit_vcv\"" + rest + "}"));
  };
  CHECK(contains(of(""), "commands[0]: the key \"nodes\" is missing"));
  CHECK(contains(of(", \"nodes\": []"), "commands[0].nodes: expected a list of nodes"));
  CHECK(contains(of(", \"nodes\": [{}]"), "commands[0].nodes[0]: the key \"node\" is missing"));
  CHECK(contains(of(", \"nodes\": [{\"node\": 1.5}]"),
                 "commands[0].nodes[0].node: found 1.5, expected a whole number"));
  CHECK(contains(of(", \"nodes\": [{\"node\": 1, \"angles\": [90, \"x\"]}]"),
                 "commands[0].nodes[0].angles[1]: found \"x\", expected a number"));
  CHECK(contains(of(", \"nodes\": [{\"node\": 1, \"neighbours\": 3}]"),
                 "commands[0].nodes[0].neighbours: found 3, expected a list of whole numbers"));
  CHECK(contains(of(", \"nodes\": [{\"node\": 1, \"length\": [1]}]"),
                 "commands[0].nodes[0].length: unknown key"));
}

TEST_CASE("limits of the quality stand in an object of their own, if there are any") {
  MoveCommand command;
  command.bodies[0].markers = {"a"};
  CHECK_FALSE(io::to_json(command).contains("min_quality"));
  command.how.floor.set(Metric::normalized_jacobian, 0.25);
  command.how.floor.set(Metric::skewness, 0.875);
  const auto json = io::to_json(command);
  CHECK(json["min_quality"] == nlohmann::json{{"normalized_jacobian", 0.25}, {"skewness", 0.875}});
  check_equal(round_trip(command).how, command.how);
  CHECK(contains(complaint(with_command(R"({"command": "move", "markers": ["a"],
    "min_quality": {"beauty": 1}})")),
                 "min_quality.beauty: unknown key"));
}

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
