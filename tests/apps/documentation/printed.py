"""Whether a line that a page shows is one that a command has printed."""

import os
import re

PAGES_GMSH = "4.8"  # whose meshes the pages show
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\d])", re.I)
OF_COMPUTING = re.compile(r", [\d.e-]+ s$")  # seconds that the work took
OF_COLUMN = 1e-5  # what a mesh and an iteration leave where symmetry has nothing, beside the largest number of the column
ROUNDING = 1e-12  # of doubles, beside the largest number of the line
RELATIVE = 2e-3  # of each number, between processors, beyond the last digit shown
DIFFERENCE = 0.0  # of the results whose difference is shown
if os.environ.get("GESTELL_GMSH", PAGES_GMSH) != PAGES_GMSH:
    # Results of two meshes of one size differ by at most the sum of their errors.  The pages estimate these: 1.5 % at the first
    # frequencies, so that cells as alike as those of two versions (their numbers differ by 0.3 %) stay within 1 %; 0.23 % at the
    # force F_rod.min.  A difference of results changes by as much as they do, which may be a large part of it.
    RELATIVE = 1e-2
    DIFFERENCE = 2e-3
ERROR = re.compile(r"\b(?:mesh|reduction|time|total) error\b")  # headings of the error budget


def skeleton(line):
    return re.sub(r"\s+", " ", NUMBER.sub("0", OF_COMPUTING.sub("", line))).strip()


def numbers(line):
    return NUMBER.findall(OF_COMPUTING.sub("", line))


def last_digit(number):
    """What one unit of its last digit is worth: 0.01 of 3.14, 1e-7 of 1.2e-06; small counts are exact."""
    mantissa, _, exponent = number.lower().partition("e")
    if mantissa.lstrip("+-").isdigit() and not exponent and abs(int(mantissa)) < 20:
        return 0.0  # a count
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def magnitudes(line):
    return [abs(float(number)) for number in numbers(line)]


def negligible(shown, rows):
    """For each number of a line: below what it counts as 0.  Other rows of its table have the same skeleton."""
    rounding = ROUNDING * max(magnitudes(shown), default=0.0)
    return [max(rounding, OF_COLUMN * max(column)) for column in zip(*map(magnitudes, rows))]


def results_behind(shown, heading):
    """For each number of a line: the result of which it is a part or an error, 100 of a percentage; 0 of a result itself.

    An error is right-aligned under its heading; the largest number of its line is the value."""
    line = OF_COMPUTING.sub("", shown)
    ends = {error.end() for error in ERROR.finditer(heading)}
    value = max(magnitudes(shown), default=0.0)

    def behind(number):
        return 100.0 if line[number.end() :].startswith(" %") else value if number.end() in ends else 0.0

    return list(map(behind, NUMBER.finditer(line)))


def alike(shown, found, rows, heading):
    """Numbers of two lines with one skeleton, to the digits shown."""

    def near(a, b, nothing, result):
        allowed = 1.001 * last_digit(a) + RELATIVE * abs(float(a)) + DIFFERENCE * result
        return abs(float(a) - float(b)) <= allowed or max(abs(float(a)), abs(float(b))) <= nothing

    return all(map(near, numbers(shown), numbers(found), negligible(shown, rows), results_behind(shown, heading)))


def is_printed(shown, lines, heading=""):
    """Whether one of the lines is the one shown, in which ... stands for anything, below a line without numbers."""
    if "..." in shown:
        parts = [skeleton(part) for part in shown.split("...")]
        pattern = re.compile(".*".join(re.escape(part) for part in parts) + "$")
        return any(pattern.match(skeleton(line)) and matching_numbers(shown, line, heading) for line in lines)
    rows = [line for line in lines if skeleton(line) == skeleton(shown)]
    return any(alike(shown, line, rows, heading) for line in rows)


def matching_numbers(shown, line, heading):
    """Numbers up to the first ... of a line."""
    told = shown.split("...")[0]
    return alike(told, line, [told], heading)


def missing(printed, answer):
    """Lines of a block that the answer does not have."""
    lines = answer.splitlines()
    lost, heading = [], ""
    for shown in printed.splitlines():
        if not shown.strip() or shown.strip() == "...":
            continue
        if not is_printed(shown, lines, heading):
            lost.append(shown)
        if not numbers(shown):
            heading = shown
    return lost
