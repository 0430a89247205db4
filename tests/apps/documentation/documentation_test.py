"""Runs the commands of a page as its reader would, and compares what is printed.

    documentation_test.py GESTELL usual|long PAGE     in a fresh folder, whose top looks like that of the sources
    documentation_test.py GESTELL lists               what is not run, links, scenes on pages, blocks of other languages
    documentation_test.py GESTELL gallery             every scene of apps/scenes is on the page, with picture and command
    documentation_test.py GESTELL times PAGE          runs all and tells CPU times
"""

import difflib
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib

import pages
import printed

HERE = pathlib.Path(__file__).resolve().parent


def entries_of(name):
    """Of not_run.toml or long.toml: page, begins, reason."""
    with open(HERE / name, "rb") as file:
        return tomllib.load(file)["command"]


def listed(name, page, block):
    return any(entry["page"] == str(page) and block.commands.lstrip().startswith(entry["begins"]) for entry in entries_of(name))


def root_copy(folder, gestell):
    """What commands name: the top of the sources, with the program that is tested."""
    for name in ("apps", "meshes", "tests"):
        (folder / name).symlink_to(pages.SOURCES / name)
    shutil.copytree(pages.SOURCES / "docs", folder / "docs")
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/bin").symlink_to(gestell.parent)


def environment(gestell):
    path = f"{gestell.parent}{os.pathsep}{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def answer_of(commands, folder, gestell):
    """Exit code and all that is printed by commands of a shell that stops at the first that fails."""
    done = subprocess.run(
        ["bash", "-e", "-o", "pipefail", "-c", commands],
        cwd=folder, env=environment(gestell), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout


def has_its_options(command, gestell):
    """A command with a placeholder for a file: the program has the subcommand and every option."""
    words = command.split(" #")[0].split()
    _, told = answer_of(f"gestell {words[1]} --help", "/", gestell)
    return [word for word in words if word.startswith("--") and not re.search(rf"{word}\b", told)]


def complaints_of(block, folder, gestell):
    if pages.PLACEHOLDER.search(block.commands) and "<<" not in block.commands:
        if block.commands.split()[0] != "gestell":
            return []
        return [f"`gestell help` has no option {word}" for word in has_its_options(block.commands, gestell)]
    code, answer = answer_of(block.commands, folder, gestell)
    if code != 0:
        return [f"exit code {code}:\n{answer}"]
    lost = [line for text in block.printed for line in printed.missing(text, answer)]
    return [f"not printed: {line}\n    nearest: {nearest(line, answer)}" for line in lost]


def nearest(line, answer):
    return max(answer.splitlines(), key=lambda other: difflib.SequenceMatcher(None, line, other).ratio(), default="")


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_page(page, gestell, with_long, tell_times=False):
    blocks = [block for block in pages.blocks(page) if not listed("not_run.toml", page, block)]
    skipped = [] if with_long else [block for block in blocks if listed("long.toml", page, block)]
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if "tutorials" not in page.parts:
            root_copy(folder, gestell)
        for block in blocks:
            if block in skipped:
                continue
            before = cpu_seconds()
            complaints = complaints_of(block, folder, gestell)
            if tell_times:
                print(f"{cpu_seconds() - before:8.2f} s  {block.commands.strip().splitlines()[-1]}", flush=True)
            if complaints:
                failed += 1
                print(f"--- {page}\n{block.commands}", *complaints, sep="\n", flush=True)
    print(f"{page}: {len(blocks) - len(skipped)} blocks, {failed} failed, {cpu_seconds():.1f} CPU s")
    return failed


def check_lists(gestell):
    """Entries that no page has, without a reason, or too many; scenes and blocks that no test knows."""
    wrong = []
    for name in ("not_run.toml", "long.toml"):
        entries = entries_of(name)
        wrong += [f"{name}: {complaint}" for entry in entries for complaint in wrong_entry(entry)]
        if len(entries) > 15:
            wrong.append(f"{name} has become long")
    wrong += unknown_languages() + dead_links() + wrong_scenes(gestell) + outdated_tables(gestell)
    print(*wrong, sep="\n")
    return len(wrong)


def wrong_entry(entry):
    page, wrong = entry["page"], []
    exists = (pages.SOURCES / page).exists()
    if not exists or not any(block.commands.lstrip().startswith(entry["begins"]) for block in pages.blocks(page)):
        wrong.append(f"{page} has no command `{entry['begins']}`")
    if len(entry.get("reason", "")) < 20:
        wrong.append(f"`{entry['begins']}` needs a reason")
    return wrong


TESTERS = {  # of pages with blocks of other languages: the test that reads them
    "docs/reference/python.md": ("tests/apps/python/CMakeLists.txt", {"python"}),
    "docs/how_to/python_first_hour.md": ("tests/apps/python/CMakeLists.txt", {"python"}),
    "docs/reference/library.md": ("tests/apps/package/installed_test.py", {"cpp", "cmake"}),
    "docs/develop": ("tests/site/how_to_test.py", {"cpp", "diff"}),
}


def unknown_languages():
    wrong = []
    for page in pages.pages():
        _, known = TESTERS.get(str(page)) or TESTERS.get(str(page.parent)) or ("", set())
        kinds = {kind for kind, _ in pages.FENCE.findall(pages.text_of(page))} - {"sh", "text", "toml", ""}
        wrong += [f"{page}: no test knows blocks of '{kind}'" for kind in sorted(kinds - known)]
    for page, (tester, _) in TESTERS.items():
        if page not in (pages.SOURCES / tester).read_text(encoding="utf-8"):
            wrong.append(f"{tester} does not run {page}")
    return wrong


def dead_links():
    """Links to files and pictures that are not there."""
    return [
        f"{page}: there is no {target}"
        for page in pages.pages()
        for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", pages.FENCE.sub("", pages.text_of(page)))
        if "://" not in target and not (pages.SOURCES / page.parent / target).exists()
    ]


def outdated_tables(gestell):
    """Pages whose generated tables (keys, options, files, members) differ from those of the program."""
    with tempfile.TemporaryDirectory() as name:
        copy = pathlib.Path(name) / "docs"
        shutil.copytree(pages.SOURCES / "docs", copy)
        code, answer = answer_of(f"gestell help --renew {copy}", name, gestell)
        if code != 0:
            return [f"gestell help --renew: {answer}"]
        paths = [path.relative_to(copy) for path in copy.rglob("*") if path.suffix in (".md", ".json")]
        return [
            f"docs/{path}: a generated table is outdated: gestell help --renew docs"
            for path in paths
            if (copy / path).read_bytes() != (pages.SOURCES / "docs" / path).read_bytes()
        ]


def is_part(part, whole):
    if isinstance(part, dict):
        return isinstance(whole, dict) and all(key in whole and is_part(value, whole[key]) for key, value in part.items())
    return part == whole


def wrong_scenes(gestell):
    """Blocks of TOML: they can be read; what is from a file stands there; whole scenes are well formed."""
    wrong = []
    for page in pages.pages():
        text = pages.text_of(page)
        for fence in pages.FENCE.finditer(text):
            if fence.group(1) == "toml":
                runs = not pages.changes_the_program(page)
                wrong += [f"{page}: {complaint}" for complaint in wrong_scene(fence.group(2), text[: fence.start()], runs, gestell)]
    return wrong


def wrong_scene(body, before, runs, gestell):
    try:
        entries = tomllib.loads(body)
    except tomllib.TOMLDecodeError as error:
        return [f"{error} in\n{body}"]
    source = re.search(r"From `([^`]*\.toml)`:\s*$", before)
    if source:
        with open(pages.SOURCES / source.group(1), "rb") as file:
            return [] if is_part(entries, tomllib.load(file)) else [f"the block is not part of {source.group(1)}"]
    if runs and "run" in entries and "output" in entries:
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "scene.toml").write_text(body, encoding="utf-8")
            code, answer = answer_of("gestell check scene.toml", name, gestell)
            return [] if code == 0 else [answer]
    return []


