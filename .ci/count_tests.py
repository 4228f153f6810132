#!/usr/bin/python3
"""Names what failed or was skipped in the given JUnit files, and those below the given folders, then counts.

The last line is `N passed, N failed, N skipped`. Exit status 1 if a test failed, if a file cannot
be read, or if no test passed. (catkin_test_results counts every gtest twice and passes over files
that were cut short.)
"""
import pathlib
import sys
import xml.etree.ElementTree

OUTCOMES = {"failure": "failed", "error": "failed", "skipped": "skipped"}


def outcomes(file):
    """Yields (outcome, name, message) of every test case of a JUnit file."""
    try:
        cases = xml.etree.ElementTree.parse(file).getroot().iter("testcase")
    except xml.etree.ElementTree.ParseError as error:
        yield "failed", str(file), f"not a complete JUnit file: {error}"
        return
    for case in cases:
        name = f"{case.get('classname', '')}.{case.get('name', '')}"
        marks = [child for child in case if child.tag in OUTCOMES]
        if not marks:
            yield ("skipped", name, "disabled") if case.get("status") == "notrun" else ("passed", name, "")
        for mark in marks[:1]:
            yield OUTCOMES[mark.tag], name, (mark.get("message") or mark.text or "").strip()


def main():
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for path in map(pathlib.Path, sys.argv[1:]):
        for file in sorted(path.rglob("*.xml")) if path.is_dir() else [path]:
            for outcome, name, message in outcomes(file):
                counts[outcome] += 1
                if outcome != "passed":
                    print(f"{outcome}: {name}: {message}")
    print(", ".join(f"{count} {outcome}" for outcome, count in counts.items()))
    return 1 if counts["failed"] or not counts["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
