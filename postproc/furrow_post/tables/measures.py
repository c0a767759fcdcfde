# SPDX-License-Identifier: GPL-2.0-or-later
"""The measures that a study.yaml can name: what they take from a run is in their own files."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import element_measures as element
from . import ground_measures as ground
from . import tyre_measures as tyre
from . import wheel_measures as wheel

Measure = Callable[..., Any]

_ALL: Sequence[Measure] = (
    *(wheel.travel, wheel.steady, wheel.passes, wheel.watched, wheel.watched_share, wheel.energies, wheel.work_per_metre),
    *(wheel.summary, wheel.sweep_point, ground.rut, ground.moved, ground.deviator_below_wheel, ground.below_plate),
    *(ground.stress_of_instants, ground.flow_zones, ground.tyre_ground, ground.layer_stress),
    *(tyre.tyre, tyre.tyre_states_of, tyre.tyre_at_measured, tyre.tyre_print, tyre.line_means, tyre.across_middle, tyre.rib_shares, tyre.sidewalls, tyre.rib_lean),
    *(tyre.shift_on_plane, tyre.shift_in_run, tyre.modes, tyre.shift_by_mode, tyre.come_in, tyre.lift_on_plane),
    *(tyre.lift_on_ground, element.plate, element.smooth_plate, element.smooth_force, element.plate_pressure, element.cone_resistance),
    *(element.path, element.piece, element.laboratory, element.cell, element.cone_index, element.columns, ground.deposit),
)
ROWS: Mapping[str, Measure] = {"plate_calibration": element.plate_calibration}
MEASURES: Mapping[str, Measure] = {str(getattr(one, "__name__")): one for one in _ALL}