def check_gallery():
    """docs/reference/gallery.md against apps/scenes and the pictures, which may not grow beyond 2 MB."""
    page, pictures = pages.text_of("docs/reference/gallery.md"), pages.SOURCES / "docs/images/gallery"
    scenes = sorted(path.stem for path in (pages.SOURCES / "apps/scenes").glob("*.toml"))
    wrong = [f"gallery: no {what}" for name in scenes for what in (f"(../images/gallery/{name}.png)", f"gestell run apps/scenes/{name}.toml") if what not in page]
    wrong += [f"gallery: no picture {name}.png" for name in scenes if not (pictures / f"{name}.png").is_file()]
    shown = re.findall(r"\(\.\./images/gallery/(\w+)\.png\)", page)
    wrong += [f"gallery: there is no scene {name}" for name in {*shown, *(path.stem for path in pictures.glob("*.png"))} - set(scenes)]
    size = sum(path.stat().st_size for path in pictures.iterdir())
    if size > 2e6:
        wrong.append(f"gallery: {size} bytes of pictures")
    print(*wrong, sep="\n")
    return len(wrong)


def main():
    gestell, what = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    if what == "lists":
        return check_lists(gestell)
    if what == "gallery":
        return check_gallery()
    return run_page(pathlib.Path(sys.argv[3]), gestell, with_long=what != "usual", tell_times=what == "times")


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
