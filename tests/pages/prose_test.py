# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages and comments stay readable: prose_test.py <source> [--update | --worst FOLDER].

Four figures of each folder's prose, apart for pages, C++ comments and Python comments, have limits:
words per sentence, the share of long sentences, the share of sentences with many numbers, and terms
that the table of words in CONTRIBUTING.md replaces. A folder over a limit has a row in
prose_limits.csv, next to this file, with its present figures. They may only fall: --update lowers
them, removes rows that are no longer needed, and never raises one. --worst shows the sentences of a
folder to rewrite first.
"""

import ast
import csv
import io
import re
import sys
import tokenize
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

LONG = 30  # words of a long sentence
MANY = 3  # numbers that a sentence may have
LIMITS = {"words": 16.5, "long_percent": 5.0, "numbers_percent": 2.0, "terms_per_1000": 0.3}
CLEAN = ("src/theory", "inputs/guide")  # pages below have none of the terms
SKIPPED = re.compile(r"(^|/)(build[^/]*|results[^/]*|\.git|__pycache__)(/|$)")
RECORD = "prose_limits.csv"

ABBREVIATION = re.compile(r"\b(e\.g|i\.e|eqs?|figs?|al|vs|approx|ed|ch|sec|no|pp?)\.", re.I)
SENTENCE_END = re.compile(r"[.!?;:]\s+(?=[\"'(\[]*[A-Z0-9])")
NUMBER = re.compile(r"(?<![\w./-])\d+(?:[.,]\d+)*(?![\w/])")
WORD = re.compile(r"[^\W_][\w'’-]*")


def terms_of(guide: str) -> list[re.Pattern[str]]:
    """First column of the table of words: terms apart by commas, with what explains them in ()."""
    table = re.search(r"^\| not \| but \|\n\|[-|]+\|\n((?:\|.*\n)+)", guide, re.M)
    if table is None:
        sys.exit("CONTRIBUTING.md: has no table '| not | but |'")
    terms = []
    for row in table[1].splitlines():
        cell = re.sub(r"\([^)]*\)", "", row.split("|")[1])
        terms += [term.strip() for term in cell.split(",") if term.strip()]
    if len(terms) < 20:
        sys.exit(f"CONTRIBUTING.md: only {len(terms)} terms were found in the table of words")
    return [re.compile(rf"\b{re.escape(term)}(?!\w)", re.I) for term in terms]


def without_markup(text: str) -> str:
    """Formulas, code and addresses become one word each."""
    text = re.sub(r"<!--.*?-->", " ", text, flags=re.S)
    text = re.sub(r"`[^`]*`", "Code", text)
    text = re.sub(r"\$[^$]+\$", "Formula", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return text.replace("*", "")


def paragraphs_of_page(text: str) -> Iterator[str]:
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    text = re.sub(r"^\$\$.*?\$\$$", "", text, flags=re.M | re.S)
    for block in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.)\s)", text):
        lines = [line for line in block.splitlines() if not re.match(r"\s*[|#]", line)]
        yield re.sub(r"^\s*(?:[-*]|\d+\.)\s+", "", " ".join(lines))


def paragraphs_of_cpp(text: str) -> Iterator[str]:
    """Comments on successive lines are one paragraph. A command of Doxygen begins another, and so
    does a comment behind code. An indented line is a formula or a table."""
    lines: list[str] = []
    was_behind = False
    for line in text.splitlines():
        comment = re.search(r"(?:^|\s)//[/!]?(<?)\s?(.*)$", line)
        body = comment[2] if comment and "SPDX" not in line else ""
        behind = comment is not None and line[: comment.start()].strip() != ""
        goes_on = was_behind and comment is not None and bool(comment[1]) and not behind
        if not body.strip() or re.match(r"@\w+", body) or behind or (was_behind and not goes_on):
            yield " ".join(lines)
            lines = []
        if body.strip() and not body.startswith("  "):
            lines.append(re.sub(r"@\w+", "", body))
        was_behind = behind or goes_on
    yield " ".join(lines)


def paragraphs_of_python(text: str) -> Iterator[str]:
    """The same for Python, and the paragraphs of docstrings."""
    lines: list[str] = []
    last = 0
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type != tokenize.COMMENT or token.string.startswith(("#!", "# SPDX", "# fmt")):
            continue
        behind_code = token.line[: token.start[1]].strip() != ""
        if token.start[0] != last + 1 or behind_code:
            yield " ".join(lines)
            lines = []
        lines.append(token.string.lstrip("# "))
        last = 0 if behind_code else token.start[0]
    yield " ".join(lines)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            for block in re.split(r"\n\s*\n", ast.get_docstring(node) or ""):
                yield " ".join(
                    line for line in block.splitlines() if not line.startswith("    ")
                )


READERS = {
    ".md": ("pages", paragraphs_of_page),
    ".h": ("C++", paragraphs_of_cpp),
    ".cpp": ("C++", paragraphs_of_cpp),
    ".py": ("Python", paragraphs_of_python),
}


@dataclass
class Prose:
    """The sentences of the files of one kind in a folder."""

    terms: list[re.Pattern[str]]
    sentences: list[tuple[str, str]] = field(default_factory=list)  # file, sentence

    def read(self, name: str, paragraphs: Iterator[str]) -> None:
        for paragraph in paragraphs:
            text = ABBREVIATION.sub(lambda hit: hit[1], without_markup(paragraph))
            for sentence in SENTENCE_END.split(text):
                if len(WORD.findall(sentence)) > 2:
                    self.sentences.append((name, " ".join(sentence.split())))

    def hits(self, sentence: str) -> int:
        return sum(len(term.findall(sentence)) for term in self.terms)

    def figures(self) -> dict[str, float]:
        """The measured figures; one sentence alone is no share of a small folder."""
        lengths = [len(WORD.findall(sentence)) for _, sentence in self.sentences]
        count, words = len(lengths), sum(lengths)
        if not count:
            return dict.fromkeys(LIMITS, 0.0)
        long = sum(length > LONG for length in lengths)
        many = sum(len(NUMBER.findall(sentence)) > MANY for _, sentence in self.sentences)
        hits = sum(self.hits(sentence) for _, sentence in self.sentences)

        def share(found: int, of: int, factor: float) -> float:
            return factor * found / of if found > 1 else 0.0

        return {
            "words": words / count,
            "long_percent": share(long, count, 100.0),
            "numbers_percent": share(many, count, 100.0),
            "terms_per_1000": share(hits, words, 1000.0),
        }


def folder_of(path: Path, source: Path) -> str:
    parts = path.relative_to(source).parent.parts
    return "/".join(parts[:2]) or "."


def read_all(source: Path, terms: list[re.Pattern[str]]) -> dict[tuple[str, str], Prose]:
    found: dict[tuple[str, str], Prose] = defaultdict(lambda: Prose(terms))
    for path in sorted(source.rglob("*")):
        relative = str(path.relative_to(source))
        if path.suffix not in READERS or SKIPPED.search(relative) or not path.is_file():
            continue
        kind, reader = READERS[path.suffix]
        found[folder_of(path, source), kind].read(
            relative, reader(path.read_text(encoding="utf-8"))
        )
    return found


Record = dict[tuple[str, str], dict[str, float]]


def read_record(path: Path) -> Record:
    with path.open(encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {
            (row["folder"], row["kind"]): {key: float(row[key]) for key in LIMITS} for row in rows
        }


def write_record(path: Path, record: Record) -> None:
    with path.open("w", encoding="utf-8") as file:
        file.write("# Present figures of folders over a limit of prose_test.py, which explains them.\n")
        file.write("folder,kind," + ",".join(LIMITS) + "\n")
        for (folder, kind), figures in sorted(record.items()):
            file.write(f"{folder},{kind}," + ",".join(f"{figures[k]:.1f}" for k in LIMITS) + "\n")


def over(figures: dict[str, float], allowed: dict[str, float]) -> list[str]:
    """Names of the figures above what is allowed, to the digit that the record has."""
    return [key for key in LIMITS if round(figures[key], 1) > max(allowed[key], LIMITS[key])]


def update(path: Path, record: Record, now: Record) -> None:
    lowered: Record = {}
    for place, figures in now.items():
        if not over(figures, LIMITS):
            continue
        before = record.get(place, figures if not record else LIMITS)
        lowered[place] = {key: min(figures[key], before[key]) for key in LIMITS}
    write_record(path, lowered)


def show_worst(found: dict[tuple[str, str], Prose], folder: str) -> None:
    for (name, kind), prose in sorted(found.items()):
        if name != folder:
            continue
        print(name, kind, {key: round(value, 1) for key, value in prose.figures().items()})
        hardness = [
            (len(WORD.findall(s)) + 4 * len(NUMBER.findall(s)) + 10 * prose.hits(s), file, s)
            for file, s in prose.sentences
        ]
        for value, file, sentence in sorted(hardness, reverse=True)[:25]:
            print(f"  {value:3d} {file}: {sentence}")


def main(source: Path, options: list[str]) -> None:
    path = Path(__file__).with_name(RECORD)
    terms = terms_of((source / "CONTRIBUTING.md").read_text(encoding="utf-8"))
    found = read_all(source, terms)
    if options[:1] == ["--worst"]:
        show_worst(found, options[1])
        return
    now = {place: prose.figures() for place, prose in found.items()}
    record = read_record(path) if path.exists() else {}
    if options == ["--update"]:
        update(path, record, now)
        return
    errors = []
    for place, figures in sorted(now.items()):
        for key in over(figures, record.get(place, LIMITS)):
            allowed = max(record.get(place, LIMITS)[key], LIMITS[key])
            errors.append(
                f"{place[0]}, {place[1]}: {key} is {figures[key]:.1f}, allowed {allowed:g}; "
                f"see prose_test.py . --worst {place[0]}"
            )
    for (folder, kind), prose in found.items():
        if kind == "pages" and folder.startswith(CLEAN):
            for file, sentence in prose.sentences:
                if prose.hits(sentence):
                    errors.append(f"{file}: a term that CONTRIBUTING.md replaces: {sentence}")
    if errors:
        sys.exit("\n".join(errors))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), sys.argv[2:])
