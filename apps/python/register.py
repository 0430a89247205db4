#!/usr/bin/env python3
"""Makes the module of a build importable by this Python, without variables.

register.py FOLDER writes gestell.pth, a line with FOLDER, into the user's site-packages (those of a virtual environment if
its Python runs this); register.py --remove removes it.  It prints one line, and ends with 1 where the import fails.
"""

import os
import pathlib
import site
import subprocess
import sys
import sysconfig


def place() -> pathlib.Path:
    """Where Python reads .pth files that its user may write."""
    if sys.prefix != sys.base_prefix:
        return pathlib.Path(sysconfig.get_paths()["purelib"]) / "gestell.pth"
    if not site.ENABLE_USER_SITE:
        raise SystemExit(f"Python: {sys.executable} has no site-packages for its user; set PYTHONPATH instead")
    return pathlib.Path(site.getusersitepackages()) / "gestell.pth"


def import_error(folder: pathlib.Path) -> str:
    """Why a new Python does not import the module from the folder; empty: it does."""
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    tried = subprocess.run([sys.executable, "-c", "import gestell; print(gestell.__file__)"], cwd="/", env=variables,
                           capture_output=True, text=True)
    if tried.returncode != 0:
        return tried.stderr.strip()[-500:] or f"it ended with {tried.returncode}"
    found = pathlib.Path(tried.stdout.strip()).parent
    return "" if found.resolve() == folder else f"it finds the module of {found}"


def main(argument: str) -> int:
    link = place()
    if argument == "--remove":
        link.unlink(missing_ok=True)
        print(f"Python: {link} is removed")
        return 0
    folder = pathlib.Path(argument).resolve()
    before = link.read_text().strip() if link.exists() else ""
    link.parent.mkdir(parents=True, exist_ok=True)
    link.write_text(f"{folder}\n")
    if error := import_error(folder):
        link.write_text(before + "\n") if before else link.unlink()
        print(f"Python: {sys.executable} cannot import gestell from {folder}:\n{error}", file=sys.stderr)
        return 1
    instead = f", instead of that in {before}" if before not in ("", str(folder)) else ""
    print(f"Python: 'import gestell' works in {sys.executable} by {link}{instead} (apps/python/register.py --remove undoes it)")
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    try:
        sys.exit(main(sys.argv[1]))
    except OSError as error:
        sys.exit(f"Python: {error}; set PYTHONPATH instead")
