"""The words of docs, messages, comments of headers and test names, against words.tsv: README.md.

    words_test.py TREE                       checks
    words_test.py TREE --list [FILE ...]     prints every hit, those to review too, with a better wording
    words_test.py TREE --lower               writes counts that have fallen into counts.tsv"""

import collections
import csv
import pathlib
import re
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SENTENCE = 32  # words at most
PROGRAM = ("apps", "coupling", "fem", "mechanism")
GENERATED = ("docs/trust/verification.md",)
CODE = re.compile(r"^ *```.*?^ *```$|<!--.*?-->|(?<=\n\n)(?: {4}[^\n]*\n)+", re.S | re.M)
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((.*?)\)\1"|"((?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\\n])\'', re.S)
BETWEEN = re.compile(r'\s*(?:(?:\+|<<)[^;"{}]{0,200}(?:\+|<<))?\s*')
TEST = re.compile(r"^(?:TYPED_)?TEST(?:_[FP])?\((\w+),\s*(\w+)\)", re.M)
Rule = collections.namedtuple("Rule", "pattern where better why")


def rows_of(name):
    with open(HERE / name, encoding="utf-8", newline="") as file:
        return list(csv.reader(file, delimiter="\t", quoting=csv.QUOTE_NONE))[1:]


RULES = [Rule(re.compile(row[0]), *row[1:]) for row in rows_of("words.tsv")]
IGNORED = [(where, re.compile(text)) for where, text, _ in rows_of("ignore.tsv")]


def paragraphs(page):
    """(line, text) of paragraphs, items, headings and cells of a page, without code, links and comments."""
    page = CODE.sub(lambda block: "\n" * block[0].count("\n"), page)
    open_at, text = 0, ""
    for at, line in enumerate(page.splitlines() + [""], 1):
        line = re.sub(r"!?\[([^\]]*)\]\([^)\s]*\)", r"\1", re.sub(r"(`+).+?\1", "CODE", line))
        starts = re.match(r" *([-*] |\d+\. |#|>|\|)|\s*$", line)
        if (starts or not text) and text:
            yield open_at, text
            text = ""
        if line.startswith("|"):
            yield from ((at, cell.strip()) for cell in line.split("|") if cell.strip(" -:"))
        elif line.strip() and text:
            text += " " + line.strip()
        elif line.strip():
            open_at, text = at, re.sub(r"^ *([-*>]|\d+\.|#+) +", "", line).strip()


def strings(source):
    """(line, text) of string literals, neighbours joined, X for an expression between two."""
    source = re.sub(r'^\s*#.*$', "", source, flags=re.M)
    found, end = [], 0
    for token in TOKEN.finditer(source):
        if token[2] is None and token[3] is None:
            continue
        text = token[2] if token[2] is not None else re.sub(r"\\(.)", lambda escape: {"n": "\n"}.get(escape[1], escape[1]), token[3])
        between = source[end : token.start()]
        if found and BETWEEN.fullmatch(between):
            found[-1][1] += text if not between.strip() else f"X{text}"
        else:
            found.append([source.count("\n", 0, token.start()) + 1, text])
        end = token.end()
    return [(line, text) for line, text in found if " " in text]


def comments(source):
    """(line, text) of blocks of // comments."""
    for block in re.finditer(r"(?:^[^\n\"]*?//[^\n]*\n)(?:^\s*//[^\n]*\n)*", source, re.M):
        text = " ".join(line.partition("//")[2].strip("/< ") for line in block[0].splitlines())
        yield source.count("\n", 0, block.start()) + 1, re.sub(r"`[^`]*`", "CODE", text)


