# SPDX-License-Identifier: GPL-2.0-or-later
"""The rooms of furrow_post: who may import whom; everything is imported at the head of a module."""

import ast
import functools
import re
import unittest
from graphlib import TopologicalSorter
from pathlib import Path

from support.command import SOURCE

PACKAGE = SOURCE / "postproc" / "furrow_post"
# A room imports from those before it and from itself
ROOMS = (
    *("", "run", "read", "study", "uncertainty", "laws", "analyse", "laboratory"),
    *("figures", "sweep", "scene", "soil", "tables", "surrogate", "cli"),
)


@functools.cache
def modules() -> dict[str, Path]:
    """Dotted name below the package -> file."""
    return {
        ".".join(path.relative_to(PACKAGE).with_suffix("").parts): path
        for path in sorted(PACKAGE.rglob("*.py"))
        if path.name != "__init__.py"
    }


def room(module: str) -> str:
    return module.rpartition(".")[0]


def imported(module: str, node: ast.ImportFrom) -> set[str]:
    """Modules of the package that a relative import brings."""
    above = module.split(".")[: -node.level]
    base = ".".join([*above, *([node.module] if node.module else [])])
    names = {".".join(filter(None, [base, alias.name])) for alias in node.names}
    known = set(modules())
    return {name if name in known else base for name in names} & known


class RoomsTest(unittest.TestCase):
    def setUp(self) -> None:
        self.imports: dict[str, set[str]] = {}
        for module, path in modules().items():
            tree = ast.parse(path.read_text(encoding="utf-8"))
            found: set[str] = set()
            for node in ast.walk(tree):
                if isinstance(node, ast.ImportFrom) and node.level:
                    found |= imported(module, node)
            self.imports[module] = found

    def test_rooms_have_no_cycle(self) -> None:
        order = list(TopologicalSorter(self.imports).static_order())
        self.assertEqual(len(order), len(self.imports))
        self.assertGreater(len(order), 40)

    def test_rooms_import_lower_rooms_alone(self) -> None:
        for module, others in self.imports.items():
            for other in others:
                mine, theirs = room(module), room(other)
                with self.subTest(module=module, imports=other):
                    self.assertLessEqual(ROOMS.index(theirs), ROOMS.index(mine))

    def test_everything_is_imported_at_the_head(self) -> None:
        for module, path in modules().items():
            tree = ast.parse(path.read_text(encoding="utf-8"))
            inner = [
                node
                for function in ast.walk(tree)
                if isinstance(function, (ast.FunctionDef, ast.ClassDef))
                for node in ast.walk(function)
                if isinstance(node, (ast.Import, ast.ImportFrom))
            ]
            self.assertEqual(inner, [], module)

    def test_file_names_are_unique(self) -> None:
        names = [path.name for path in modules().values()]
        self.assertEqual([name for name in names if names.count(name) > 1], [])

    def test_room_of_runs_starts_all_programs(self) -> None:
        """And ffmpeg by the film."""
        starting = {
            module
            for module, path in modules().items()
            if re.search(r"^(import subprocess|from subprocess)|os\.(system|spawn|popen)", path.read_text(encoding="utf-8"), re.M)
        }
        self.assertEqual({module for module in starting if room(module) != "run"}, {"figures.film"})

    def test_every_room_is_installed_by_pip(self) -> None:
        project = (PACKAGE.parent / "pyproject.toml").read_text()
        for folder in filter(None, ROOMS):
            self.assertIn(f'"furrow_post.{folder}"', project)


if __name__ == "__main__":
    unittest.main()
