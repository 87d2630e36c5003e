"""Columns of numbers as text: every way they are cut, in pieces of any size, and every line that is wrong."""

from __future__ import annotations

import gzip
import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.errors import InvalidValue, UnknownName
from coplanar.logs import columns, lines
from coplanar.logs.columns import Wanted, read_columns

TVW = Wanted(("t", "v", "omega"))
TICKS = Wanted(("t", "left", "right"), optional=True)


def reader(data, size=1 << 30):
    """Gives the bytes in pieces of at most this size."""
    places = iter(range(0, len(data), size))
    return lambda most: data[(i := next(places, len(data))) : i + size] if most else b""


def rows_of(data, wanted=TVW, size=1 << 30):
    pieces = list(read_columns(reader(data, size), wanted, "log"))
    return np.concatenate([p.values for p in pieces]), np.concatenate([p.lines for p in pieces])


@pytest.mark.parametrize(
    "text",
    [
        b"0,1,2\n3,4,5\n",
        b"0, 1, 2\n3 ,4 ,5\n", b"0 1 2\n3 4 5", b"0\t1\t2\n3\t4\t5\n", b"0;1;2\n3;4;5\n",
        b"  0   1 \t 2  \n\t3 4 5\n", b"0,1,2\r\n3,4,5\r\n",
        b"\xef\xbb\xbf0,1,2\n3,4,5\n", b"0,+1.,2e0\n3e+0,4.0,.5e1\n",
        b'"0","1","2"\n"3","4","5"\n',
    ],
)  # fmt: skip
def test_separators_signs_and_line_ends(text):
    values, where = rows_of(text)
    assert values.tolist() == [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]
    assert where.tolist() == [1, 2]


def test_comments_blank_lines_and_headers_are_counted_as_lines():
    text = b"# made by a robot, v 1\n\nt [s], V (m/s) ,omega\n# 1,2\n0,1,2 # first\n\n  \n3,4,5\n"
    values, where = rows_of(text)
    assert values.tolist() == [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]
    assert where.tolist() == [5, 8]


@pytest.mark.parametrize(
    ("text", "wanted", "values"),
    [
        (b"omega,x,t,v\n1,2,3,4\n", TVW, [[3.0, 4.0, 1.0]]),
        (b"a,b,c,d\n1,2,3,4\n", Wanted(TVW.names, ("d", "a", "2")), [[4.0, 1.0, 2.0]]),
        (b"1,2,3,4\n", Wanted(TVW.names, ("4", "1", "2")), [[4.0, 1.0, 2.0]]),
        (b"right,left\n1,2\n", TICKS, [[2.0, 1.0]]),
        (b"right,left,t\n1,2,3\n", TICKS, [[3.0, 2.0, 1.0]]),
        (b"1 2\n", TICKS, [[1.0, 2.0]]),
        (b"9 1 2\n", TICKS, [[9.0, 1.0, 2.0]]),
        (b"l,r\n5,6\n", Wanted(TICKS.names, ("l", "r"), optional=True), [[5.0, 6.0]]),
        (b"name,t,v,omega\nbob,1,2,3\nann,,2,3\n", Wanted(("v", "omega")), [[2.0, 3.0], [2.0, 3.0]]),
        (b"t,v,omega,x\n1,2,3,nan\n", TVW, [[1.0, 2.0, 3.0]]),
    ],
)
def test_columns_are_chosen(text, wanted, values):
    assert rows_of(text, wanted)[0].tolist() == values


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"", "log = 'no row of numbers'"),
        (b"# nothing\n\n", "log = 'no row of numbers'"),
        (b"t,v,omega\n", "log = 'no row of numbers'"),
        (b"0,1,2\n1,nan,2\n", "v in line 2 of log = nan: needed a finite number"),
        (b"0,1,2\n1,2,inf\n", "omega in line 2 of log = inf"),
        (b"0,1,2\n1,2,1e999\n", "omega in line 2 of log = inf"),
        (b"0,1,2\n\n1,2\n", "line 3 of log = '1,2': needed 3 cells, as in line 1; it has 2"),
        (b"0,1,2\n1,2,3,4\n", "line 2 of log"),
        (b"0,1,2\n1 2 3\n", "line 2 of log = '1 2 3': needed 3 cells, as in line 1; it has 1"),
        (b"0,1,2\n1,2,3,\n", "line 2 of log = '1,2,3,': needed 3 cells, as in line 1; it has 4"),
        (b"0,1,2\n,1,2\n", "t in line 2 of log = ''"),
        (b"0,1,2\n1,,2\n", "v in line 2 of log = ''"),
        (b"0,1,2\n1,2 3,\n", "v in line 2 of log = '2 3'"),
        (b"0,1,2\n1,,2 3\n", "v in line 2 of log = ''"),
        (b"0,1,2\n1,2,3.4.5\n", "omega in line 2 of log = '3.4.5'"),
        (b"0,1,2\n1,3.4.5,x\n", "v in line 2 of log = '3.4.5'"),
        (b"0,1,2\n1,2,1_000\n", "omega in line 2 of log = '1_000'"),
        (b"0 1 2\n1 2 0x10\n", "omega in line 2 of log = '0x10'"),
        (b"0;1;2\n1;2;1,5\n", "write a decimal point"),
        (b"0 1 2\n1 2 \xff\xfe\n", r"omega in line 2 of log = "),
        (b"0 1 2\n1 2 3\x014\n", "omega in line 2 of log"),
        (b"0 1\n", "line 1 of log = '0 1': needed columns t, v, omega; it has 2 cells"),
        (b"\xff\xfe0\x001\x00", "line 1 of log = 'UTF-16': needed UTF-8"),
        (b"PK\x03\x04whatever", "a ZIP archive"),
        (b"0 1 2\n\x00\x01\n", "line 2 of log = 'bytes that are not text'"),
        (b"t,v,omega,v\n1,2,3,4\n", "one column called v"),
    ],
)
@pytest.mark.parametrize("size", [1, 1 << 30])
def test_what_is_wrong_is_said_with_its_line(text, message, size):
    with pytest.raises(InvalidValue) as error:
        rows_of(text, size=size)
    assert message in str(error.value)


