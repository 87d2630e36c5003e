"""What the compiler makes of the loops over rows, which no answer tells: vector code, on a stack that fits vectors."""

from __future__ import annotations

import re

import numpy as np
import pytest

from coplanar.laws import arms, control, motion
from tests.engines import NEEDS_NUMBA

pytestmark = NEEDS_NUMBA

LAWS = [arms.two_link_row, control.tracking_step, motion.segment_jacobian]  # few columns, and more than many


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
@pytest.mark.parametrize("pairs", [0, 3])
def test_rows_are_worked_on_in_vectors(law, pairs):
    from coplanar.engine.compiled.kernels import Kernel
    from coplanar.engine.evaluator import evaluator

    constants = (("PAIRS", pairs), ("FINITE", False))
    loop = Kernel(law)._compile("rows", "rows_serial", constants, cached=False)
    columns = [np.full(20, 0.5) for _ in range(law.__code__.co_argcount)]
    for column in columns:
        column.flags.writeable = False
    steps = tuple(2 if pairs >> k & 1 else 1 for k in range(len(columns)))
    outs = tuple(np.empty(8) for _ in evaluator(law)._facts.results * [None])
    assert loop(tuple(columns), steps, outs, 8, 4096) == 0
    assert all(np.all(out == out[0]) for out in outs)
    (code,) = loop.inspect_llvm().values()
    products = re.findall(r"= fmul \S.*? (<\d+ x double>|double) ", code)
    assert products.count("double") < len(products)
    assert "alignstack(64)" in code
