"""Manual page and completions: made of the parser, so that they have what the help has."""
import re
import shutil
import subprocess
import unittest

import support
from support import USAGE, ProgramTest

SHELLS = ("bash", "fish", "zsh")


class Shells(ProgramTest):
    @classmethod
    def setUpClass(cls):
        run = lambda *args: subprocess.run([support.WINSLOW, *args], check=True, text=True,
                                           capture_output=True).stdout
        cls.commands = re.findall(r"^  ([a-z]+) ", run("--help").split("Subcommands:")[1], re.M)
        cls.help = {c: run(c, "--help") for c in cls.commands}
        cls.flags = {c: set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", text, re.M))
                     for c, text in cls.help.items()}
        cls.scripts = {s: run("reference", s) for s in SHELLS}
        cls.manual = run("reference", "man")

    def write(self, shell):
        path = self.path(f"winslow.{shell}")
        path.write_text(self.scripts[shell])
        return path

    def run_in(self, program, script, *args):
        done = subprocess.run([program, *args, script], cwd=self.folder, text=True,
                              capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), script)
        return done.stdout.splitlines()

    def bash(self, line):
        """What bash offers at the end of a line."""
        words = line.split(" ")
        quoted = " ".join("'" + w + "'" for w in words)
        return self.run_in("bash", f"source ./winslow.bash; COMP_WORDS=({quoted}); "
                           f"COMP_CWORD={len(words) - 1}; _winslow; "
                           'printf "%s\\n" "${COMPREPLY[@]}"', "-c")

    def test_there_is_something_to_compare_with(self):
        for command in ("smooth", "move", "deform", "layers", "quality", "convert", "replay"):
            self.assertIn(command, self.commands)
        for command in ("render", "studio"):
            self.assertEqual(command in self.commands, support.HAS_GUI)
        self.assertIn("--pivot", self.flags["move"])
        self.assertIn("--formulation", self.flags["smooth"])
        self.assertGreater(sum(map(len, self.flags.values())), 150)

    def test_the_manual_has_every_command_and_option(self):
        plain = self.manual.replace("\\-", "-")
        for command, flags in self.flags.items():
            self.assertIn(f".SS winslow {command}\n", plain)
            for flag in flags:
                self.assertRegex(plain, rf"\\fB{flag}\\fR")
        for status in ("130 interrupted", "5 not converged"):
            self.assertIn(status, plain)

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_groff_reads_the_manual_without_a_warning(self):
        done = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-P-cbou"], input=self.manual,
                              text=True, capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = re.sub(r"\s+", " ", done.stdout.replace("-\n", "-"))
        self.assertIn("WINSLOW(1)", text)
        self.assertIn("--pivot X Y", text)
        self.assertIn("0.026 / Re^(1/7)", text)

    def test_bash_completes_commands_and_options(self):
        self.write("bash")
        offered = self.bash("winslow ")
        self.assertEqual([w for w in offered if not w.startswith("-")], self.commands)
        self.assertEqual(self.bash("winslow smo"), ["smooth"])
        for command, flags in self.flags.items():
            self.assertEqual({w for w in self.bash(f"winslow {command} --") if w.startswith("--")}, flags)
        self.assertEqual(self.bash("winslow move ring.su2 --piv"), ["--pivot"])
        # A new option, without a value of its own, after one that has all it takes.
        self.assertEqual(self.bash("winslow move --pivot 0 0 --rot"), ["--rotate"])

    def test_bash_completes_what_options_take(self):
        self.write("bash")
        self.assertEqual(self.bash("winslow smooth --formulation "), ["variational", "pointwise"])
        self.assertEqual(self.bash("winslow smooth --formulation p"), ["pointwise"])
        self.assertEqual(self.bash("winslow smooth in.su2 --targets element v"), ["vcv"])
        self.assertEqual(self.bash("winslow deform --fade "), ["none", "start", "end", "both"])
        if support.HAS_GUI:
            self.assertIn("smallest_angle", self.bash("winslow render --color small"))
        # Numbers are for the user, also negative ones; files are for the shell.
        self.assertEqual(self.bash("winslow move --rotate -4"), [""])
        self.assertEqual(self.bash("winslow move --pivot 0 "), [""])
        self.assertEqual(self.bash("winslow smooth --report "), [""])

    def test_bash_knows_the_markers_of_the_mesh(self):
        self.write("bash")
        self.ring()
        self.assertEqual(self.bash("winslow move ring.su2 --marker "), ["body", "farfield"])
        self.assertEqual(self.bash("winslow move ring.su2 --marker f"), ["farfield"])
        self.assertEqual(self.bash("winslow layers ring.su2 -o o.su2 --marker b"), ["body"])
        self.winslow("convert", "ring.su2", "ring.msh", "--quiet")
        self.assertEqual(self.bash("winslow move ring.msh --hold-layers "), ["body", "farfield"])
        self.assertEqual(self.bash("winslow move --marker "), [""])
        # A body has names, then keys.
        self.assertEqual(self.bash("winslow move ring.su2 --body b"), ["body"])
        self.assertEqual(self.bash("winslow move ring.su2 --body body "),
                         ["rotate=", "axis=", "pivot=", "translate="])
        self.assertEqual(self.bash("winslow move ring.su2 --body body rotate=5 p"), ["pivot="])

    def test_the_scripts_have_every_option_of_every_command(self):
        for command, flags in self.flags.items():
            part = re.search(rf"^    {command}\)\n      _arguments(.*?);;", self.scripts["zsh"], re.S | re.M)
            for flag in flags:
                self.assertIn(f"{flag}[", part[1])
                self.assertRegex(self.scripts["fish"], rf"seen_subcommand_from [a-z ]*\b{command}\b[a-z ]*'"
                                 rf"(?: -s \w)? -l {flag[2:]} ")

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        self.write("fish")
        self.ring()
        fish = lambda line: [w.split("\t")[0] for w in self.run_in(
            "fish", f"source ./winslow.fish; complete -C '{line}'", "--no-config", "-c")]
        self.assertEqual(fish("winslow smo"), ["smooth"])
        self.assertEqual(set(fish("winslow smooth --formulation ")), {"variational", "pointwise"})
        self.assertEqual(fish("winslow move --piv"), ["--pivot"])
        self.assertEqual(fish("winslow move ring.su2 --marker f"), ["farfield"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_reads_the_script(self):
        path = self.write("zsh")
        self.assertEqual(self.run_in("zsh", str(path), "-f", "-n"), [])
        done = self.run_in("zsh", "autoload -Uz compinit && compinit -u -D && source ./winslow.zsh && "
                           "print $_comps[winslow]", "-f", "-c")
        self.assertEqual(done, ["_winslow"])

    def test_an_unknown_name_is_refused(self):
        self.assertIn("did you mean bash?", self.winslow("reference", "bush", code=USAGE).stderr)


if __name__ == "__main__":
    support.main()
