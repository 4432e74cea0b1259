"""The stub and the docstrings are what the tables of the program say."""

import ast
import inspect
import subprocess
import sys
import unittest

import winslow
from winslow import _winslow, tables
from support import ROOT, ring

STUB = ROOT / "src" / "python" / "winslow" / "__init__.pyi"
DOCUMENTED = ["smooth", "move", "deform", "layers", "scramble", "sweep"]


class Stub(unittest.TestCase):
    def test_it_is_made_anew(self):
        run = subprocess.run([sys.executable, "-B", ROOT / "docs" / "make_python.py", "--check"], capture_output=True,
                             text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_it_has_what_the_package_has(self):
        tree = ast.parse(STUB.read_text())
        names = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(names | {"__version__"}, set(winslow.__all__))
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and hasattr(winslow, node.name):
                kind = getattr(winslow, node.name)
                for member in node.body:
                    if isinstance(member, ast.FunctionDef):
                        self.assertTrue(hasattr(kind, member.name), f"{node.name}.{member.name}")

    def test_every_public_member_has_a_docstring(self):
        for name in winslow.__all__:
            member = getattr(winslow, name)
            if not isinstance(member, str):
                self.assertTrue(inspect.getdoc(member), name)

    def keywords(self, name):
        """The keywords of a function with their defaults, as the stub has them."""
        for node in ast.parse(STUB.read_text()).body:
            if isinstance(node, ast.FunctionDef) and node.name == name:
                return {a.arg: ast.literal_eval(d) for a, d in zip(node.args.kwonlyargs, node.args.kw_defaults)}
        return self.fail(name)

    def test_every_default_is_accepted(self):
        mesh = ring()
        own = {"bodies", "displacements", "positions", "nodes", "sine", "walls", "columns"}
        plain = {"smooth": {}, "scramble": {"allow_inverted": True}, "move": {"rotate": 1}}
        for name, more in plain.items():
            options = {k: v for k, v in self.keywords(name).items() if k not in own}
            options.update(more)
            self.assertGreater(len(options), 3)
            arguments = (mesh, "body") if name == "move" else (mesh,)
            self.assertEqual(getattr(winslow, name)(*arguments, **options)._name, name)

    def test_signatures(self):
        for name in DOCUMENTED:
            signature = inspect.signature(getattr(winslow, name))
            rows = {row["name"] for _, table in _winslow.tables_of(name) for row in table}
            self.assertLessEqual(rows, set(signature.parameters), name)
            self.assertLessEqual(rows, set(self.keywords(name)), name)
            self.assertLessEqual({row[0] for row in tables.own_options(name)}, set(signature.parameters))

    def test_docstrings_have_the_help_of_the_tables(self):
        text = " ".join(winslow.move.__doc__.split())
        for _, table in _winslow.tables_of("move"):
            for row in table:
                self.assertIn(f"{row['name']} : ", text)
                self.assertIn(" ".join(row["help"].split()), text)
        for heading in ("Parameters", "Returns", "Raises", "Smoothing", "Motion"):
            self.assertIn(heading, winslow.move.__doc__)
        self.assertIn("(1 to 64)", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
