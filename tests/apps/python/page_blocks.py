"""Runs the blocks of a page that are marked as python, one after another, in an empty folder."""

import os
import re
import sys
import tempfile

with open(sys.argv[1], encoding="utf-8") as page:
    blocks = re.findall(r"^```python\n(.*?)^```", page.read(), re.S | re.M)
assert len(blocks) > 5, "the page has lost its blocks"
names = {}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"block {number}", "exec"), names)
    os.chdir("/")
if "swing" in names:
    assert abs(names["swing"]["x"] - names["exact"]).max() < 1e-7, "the oscillator of the page is not the one it says"
