# SPDX-License-Identifier: GPL-2.0-or-later
"""The importer of the guide for FMI 3.0."""

import ctypes
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from importer import Fmu, FmuError, Instance

Log = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)
ARRAYS: dict[str, Any] = {"Float64": ctypes.c_double * 1, "Boolean": ctypes.c_bool * 1, "String": ctypes.c_char_p * 1}
STATES = {"fmi2GetFMUstate": "fmi3GetFMUState", "fmi2SetFMUstate": "fmi3SetFMUState",
          "fmi2FreeFMUstate": "fmi3FreeFMUState", "fmi2SerializedFMUstateSize": "fmi3SerializedFMUStateSize",
          "fmi2SerializeFMUstate": "fmi3SerializeFMUState", "fmi2DeSerializeFMUstate": "fmi3DeserializeFMUState"}


class Fmu3(Fmu):
    def __init__(self, file: Path) -> None:
        super().__init__(file, "x86_64-linux")
        self.resources = f"{self.folder.name}/resources/"
        self.variables = {v.attrib["name"]: v for v in self.description.find("ModelVariables") or ()}


class Instance3(Instance):
    def __init__(self, fmu: Any, token: str | None = None) -> None:
        self.fmu, self.messages = fmu, []
        self.log3 = Log(lambda _, __, ___, message: self.messages.append(message.decode()))
        make = fmu.library.fmi3InstantiateCoSimulation
        make.restype = ctypes.c_void_p
        given = (b"wheel", (token or fmu.description.attrib["instantiationToken"]).encode(), fmu.resources.encode())
        self.component = make(*given, 0, 0, 0, 0, None, ctypes.c_size_t(0), None, self.log3, None)
        if not self.component:
            raise FmuError(self.messages[-1])

    def status(self, function: str, *arguments: object) -> int:
        return super().status(STATES.get(function, function.replace("fmi2", "fmi3")), *arguments)

    def array(self, name: str, *values: object) -> tuple[str, Any, Any]:
        variable = self.fmu.variables[name]
        references = (ctypes.c_uint * 1)(int(variable.attrib["valueReference"]))
        return variable.tag, references, ARRAYS[variable.tag](*values)

    def set(self, values: Mapping[str, float | bool | str]) -> None:
        for name, value in values.items():
            given = value.encode() if isinstance(value, str) else value
            kind, references, array = self.array(name, given)
            self.call(f"fmi3Set{kind}", references, ctypes.c_size_t(1), array, ctypes.c_size_t(1))

    def get(self, name: str) -> Any:
        kind, references, array = self.array(name)
        self.call(f"fmi3Get{kind}", references, ctypes.c_size_t(1), array, ctypes.c_size_t(1))
        return array[0]

    def initialize(self, parameters: Mapping[str, bool | str], start: float = 0.0) -> None:
        self.set(parameters)
        times = (ctypes.c_double(0.0), ctypes.c_double(start), 0, ctypes.c_double(0.0))
        self.call("fmi3EnterInitializationMode", 0, *times)
        self.call("fmi3ExitInitializationMode")

    def step(self, time: float, length: float) -> None:
        self.flags = [ctypes.c_bool(True) for _ in range(3)]
        self.last = ctypes.c_double()
        pointers = [ctypes.byref(flag) for flag in (*self.flags, self.last)]
        self.call("fmi3DoStep", ctypes.c_double(time), ctypes.c_double(length), 1, *pointers)

    def free(self) -> None:
        self.fmu.library.fmi3FreeInstance(ctypes.c_void_p(self.component))
