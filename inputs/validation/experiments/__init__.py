# SPDX-License-Identifier: GPL-2.0-or-later
"""Every experiment of [Shoop2001] that has a number or a finding, and where ours is stored.

Numbers of the report are those of its text, tables and captions; curves that are only drawn there
are not at hand.
"""

from .hard_surface import HARD_SURFACE
from .material import MATERIAL
from .plans import FUTURE
from .plates import PLATES
from .rigid_wheel import RIGID_WHEEL
from .tyre_on_ground import TYRE_ON_GROUND

GROUPS = (MATERIAL, PLATES, HARD_SURFACE, RIGID_WHEEL, TYRE_ON_GROUND, FUTURE)
