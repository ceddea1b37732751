#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Collects every sentence a user may read into the catalogues of translations.

Sentences of the window stand in tr(); lupdate finds them. Sentences of `core` are English formats of {fmt} ("file {} is
not there"); this script finds them and writes them into widgets/common/core_formats, a file for each folder of core, where
lupdate sees them under the context "core" and the program looks them up (widgets/common/core_sentence.h).

    update.py           writes core_formats/*.cpp and brings all resources/translations/*.ts up to date
    update.py --check   writes nothing; exit status 1 and what is missing if a file is not up to date
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

TOP = pathlib.Path(__file__).resolve().parents[2]
FORMATS = TOP / "widgets/common/core_formats"
# Beside the folders of core: words, counts and headings that are put together, and texts of the window.
WORDS_FILE, WINDOW_FILE = "words", "window"
CATALOGUES = TOP / "resources/translations"
# Decks for solvers, the reference of files and of the command line are documents of their own: English.
LEFT_OUT = re.compile(r"core/finite_elements/|core/workflows/file_|core/base/program_reference|"
                      r"core/plant/plant_schema|core/discrepancy/catalogue\.h")
# Headings and titles of columns in reports are often a single word.
OF_REPORTS = re.compile(r"core/(reporting/|\w+/\w*report|workflows/manual\.cpp)")
TITLE = re.compile(r"[A-Z][a-z]+:?")
# Arguments of these are for machines or for programmers.
NOT_SHOWN = {"SPINDRIFT_ASSERT", "guarded", "writing", "prepare", "log", "demand", "send", "set_pattern", "set_name",
             "format_error", "starts_with", "ends_with", "rfind", "find", "selectResults", "writeFileAtomically", "open",
             "InternalError", "invalid_argument", "logic_error", "countOf", "format_to"}
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((?:.*?)\)\1"|"((?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\\n]|\\.)+\''
                   r'|[A-Za-z_]\w*|\d[\w.\']*|::|->|<<|\S', re.S)
# Sentences that core puts together in more than one place.
COMPOSED = ("squareness of {} to {}", "{} = {}, before {}",
            "{} of {} captures failed the check. Take them again, or exclude them.", "{} before", "{} after", "{} (reference)",
            "{} focus", "{} rotation", "{} along X", "{} along Y", "radius {:g} mm", "holes of {:g} mm", "certified at {:g} °C",
            "expansion {:g} µm/(m K)", "uncertainty of the certificate {:g} µm")
# Words that stand alone.
ALONE = ("push broom", "α about X", "β about Y", "γ about Z", "and", "or", "measured", "simulation", "one", "two", "three", "four", "five", "focus", "spindle changed", "re-levelled", "crash", "repair", "moved", "note", "tilt", "rotation", "Signatures", "Where simulation and measurement disagree", "converged", "degenerate", "no convergence", "rejected", "artefact", "bed", "column", "coolant", "instrument", "room",
         "table", "rotary drive", "before", "after", "noise", "added", "ahead of", "behind", "effects", "remainder", "cycle",
         "none", "remains", "named", "(proposed)", "earlier", "later", "ambient", "spindle", "housing", "rotary", "stylus", "ball screw", "rotary encoder",
         "linear scale", "linear motor", "gain", "gain lift", "time constant", "time constant on", "time constant off")
# The window lists the sections of a report.
HEADING = re.compile(r'(?:\bsection\((?:fmt::format\()?|\bsections\.(?:push_back|emplace_back)\(\{?)\s*"([^"]+)"')
INSTRUMENT = re.compile(r'if \(instrument == "\w+"\) return "([^"]+)";')
# Help is XHTML with drawings: every block of it is a text of its own, with its marks (widgets/common/help_text.cpp).
HELP_BLOCKS = {"h3", "h4", "p", "li", "td", "text"}
PLACEHOLDER = re.compile(r"\{[^{}]*(?:\{\}[^{}]*)*\}")
STATEMENT = re.compile(r"\s*(not exists|select|insert|update|delete|create|drop|alter|pragma|where|from|order by|for update|begin "
                       r"|set [a-z_.]+ =|set default_|setp |sets |addf |net |newsig |show (pin|sig)|timeout |bigint |integer "
                       r"|do \$|page=\{|DejaVu |Inter, |while (executing|preparing)$|  +|--(wrap|dependency)=|TCH |FN |L [XZ{]|%Y|%\d)")
MARKUP = re.compile(r'</|<\w+[ >]|=\\"|^#|^\*[A-Z]|\\n.*\\n', re.S)
WORDS = re.compile(r"[A-Za-z}][.,:;)'\"\\]* +\S|^ +[a-z]{2}|[a-z]{2}: *$")


def literals(text):
    """(literal, token before, names of the calls around it, token after) of all string literals."""
    text = re.sub(r"^[ \t]*#[^\n]*", "", text, flags=re.M)
    calls, before, current = [], "", None
    for match in TOKEN.finditer(text):
        token = match.group(0)
        if token[:2] in ("//", "/*"):
            continue
        if match.group(2) is not None:
            if current is None:
                current = [match.group(2), before, list(calls)]
            else:
                current[0] += match.group(2)
            continue
        if current is not None:
            yield current[0], current[1], current[2], token
            current = None
        if token in ("(", "[", "{"):
            calls.append(before if token == "(" else "")
        elif token in (")", "]", "}") and calls:
            calls.pop()
        before = token


def isSentence(text):
    """Words for people: a word of three small letters beside the placeholders, in more than a key, a path, a statement or
    a line of the command line (which ends with its line break)."""
    words = re.sub(r"\\.", " ", PLACEHOLDER.sub(" ", text))
    if text.endswith("\\n") or STATEMENT.match(text) or MARKUP.search(text.rstrip("\\n")):
        return False
    return re.search(r"\b[A-Z]?[a-z]{2,}\b", words) is not None and WORDS.search(text) is not None


def coreFormats():
    found = dict.fromkeys(ALONE + COMPOSED, "")
    for path in sorted((TOP / "core").rglob("*")):
        name = path.relative_to(TOP).as_posix()
        if path.suffix not in (".cpp", ".h") or LEFT_OUT.search(name):
            continue
        for text, before, calls, after in literals(path.read_text(encoding="utf-8")):
            title = TITLE.fullmatch(text) and OF_REPORTS.match(name)
            if any(call in NOT_SHOWN for call in calls) or not (title or isSentence(text)):
                continue
            # What is joined with + to something else is part of a longer sentence.
            joined = "format" not in calls[-1:]
            if before in ("+", "+=") and joined and calls[-1:] != ["string"]:
                text = "{}" + text
            if after == "+" and joined:
                text = text + "{}"
            found.setdefault(text.strip() if text.strip().strip("{}") == text.strip() else text, name)
    for path in sorted((TOP / "core").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        found.update(dict.fromkeys(HEADING.findall(text) + INSTRUMENT.findall(text), ""))
    for path in sorted([*(TOP / "core").rglob("*.cpp"), *(TOP / "widgets").rglob("*.cpp")]):
        for text in counts(path.read_text(encoding="utf-8")):
            found.setdefault(text, "")
    return found


def counts(text):
    """"1 touch" and "{} touches" of countOf(n, "touch", "touches"); `many` where it is not `one` with an s."""
    for one, _, many in re.findall(r'countOf\([^;"]*?"([a-z ]+)"(, *"([a-z ]+)")?', text):
        yield "1 " + one
        yield "{} " + (many or one + "s")


HELPER = re.compile(r'(?:QString |auto )(\w+)(?: = \[[^\]]*\])?\(const char\* (\w+)\) \{\s*return '
                    r'QCoreApplication::translate\("([\w:]+)", \2\);')


def collectedTexts():
    """Texts of functions in the window that translate in a context of their own, which lupdate does not look into."""
    found = set()
    for path in sorted((TOP / "widgets").rglob("*.cpp")):
        text = path.read_text(encoding="utf-8")
        contexts = {name: context for name, _, context in HELPER.findall(text)}
        if not contexts or path.parent == FORMATS:
            continue
        for literal, _, calls, _ in literals(text):
            if calls and calls[-1] in contexts:
                found.add((contexts[calls[-1]], literal))
    found.update(("files", escapedText(text)) for text in textsOfFiles())
    for path in sorted([*(TOP / "resources/help").glob("*.html"), *(TOP / "resources/help").glob("*.svg")]):
        text = path.read_text(encoding="utf-8")
        # Pieces of a page have no element around them.
        root = ElementTree.fromstring(text if path.suffix == ".svg" else f"<help>{text}</help>")
        for block in root.iter():
            if block.tag.split("}")[-1] in HELP_BLOCKS and re.search(r"[A-Za-z]{2}", "".join(block.itertext())):
                words = re.sub(r"[ \n\t]+", " ", marked(block)).strip(" ")
                found.add(("help", escapedText(words)))
    return sorted(found)


def escapedText(text):
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")


FILE_TOKEN = re.compile(r'R"\((.*?)\)"|"((?:[^"\\]|\\.)*)"|//[^\n]*|[{},]', re.S)


def textsOfFiles():
    """Words for people of the table of files (core/workflows/file_formats.cpp): its introduction, and of every format the
    title, what it is, and of its keys all but their paths. What is code or a number alone stays in every language."""
    source = (TOP / "core/workflows/file_formats.cpp").read_text(encoding="utf-8")
    found = {re.search(r'introduction = R"\((.*?)\)";', source, re.S).group(1)}
    found |= {"Key or column", "Unit", "Without it", "Allowed", "Meaning"}
    depth, fields, field = 0, [], ""
    for match in FILE_TOKEN.finditer(source, source.index("texts{{") + len("texts{")):
        token = match.group(0)
        if match.group(1) is not None:
            field += match.group(1)
        elif match.group(2) is not None:
            field += re.sub(r"\\(.)", r"\1", match.group(2))
        elif token == "{":
            depth += 1
        elif token in (",", "}") and depth == 2:
            fields.append(field)
            field = ""
            if token == "}":
                _, title, _, what, _, keys = fields
                lines = [[part.strip() for part in line.split("|")] for line in keys.splitlines() if line.strip()]
                found |= {title, what} | {part for line in lines for part in line[1:]}
                units = {unit for line in lines for unit in re.findall(r" {(.*)}$", line[0])}
                found |= {unit for unit in units if re.search(r"\b(?!u?rad|sigma|min)[a-z]{3,}", unit)}
                fields = []
                depth -= 1
        elif token == "}":
            break
    return {text for text in found if re.search(r"[A-Za-z]{2}", re.sub(r"`[^`]*`", "", text))}


def marked(element):
    """Text and marks inside an element of the help."""
    def escaped(text):
        return (text or "").replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped(element.text) + "".join(f"<{each.tag}>{marked(each)}</{each.tag}>{escaped(each.tail)}"
                                           for each in element)


def formatsFiles(found):
    """Path and text of every file below FORMATS."""
    groups = {}
    for text, name in found.items():
        groups.setdefault(name.split("/")[1] if name else WORDS_FILE, []).append(text)
    files = {}
    head = ["// SPDX-License-Identifier: GPL-3.0-or-later",
            "// Written by resources/translations/update.py from the sources; do not edit."]
    for group, texts in sorted(groups.items()):
        lines = head + ['#include "widgets/common/core_formats/groups.h"', "", "#include <QtGlobal>", "",
                        "// clang-format off", "", f"std::span<const char* const> spindrift::gui::core_formats::{group}() noexcept {{",
                        "  static const char* const formats[] = {"]
        lines += ['    QT_TRANSLATE_NOOP("core", "%s"),' % text for text in sorted(texts)]
        files[FORMATS / f"{group}.cpp"] = "\n".join([*lines, "  };", "  return formats;", "}", ""])
    lines = head + ["// Found by lupdate here, looked up where they stand.", "#include <QtGlobal>", "", "// clang-format off", "",
                    "namespace {", "", "[[maybe_unused]] constexpr const char* window_texts[] = {"]
    lines += ['    QT_TRANSLATE_NOOP("%s", "%s"),' % each for each in collectedTexts()]
    files[FORMATS / f"{WINDOW_FILE}.cpp"] = "\n".join([*lines, "};", "", "}  // namespace", ""])
    names = sorted(groups)
    lines = head + ["// The formats of each folder of core, and the words that several of them put together.", "#pragma once", "",
                    "#include <span>", "", "namespace spindrift::gui::core_formats {", ""]
    lines += [f"[[nodiscard]] std::span<const char* const> {name}() noexcept;" for name in names]
    lines += ["", "inline constexpr std::span<const char* const> (*groups[])() noexcept = {"]
    lines += [f"    {name}," for name in names]
    lines += ["};", "", "}  // namespace spindrift::gui::core_formats", ""]
    files[FORMATS / "groups.h"] = "\n".join(lines)
    return files


def runLupdate(catalogue, *options):
    command = ["/usr/lib/qt6/bin/lupdate", "-silent", "-I", ".", "-locations", "none", "-no-obsolete", *options,
               "widgets", "app/gui", "-ts", str(catalogue)]
    subprocess.run(command, cwd=TOP, check=True, stderr=subprocess.DEVNULL)


def sources(catalogue):
    return {(context.findtext("name"), message.findtext("source"), message.findtext("comment") or "")
            for context in ElementTree.parse(catalogue).getroot().iter("context")
            for message in context.iter("message")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; exit status 1 if something is not up to date")
    arguments = parser.parse_args()
    files = formatsFiles(coreFormats())
    catalogues = sorted(CATALOGUES.glob("*.ts"))
    there = {path: path.read_text(encoding="utf-8") for path in FORMATS.glob("*")} if FORMATS.is_dir() else {}
    if not arguments.check:
        FORMATS.mkdir(exist_ok=True)
        for path in there.keys() - files.keys():
            path.unlink()
        for path, text in files.items():
            if there.get(path) != text:
                path.write_text(text, encoding="utf-8")
        for catalogue in catalogues:
            runLupdate(catalogue, *(["-pluralonly"] if catalogue.stem.endswith("_en") else []))
        return 0
    wrong = []
    for path in sorted(there.keys() ^ files.keys() | {path for path in files if there.get(path) != files[path]}):
        wrong.append(f"{path.relative_to(TOP)} is not what the sources say")
    for catalogue in catalogues:
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / catalogue.name
            copy.write_bytes(catalogue.read_bytes())
            runLupdate(copy, *(["-pluralonly"] if catalogue.stem.endswith("_en") else []))
            for where, source, _ in sorted(sources(copy) ^ sources(catalogue)):
                wrong.append(f"{catalogue.name}: {where}: {source}")
    for sentence in wrong:
        print(sentence, file=sys.stderr)
    if wrong:
        print("Run resources/translations/update.py (target translations).", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
