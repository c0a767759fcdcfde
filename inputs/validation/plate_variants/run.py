#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plate in the laboratory's snow, 180 kg/m3: cap law, cap law with a slide surface under the
plate's edge, foam law with it; load, and density below the plate layer by layer. See README.md.

Makes the runs that are missing and writes results.csv, best_estimates.csv, field.csv and
layers.png.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.study import Study, run_study

if __name__ == "__main__":
    made = cases.CASES + cases.FIELD_CASES
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", made, report.evaluate)))
