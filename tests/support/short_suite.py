# SPDX-License-Identifier: GPL-2.0-or-later
"""The short tests use every law, style and scene: short_suite.py <source> <build>.

Laws have conformance tests. The first example of each style's page runs in pages.snippets. A scene
runs in its quick form, or in that of tests/scenes/short.csv.
"""

import json
import subprocess
import sys
from pathlib import Path


def output(*command: str | Path) -> str:
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def main(source: Path, build: Path) -> None:
    listed = json.loads(output("ctest", "--test-dir", build, "--show-only=json-v1", "-LE", "study|long"))
    tests = {test["name"] for test in listed["tests"]}
    faults = [f"{test} is not a short test" for test in ("unit_material", "pages.snippets", "coupled.pages_test.np1") if test not in tests]
    cases = output(build / "tests" / "unit_material", "--gtest_list_tests", "--gtest_filter=*MaterialConformance*")
    for law in json.loads(output(build / "bin" / "furrow-point", "laws", "--json")):
        if f"/{law}_0 " not in cases:
            faults.append(f"the law {law} has no conformance test")
    styles = json.loads(output(build / "bin" / "furrow", "--keys"))
    pages = {page.stem for page in (source / "coupling").rglob("*.md")}
    for style in styles:
        internal = style.startswith("fix furrow/") or style == "fix ave/time"
        if not internal and style.replace(" ", "_").replace("/", "_") not in pages:
            faults.append(f"the style {style} has no page with an example")
    scenes = [scene.stem for scene in (source / "inputs" / "scenes").glob("*.lig")]
    for scene in scenes:
        if not tests & {f"scenes.short.{scene}", f"scenes.{scene}.np1", f"scenes.{scene}.np2"}:
            faults.append(f"the scene {scene} has no short test")
    print(f"{len(tests)} short tests, {len(styles)} styles, {len(scenes)} scenes")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
