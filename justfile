# What CI runs, by the same names:  just check

# all of it
check: test lint types layers spelling

# the tests, as the README prints them
test:
    pytest

# format and lint
lint:
    ruff format --check .
    ruff check .

# static types
types:
    mypy

# which layer may import which
layers:
    lint-imports

# spelling in code and text
spelling:
    codespell

# put the formatting right
format:
    ruff format .
    ruff check --fix .

# remake the golden files (needs the extra "oracle")
truth:
    for f in tools/truth_*.py; do python "$f"; done
