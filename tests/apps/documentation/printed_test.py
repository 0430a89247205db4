"""The comparison itself: it must find what differs, and pass over what may."""

import importlib
import os

os.environ.pop("GESTELL_GMSH", None)  # as with the gmsh of the pages

import printed

LINE = "F_P                -601644.5     0.2449125         1056627     0.2341878  N"

assert printed.is_printed(LINE, ["other", LINE])
assert printed.is_printed(LINE, [LINE.replace("  N", " N")]), "blanks do not count"
assert printed.is_printed(LINE, [LINE.replace("-601644.5", "-601644.6")]), "the last digit may differ"
assert not printed.is_printed(LINE, [LINE.replace("-601644.5", "-611644.5")]), "1.7 % is another number"
assert not printed.is_printed(LINE, [LINE.replace("-601644.5", "601644.5")]), "so is another sign"
assert not printed.is_printed(LINE, [LINE.replace("F_P", "F_Q")]), "words are to agree"
assert not printed.is_printed(LINE, [LINE.replace("0.2449125", "7.9").replace("0.2341878", "-3.1")]), "times beside a large force count"
assert not printed.is_printed("mode 3 of 1056627", ["mode 4 of 1056627"]), "so do counts"

MODES = ["1 54.934595 0.009996 6325 1.812e-05", "6 268.0056 0.009978 1.575e-06 8365"]
assert printed.is_printed(MODES[0], [MODES[0].replace("1.812e-05", "-3e-06"), MODES[1]]), "rounding beside the largest of its column"
assert not printed.is_printed(MODES[0], [MODES[0].replace("1.812e-05", "1.8"), MODES[1]])
assert not printed.is_printed(MODES[0], [MODES[0].replace("0.009996", "0.05"), MODES[1]]), "damping ratios beside masses"
assert not printed.is_printed("206.408 2.313e-05", ["206.408 9.9e-05", "31.0459 0.0001538"]), "small damping ratios among their like"
assert printed.is_printed("stable, 0.9197, closes to 5.7e-16", ["stable, 0.9197, closes to 8.1e-15"]), "rounding of doubles"
assert not printed.is_printed("stable, 0.9197, closes to 5.7e-16", ["stable, 0.9197, closes to 8.1e-9"])
assert printed.is_printed("4 factorisations, 0.02 s", ["4 factorisations, 1.5 s"]), "times of computing"
assert not printed.is_printed("4 factorisations, 0.02 s", ["5 factorisations, 0.02 s"])
assert printed.is_printed("open by 112 J, ... 1 s", ["open by 112 J, which came from nowhere in 1 s"])
assert not printed.is_printed("open by 112 J, ...", ["open by 212 J, which came from nowhere"])
assert printed.missing("a 1\n...\nb 2\n", "a 1\nc 3\n") == ["b 2"]

BUDGET = "  no.  output         value  unit  mesh error  reduction error  time error  total error\n"
ERRORS = "    2  F_rod.min  -495297.6  N           1151              811        0.78         1964"
CHANGE = "F_rod  0.24 % of 1054547 N"
assert printed.missing(BUDGET + ERRORS, BUDGET + ERRORS.replace("1151", "1082")) == [ERRORS]

os.environ["GESTELL_GMSH"] = "4.13"  # other meshes
importlib.reload(printed)
assert not printed.missing(BUDGET + ERRORS, BUDGET + ERRORS.replace("1151", "1082").replace("5297", "7000")), "errors beside their value"
assert printed.missing(BUDGET + ERRORS, BUDGET + ERRORS.replace("1151", "2251")) == [ERRORS]
assert printed.missing(ERRORS, ERRORS.replace("1151", "1082")) == [ERRORS], "without the heading a result like others"
assert printed.is_printed(CHANGE, [CHANGE.replace("0.24", "0.43")]), "per cent of a result"
assert not printed.is_printed(CHANGE, [CHANGE.replace("0.24", "0.48")])
assert printed.is_printed(LINE, [LINE.replace("-601644.5", "-605644.5")]), "0.7 %"
assert not printed.is_printed(LINE, [LINE.replace("-601644.5", "-611644.5")])
assert not printed.is_printed(LINE, [LINE.replace("0.2449125", "0.2549125")]), "times beside a large force count"
