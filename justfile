# What CI runs, by the same names:  just check

# all of it
check: test lint types layers spelling web browser

# the tests, as the README prints them
test:
    pytest

# which lines the tests reach
coverage:
    pytest --cov=coplanar --cov-branch --cov-report=term:skip-covered

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

# the JavaScript of the pages: types, lint, and that what is vendored is what npm has
web:
    npm --prefix tools/web ci
    npm --prefix tools/web run check

# the pages in a real Chromium
browser:
    pytest -n0 tests/browser

# put the formatting right
format:
    ruff format .
    ruff check --fix .
    npm --prefix tools/web run format

# remake the golden files (needs the extra "oracle")
truth:
    for f in tools/truth_*.py; do python "$f"; done
