# SPDX-License-Identifier: GPL-2.0-or-later
"""The accuracy table on a phone 360 px wide: every cell is in view, with the name of its column."""

import html
import re
import unittest

from support.browser import Browser
from support.command import SOURCE
from support.folder import FolderTest

STATIC = SOURCE / "postproc" / "site" / "static"
PHONE, DESKTOP = 360, 770  # [pixel] of the text
LEAST = 90  # [pixel] of a column of words


def table() -> str:
    """The first table of the accuracy page as Sphinx writes it."""
    page = (SOURCE / "inputs" / "validation" / "README.md").read_text(encoding="utf-8")
    page = re.sub(r"<!--.*?-->|\[([^]]*)\]\([^)]*\)", r"\1", page)
    found = re.search(r"(?:^\|.*\n)+", page, re.M)
    assert found
    head, _, *body = ([cell.strip() for cell in row.strip("|").split("|")] for row in found[0].splitlines())

    def row(tag: str, cells: list[str]) -> str:
        return "<tr>" + "".join(f"<{tag}><p>{html.escape(cell)}</p></{tag}>" for cell in cells) + "</tr>"

    rows = "\n".join(row("td", cells) for cells in body)
    return f"<table><thead>{row('th', head)}</thead><tbody>{rows}</tbody></table>"


class AccuracyTableTest(FolderTest):
    def shown(self, width: int) -> Browser:
        files = {name: (STATIC / name).read_text(encoding="utf-8") for name in ("tables.css", "tables.js")}
        page = self.folder / "page.html"
        page.write_text(
            '<!DOCTYPE html><html><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width"/>'
            f"<style>body {{ margin: 16px; font: 16px sans-serif; }} p {{ margin: 0; }} {files['tables.css']}</style>"
            f"</head><body><article>{table()}</article><script>{files['tables.js']}</script></body></html>",
            encoding="utf-8",
        )
        browser = Browser(width, 740)
        self.addCleanup(browser.close)
        browser.open(page)
        browser.wait_for("document.querySelectorAll('table.many-columns').length == 1")
        self.assertEqual(browser.troubles, [])
        return browser

    def test_phone_shows_every_cell_with_the_name_of_its_column(self) -> None:
        browser = self.shown(PHONE)
        self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), PHONE)
        cells = browser.evaluate(
            "[...document.querySelectorAll('td')].map((cell) => { const p = cell.querySelector('p');"
            "const label = getComputedStyle(cell, '::before').content, box = p.getBoundingClientRect();"
            "return [cell.dataset.label, label, box.left, box.right, box.width]; })"
        )
        self.assertGreater(len(cells), 40)
        for name, label, left, right, width in cells:
            self.assertGreaterEqual(left, 0)
            self.assertLessEqual(right, PHONE)
            self.assertGreater(width, LEAST, name)
            self.assertIn(label, (f'"{name}"', "none" if name == "what" else ""))

    def test_desktop_shows_all_columns(self) -> None:
        browser = self.shown(DESKTOP)
        self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), DESKTOP)
        first = "document.querySelector('tbody td:first-child').getBoundingClientRect().width"
        self.assertGreater(browser.evaluate(first), LEAST)


if __name__ == "__main__":
    unittest.main()
