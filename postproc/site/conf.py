# SPDX-License-Identifier: GPL-2.0-or-later
"""Configuration of the site: every Markdown page of the tree as one searchable set of HTML pages.

The pages stay as a forge shows them. While Sphinx reads one, links to files that are no pages are
redirected to highlighted copies, and keys of sources become citations.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from docutils import nodes
from pybtex.plugin import register_plugin
from pybtex.style.formatting.unsrt import Style
from pybtex.style.labels import BaseLabelStyle
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_for_filename
from pygments.lexers.special import TextLexer
from pygments.util import ClassNotFound
from sphinx.application import Sphinx

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postproc"))

from furrow_post import __version__

BUILD = Path(os.environ["FURROW_SITE"])  # the folder that CMake gives this target
BUILD.mkdir(parents=True, exist_ok=True)
REFERENCES = "inputs/validation/references"
HEADERS = "postproc/site/headers"

project, version = "Furrow", __version__
extensions = ["myst_parser", "sphinxcontrib.bibtex", "breathe"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_url_schemes = ["http", "https", "mailto", "source"]
source_suffix = {".md": "markdown"}
root_doc = "README"
exclude_patterns = ["build*", "results*", ".git", "**/__pycache__", "**/results"]
suppress_warnings = ["myst.header"]  # a page may skip a level of headings
highlight_language = "none"
MATHJAX = Path("/usr/share/javascript/mathjax")  # Debian's libjs-mathjax
MATHJAX_UNUSED = ("HTML-CSS", "CommonHTML", "PreviewHTML", "NativeMML", "STIX-Web", "Asana-Math",
                  "Gyre-*", "Latin-Modern", "Neo-Euler")  # fmt: skip
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"  # in _static
mathjax2_config = {"tex2jax": {"processClass": "tex2jax_process|mathjax_process|math"}}
html_theme = "furo"
html_static_path = ["static"]
html_css_files, html_js_files = ["tables.css"], ["tables.js"]
html_title = f"Furrow {version}"
html_copy_source = False
html_show_copyright = False
bibtex_bibfiles = [str(BUILD / "references.bib")]
bibtex_default_style = "furrow"
bibtex_reference_style = "label"
breathe_projects = {"furrow": str(BUILD / "doxygen" / "xml")}
breathe_default_project = "furrow"

# The side bar: caption, and pages in their order, patterns as pathlib's
CONTENTS = (
    ("Tutorials", ("inputs/guide/README", "inputs/guide/tutorials/*")),
    ("How to", ("inputs/guide/howto/*", "inputs/sweep/README", "inputs/costs/README",
                "postproc/README")),
    ("Look up", ("inputs/guide/which_*", "inputs/guide/glossary", "inputs/guide/*_files", "inputs/scenes/README",
                 "inputs/README", "inputs/environment", "src/programs/*")),
    ("Styles of the script", ("coupling/README", "coupling/[!l]*/*", "coupling/[!l]*/*/*")),
    ("Theory", ("src/theory/README", "src/theory/*")),
    ("Accuracy", ("inputs/validation/README", "inputs/validation/report_findings",
                  "inputs/validation/*/README",
                  "inputs/crosscheck/README", "inputs/laboratory/*", "tests/reliability",
                  REFERENCES)),
    ("Extend", ("CONTRIBUTING", HEADERS, "src/**/*", "coupling/liggghts/*", "tests/**/*",
                "CHANGELOG")),
    ("More", ("**/*",)),
)  # fmt: skip


class LabelOfKey(BaseLabelStyle):
    def format_labels(self, entries: list[Any]) -> list[str]:
        return [entry.key for entry in entries]


class FurrowStyle(Style):
    default_label_style = LabelOfKey


register_plugin("pybtex.style.formatting", "furrow", FurrowStyle)


def write_bibliography() -> set[str]:
    """The rows of the page of references as a BibTeX file. Returns its keys."""
    page = (ROOT / f"{REFERENCES}.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\w[\w-]*(?:, [\w-]+)*) \| ([^|]+) \|", page, re.M)
    sources = {key: text for keys, text in rows if keys != "key" for key in keys.split(", ")}
    entries = []
    for key, text in sources.items():
        plain = re.sub(r"[*`]", "", text).strip()
        for letter in "\\{}#$%&_^~":
            plain = plain.replace(letter, f"\\{letter}")
        entries.append(f"@misc{{{key},\n  note = {{{plain}}}\n}}\n")
    (BUILD / "references.bib").write_text("\n".join(entries), encoding="utf-8")
    return set(sources)


def public_classes() -> str:
    """Sections for the page for authors: the classes of each header that it lists, by Doxygen."""
    page = ROOT / f"{HEADERS}.md"
    targets = re.findall(r"\]\(([^)]+\.h)\)", page.read_text(encoding="utf-8"))
    found = [(page.parent / target).resolve() for target in targets]
    settings = {
        "PROJECT_NAME": project,
        "INPUT": " ".join(f'"{header}"' for header in found),
        "OUTPUT_DIRECTORY": BUILD / "doxygen",
        "GENERATE_HTML": "NO",
        "GENERATE_LATEX": "NO",
        "GENERATE_XML": "YES",
        "QUIET": "YES",
        "EXTRACT_ALL": "YES",
        "JAVADOC_AUTOBRIEF": "YES",
        "WARN_IF_UNDOCUMENTED": "NO",
        "WARN_IF_INCOMPLETE_DOC": "NO",
        "WARN_AS_ERROR": "FAIL_ON_WARNINGS",
    }
    (BUILD / "doxygen").mkdir(exist_ok=True)
    lines = "".join(f"{name} = {value}\n" for name, value in settings.items())
    subprocess.run(["doxygen", "-"], input=lines, text=True, check=True, cwd=BUILD / "doxygen")
    xml = BUILD / "doxygen" / "xml"
    index = ElementTree.parse(xml / "index.xml").iterfind("compound[@kind='file']")
    files = {entry.findtext("name"): entry.get("refid") for entry in index}
    parts = []
    for header in found:
        parts.append(f"## {header.name}\n")
        inner = ElementTree.parse(xml / f"{files[header.name]}.xml").iterfind(".//innerclass")
        kinds = {entry.text or "": entry.get("refid", "") for entry in inner}
        for name, refid in kinds.items():
            if name.rpartition("::")[0] not in kinds:
                kind = "struct" if refid.startswith("struct") else "class"
                options = ":members:\n:protected-members:"
                parts.append(f"```{{doxygen{kind}}} {name}\n{options}\n```\n")
    return "\n".join(parts)


KEYS = write_bibliography()
CLASSES = public_classes()
CODE = re.compile(r"(^```.*?^```|`[^`\n]+`|\$\$.*?\$\$)", re.M | re.S)
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")


def table_of_contents(pages: set[str]) -> str:
    """Toctrees for the end of the first page, from CONTENTS; each page is in one of them."""
    left, parts = set(pages) - {root_doc}, []
    for caption, patterns in CONTENTS:
        taken: list[str] = []
        for pattern in patterns:
            found = sorted(page for page in left if Path(page).match(pattern))
            found = [page for page in found if _below(page, pattern)]
            taken += found
            left -= set(found)
        if taken:
            lines = "\n".join(f"/{page}" for page in taken)
            options = f":hidden:\n:caption: {caption}\n:maxdepth: 1"
            parts.append(f"```{{toctree}}\n{options}\n\n{lines}\n```\n")
    return "\n".join(parts)


def _below(page: str, pattern: str) -> bool:
    """True if the page lies in the folder of the pattern; pathlib matches from the right alone."""
    if "**" in pattern:
        return page.startswith(pattern.partition("**")[0])
    return page.count("/") == pattern.count("/")


def read_page(app: Sphinx, page: str, source: list[str]) -> None:
    """Redirects links and makes citations, outside of code."""
    folder = (ROOT / page).parent
    pages = app.env.found_docs

    def redirected(match: re.Match[str]) -> str:
        start, target, anchor, end = match.groups(default="")
        path = Path(os.path.normpath(folder / target))
        if ":" in target or not path.exists() or ROOT not in path.parents:
            return match[0]
        name = path.relative_to(ROOT).as_posix()
        if f"{name}/README" in pages:
            return f"{start}/{name}/README.md{anchor}{end}"
        if path.suffix in (".md", ".png", ".gif", ".svg"):
            return match[0]
        app.env.furrow_sources.add(name)
        return f"{start}source:{name}{end}"

    def cited(match: re.Match[str]) -> str:
        keys = [key.strip() for key in match[1].split(",")]
        return f"{{cite}}`{','.join(keys)}`" if all(key in KEYS for key in keys) else match[0]

    parts = CODE.split(source[0])
    for k in range(0, len(parts), 2):
        parts[k] = LINK.sub(redirected, parts[k])
        if page != REFERENCES:
            parts[k] = re.sub(r"(?<!\])\\?\[([\w, -]+)\\?\](?![(\[:])", cited, parts[k])
    source[0] = "".join(parts)
    if page == root_doc:
        source[0] += "\n" + table_of_contents(set(pages))
    if page == REFERENCES:
        source[0] += "\n## Bibliography\n\n```{bibliography}\n:all:\n```\n"
    if page == HEADERS:
        source[0] += f"\n{CLASSES}"


def finish_page(app: Sphinx, tree: nodes.document, page: str) -> None:
    """Makes links to copies of files relative to the page."""
    for link in tree.findall(nodes.reference):
        if link.get("refuri", "").startswith("source:"):
            name = link["refuri"].partition(":")[2]
            link["refuri"] = app.builder.get_relative_uri(page, f"sources/{name}")
    # docutils 0.19 opens no list of citations where the first one is the first child
    for citation in tree.findall(nodes.citation):
        if citation.parent.index(citation) == 0:
            citation.parent.insert(0, nodes.comment("", ""))


def sources(app: Sphinx) -> Any:
    """Highlighted copies of the files that pages link to, and the first page."""
    first = {
        "title": "Furrow",
        "body": "<p><a href='README.html'>Furrow</a></p>",
        "metatags": "<meta http-equiv='refresh' content='0; url=README.html'>",
    }
    yield "index", first, "page.html"
    formatter = HtmlFormatter(linenos=False)
    for name in sorted(app.env.furrow_sources):
        path = ROOT / name
        if path.is_dir():
            names = sorted(entry.name for entry in path.iterdir())
            text = "\n".join(each for each in names if not each.startswith(("__", ".")))
        else:
            text = path.read_text(encoding="utf-8", errors="replace")
        try:
            lexer = get_lexer_for_filename(path.name)
        except ClassNotFound:
            lexer = TextLexer()
        body = f"<h1>{name}</h1>\n{highlight(text, lexer, formatter)}"
        yield f"sources/{name}", {"body": body, "title": name}, "page.html"


def copy_mathjax(app: Sphinx, error: Exception | None) -> None:
    """Copies the part of MathJax that equations need without a network, about 5 MB."""
    target = Path(app.outdir) / "_static" / "mathjax"
    if error is None and not target.exists():
        for part in ("config/TeX-AMS_SVG.js", "jax", "extensions", "localization/en"):
            if (MATHJAX / part).is_dir():
                unused = shutil.ignore_patterns(*MATHJAX_UNUSED)
                shutil.copytree(MATHJAX / part, target / part, ignore=unused)
            else:
                (target / part).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(MATHJAX / part, target / part)
        shutil.copy(MATHJAX / "MathJax.js", target)


def setup(app: Sphinx) -> None:
    def begin(app: Sphinx, env: Any, _: Any) -> None:
        env.furrow_sources = getattr(env, "furrow_sources", set())

    app.connect("env-before-read-docs", begin)
    app.connect("source-read", read_page)
    app.connect("doctree-resolved", finish_page)
    app.connect("html-collect-pages", sources)
    app.connect("build-finished", copy_mathjax)
