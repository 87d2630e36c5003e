"""What a package offers: every name in ``__all__`` is there, once, and in order."""

from __future__ import annotations

import pkgutil
from importlib import import_module

import pytest

import coplanar
from tests.engines import HAS_NUMBA


def modules():
    """Every module of the package; compiled loops only where they can be imported."""
    yield "coplanar"
    for module in pkgutil.walk_packages(coplanar.__path__, "coplanar."):
        if HAS_NUMBA or not module.name.startswith("coplanar.engine.compiled"):
            yield module.name


def in_order(names):
    """Constants, then classes, then the rest; each by the alphabet."""
    return sorted(names, key=lambda name: (0 if name.isupper() else 1 if name[0].isupper() else 2, name))


@pytest.mark.parametrize("name", list(modules()))
def test_all_is_sorted_and_true(name):
    module = import_module(name)
    names = list(getattr(module, "__all__", []))
    assert names == in_order(set(names))
    assert [n for n in names if not hasattr(module, n)] == []


def test_the_top_offers_what_it_says():
    assert coplanar.__all__
    assert coplanar.__version__
    star: dict = {}
    exec("from coplanar import *", star)
    assert set(coplanar.__all__) <= set(star)


@pytest.mark.parametrize("name", [m.name for m in pkgutil.iter_modules(coplanar.__path__) if m.ispkg])
def test_every_package_has_a_docstring(name):
    assert (import_module(f"coplanar.{name}").__doc__ or "").strip()


def test_no_name_at_the_top_is_a_module_too():
    assert not {m.name for m in pkgutil.iter_modules(coplanar.__path__)} & set(coplanar.__all__)
