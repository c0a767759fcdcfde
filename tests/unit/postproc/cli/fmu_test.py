# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that come into an FMU."""

import unittest

from furrow_post.cli.fmu_command import resources
from furrow_post.errors import ResultsError
from support.folder import FolderTest


class FmuTest(FolderTest):
    def test_material_comes_with_its_base_and_contact(self) -> None:
        texts = {"wheel.lig": "run 1\n", "snow.yaml": "base: base/old.yaml\n", "base/old.yaml": "contact: ../steel.yaml\n", "steel.yaml": "{}\n"}
        for name, text in texts.items():
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(text)
        script, material = self.folder / "wheel.lig", self.folder / "snow.yaml"
        self.assertEqual(resources([script, material]), {name: (self.folder / name).resolve() for name in texts})
        (self.folder / "link.lig").symlink_to(script)
        self.assertEqual(list(resources([self.folder / "link.lig"])), ["link.lig"])  # as the FMU calls it
        with self.assertRaisesRegex(ResultsError, r"old.yaml: names \.\./steel.yaml, which is not below its folder"):
            resources([script, self.folder / "base" / "old.yaml"])


if __name__ == "__main__":
    unittest.main()
