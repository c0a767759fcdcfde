# SPDX-License-Identifier: GPL-2.0-or-later
"""The page in 3D in headless Chromium: it needs no network, shows what the run did, and is operated."""

import re
import unittest
from typing import Any

import numpy as np

from support.browser import Browser
from support.command import run_post
from support.folder import SharedFolderTest
from support.motion import (
    FRAMES,
    INTERVAL,
    LEVEL,
    SINKAGE,
    SPEED,
    ground,
    settlement,
    write_moving_run,
    write_rolling_wheel,
)
from support.runs import RADIUS

BEHIND = 3 * RADIUS  # of a rear wheel [m]
READY = "document.querySelector('.furrow-view')?.dataset.ready == 'yes'"
STAGE = (slice(50, 280), slice(30, 610))  # rows and columns of a screenshot inside the canvas


class ViewTest(SharedFolderTest):
    browser: Browser

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        for kind in ("grains", "continuum"):
            write_moving_run(cls.folder / kind, kind)
        cls.browser = Browser(640, 560)
        cls.addClassCleanup(cls.browser.close)

    def show(self, *folders: str) -> None:
        """Writes the page of these runs, once, and opens it."""
        page = self.folder / f"{'_'.join(folders)}.html"
        if not page.exists():
            done = run_post("view", *(self.folder / name for name in folders), "-o", page)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.browser.open(page)
        self.browser.wait_for(READY)

    def set(self, control: str, value: float) -> None:
        self.browser.evaluate(
            f"{{ const input = document.querySelector('.furrow-{control}'); input.value = {value};"
            " input.dispatchEvent(new Event('input')); }"
        )

    def stage(self) -> Any:
        """Pixels of the canvas, without the rows of labels and legend."""
        return self.browser.screenshot()[STAGE][:, :, :3]

    def changed(self, before: Any, after: Any) -> float:
        """Share of pixels that differ."""
        return float((np.abs(before - after).max(axis=2) > 0.02).mean())

    def test_loads_without_error_and_without_a_network(self) -> None:
        self.show("grains")
        self.assertEqual(self.browser.troubles, [])
        self.assertEqual(self.browser.requests, [(self.folder / "grains.html").resolve().as_uri()])
        text = (self.folder / "grains.html").read_text(encoding="utf-8")
        self.assertFalse(re.search(r"(src|href)=\"(?!data:)", text))
        self.assertTrue(f"grains: all {FRAMES} frames." in text)

    def test_canvas_shows_wheel_and_ground(self) -> None:
        self.show("grains")
        stage = self.stage()
        drawn = np.abs(stage - stage[0, 0]).max(axis=2) > 0.1
        self.assertGreater(drawn.mean(), 0.05)
        sand = stage[:, :, 0] - stage[:, :, 2] > 0.15
        wheel = drawn & (np.abs(stage[:, :, 0] - stage[:, :, 2]) < 0.1)
        self.assertGreater(sand.mean(), 0.01)
        self.assertGreater(wheel.mean(), 0.01)

    def test_places_are_those_of_the_run(self) -> None:
        for kind in ("grains", "continuum"):
            self.show(kind)
            for frame in (0, FRAMES - 1):
                levels = self.browser.evaluate(
                    "(() => { const run = document.querySelector('.furrow-view').view.runs[0];"
                    "const cloud = run.clouds[0], n = 3 * cloud.count, u = cloud.group.children[0]"
                    ".material.uniforms, low = u.low.value.toArray(), span = u.span.value.toArray();"
                    f"return Array.from(cloud.places.slice({frame} * n, {frame + 1} * n), (p, i) =>"
                    "low[Math.floor(i / cloud.count)] + span[Math.floor(i / cloud.count)] * p / 65535);"
                    "})()"
                )
                shown = np.array(levels).reshape(3, -1).T
                start = ground()
                expected = start + settlement(start, frame * INTERVAL)
                resolution = (expected.max(axis=0) - expected.min(axis=0) + SINKAGE) / 65534
                self.assertLess((np.abs(shown - expected) / resolution).max(), 1.0)
                centre = self.browser.evaluate(
                    "(() => { const [body] = document.querySelector('.furrow-view').view.runs[0].bodies;"
                    f"return [body.centre({frame}, 0), body.centre({frame}, 2)]; }})()"
                )
                travelled = [SPEED * frame * INTERVAL, LEVEL + RADIUS - SINKAGE]
                # the middle of a polygon that has turned
                np.testing.assert_allclose(centre, travelled, atol=0.01 * RADIUS)

    def test_every_wheel_is_shown_and_rolls(self) -> None:
        run = write_moving_run(self.folder / "two_axles")
        write_rolling_wheel(run / "rear", BEHIND)
        self.show("two_axles")
        for frame in (0, FRAMES - 1):
            centres = self.browser.evaluate(
                "document.querySelector('.furrow-view').view.runs[0].bodies.map("
                f"(body) => body.centre({frame}, 0))"
            )
            front = SPEED * frame * INTERVAL
            np.testing.assert_allclose(centres, [front, front - BEHIND], atol=0.01 * RADIUS)
        with_wheels = self.stage()
        self.browser.evaluate("document.querySelector('.furrow-body').click()")
        gone = np.abs(with_wheels - self.stage()).max(axis=(0, 2)) > 0.02  # of the columns
        # seen from the front right: a gap between two wheels
        self.assertGreater(np.count_nonzero(np.diff(gone.astype(int)) == -1), 1)

    def test_time_cut_colour_and_camera_change_the_picture(self) -> None:
        self.show("grains")
        start = self.stage()
        self.set("time", FRAMES - 1)
        end = self.stage()
        self.assertGreater(self.changed(start, end), 0.005)
        clock = self.browser.evaluate("document.querySelector('.furrow-clock').textContent")
        self.assertEqual(clock, f"t = {(FRAMES - 1) * INTERVAL:.3f} s")
        self.set("cut", 0.15)
        cut = self.stage()
        self.assertGreater(self.changed(end, cut), 0.005)
        self.set("cut", -1e3)  # none
        self.assertLess(self.changed(end, self.stage()), 1e-3)
        self.browser.evaluate(
            "{ const s = document.querySelector('.furrow-quantity'); s.selectedIndex = 1;"
            "s.dispatchEvent(new Event('change')); }"
        )
        unit = self.browser.evaluate("document.querySelector('.furrow-unit').textContent")
        self.assertEqual(unit, "speed [m/s]")
        self.browser.evaluate("document.querySelector('[data-look=above]').click()")
        self.assertGreater(self.changed(end, self.stage()), 0.05)
        self.assertEqual(self.browser.troubles, [])

    def test_play_goes_to_the_end(self) -> None:
        self.show("grains")
        self.browser.evaluate("document.querySelector('.furrow-speed').value = 2")
        self.browser.evaluate("document.querySelector('.furrow-play').click()")
        self.browser.wait_for(f"document.querySelector('.furrow-time').value == {FRAMES - 1}")
        self.browser.wait_for("document.querySelector('.furrow-play').textContent == 'play'")

    def test_two_runs_turn_together(self) -> None:
        self.show("grains", "continuum")
        before = self.stage()
        self.browser.drag((200, 180), (260, 150))
        after = self.stage()
        middle = before.shape[1] // 2
        for half in (slice(0, middle), slice(middle, None)):
            self.assertGreater(self.changed(before[:, half], after[:, half]), 0.02)
        labels = self.browser.evaluate(
            "[...document.querySelectorAll('.furrow-label')].map((e) => e.textContent)"
        )
        self.assertEqual(labels, ["grains", "continuum"])
        self.assertEqual(self.browser.troubles, [])

    def test_a_small_page_has_fewer_frames_then_fewer_points(self) -> None:
        library = 0.88  # [MB] of three.js
        write_moving_run(self.folder / "large", number=20, noise=0.01)
        page = self.folder / "small.html"
        done = run_post("view", self.folder / "large", "-o", page, "--size", library + 0.1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(page.stat().st_size, 1e6 * (library + 0.12))  # and the page's own words
        note = re.search(r"one of (\d+) points, enlarged", page.read_text(encoding="utf-8"))
        assert note
        self.assertGreater(int(note[1]), 1)
        self.browser.open(page)
        self.browser.wait_for(READY)


if __name__ == "__main__":
    unittest.main()
