"""Who may import whom, read from the syntax trees of every file.

panels → geoanalogy.blender; operators → geoanalogy.blender → the engines → relations → geometry. The engine knows no
Blender, and imports itself by relative names only, since its absolute name differs in an installed extension.
"""

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from checkout import ROOT, engine_modules, module_name, modules, name_of, syntax_tree

BLENDER = {
    *("bpy", "bmesh", "mathutils", "gpu", "gpu_extras", "bpy_extras", "bl_math", "bl_ui", "blf", "aud", "idprop"),
    *("addon_utils", "nodeitems_utils"),
}
NUMERICAL = {"numpy", "scipy", "shapely", "manifold3d"}
OURS = {"geoanalogy", "operators", "panels", "bl_ext"}

BASE = {"errors", "arguments", "options", "tolerances", "progress"}
ENGINES = {"poses", "placements", "regions"}

# Each package of the engine, and the packages of the engine that it may import besides itself.
MAY_IMPORT = {
    "errors": set(),
    "tolerances": set(),
    "arguments": {"errors"},
    "options": {"errors", "arguments"},
    "progress": {"errors", "arguments"},
    "geometry": BASE,
    "relations": BASE | {"geometry"},
    "poses": BASE | {"geometry", "relations"},
    "placements": BASE | {"geometry", "relations"},
    "regions": BASE | {"geometry", "relations"},
    "formats": BASE | {"geometry", "regions"},
    "operations": BASE | ENGINES | {"geometry", "relations"},
    "batch": BASE | {"geometry", "operations"},
    "applying": BASE | {"geometry", "operations", "formats", "batch", "blender"},
    "blender": BASE | ENGINES | {"geometry", "relations", "operations", "formats", "batch", "command_line"},
    "command_line": BASE | {"applying", "batch", "blender"},
    # The package's own face: it collects the names, and is imported by none of them.
    "__init__": BASE | ENGINES | {"geometry", "relations", "operations", "formats"},
}


def imports(path: Path) -> list[tuple[int, int, tuple[str, ...]]]:
    """Every import of a file: line, level (0 where absolute) and the dotted name as a tuple."""
    found = []
    for node in ast.walk(syntax_tree(path)):
        if isinstance(node, ast.Import):
            found += [(node.lineno, 0, tuple(alias.name.split("."))) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            module = tuple(node.module.split(".")) if node.module else ()
            names = [module] if module else [(alias.name,) for alias in node.names]
            found += [(node.lineno, node.level, name) for name in names]
    return found


def packages(path: Path) -> tuple[str, ...]:
    """The package that a file's relative imports start from."""
    return path.relative_to(ROOT).parent.parts


def targets(path: Path) -> list[tuple[int, tuple[str, ...]]]:
    """The relative imports of a file, resolved against the checkout's root."""
    resolved = []
    for line, level, name in imports(path):
        if level:
            assert level - 1 <= len(packages(path)), f"{name_of(path)}:{line} leaves the checkout"
            resolved.append((line, packages(path)[: len(packages(path)) - (level - 1)] + name))
    return resolved


def absolute(path: Path) -> list[tuple[int, str]]:
    """The first name of each absolute import of a file."""
    return [(line, name[0]) for line, level, name in imports(path) if level == 0]


def foreign(path: Path, allowed: set[str]) -> list[str]:
    """The absolute imports that are neither the standard library's nor allowed."""
    return [
        f"{name_of(path)}:{line} imports {name}"
        for line, name in absolute(path)
        if name not in sys.stdlib_module_names and name not in allowed
    ]


def test_every_package_of_the_engine_has_its_row():
    found = {path.relative_to(ROOT).parts[1].removesuffix(".py") for path in modules("geoanalogy")}
    assert found - set(MAY_IMPORT) == set()


def test_the_table_points_one_way():
    order = [
        "errors",
        "arguments",
        "options",
        "progress",
        "tolerances",
        "geometry",
        "relations",
        *ENGINES,
        "formats",
        "operations",
    ]
    for row in order:
        assert MAY_IMPORT[row] <= set(order[: order.index(row)]), row


@pytest.mark.parametrize("path", modules("geoanalogy"), ids=name_of)
def test_the_engine_imports_downwards_only(path):
    row = path.relative_to(ROOT).parts[1].removesuffix(".py")
    wrong = [
        f"{name_of(path)}:{line} imports {'.'.join(target)}"
        for line, target in targets(path)
        if target[0] != "geoanalogy" or len(target) < 2 or target[1] not in MAY_IMPORT[row] | {row}
    ]
    assert wrong == []


@pytest.mark.parametrize("path", engine_modules(), ids=name_of)
def test_the_engine_needs_numerical_packages_only(path):
    assert foreign(path, NUMERICAL) == []


@pytest.mark.parametrize("path", modules("geoanalogy/blender"), ids=name_of)
def test_the_bridge_needs_blender_too_and_nothing_more(path):
    assert foreign(path, NUMERICAL | BLENDER) == []


@pytest.mark.parametrize("path", modules("operators"), ids=name_of)
def test_operators_hold_no_algorithm_and_know_no_panel(path):
    assert foreign(path, BLENDER | {"numpy"}) == []
    assert [target for _, target in targets(path) if target[0] not in ("operators", "geoanalogy")] == []


@pytest.mark.parametrize("path", modules("panels"), ids=name_of)
def test_panels_draw_what_the_bridge_has_and_call_operators_by_name(path):
    assert foreign(path, BLENDER) == []
    wrong = [
        target
        for _, target in targets(path)
        if target[0] != "panels" and target[:2] not in {("geoanalogy", "blender"), ("geoanalogy", "errors")}
    ]
    assert wrong == []


def test_the_root_imports_nothing_until_it_is_registered():
    tree = syntax_tree(ROOT / "__init__.py")
    assert [node.lineno for node in tree.body if isinstance(node, ast.Import | ast.ImportFrom)] == []
    assert absolute(ROOT / "__init__.py") == []


@pytest.mark.parametrize("path", modules("tests/engine", "tests/house"), ids=name_of)
def test_the_engine_is_tested_without_blender(path):
    assert [(line, name) for line, name in absolute(path) if name in BLENDER | OURS - {"geoanalogy"}] == []


@pytest.mark.parametrize("path", modules("tests/blender"), ids=name_of)
def test_the_extension_is_tested_through_its_installed_copy(path):
    # A complete Blender has neither the top-level engine nor hypothesis.
    assert [(line, name) for line, name in absolute(path) if name in OURS | {"hypothesis"}] == []


def test_the_engine_imports_where_there_is_no_blender():
    names = [module_name(path) for path in engine_modules()]
    program = (
        f"import importlib, sys\nfor name in {sorted(BLENDER)}: sys.modules[name] = None\n"
        f"for name in {names}: importlib.import_module(name)"
    )
    subprocess.run([sys.executable, "-c", program], cwd=ROOT, check=True)
