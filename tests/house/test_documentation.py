"""Docstrings say what goes in and what comes out, and every example in them and in the documents is true."""

import ast
import doctest
import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from checkout import ROOT, engine_modules, module_name, name_of, syntax_tree

DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS

# numpy 2 prints its scalars with their type; examples are written as numpy 1 prints them.
PRINTED = {"legacy": "1.25"} if np.lib.NumpyVersion(np.__version__) >= "2.0.0" else {}


def with_examples(paths: list[Path]) -> list[Path]:
    return [path for path in paths if ">>> " in path.read_text(encoding="utf-8")]


def public_functions() -> list[tuple[Path, ast.FunctionDef]]:
    """The functions of the engine whose name and file are public, and the methods of the classes on its face."""
    face = importlib.import_module("geoanalogy").__all__
    found = []
    for path in engine_modules():
        if any(part.startswith("_") and part != "__init__.py" for part in path.relative_to(ROOT).parts):
            continue
        for node in syntax_tree(path).body:
            members = node.body if isinstance(node, ast.ClassDef) and node.name in face else [node]
            found += [(path, one) for one in members if isinstance(one, ast.FunctionDef) and one.name[0] != "_"]
    return found


def is_read(function: ast.FunctionDef) -> bool:
    """Whether a method is read like an attribute, or only declares a type."""
    names = {getattr(node, "id", "") for node in function.decorator_list}
    return bool(names & {"property", "cached_property", "overload"})


def section(docstring: str, title: str) -> str:
    """The text of a numpydoc section; empty where there is none."""
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^\S[^\n]*\n-{{3,}}|\Z)", docstring, flags=re.M | re.S)
    return found.group(1) if found else ""


@pytest.mark.parametrize("path", with_examples(engine_modules()), ids=name_of)
def test_the_examples_of_the_engine_are_true(path):
    with np.printoptions(**PRINTED):
        result = doctest.testmod(importlib.import_module(module_name(path)), optionflags=OPTIONS)
    assert result.attempted
    assert not result.failed


@pytest.mark.parametrize("path", with_examples([path for path in DOCUMENTS if path.is_file()]), ids=name_of)
def test_the_examples_of_the_documents_are_true(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with np.printoptions(**PRINTED):
        result = doctest.testfile(str(path), module_relative=False, optionflags=OPTIONS, encoding="utf-8")
    assert result.attempted
    assert not result.failed


@pytest.mark.parametrize("path", DOCUMENTS, ids=name_of)
def test_the_files_that_documents_name_are_there(path):
    text = path.read_text(encoding="utf-8")
    folders = "benchmarks|docs|geoanalogy|operators|panels|sample_blends|scripts|tests"
    named = re.findall(rf"`((?:{folders})(?:/[\w-]+)*(?:\.(?:py|md|png|blend|json|geojson))?)`", text)
    linked = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text)
    missing = [name for name in named if not (ROOT / name).exists() and not (ROOT / f"{name}.py").exists()]
    missing += [name for name in linked if not (path.parent / name).exists()]
    assert not missing


@pytest.mark.parametrize(
    ("path", "function"),
    [
        pytest.param(*pair, id=f"{module_name(pair[0])}.{pair[1].name}")
        for pair in public_functions()
        if not is_read(pair[1])
    ],
)
def test_a_public_function_documents_its_arguments_and_its_result(path, function):
    docstring = ast.get_docstring(function) or ""
    arguments = function.args
    names = [argument.arg for argument in arguments.posonlyargs + arguments.args + arguments.kwonlyargs]
    if names[:1] == ["self"] or any(getattr(node, "id", "") == "classmethod" for node in function.decorator_list):
        names = names[1:]
    names += [f"*{argument.arg}" for argument in [arguments.vararg] if argument]
    names += [f"**{argument.arg}" for argument in [arguments.kwarg] if argument]
    heads = [line.split(" : ")[0] for line in section(docstring, "Parameters").splitlines() if line[:1].strip()]
    documented = [name.strip() for head in heads for name in head.split(",")]
    assert documented == names, f"{name_of(path)}:{function.lineno}: the Parameters section names {documented}"
    returns = function.returns
    if returns is not None and not (isinstance(returns, ast.Constant) and returns.value is None):
        told = section(docstring, "Returns") or section(docstring, "Yields")
        never = isinstance(returns, ast.Name) and returns.id in ("NoReturn", "Never")
        assert told or never, f"{name_of(path)}:{function.lineno}: no Returns section"