def test_columns_that_are_not_there():
    with pytest.raises(UnknownName, match=r"column in line 1 of log = 'omega'.*did you mean 'omga'"):
        rows_of(b"t,v,omga\n1,2,3\n")
    with pytest.raises(UnknownName, match="'w'"):
        rows_of(b"t,v,omega\n1,2,3\n", Wanted(TVW.names, ("t", "v", "w")))
    with pytest.raises(InvalidValue, match="numbers of columns, 1 to 3"):
        rows_of(b"1,2,3\n", Wanted(TVW.names, ("1", "2", "4")))
    with pytest.raises(InvalidValue, match="no header"):
        rows_of(b"1,2,3\n", Wanted(TVW.names, ("t", "2", "3")))
    with pytest.raises(InvalidValue, match="one for each of t, v, omega"):
        rows_of(b"1,2,3\n", Wanted(TVW.names, ("1", "2")))


@pytest.mark.parametrize("bad", [0, 1, 70_000, 199_999])
def test_the_line_is_exact_far_into_a_file(bad):
    rows = [b"%d,0.5,0.25" % i for i in range(200_000)]
    rows[bad] = b"%d,half,0.25" % bad
    text = b"# a log\n" + b"\n".join(rows)
    with pytest.raises(InvalidValue, match=rf"v in line {bad + 2} of log = 'half'"):
        rows_of(text)


numbers = st.floats(allow_nan=False, allow_infinity=False, width=64)


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=40),
    st.sampled_from([",", ", ", " ", "\t", ";", " ; "]),
    st.sampled_from(["%r", "%.17g", "%+.17e"]),
    st.integers(1, 200),
    st.lists(st.integers(0, 39), max_size=5),
    st.booleans(),
)
def test_numbers_come_back_to_the_last_bit_in_pieces_of_any_size(table, separator, form, size, blanks, packed):
    texts = [separator.join(form % value for value in row) for row in table]
    for place in sorted(blanks, reverse=True):
        texts.insert(place, "# 1,2" if place % 2 else "")
    data = "\n".join(texts).encode()
    values, where = rows_of(gzip.compress(data, mtime=0) if packed else data, size=size)
    assert np.array_equal(values, np.array(table))
    assert [texts[line - 1][:1] not in ("", "#") for line in where.tolist()] == [True] * len(table)


