# SPDX-License-Identifier: GPL-2.0-or-later
"""The command that users start from: a scene is found, run and shown."""
