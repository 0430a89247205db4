"""Pages of README and docs as their readers use them: blocks of commands, and what is said to be printed behind them."""

import dataclasses
import pathlib
import re

SOURCES = pathlib.Path(__file__).resolve().parents[3]

COMMAND = re.compile(r"(\./|\.ci/|build/release/|~/|(gestell|gestell_random_machines|mpirun|srun|cmake|ctest|apt|export|paraview)\b)")
PLACEHOLDER = re.compile(r"(?<![\w$./-])(SCENE|SEED|DIR|FILE|STUDY|KEY|KIND|CASES)\b")
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.S | re.M)
INDENTED = re.compile(r"(?:^    .*\n)+", re.M)


@dataclasses.dataclass
class Block:
    """Commands that a shell reads, and the blocks that are said to be printed."""

    commands: str
    printed: list = dataclasses.field(default_factory=list)


def pages():
    """README.md and all pages of docs, relative to the sources."""
    found = [SOURCES / "README.md", *sorted((SOURCES / "docs").rglob("*.md"))]
    return [path.relative_to(SOURCES) for path in found]


def text_of(page):
    return (SOURCES / page).read_text(encoding="utf-8")


def changes_the_program(page):
    """Pages whose commands need the source that they add: followed in a copy of the tree by tests/site/how_to_test.py."""
    return str(page).startswith("docs/develop/add_")


def fenced(text, language):
    return [body for kind, body in FENCE.findall(text) if kind == language]


def joined(lines):
    """Commands of an indented block: lines that begin as one, with those a backslash continues."""
    commands, open_line = [], False
    for line in lines:
        if open_line:
            commands[-1] += "\n" + line
        elif COMMAND.match(line):
            commands.append(line)
        else:
            continue
        open_line = line.endswith("\\")
    return commands


def blocks(page):
    """Commands of a page in their order: those fenced as sh with what is printed, those indented one by one."""
    if changes_the_program(page):
        return []
    text, found, at = text_of(page), [], 0
    for fence in FENCE.finditer(text):
        found += indented(text[at : fence.start()])
        at = fence.end()
        kind, body = fence.groups()
        if kind == "sh":
            found.append(Block(body))
        elif kind == "text" and found:
            found[-1].printed.append(body)
    return found + indented(text[at:])


def indented(text):
    return [
        Block(command)
        for block in INDENTED.findall(text)
        for command in joined(line[4:] for line in block.splitlines())
    ]
