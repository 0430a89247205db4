"""The comparison itself: it must find what differs, and pass over what may."""

import printed

LINE = "F_P                -601644.5     0.2449125         1056627     0.2341878  N"

assert printed.is_printed(LINE, ["other", LINE])
assert printed.is_printed(LINE, [LINE.replace("  N", " N")]), "blanks do not count"
assert printed.is_printed(LINE, [LINE.replace("-601644.5", "-601644.6")]), "the last digit may differ"
assert not printed.is_printed(LINE, [LINE.replace("-601644.5", "-611644.5")]), "1.7 % is another number"
assert not printed.is_printed(LINE, [LINE.replace("-601644.5", "601644.5")]), "so is another sign"
assert not printed.is_printed(LINE, [LINE.replace("F_P", "F_Q")]), "words are to agree"
assert printed.is_printed("mode 6325 1.8e-05", ["mode 6325 -3e-06"]), "rounding beside a large number"
assert not printed.is_printed("mode 6325 1.8", ["mode 6325 -3"])
assert printed.is_printed("4 factorisations, 0.02 s", ["4 factorisations, 1.5 s"]), "times of computing"
assert not printed.is_printed("4 factorisations, 0.02 s", ["5 factorisations, 0.02 s"])
assert printed.is_printed("open by 112 J, ... 1 s", ["open by 112 J, which came from nowhere in 1 s"])
assert not printed.is_printed("open by 112 J, ...", ["open by 212 J, which came from nowhere"])
assert printed.missing("a 1\n...\nb 2\n", "a 1\nc 3\n") == ["b 2"]