@settings(deadline=None, max_examples=100)
@given(st.binary(max_size=200), st.integers(1, 64))
def test_any_bytes_are_rows_or_refused(data, size):
    outcomes = []
    for pieces in (size, 1 << 30):
        try:
            outcomes.append([part.tolist() for part in rows_of(data, size=pieces)])
        except (InvalidValue, UnknownName) as error:
            outcomes.append(str(error))
    assert outcomes[0] == outcomes[1]


cells = st.text("0123456789.eE+-naif x_", min_size=1, max_size=6)


@settings(deadline=None, max_examples=300)
@given(st.lists(st.tuples(cells, cells, cells), min_size=1, max_size=3))
def test_the_fast_way_reads_what_the_slow_one_reads(table):
    """Vector code never accepts what cell by cell is refused, nor reads another number."""
    text = b"0,1,2\n" + "\n".join(",".join(row) for row in table).encode() + b"\n"
    layout = columns.layout_of(lines.Lines(1, text), TVW, "log")
    fast = columns._at_once(lines.Lines(1, text), layout)
    if fast is not None:
        slow, fault = columns._cell_by_cell(lines.Lines(1, text), layout)
        assert fault is None
        assert np.array_equal(fast.values, slow.values, equal_nan=True)
        assert fast.lines.tolist() == slow.lines.tolist()


def test_the_fast_way_is_taken(monkeypatch):
    monkeypatch.setattr(columns, "_cell_by_cell", None)
    text = b"\n".join(b"%d, 1.5, -2e-3 # row" % i if i % 7 else b"" for i in range(1000))
    assert len(rows_of(text)[0]) == 857


def test_gzip_is_seen_by_its_content():
    text = b"0 1 2\n" * 50_000
    parts = gzip.compress(text[: 6 * 20_001], mtime=0), gzip.compress(text[6 * 20_001 :], mtime=0)
    for data in (gzip.compress(text, mtime=0), b"".join(parts), parts[0] + parts[1] + bytes(512)):
        for size in (7, 1 << 30):
            assert len(rows_of(data, size=size)[0]) == 50_000


@pytest.mark.parametrize("cut", [3, 12, 60, -1, -4, -9])
def test_gzip_that_breaks_off_names_the_line(cut):
    data = gzip.compress(b"".join(b"%d %d 2\n" % (i, i * i) for i in range(100_000)))
    with pytest.raises(InvalidValue, match=r"line \d+ of log = .*needed gzip that can be unpacked to its end"):
        rows_of(data[:cut])


def test_rows_before_the_break_are_given():
    data = gzip.compress(b"".join(b"%d %d 2\n" % (i, i * i) for i in range(100_000)))
    seen, line = before_the_fault(data[: len(data) // 2])
    assert 40_000 < seen == line - 1


@pytest.mark.parametrize("wrong", [b"1,x,2", b"1,nan,2", b"1,2", b"1,2,1e999"])
@pytest.mark.parametrize("bad", [1, 2, 777, 60_000])
def test_every_row_before_a_bad_one_is_given(bad, wrong):
    rows = [b"%d,1,2" % i for i in range(70_000)]
    rows[bad] = wrong
    assert before_the_fault(b"\n".join(rows)) == (bad, bad + 1)


def before_the_fault(data):
    """The last line that was given, and the line that the error names."""
    seen, pieces = 0, read_columns(reader(data), TVW, "log")
    try:
        for rows in pieces:
            seen = rows.lines[-1]
    except InvalidValue as error:
        return seen, int(re.search(r"line (\d+) of log", str(error))[1])
    raise AssertionError


def test_gzip_that_is_damaged_is_refused():
    data = bytearray(gzip.compress(b"0 1 2\n" * 1000, mtime=0))
    data[-6] ^= 1  # of the checksum
    with pytest.raises(InvalidValue, match="gzip"):
        rows_of(bytes(data))


def test_a_line_without_end_is_refused_in_little_memory():
    given_out = 0

    def endless(most):
        nonlocal given_out
        given_out += most
        return b"1" * most

    with pytest.raises(InvalidValue, match=r"line 1 of log = b'1111.*lines of at most"):
        list(read_columns(endless, TVW, "log"))
    assert given_out < 4 * lines.LONGEST


def test_pieces_are_bounded():
    pieces = list(read_columns(reader(b"1 1 1\n" * 100_000), TVW, "log"))
    assert max(len(p.lines) for p in pieces) <= columns.MOST
    assert math.fsum(len(p.lines) for p in pieces) == 100_000
