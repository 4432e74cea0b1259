import json
import os

import support
from support import INPUT, INVERTED, NOT_CONVERGED, USAGE, ProgramTest

MOVE = ("--marker", "body", "--rotate", "-25", "--pivot", "0.1", "-0.2", "--translate", "0.1", "0",
        "--damping", "0.35", "--linear", "gmres")
SINE = ("--marker", "body", "--sine", "-0.04", "2", "--fade", "both", "--fade-length", "0.25",
        "--increments", "3")


class Replay(ProgramTest):
    def recipe(self, name, **content):
        self.path(name).write_text(json.dumps({"winslow_recipe": 1, **content}))

    def test_replays_the_commands_one_by_one_to_the_bit(self):
        self.ring()
        self.path("d.csv").write_text("node,dx,dy\n3,0.01,0.02\n4,0.01,0.015\n")
        self.winslow("move", "ring.su2", "-o", "1.su2", *MOVE, "--save-recipe", "1.json")
        self.winslow("deform", "1.su2", "-o", "2.su2", *SINE, "--save-recipe", "2.json")
        self.winslow("scramble", "2.su2", "-o", "3.su2", "--seed", "18446744073709551615",
                     "--allow-inverted", "--save-recipe", "3.json", code=INVERTED)
        self.winslow("smooth", "3.su2", "-o", "4.su2", "--max-iterations", "3000",
                     "--save-recipe", "4.json")
        self.winslow("deform", "4.su2", "-o", "5.su2", "--marker", "body", "--displacements",
                     "d.csv", "--save-recipe", "5.json")
        commands = [c for n in range(1, 6) for c in self.json(f"{n}.json")["commands"]]
        self.assertEqual([c["command"] for c in commands],
                         ["move", "deform", "scramble", "smooth", "deform"])
        self.recipe("all.json", input="ring.su2", output="all.su2", commands=commands)
        self.winslow("replay", "all.json", "--report", "r.json", "--history", "h.csv")
        self.assertEqual(self.path("all.su2").read_bytes(), self.path("5.su2").read_bytes())
        report = self.json("r.json")
        self.assertEqual(len(report["commands"]), 5)
        self.assertEqual(report["outer_iterations"],
                         sum(c["outer_iterations"] for c in report["commands"]))

    def test_every_option_of_the_linear_solver_has_a_flag(self):
        self.ring()
        self.winslow("smooth", "ring.su2", "-o", "out.su2", "--linear", "gmres", "--linear-tolerance", "1e-5",
                     "--linear-max-iterations", "60", "--linear-restart", "20", "--save-recipe", "r.json")
        self.assertEqual(self.json("r.json")["commands"][0]["smooth"]["linear"],
                         {"solver": "gmres", "tolerance": 1e-5, "max_iterations": 60, "restart": 20})
        for flag, value in (("--linear-tolerance", "1"), ("--linear-tolerance", "0"),
                            ("--linear-max-iterations", "0"), ("--linear-restart", "-3")):
            run = self.winslow("smooth", "ring.su2", "-o", "out.su2", flag, value, code=USAGE)
            self.assertIn(f"{flag}: found {value}, expected", run.stderr)

    def test_layers_that_only_recipes_could_set(self):
        self.ring()
        self.winslow("layers", "ring.su2", "-o", "out.su2", "--marker", "body", "--count", "2", "--first", "0.02",
                     "--crossing", "0.4", "--most-corrections", "3", "--save-recipe", "r.json")
        command = self.json("r.json")["commands"][0]
        self.assertEqual((command["crossing"], command["most_corrections"]), (0.4, 3))

    def test_a_saved_recipe_runs_as_it_is_from_anywhere(self):
        self.path("meshes").mkdir()
        self.path("recipes").mkdir()
        self.ring("meshes/ring.su2")
        self.winslow("move", "meshes/ring.su2", "-o", "meshes/out.su2", *MOVE, "--save-recipe",
                     "recipes/r.json")
        first = self.path("meshes/out.su2").read_bytes()
        os.remove(self.path("meshes/out.su2"))
        self.winslow("replay", self.path("recipes/r.json"), cwd="/")
        self.assertEqual(self.path("meshes/out.su2").read_bytes(), first)
        self.winslow("replay", "recipes/r.json", "--input", "meshes/ring.su2", "-o", "other.su2",
                     "--threads", "2")
        self.assertEqual(self.path("other.su2").read_bytes(), first)

    def test_displacements_from_a_file_beside_the_recipe(self):
        self.path("sub").mkdir()
        self.ring("sub/ring.su2")
        self.path("sub/d.csv").write_text("node,dx,dy\n3,0.01,0.02\n")
        self.recipe("sub/r.json", input="ring.su2", output="out.su2",
                    commands=[{"command": "deform", "markers": ["body"],
                               "displacements": {"file": "d.csv"}}])
        self.winslow("replay", "sub/r.json")
        before, _, _ = support.read_su2(self.path("sub/ring.su2"))
        after, _, _ = support.read_su2(self.path("sub/out.su2"))
        self.assertAlmostEqual(after[3][0] - before[3][0], 0.01)

    def test_exit_codes(self):
        self.ring()
        self.recipe("t.json", input="ring.su2", output="o.su2", commands=[{"command": "scramble"}])
        self.winslow("replay", "t.json", code=INVERTED)
        self.assertNotIn("o.su2", self.files())
        self.recipe("t.json", input="ring.su2", output="o.su2",
                    commands=[{"command": "smooth", "smooth": {"formulation": "pointwise", "outer": "picard",
                                            "max_iterations": 1}}])
        self.winslow("replay", "t.json", code=NOT_CONVERGED)
        self.recipe("t.json", commands=[])
        self.assertIn("--input", self.winslow("replay", "t.json", "-o", "o.su2", code=USAGE).stderr)
        self.assertIn("-o", self.winslow("replay", "t.json", "--input", "ring.su2",
                                         code=USAGE).stderr)
        self.recipe("t.json", input="ring.su2", output="o.su2",
                    commands=[{"command": "move", "markers": ["bodi"], "rotate": 1}])
        self.assertIn("did you mean body?", self.winslow("replay", "t.json", code=USAGE).stderr)

    def test_bad_recipes(self):
        self.path("t.json").write_text('{\n "winslow_recipe": 1,\n "commands": [\n  {"command": '
                                       '"smooth",\n   "smooth": {"dampin": 0.4}}]\n}\n')
        run = self.winslow("replay", "t.json", code=INPUT)
        self.assertIn("t.json:5: commands[0].smooth.dampin: unknown key", run.stderr)
        self.path("t.json").write_text('{\n "winslow_recipe": 1,\n "commands": [}\n')
        self.assertIn("t.json:3:", self.winslow("replay", "t.json", code=INPUT).stderr)
        self.winslow("replay", "none.json", code=INPUT)


if __name__ == "__main__":
    support.main()
