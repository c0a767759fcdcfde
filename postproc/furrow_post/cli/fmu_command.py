# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post fmu: a script of one wheel as a co-simulation FMU for other programs."""

import ctypes
import json
import os
import shlex
import tempfile
import uuid
import zipfile
from collections.abc import Sequence
from pathlib import Path

from ..arguments import path
from ..errors import ResultsError
from ..programs import find_program
from ..run.case import with_named_files
from ..run.script import script_variables
from ..scene.restart import BEGIN, FROM
from .parameters import Given, argument, command, option, require_file

LIBRARY = "furrow_wheel.so"
PLATFORMS = {2: "linux64", 3: "x86_64-linux"}  # by version of FMI


@command(
    argument("script", "one wheel on its ground, without a wheel/rig", path),
    argument("files", "that the script names, for its folder", path, nargs=-1),
    option("--fmi", choices=list(map(str, PLATFORMS)), default="2", show_default=True, help="version of FMI"),
    option("-o", "--output", parse=path, help="file to write (default: <script>.fmu)"),
)
def fmu(given: Given) -> None:
    script: Path = given.script
    files: Sequence[Path] = given.files
    version = int(given.fmi)
    target: Path = given.output or Path(script.stem + ".fmu")
    require_file(target, "fmu")
    known = script_variables(script, {})
    variables = [
        {"name": name, "value": (shlex.split(known.defaults.get(name, "")) or [""])[0]}
        for name in known.settable
    ]
    library = _library()
    contents = {
        "script": script.name,
        "variables": variables,
        "keeps_states": bool({BEGIN, FROM} & set(known.defaults)),
    }
    text = script.read_text(encoding="utf-8")
    fingerprint = json.dumps([contents, text, version, library.stat().st_size])
    contents["guid"] = f"{{{uuid.uuid5(uuid.NAMESPACE_URL, fingerprint)}}}"
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        description = _description(library, contents, script.stem, version)
        archive.writestr("modelDescription.xml", description)
        archive.writestr("resources/furrow.json", json.dumps(contents, indent=2))
        archive.write(library, f"binaries/{PLATFORMS[version]}/{LIBRARY}")
        for name, each in resources((script, *files)).items():
            archive.write(each, f"resources/{name}")
    states = "with" if contents["keeps_states"] else "without"
    print(f"{target} ({len(variables)} variables of the script, {states} states)")


def resources(files: Sequence[Path]) -> dict[str, Path]:
    """Files by their path in the FMU, with those that they name. @raises ResultsError"""
    found: dict[str, Path] = {}
    for file in files:
        for each in with_named_files(file):
            name = os.path.relpath(each, file.resolve().parent)
            if name.startswith(".."):
                raise ResultsError(f"{file}: names {name}, which is not below its folder; an FMU keeps files there")
            found[file.name if each == file.resolve() else name] = each
    return found


def _library() -> Path:
    folder = find_program("furrow").resolve().parent.parent
    for place in (folder / "fmi", folder / "lib" / "furrow", *folder.glob("lib/*/furrow")):
        if (place / LIBRARY).is_file():
            return place / LIBRARY
    raise ResultsError(f"there is no {LIBRARY} below {folder}; build or install Furrow with its FMU")


def _description(library: Path, contents: dict[str, object], name: str, version: int) -> bytes:
    """modelDescription.xml as the library writes it, which has the table of variables."""
    describe = ctypes.CDLL(str(library)).furrow_describe_fmu
    describe.restype = ctypes.c_long
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(contents, file)
        file.flush()
        given = (file.name.encode(), name.encode(), version)
        size = int(describe(*given, None, ctypes.c_size_t(0)))
        buffer = ctypes.create_string_buffer(max(size, 0))
        if size < 0 or describe(*given, buffer, ctypes.c_size_t(size)) != size:
            raise ResultsError(f"{library} cannot describe the FMU; build it again")
    return buffer.raw
