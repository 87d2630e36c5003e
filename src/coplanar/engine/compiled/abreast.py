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


@contextmanager
def abreast(builder, count, vectors):
    """The body of a loop over rows: its index, and what counts the rows that show a flag: it returns where."""
    shown = cgutils.alloca_once_value(builder, _PLACE(0))

    def show(flag):
        builder.store(builder.add(builder.load(shown), builder.zext(flag, _PLACE)), shown)
        return shown

    with cgutils.for_range(builder, count) as loop:
        yield loop.index, show
        last = builder.block
    _advise(last.terminator, vectors)


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


def _advise(branch, vectors):
    """Tell the compiler at the end of a loop how many vectors to work on side by side."""
    module = branch.module
    words = ir.MetaDataString(module, "llvm.loop.interleave.count")
    advice = module.add_metadata([words, ir.IntType(32)(vectors)])
    loop = ir.values.MDValue(module, (), name=str(len(module.metadata)))
    loop.operands = (loop, advice)  # a loop is told from others by naming itself
    branch.set_metadata("llvm.loop", loop)
