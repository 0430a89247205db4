"""Whether a line that a page shows is one that a command has printed."""

import re

NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\d])", re.I)
OF_COMPUTING = re.compile(r", [\d.e-]+ s$")  # seconds that the work took
ROUNDING = 1e-5  # beside the largest number of a line
RELATIVE = 2e-3  # between processors, beyond the last digit shown


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


def alike(shown, found):
    """Numbers of two lines with one skeleton, to the digits shown; rounding beside the largest of them counts as 0."""
    pairs = list(zip(numbers(shown), numbers(found)))
    largest = max([abs(float(a)) for a, _ in pairs], default=0.0)

    def near(a, b):
        difference = abs(float(a) - float(b))
        return difference <= 1.001 * last_digit(a) + RELATIVE * abs(float(a)) or max(abs(float(a)), abs(float(b))) <= ROUNDING * largest

    return all(near(a, b) for a, b in pairs)


def is_printed(shown, lines):
    """Whether one of the lines is the one shown, in which ... stands for anything."""
    if "..." in shown:
        parts = [skeleton(part) for part in shown.split("...")]
        pattern = re.compile(".*".join(re.escape(part) for part in parts) + "$")
        return any(pattern.match(skeleton(line)) and matching_numbers(shown, line) for line in lines)
    return any(skeleton(shown) == skeleton(line) and alike(shown, line) for line in lines)


def matching_numbers(shown, line):
    """Numbers up to the first ... of a line."""
    return alike(shown.split("...")[0], line)


def missing(printed, answer):
    """Lines of a block that the answer does not have."""
    lines = answer.splitlines()
    shown = [line for line in printed.splitlines() if line.strip() and line.strip() != "..."]
    return [line for line in shown if not is_printed(line, lines)]
