"""A build's module is found without variables.  The folder of the module is the argument."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv.pop(1)).resolve()
REGISTER = pathlib.Path(__file__).resolve().parents[3] / "apps" / "python" / "register.py"


class Module(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.home = home.name

    def python(self, *arguments, cwd="/"):
        variables = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        return subprocess.run([sys.executable, *arguments], cwd=cwd, capture_output=True, text=True, env={**variables, "HOME": self.home})

    def test_is_imported_from_anywhere_until_it_is_removed(self):
        self.assertNotEqual(self.python("-c", "import gestell").returncode, 0)
        made = self.python(REGISTER, FOLDER)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(made.stdout.count("\n"), 1)
        self.assertIn("gestell.pth", made.stdout)
        found = self.python("-c", "import gestell; print(gestell.__file__)")
        self.assertTrue(pathlib.Path(found.stdout.strip()).samefile(FOLDER / "gestell.py"), found.stderr)
        self.assertIn("removed", self.python(REGISTER, "--remove").stdout)
        self.assertNotEqual(self.python("-c", "import gestell").returncode, 0)

    def test_of_another_build_is_named_when_it_is_replaced(self):
        self.python(REGISTER, FOLDER)
        link = next(pathlib.Path(self.home).rglob("gestell.pth"))
        link.write_text("/another/build\n")
        self.assertIn("instead of that in /another/build", self.python(REGISTER, FOLDER).stdout)

    def test_that_cannot_be_imported_leaves_things_as_they_were(self):
        self.python(REGISTER, FOLDER)
        failed = self.python(REGISTER, self.home)
        self.assertEqual(failed.returncode, 1)
        self.assertIn("cannot import gestell", failed.stderr)
        self.assertEqual(self.python("-c", "import gestell").returncode, 0)


if __name__ == "__main__":
    unittest.main()
