"""Loops over rows that work on several vectors side by side, instruction by instruction.

A law is a chain of operations that wait for one another, and a processor looks ahead over no more than two or three
hundred of them. The compiler interleaves vectors if it is told to; hence a loop of our own that can carry the advice.
"""

from __future__ import annotations

import math
from contextlib import contextmanager

from llvmlite import ir
from numba.core import cgutils

_PLACE = ir.IntType(64)


class _Group(ir.values.MDValue):  # type: ignore[misc]
    """Metadata for accesses of memory, told from any other by being distinct."""

    def __init__(self, module):
        super().__init__(module, (), name=str(len(module.metadata)))

    def descr(self, buf):
        buf += ("distinct !{ }", "\n")


@contextmanager
def abreast(builder, count, vectors):
    """The body of a loop over rows: its index, what counts the rows that show a flag, and what marks an access.

    The first returns where the count is kept. If all loads and stores are marked, the compiler knows that nothing
    written is read or written by another row, and asks nothing of addresses when the loop begins.
    """
    group = _Group(builder.module)
    shown = cgutils.alloca_once_value(builder, _PLACE(0))

    def show(flag):
        builder.store(builder.add(builder.load(shown), builder.zext(flag, _PLACE)), shown)
        return shown

    def mark(access):
        access.set_metadata("llvm.access.group", group)
        return access

    with cgutils.for_range(builder, count) as loop:
        yield loop.index, show, mark
        last = builder.block
    _advise(last.terminator, vectors, group)


def is_nan(builder, values):
    """Whether one of the values is (or infinities cancel): sums go by units that the law leaves free."""
    total = sum_in_pairs(builder, values)
    return builder.fcmp_unordered("uno", total, total)


def is_not_finite(builder, values):
    """Whether one of the values is not, or their sum."""
    total = sum_in_pairs(builder, values)
    size = builder.call(builder.module.declare_intrinsic("llvm.fabs", [total.type]), [total])
    return builder.fcmp_unordered("==", size, ir.Constant(total.type, math.inf))


def sum_in_pairs(builder, values):
    """Their sum, pair by pair: the fewer additions wait for one another, the sooner it is there."""
    while len(values) > 1:
        pairs = zip(values[::2], values[1::2], strict=False)
        values = [builder.fadd(a, b) for a, b in pairs] + values[len(values) - len(values) % 2 :]
    return values[0]


def _advise(branch, vectors, group):
    """Tell the compiler at the end of a loop how many vectors to work on side by side, and which accesses are apart."""
    module = branch.module
    wishes = {"llvm.loop.interleave.count": ir.IntType(32)(vectors), "llvm.loop.parallel_accesses": group}
    advice = [module.add_metadata([ir.MetaDataString(module, name), value]) for name, value in wishes.items()]
    loop = ir.values.MDValue(module, (), name=str(len(module.metadata)))
    loop.operands = (loop, *advice)  # a loop is told from others by naming itself
    branch.set_metadata("llvm.loop", loop)
