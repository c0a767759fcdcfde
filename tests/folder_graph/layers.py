#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The folders of coupling/, src/io and the Python package include only folders of lower layers.

CONTRIBUTING.md draws the layers, lowest first, one tree on each line:

    coupling: liggghts <- base <- bodies, contact <- checks, main

A folder may include every folder to the left of its layer, and none of the same layer. A name
that is no folder (main) stands for the files of the tree itself, if it has any.

    layers.py <root of the project> <CONTRIBUTING.md>
"""
import ast
import re
import sys
from pathlib import Path

TREES = {"coupling": "coupling", "io": "src/io", "furrow_post": "postproc/furrow_post"}


def drawn_layers(page, tree):
    """name -> number of its layer"""
    drawings = re.findall(rf"^{tree}: (.*(?:\n {{2,}}.*)*)", page, re.MULTILINE)
    if len(drawings) != 1:
        raise SystemExit(f"CONTRIBUTING.md draws the layers of {tree} {len(drawings)} times, not once")
    layers = re.sub(r"\s+", " ", drawings[0]).split("<-")
    return {name.strip(): number for number, layer in enumerate(layers) for name in layer.split(",")}


def cpp_includes(path, tree):
    return re.findall(r'^#include "(?:furrow/)?' + tree.name + r'/([^"]+)"', path.read_text(), re.MULTILINE)


def python_imports(path, tree):
    """Paths below the package of what a module imports from the package."""
    package = path.relative_to(tree.parent).with_suffix("").parts[:-1]
    found = []
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            modules = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            outer = package[: len(package) - node.level + 1] if node.level else ()
            module = [*outer, *(node.module.split(".") if node.module else [])]
            modules = [[*module, alias.name] for alias in node.names]
        else:
            continue
        found += ["/".join(m[1:]) for m in modules if m[0] == tree.name]
    return found


def wrong_arrows(tree, layers):
    """One line for each folder, or arrow between two folders, that the drawing does not have."""
    folders = {
        f.name for f in tree.iterdir() if any(f.glob("*.cpp")) or any(f.glob("*.py")) or any(f.glob("*.h"))
    }
    files = sorted(set(layers) - folders)
    errors = [f"{tree.name}: the drawing has no {name}" for name in sorted(folders - set(layers))]
    own_files = any(f.suffix in (".h", ".cpp", ".py") for f in tree.iterdir())
    if len(files) != own_files:
        return errors + [f"{tree.name}: {files} are no folders; one name means the files of the tree, if it has any"]
    if errors:
        return errors
    arrows = 0
    for path in sorted(p for p in tree.rglob("*") if p.suffix in (".h", ".cpp", ".py")):
        if path == tree / "__init__.py":
            continue  # what the package shows to its users
        relative = path.relative_to(tree)
        own = relative.parts[0] if len(relative.parts) > 1 else files[0]
        read = python_imports if path.suffix == ".py" else cpp_includes
        for include in read(path, tree):
            first = include.split("/")[0]
            other = first if first in folders else files[0]
            if other == own:
                continue
            arrows += 1
            if layers[other] >= layers[own]:
                errors.append(f"{tree.name}: {own} is not above {other}, but {relative} includes {include}")
    return errors or ([] if arrows else [f"{tree.name}: no include found"])


def main():
    root, page = Path(sys.argv[1]), Path(sys.argv[2]).read_text()
    errors = []
    for tree, folder in TREES.items():
        errors += wrong_arrows(root / folder, drawn_layers(page, tree))
    print("\n".join(errors) or f"{', '.join(TREES)}: every include points to a lower layer")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
