# SPDX-License-Identifier: GPL-2.0-or-later
"""A small importer of co-simulation FMUs (FMI 2.0) for Linux on 64-bit processors."""

import ctypes
import tempfile
import xml.etree.ElementTree
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

Logger = ctypes.CFUNCTYPE(
    None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_char_p
)
CO_SIMULATION = 1
OK = 0
ARRAYS: dict[str, Any] = {"Real": ctypes.c_double * 1, "Boolean": ctypes.c_int * 1, "String": ctypes.c_char_p * 1}


class Callbacks(ctypes.Structure):
    _fields_ = [
        ("logger", Logger),
        ("allocate", ctypes.c_void_p),
        ("free", ctypes.c_void_p),
        ("finished", ctypes.c_void_p),
        ("environment", ctypes.c_void_p),
    ]


class FmuError(RuntimeError):
    """Error of the FMU, with its log."""


class Fmu:
    """A file .fmu, unpacked and loaded. Its instances are made by Instance."""

    def __init__(self, file: Path, platform: str = "linux64") -> None:
        self.folder = tempfile.TemporaryDirectory()
        with zipfile.ZipFile(file) as archive:
            archive.extractall(self.folder.name)
        place = Path(self.folder.name)
        self.resources = (place / "resources").as_uri()
        self.description = xml.etree.ElementTree.parse(place / "modelDescription.xml").getroot()
        self.flags = self.description.find("CoSimulation").attrib  # type: ignore[union-attr]
        self.variables = {v.attrib["name"]: v for v in self.description.iter("ScalarVariable")}
        self.library = ctypes.CDLL(str(place / "binaries" / platform / f"{self.flags['modelIdentifier']}.so"))


class Instance:
    """An instance of an FMU. Calls follow the standard, and raise FmuError unless they return fmi2OK."""

    def __init__(self, fmu: Fmu, name: str = "wheel", guid: str | None = None) -> None:
        self.fmu, self.messages = fmu, list[str]()
        self.callbacks = Callbacks(logger=Logger(self.log))
        instantiate = fmu.library.fmi2Instantiate
        instantiate.restype = ctypes.c_void_p
        fingerprint = guid or fmu.description.attrib["guid"]
        given = (name.encode(), CO_SIMULATION, fingerprint.encode(), fmu.resources.encode())
        self.component = instantiate(*given, ctypes.byref(self.callbacks), 0, 0)
        if not self.component:
            raise FmuError(self.messages[-1])

    def log(self, _: int, __: bytes, ___: int, ____: bytes, message: bytes, rest: bytes | None) -> None:
        text = message.decode().replace("%%", "\0")
        if "%s" in text and rest:
            text = text.replace("%s", rest.decode())
        self.messages.append(text.replace("\0", "%"))

    def status(self, function: str, *arguments: object) -> int:
        return int(getattr(self.fmu.library, function)(ctypes.c_void_p(self.component), *arguments))

    def call(self, function: str, *arguments: object) -> None:
        if self.status(function, *arguments) != OK:
            raise FmuError(self.messages[-1] if self.messages else function)

    def of_variable(self, name: str) -> tuple[str, ctypes.Array[ctypes.c_uint]]:
        """Type and value reference."""
        variable = self.fmu.variables[name]
        kind = next(child.tag for child in variable if child.tag in ARRAYS)
        return kind, (ctypes.c_uint * 1)(int(variable.attrib["valueReference"]))

    def set(self, values: Mapping[str, float | bool | str]) -> None:
        for name, value in values.items():
            kind, reference = self.of_variable(name)
            given = value.encode() if isinstance(value, str) else value
            self.call(f"fmi2Set{kind}", reference, ctypes.c_size_t(1), ARRAYS[kind](given))

    def get(self, name: str) -> float:
        kind, reference = self.of_variable(name)
        value = ARRAYS[kind]()
        self.call(f"fmi2Get{kind}", reference, ctypes.c_size_t(1), value)
        return float(value[0])

    def initialize(self, parameters: Mapping[str, bool | str], start: float = 0.0) -> None:
        self.set(parameters)
        self.call("fmi2SetupExperiment", 0, ctypes.c_double(0.0), ctypes.c_double(start), 0, ctypes.c_double(0.0))
        self.call("fmi2EnterInitializationMode")
        self.call("fmi2ExitInitializationMode")

    def step(self, time: float, length: float) -> None:
        self.call("fmi2DoStep", ctypes.c_double(time), ctypes.c_double(length), 1)

    def get_state(self) -> ctypes.c_void_p:
        state = ctypes.c_void_p()
        self.call("fmi2GetFMUstate", ctypes.byref(state))
        return state

    def set_state(self, state: ctypes.c_void_p) -> None:
        self.call("fmi2SetFMUstate", state)

    def free_state(self, state: ctypes.c_void_p) -> None:
        self.call("fmi2FreeFMUstate", ctypes.byref(state))

    def serialize(self, state: ctypes.c_void_p) -> bytes:
        size = ctypes.c_size_t()
        self.call("fmi2SerializedFMUstateSize", state, ctypes.byref(size))
        data = ctypes.create_string_buffer(size.value)
        self.call("fmi2SerializeFMUstate", state, data, size)
        return data.raw

    def deserialize(self, data: bytes) -> ctypes.c_void_p:
        state = ctypes.c_void_p()
        self.call("fmi2DeSerializeFMUstate", data, ctypes.c_size_t(len(data)), ctypes.byref(state))
        return state

    def free(self) -> None:
        self.fmu.library.fmi2FreeInstance(ctypes.c_void_p(self.component))
