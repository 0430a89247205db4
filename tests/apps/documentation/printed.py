"""Whether a line that a page shows is one that a command has printed."""

import os
import re

PAGES_GMSH = "4.8"  # whose meshes the pages show
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\d])", re.I)
OF_COMPUTING = re.compile(r", [\d.e-]+ s$")  # seconds that the work took
OF_COLUMN = 1e-5  # what a mesh and an iteration leave where symmetry has nothing, beside the largest number of the column
ROUNDING = 1e-12  # of doubles, beside the largest number of the line
RELATIVE = 2e-3  # between processors, beyond the last digit shown
OF_LINE = 0.0  # beside the largest number of the line
if os.environ.get("GESTELL_GMSH", PAGES_GMSH) != PAGES_GMSH:
    RELATIVE = 1e-2  # numbers of cells differ by 0.3 %, results by less than the error of the mesh, some 2 %
    OF_LINE = 2e-3  # an estimated error of 1151 N in 495 298 N becomes 1082 N


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


def alike(shown, found, rows):
    """Numbers of two lines with one skeleton, to the digits shown."""

    of_line = OF_LINE * max([100.0] * (" %" in shown) + magnitudes(shown), default=0.0)  # 100 % is the whole

    def near(a, b, nothing):
        allowed = 1.001 * last_digit(a) + RELATIVE * abs(float(a)) + of_line
        return abs(float(a) - float(b)) <= allowed or max(abs(float(a)), abs(float(b))) <= nothing

    return all(map(near, numbers(shown), numbers(found), negligible(shown, rows)))


def is_printed(shown, lines):
    """Whether one of the lines is the one shown, in which ... stands for anything."""
    if "..." in shown:
        parts = [skeleton(part) for part in shown.split("...")]
        pattern = re.compile(".*".join(re.escape(part) for part in parts) + "$")
        return any(pattern.match(skeleton(line)) and matching_numbers(shown, line) for line in lines)
    rows = [line for line in lines if skeleton(line) == skeleton(shown)]
    return any(alike(shown, line, rows) for line in rows)


def matching_numbers(shown, line):
    """Numbers up to the first ... of a line."""
    told = shown.split("...")[0]
    return alike(told, line, [told])


def missing(printed, answer):
    """Lines of a block that the answer does not have."""
    lines = answer.splitlines()
    shown = [line for line in printed.splitlines() if line.strip() and line.strip() != "..."]
    return [line for line in shown if not is_printed(line, lines)]
