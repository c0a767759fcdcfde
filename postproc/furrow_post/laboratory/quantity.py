# SPDX-License-Identifier: GPL-2.0-or-later
"""A number that a test gives, with its error."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LaboratoryQuantity:
    """A number that a test gives; error: standard error, NaN where it is not known."""

    name: str
    value: float
    error: float
    unit: str
    meaning: str

    def line(self) -> str:
        return (
            f"  {self.name:26} {self.value:12.5g} ± {self.error:<10.3g} {self.unit:6} "
            f"{self.meaning}"
        )