def test_names(source):
    """(line, text) of names of tests, as they are and as words."""
    for test in TEST.finditer(source):
        words = re.sub(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", test[2]).lower()
        yield source.count("\n", 0, test.start()) + 1, f"{test[2]} | {words}"


def texts(top):
    """(path, places of words.tsv that apply, line, text) of all that is read."""
    pages = [top / "README.md", top / "CHANGELOG.md", *(top / "docs").rglob("*.md")]
    kinds = [(page, {"all", "docs"}, paragraphs) for page in pages]
    for folder in PROGRAM:
        kinds += [(path, {"all", "message"}, strings) for end in ("cc", "h") for path in (top / folder).rglob(f"*.{end}")]
        kinds += [(path, {"all"}, comments) for path in (top / folder).rglob("*.h")]
    kinds += [(path, {"all", "code"}, test_names) for path in (top / "tests").rglob("*_test.cc")]
    for path, where, reader in kinds:
        name = path.relative_to(top).as_posix()
        if name not in GENERATED:
            for line, text in reader(path.read_text(encoding="utf-8")):
                yield name, where, line, text


def without_ignored(name, text):
    for where, pattern in IGNORED:
        if pathlib.PurePath(name).match(where):
            text = pattern.sub("~", text)
    return text


def hits(top, why="[error]"):
    """{path: [(line, wording, better)]}"""
    found = collections.defaultdict(list)
    for name, where, line, text in texts(top):
        text = without_ignored(name, text)
        for rule in RULES:
            if rule.where in where and why in rule.why:
                found[name] += [(line, text[max(0, hit.start() - 25) : hit.end() + 15].replace("\n", " "), rule.better)
                                for hit in rule.pattern.finditer(text)]
    return found


def long_sentences(top):
    for page in [top / "README.md", *sorted((top / "docs/tutorials").glob("*.md"))]:
        for line, text in paragraphs(page.read_text(encoding="utf-8")):
            for sentence in re.split(r"(?<=[.!?])\)?\s+(?=[(A-Z`*\"])", text):
                count = len(re.findall(r"\S*\w\S*", sentence))
                if count > SENTENCE:
                    yield f"{page.relative_to(top)}:{line}: {count} words: {sentence}"


class Words(unittest.TestCase):
    top = pathlib.Path(".")

    def test_counts_only_fall(self):
        found, wrong = hits(self.top), []
        counts = {name: int(count) for name, count in rows_of("counts.tsv")}
        for name in sorted({*found, *counts}):
            now, most = len(found[name]), counts.get(name, 0)
            if now > most:
                wrong += [f"{name}: {now} hits, {most} allowed"] + [f"  {line}: {text!r}: {better}" for line, text, better in found[name]]
            elif now < most:
                wrong.append(f"{name}: {now} hits, counts.tsv has {most}: run words_test.py TREE --lower")
        if wrong:
            self.fail("\n" + "\n".join(wrong))

    def test_sentences_are_short(self):
        wrong = list(long_sentences(self.top))
        if wrong:
            self.fail("\n" + "\n".join(wrong))

    def test_troubleshooting_quotes_the_program(self):
        sources = [path for folder in PROGRAM for end in ("cc", "h") for path in (self.top / folder).rglob(f"*.{end}")]
        printed = [text for path in sources for _, text in strings(path.read_text(encoding="utf-8"))]
        page = (self.top / "docs/help/troubleshooting.md").read_text(encoding="utf-8")
        messages = re.findall(r"^\| (`+)(.+?)\1 \|", page, re.M)
        self.assertEqual(len(messages), 25)
        pieces = [piece.strip() for _, message in messages for piece in message.split("...") if len(piece.strip()) > 9]
        self.assertFalse([piece for piece in pieces if not any(piece in text for text in printed)])

    def test_every_exception_has_a_reason(self):
        self.assertFalse([row for row in rows_of("ignore.tsv") if len(row) != 3 or len(row[2]) < 15])

    def test_readers(self):
        page = "# A `b`\n\none [two](x.md)\nthree\n\n    code\n    code\n\n- item\n  more\n\n```\nx\n```\n| a | b |\n|---|---|\n"
        self.assertEqual([text for _, text in paragraphs(page)], ["A CODE", "one two three", "item more", "a", "b"])
        self.assertEqual(strings('f("a b"\n  "c " + x + " d", "e f"); // "no no"'), [(1, "a bc X d"), (2, "e f")])
        self.assertEqual(list(comments("int a; ///< b\n// c\n")), [(1, "b c")])
        self.assertEqual(list(test_names("TEST(A, IsToldAnew)\n")), [(1, "IsToldAnew | is told anew")])


def lower(top):
    found = hits(top)
    counts = {name: int(count) for name, count in rows_of("counts.tsv")}
    lines = [f"{name}\t{min(most, len(found[name]))}" for name, most in sorted(counts.items()) if found[name]]
    (HERE / "counts.tsv").write_text("\n".join(["file\thits", *lines]) + "\n", encoding="utf-8")


def main():
    Words.top = pathlib.Path(sys.argv.pop(1)).resolve()
    if "--lower" in sys.argv:
        lower(Words.top)
    elif "--list" in sys.argv:
        for name, places in sorted(hits(Words.top, "[").items()):
            if not sys.argv[2:] or name in sys.argv[2:]:
                print(*(f"{name}:{line}: {text!r}: {better}" for line, text, better in places), sep="\n")
    else:
        unittest.main()


if __name__ == "__main__":
    main()
