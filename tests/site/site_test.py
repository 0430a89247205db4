"""The documents become a site by a strict build; one broken link, anchor or script from a network ends it, and is named."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

top = sys.argv.pop(1)

BROKEN = {
    "see [it](no_such.md)": "no_such.md",
    "see [it](help/faq.md#no-such-title)": "help/faq.html#no-such-title",
    "see [it](#no-such-title)": "#no-such-title",
    "see [it](../apps/scenes/no_such.toml)": "../apps/scenes/no_such.toml",
    "see [them](reference/scene/)": "reference/scene/",
    '<script src="https://example.org/x.js"></script>': "https://example.org/x.js",
}


class Tree:
    """The documents beside links to what else they name, to be spoilt."""

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        shutil.copytree(os.path.join(top, "docs"), os.path.join(self.folder.name, "docs"))
        for name in ("apps", "meshes", "tests", "README.md", "CHANGELOG.md", "CITATION.cff", ".ci"):
            os.symlink(os.path.join(top, name), os.path.join(self.folder.name, name))
        return self

    def __exit__(self, *_):
        self.folder.cleanup()

    def add(self, name, text):
        path = os.path.join(self.folder.name, "docs", name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)

    def build(self):
        site = os.path.join(self.folder.name, "docs", "site")
        return subprocess.run(
            ["mkdocs", "build", "--strict", "--config-file", os.path.join(site, "mkdocs.yml"), "--site-dir", self.path("pages")],
            capture_output=True, text=True)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def page(self, name):
        with open(self.path("pages", name), encoding="utf-8") as text:
            return text.read()


class Site(unittest.TestCase):
    def test_documents_become_pages(self):
        with Tree() as tree:
            tree.add("tutorials/first.md", "# Your first frame\n\nsee [press](../../apps/scenes/press.toml)\n![x](../../picture.png)\n")
            with open(tree.path("picture.png"), "wb") as picture:
                picture.write(b"\x89PNG\xff")
            tree.add("stray.md", "# A page of no group\n\n## Again\n\n## Again\n\nsee [the second](#again-1)\n")
            built = tree.build()
            self.assertEqual(built.returncode, 0, built.stderr)
            start = tree.page("index.html")
            for title in ("Tutorials", "Your first frame", "Theory", "A page of no group"):
                self.assertIn(title, start)
            more = start.split(">More<")[1].split("</ul>")[0]
            self.assertEqual(re.findall(r'href="([^"#]+)"', more), ["stray.html"], "documents that mkdocs.yml puts into no group")
            self.assertIn("closing_length", tree.page("tree/apps/scenes/press.toml.html"))
            self.assertTrue(os.path.exists(tree.path("pages", "tree", "picture.png")))
            self.assertIn("../tree/apps/scenes/press.toml.html", tree.page("tutorials/first.html"))

    def test_what_is_broken_is_named_and_fails(self):
        with Tree() as tree:
            for i, text in enumerate(BROKEN):
                tree.add(f"stray{i}.md", "# A page\n\n" + text + "\n")
            built = tree.build()
            self.assertNotEqual(built.returncode, 0)
            warnings = [line for line in (built.stderr + built.stdout).splitlines() if "WARNING" in line]
            for i, named in enumerate(BROKEN.values()):
                self.assertTrue(any(f"stray{i}.html: {named}: " in line for line in warnings), named)
            self.assertFalse([line for line in warnings if "stray" not in line])


if __name__ == "__main__":
    unittest.main()
