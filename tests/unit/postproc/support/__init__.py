# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders made here, with known answers."""
