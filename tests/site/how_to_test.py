"""The pages docs/develop/add_* still fit the tree: new files are new, and what is shown of others can be applied.

    how_to_test.py TREE                   checks
    how_to_test.py TREE --into COPY PAGE  follows a page in a copy of the tree"""

import os
import re
import subprocess
import sys

BLOCK = re.compile(r"```(\w+)\n(.*?)```\n", re.S)


def steps(page):
    """(path, text) of new files, ("", diff) of changes, in the order of the page."""
    text = open(page, encoding="utf-8").read()
    for block in BLOCK.finditer(text):
        named = re.findall(r"^`([\w./]+)`", text[:block.start()], re.M)
        if block[1] == "diff":
            yield from (("", one) for one in re.split(r"^(?=--- a/)", block[2], flags=re.M) if one)
        elif block[1] in ("cpp", "toml") and named:
            yield named[-1], block[2]


def apply(change, tree, *options):
    return subprocess.run(["git", "apply", "--recount", *options, "-"], input=change, cwd=tree, text=True, capture_output=True)


def follow(page, tree):
    for path, text in steps(page):
        if not path:
            done = apply(text, tree)
            if done.returncode:
                raise SystemExit(f"{page}: {done.stderr}")
            continue
        target = os.path.join(tree, path)
        with open(target, "w", encoding="utf-8") as out:
            out.write(text)


def check(top):
    shown, wrong = 0, []
    for name in sorted(name for name in os.listdir(os.path.join(top, "docs/develop")) if name.startswith("add_")):
        for path, text in steps(os.path.join(top, "docs/develop", name)):
            shown += 1
            if path and os.path.exists(os.path.join(top, path)):
                wrong.append(f"{name}: {path} is there already")
            elif not path and (failed := apply(text, top, "--check")).returncode:
                wrong.append(f"{name}: {failed.stderr}")
    if shown < 10:
        wrong.append(f"only {shown} blocks were found")
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    if len(sys.argv) == 5 and sys.argv[2] == "--into":
        follow(sys.argv[4], sys.argv[3])
    else:
        check(sys.argv[1])
