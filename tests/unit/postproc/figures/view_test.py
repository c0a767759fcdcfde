# SPDX-License-Identifier: GPL-2.0-or-later
"""The page in 3D in headless Chromium: it needs no network, shows what the run did, and is operated."""

import re
import unittest
from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.arrays import Floats, Integers
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
    write_vtp,
)
from support.runs import RADIUS

BEHIND = 3 * RADIUS  # of a rear wheel [m]
READY = "document.querySelector('.furrow-view')?.dataset.ready == 'yes'"
EDGE = 6  # [pixel] of the canvas


def write_body(folder: Path, x: Floats, triangles: Integers) -> None:
    """A run on grains with this body, which does not move, in place of the wheel."""
    write_moving_run(folder)
    for k in range(FRAMES):
        write_vtp(folder / "vtk" / f"wheel_{k}.vtp", x, triangles, velocity=0 * x)


def box() -> tuple[Floats, Integers]:
    """Corners and triangles of a cube."""
    x = np.array([[i, j, k] for i in (0.0, 0.3) for j in (0.0, 0.3) for k in (0.3, 0.6)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return x, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


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
        """Pixels of the canvas."""
        left, top, right, bottom = self.browser.evaluate(
            "(() => { const r = document.querySelector('canvas').getBoundingClientRect();"
            "return [r.left, r.top, r.right, r.bottom].map(Math.round); })()"
        )
        return self.browser.screenshot()[top:bottom, left:right, :3]

    def time(self) -> float:
        return float(self.browser.evaluate("document.querySelector('.furrow-time').value"))

    def changed(self, before: Any, after: Any) -> float:
        """Share of pixels that differ."""
        return float((np.abs(before - after).max(axis=2) > 0.02).mean())

    def test_page_loads_without_errors_and_network(self) -> None:
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

    def test_positions_equal_those_of_the_run(self) -> None:
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
        self.set("time", 0)
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

    def test_page_opens_at_the_end_with_everything_in_view(self) -> None:
        for folders in (("grains",), ("grains", "continuum")):
            self.show(*folders)
            self.assertEqual(self.time(), FRAMES - 1)
            for look in ("oblique", "side", "front", "above"):
                self.browser.evaluate(f"document.querySelector('[data-look={look}]').click()")
                stage = self.stage()
                drawn = np.abs(stage - stage[1, 1]).max(axis=2) > 0.05
                for edge in (drawn[:EDGE], drawn[-EDGE:], drawn[:, :EDGE], drawn[:, -EDGE:]):
                    self.assertFalse(edge.any(), look)
                # and no further away than needed
                filled = [np.ptp(np.flatnonzero(drawn.any(axis=k))) / drawn.shape[1 - k] for k in (0, 1)]
                self.assertGreater(max(filled), 0.75, look)

    def test_scale_result_and_error_are_on_the_page(self) -> None:
        self.show("grains")
        label = self.browser.evaluate("document.querySelector('.furrow-label').textContent")
        self.assertEqual(
            label.partition(";")[0],
            "grainshub drop 50 ± 7 mm, resistance coefficient 0.20 ± 0.18 (+ mesh, step, contact, material unknown)",
        )
        text, pixels = self.browser.evaluate(
            "(() => { const { view } = document.querySelector('.furrow-view');"
            "const ends = [-0.5, 0.5].map((at) => view.runs[0].scale.localToWorld("
            "new view.controls.target.constructor(at, 0, 0)).project(view.camera).x);"
            "return [document.querySelector('.furrow-scale').textContent, ends[1] - ends[0]]; })()"
        )
        self.assertEqual(text, "500 mm")
        centre = self.browser.evaluate(
            "(() => { const { view } = document.querySelector('.furrow-view');"
            "return [view.runs[0].scale.scale.x, view.length]; })()"
        )
        self.assertEqual(centre, [0.5, 0.5])  # [m]
        self.assertGreater(pixels, 0.1)

    def test_legend_covers_no_ground(self) -> None:
        self.show("grains")
        bottom, top = self.browser.evaluate(
            "[document.querySelector('canvas').getBoundingClientRect().bottom,"
            "document.querySelector('.furrow-legend').getBoundingClientRect().top]"
        )
        self.assertGreaterEqual(top, bottom)

    def test_wheel_is_shaded_smoothly(self) -> None:
        """Corners that meet on a rim have one normal; a square box keeps its edges."""
        self.show("grains")
        self.assertLess(self.spread_of_normals(), 1e-3)
        write_body(self.folder / "box", *box())
        self.show("box")
        self.assertGreater(self.spread_of_normals(), 1.0)

    def spread_of_normals(self) -> float:
        """Largest distance of the normals of corners at one place."""
        return float(
            self.browser.evaluate(
                "(() => { const [body] = document.querySelector('.furrow-view').view.runs[0].bodies;"
                "const found = new Map(); let most = 0;"
                "body.triangles.forEach((node, k) => {"
                "  const own = body.normals.slice(3 * k, 3 * k + 3), other = found.get(node);"
                "  if (other) most = Math.max(most, Math.hypot(...own.map((x, i) => x - other[i])));"
                "  else found.set(node, own); }); return most; })()"
            )
        )

    def test_touching_grains_do_not_penetrate_the_wheel(self) -> None:
        """A sheet that cuts 3 cm off the grains below it is seen whole from above."""
        low, high = np.array([0.5, 0.0]), np.array([0.9, 0.25])
        x = np.array([[x, y, LEVEL - 0.03] for x in (low[0], high[0]) for y in (low[1], high[1])])
        write_body(self.folder / "sheet", x, np.array([[0, 1, 2], [1, 3, 2]]))
        self.show("sheet")
        self.browser.evaluate("document.querySelector('[data-look=above]').click()")
        corners = self.browser.evaluate(
            "(() => { const { view } = document.querySelector('.furrow-view'), [run] = view.runs;"
            "const Vector = view.controls.target.constructor;"
            f"return {x.tolist()}.map((p) => {{ const s = new Vector(...p); s.x += run.root.position.x;"
            "s.project(view.camera); return [s.x, s.y]; }); })()"
        )
        stage = self.stage()
        rows, columns = stage.shape[:2]
        across, up = np.array(corners).T
        left, right = (int((0.5 + 0.5 * end) * columns) for end in (across.min(), across.max()))
        top, bottom = (int((0.5 - 0.5 * end) * rows) for end in (up.max(), up.min()))
        inside = stage[top + 3 : bottom - 3, left + 3 : right - 3]
        self.assertGreater(inside.size, 3000)
        sand = inside[:, :, 0] - inside[:, :, 2] > 0.15
        self.assertFalse(sand.any())

    def test_play_runs_to_the_end(self) -> None:
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
            "[...document.querySelectorAll('.furrow-name')].map((e) => e.textContent)"
        )
        self.assertEqual(labels, ["grains", "continuum"])
        self.assertEqual(self.browser.troubles, [])

    def test_small_page_has_fewer_frames_then_fewer_points(self) -> None:
        library = 0.88  # [MB] of three.js
        write_moving_run(self.folder / "large", number=20, noise=0.01)
        page = self.folder / "small.html"
        done = run_post("view", self.folder / "large", "-o", page, "--size", library + 0.1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(page.stat().st_size, 1e6 * (library + 0.13))  # and the page's own words
        note = re.search(r"one of (\d+) points, enlarged", page.read_text(encoding="utf-8"))
        assert note
        self.assertGreater(int(note[1]), 1)
        self.browser.open(page)
        self.browser.wait_for(READY)


if __name__ == "__main__":
    unittest.main()
