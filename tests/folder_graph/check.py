#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The folders of src/ include only what their library links, and their library links only what they
include.

A header of another folder (or package) in a header requires a PUBLIC link, in a source at least a
PRIVATE one.

    check.py <src> <folder_graph.txt of the build>
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

# libraries that the includes of a package ask for
PACKAGES = {
    r"fmt/": "fmt::fmt",
    r"mpi\.h": "MPI::MPI_C",
    r"hdf5\.h": "HDF5::HDF5",
    r"yaml-cpp/": "yaml-cpp",
    r"Spectra/": "Spectra::Spectra",
    r"nlohmann/": "nlohmann_json::nlohmann_json",
    r"vtk\w+\.h": "VTK",
    r"g(test|mock)/g(test|mock)\.h": "GTest::gmock",
}
# libraries of single files
FILES = {"core/communicator": "communicator"}
# core/types.h is made of Eigen: who links core has it.
WITH_CORE = {"Eigen3::Eigen"}


def component_of(path):
    """The library that a file of src/ belongs to, from its path below src/."""
    path = Path(path)
    return FILES.get(path.with_suffix("").as_posix(), path.parts[0])


def asked_for(include, components):
    """The target that an include asks for; None for the standard library and what comes with core."""
    for pattern, target in PACKAGES.items():
        if re.match(pattern, include):
            return target
    if include.startswith("furrow/") and component_of(include[len("furrow/"):]) in components:
        return "furrow_" + component_of(include[len("furrow/"):])
    return None


def read_graph(path):
    """component -> (public targets, private targets)"""
    graph = {}
    for line in Path(path).read_text().splitlines():
        name, links = line.split(":", 1)
        graph[name] = tuple(
            {re.sub("^VTK::.*", "VTK", target) for target in re.split("[; ]+", part.strip()) if target}
            for part in links.split(" | "))
    return graph


def includes_of(src, components):
    """component -> kind ("header" or "source") -> target -> the first file that includes it"""
    found = defaultdict(lambda: defaultdict(dict))
    for path in sorted(src.rglob("*.h")) + sorted(src.rglob("*.cpp")):
        relative = path.relative_to(src)
        component = component_of(relative)
        if component not in components:
            continue  # programs
        for include in re.findall(r'^#include ["<]([^">]+)[">]', path.read_text(), re.MULTILINE):
            target = asked_for(include, components)
            if target and target != "furrow_" + component:
                kind = "header" if path.suffix == ".h" else "source"
                found[component][kind].setdefault(target, f"{relative} includes {include}")
    return found


def main():
    src, graph_file = Path(sys.argv[1]), sys.argv[2]
    graph = read_graph(graph_file)
    found = includes_of(src, graph)
    errors = []
    for component, (public, private) in graph.items():
        headers, sources = found[component]["header"], found[component]["source"]
        for target, where in headers.items():
            if target not in public:
                errors.append(f"{component} does not link {target} PUBLIC, but {where}")
        for target, where in sources.items():
            if target not in public | private:
                errors.append(f"{component} does not link {target}, but {where}")
        for target in (public | private) - WITH_CORE:
            if target not in headers and target not in sources:
                errors.append(f"{component} links {target}, which nothing in it includes")
            elif target in public and target not in headers:
                errors.append(f"{component} links {target} PUBLIC, which no header of it includes")
    if not found:
        errors.append(f"no includes found below {src}")
    print("\n".join(errors) or f"{len(graph)} libraries link what they include")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
