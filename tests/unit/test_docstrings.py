"""Everything public says in one line what it is."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import coplanar

ROOT = Path(coplanar.__file__).parent
LONGEST = 120  # characters of a first line
FILES = sorted(ROOT.rglob("*.py"))
LAWS = sorted((ROOT / "laws").glob("*.py"))
DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def decorated(node, name):
    return any(getattr(d, "id", getattr(d, "attr", "")) == name for d in node.decorator_list)


def public(body, prefix=""):
    """Public functions, classes and their methods, with what they are called; overloads speak once."""
    for node in body:
        if isinstance(node, DEFINITIONS) and not node.name.startswith("_") and not decorated(node, "overload"):
            yield f"{prefix}{node.name}", node
            if isinstance(node, ast.ClassDef):
                yield from public(node.body, f"{node.name}.")


def first_line(node):
    return (ast.get_docstring(node) or "").partition("\n")[0]


def tree_of(file):
    return ast.parse(file.read_text(encoding="utf-8"))


def name_of(file):
    return str(file.relative_to(ROOT))


@pytest.mark.parametrize("file", [f for f in FILES if "compiled" not in f.parts], ids=name_of)
def test_everything_public_has_a_first_line(file):
    tree = tree_of(file)
    wrong = [name for name, node in public(tree.body) if not 0 < len(first_line(node)) <= LONGEST]
    assert wrong == []
    assert 0 < len(first_line(tree)) <= LONGEST


@pytest.mark.parametrize("file", LAWS, ids=name_of)
def test_every_law_has_its_equation(file):
    laws = [node for node in tree_of(file).body if isinstance(node, DEFINITIONS)]
    assert [node.name for node in laws if not 0 < len(first_line(node)) <= LONGEST] == []


@pytest.mark.parametrize("file", LAWS, ids=name_of)
def test_a_law_is_one_equation(file):
    """No loops, no ifs, no classes, no annotations, no defaults, no keywords, no functions inside."""
    loops = (ast.For, ast.While, ast.If, ast.IfExp, ast.ListComp, ast.GeneratorExp, ast.Lambda, ast.ClassDef, ast.Try)
    for node in ast.walk(tree_of(file)):
        assert not isinstance(node, loops), f"line {getattr(node, 'lineno', '?')}"
        if isinstance(node, ast.FunctionDef):
            inside = [n for n in ast.walk(node) if isinstance(n, ast.FunctionDef) and n is not node]
            given = [*node.args.defaults, *node.args.kwonlyargs, node.args.vararg, node.args.kwarg, node.returns]
            assert not inside
            assert not any(given)
            assert not any(a.annotation for a in node.args.args)


def test_the_test_sees_what_is_missing():
    tree = ast.parse('class A:\n    def f(self): pass\n    def _g(self): pass\n\ndef h():\n    """Fine."""\n')
    assert [name for name, node in public(tree.body) if not first_line(node)] == ["A", "A.f"]
