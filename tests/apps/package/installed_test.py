"""What `cmake --install` and `cpack` give, in an empty folder: arguments are sources, build, names of tests."""

import gzip
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

SOURCES, BUILD = (pathlib.Path(path) for path in (sys.argv.pop(1), sys.argv.pop(1)))
FIRST_REPORT = 60.  # s, from nothing


def called(*command, folder, **environment):
    clean = {key: value for key, value in os.environ.items() if not key.startswith(("GESTELL", "PYTHONPATH"))}
    done = subprocess.run([str(word) for word in command], cwd=folder, env=clean | environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, f"{command} ends with {done.returncode}:\n{done.stdout}"
    return done.stdout


class Tree(unittest.TestCase):
    """Checks of an installed tree at self.prefix, in the folder self.folder."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def call(self, *command):
        return called(*command, folder=self.folder, GESTELL_CACHE=str(self.folder / "cache"),
                      PYTHONPATH=str(self.prefix / "lib/python3/dist-packages"), PYTHONDONTWRITEBYTECODE="1")

    def computes(self, begin):
        scenes, gestell = self.prefix / "share/gestell/scenes", self.prefix / "bin/gestell"
        self.call(gestell, "run", scenes / "press_minimal.toml", "-o", "first", "--quiet")
        self.assertGreater((self.folder / "first/report.html").stat().st_size, 1000)
        self.assertLess(time.monotonic() - begin, FIRST_REPORT)
        # its own frame from CAD, so that the plugin is found and loaded
        if (BUILD / "bin/libgestell_frame.so").exists():
            self.call(gestell, "reduce", scenes / "portal_slider_crank.toml", "--quiet", "-o", "frame")
        self.call("/usr/bin/python3" if os.path.exists("/usr/bin/python3") else sys.executable, "-c",
                  "import gestell; print(gestell.__file__); gestell.example('press_minimal').run(peaks='F_P')")

    def tells_of_itself(self):
        """Man page, completion, scenes to start from."""
        with gzip.open(self.prefix / "share/man/man1/gestell.1.gz", "rt") as page:
            self.assertIn(".TH GESTELL 1", page.read())
        for name, words in (("zsh/vendor-completions/_gestell", "#compdef gestell"),
                            ("bash-completion/completions/gestell", "complete -F")):
            self.assertIn(words, (self.prefix / "share" / name).read_text(encoding="utf-8"))
        self.call(self.prefix / "bin/gestell", "new", "press")
        self.assertIn("is valid", self.call(self.prefix / "bin/gestell", "check", "press.toml"))

    def verifies_itself(self):
        """Cases and tables of reference lie beside the program."""
        self.assertIn("all passed", self.call(self.prefix / "bin/gestell", "verify", "press", "mechanisms", "-o", "verified"))

    def lies_anywhere(self):
        """No run path leads into the build."""
        for path in self.prefix.rglob("*"):
            if not path.is_file():
                continue
            with path.open("rb") as file:
                begin = file.read(4)
            if begin == b"\x7fELF":
                self.assertNotIn(str(BUILD), self.call("readelf", "-d", path))


class Prefix(Tree):
    def test_runs_from_where_it_is_moved(self):
        begin = time.monotonic()
        called("cmake", "--install", BUILD, "--prefix", self.folder / "installed", folder=self.folder)
        self.prefix = self.folder / "moved"
        (self.folder / "installed").rename(self.prefix)
        self.computes(begin)
        self.lies_anywhere()
        self.tells_of_itself()
        self.verifies_itself()
        self.builds_examples()

    def builds_examples(self):
        page = (SOURCES / "docs/reference/library.md").read_text(encoding="utf-8")
        project = self.folder / "project"
        project.mkdir()
        (project / "CMakeLists.txt").write_text(re.search(r"^```cmake\n(.*?)^```", page, re.S | re.M)[1])
        for block in re.findall(r"^```cpp\n(.*?)^```", page, re.S | re.M):
            (project / re.match(r"// (\w+\.cc)", block)[1]).write_text(block)
        for header in sorted((self.prefix / "include/gestell").iterdir()):
            with self.subTest("compiles alone", header=header.name):
                alone = project / "alone.cc"
                alone.write_text(f"#include <gestell/{header.name}>\n#include <gestell/{header.name}>\n")
                self.call("g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-pedantic", "-fsyntax-only",
                          f"-I{self.prefix / 'include'}", alone)
        flags = called("pkg-config", "--cflags", "--libs", "gestell", folder=self.folder,
                       PKG_CONFIG_PATH=str(self.prefix / "lib/pkgconfig")).split()
        self.call("g++", "-std=c++17", project / "duffing.cc", *flags, f"-Wl,-rpath,{self.prefix / 'lib'}", "-o", "plain")
        self.assertIn("energy 0.75", self.call("./plain"))
        self.call("cmake", "-S", project, "-B", "out", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.call("cmake", "--build", "out")
        self.assertIn("energy 0.75", self.call("out/duffing"))
        told = self.call("out/stiffer_rod", self.prefix / "share/gestell/scenes/press_minimal.toml")
        self.assertIn("lowest vibration 11.", told)
        self.assertEqual(told.count(" N/m: "), 3)


class DebianPackage(Tree):
    def test_runs_unpacked(self):
        called("cpack", "--config", BUILD / "CPackConfig.cmake", "-G", "DEB", "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip",
               "-B", self.folder / "packed", folder=self.folder)
        package, = (self.folder / "packed").glob("gestell_*.deb")
        begin = time.monotonic()
        called("dpkg-deb", "-x", package, self.folder / "root", folder=self.folder)
        self.prefix = self.folder / "root/usr"
        self.assertEqual([path.name for path in (self.folder / "root").iterdir()], ["usr"])
        self.computes(begin)
        self.lies_anywhere()
        self.tells_of_itself()
        self.verifies_itself()
        depends = called("dpkg-deb", "-f", package, "Depends", folder=self.folder)
        for needed in ("libdeal.ii", "libvtk9", "libopenblas0", "python3-numpy", "libpetsc-real"):
            self.assertIn(needed, depends)


if __name__ == "__main__":
    unittest.main()
