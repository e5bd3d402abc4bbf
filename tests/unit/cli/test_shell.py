"""What the shell completes, and the form of a hull file as other programs read it."""

import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from assoc_hull.cli import main
from assoc_hull.io import hull_json as hull_schema

BASH = shutil.which("bash")


@pytest.fixture
def script(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """The script for bash."""
    assert main(["completion", "bash"]) == 0
    path = tmp_path / "completion.bash"
    path.write_text(capsys.readouterr().out, "utf-8")
    return path


def completed(script: Path, *words: str) -> set[str]:
    """What bash offers for the last of these words of a command line."""
    assert BASH is not None
    (script.parent / "ship.hull.json").touch()
    line = " ".join(f"'{word}'" for word in ("assoc-hull", *words))
    text = f"""
        source {script.name}
        COMP_WORDS=({line}) COMP_CWORD={len(words)}
        _shtab_assoc_hull assoc-hull '{words[-1]}' '{words[-2] if len(words) > 1 else "assoc-hull"}'
        printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    run = subprocess.run(
        [BASH, "--norc", "-c", text], cwd=script.parent, capture_output=True, text=True, check=True
    )
    return {word.strip() for word in run.stdout.splitlines()}


@pytest.mark.skipif(BASH is None, reason="no bash")
@pytest.mark.parametrize(
    ("words", "offered"),
    [
        (("",), {"demo", "example", "import", "edit", "check", "plot", "completion", "schema"}),
        (("ver",), {"verify"}),
        (
            ("example", ""),
            {"wigley", "series60-070", "bulk-carrier-207k", "bulk-carrier-180m", "plain-ship"},
        ),
        (("graph", "--f"), {"--format"}),
        (("graph", "--format", ""), {"dot", "graphml", "mermaid", "json"}),
        (("import", "--uni"), {"--unit"}),
        (("import", "--unit", "m"), {"m", "mm"}),
        (("param",), {"parameters"}),
        (("parameters", "--sha"), {"--shaft-height", "--shaft-spacing"}),
        (("schema", "--of", ""), {"hull", "form-parameters", "comparison", "design"}),
        (("check", "--"), {"--help", "--json", "--notes"}),
        (("info", "sh"), {"ship.hull.json"}),
        (("completion", ""), {"bash", "zsh", "fish"}),
    ],
)
def test_bash_completes(script: Path, words: tuple[str, ...], offered: set[str]) -> None:
    """Commands, options, the choices of an option, and files where a file is wanted."""
    assert offered <= completed(script, *words)


@pytest.mark.skipif(BASH is None, reason="no bash")
def test_bash_offers_what_fits_only(script: Path) -> None:
    """Another command's options are not offered, nor words that begin otherwise."""
    assert completed(script, "info", "--no") == {""}
    assert completed(script, "graph", "--format", "d") == {"dot"}


@pytest.mark.skipif(BASH is None, reason="no bash")
@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("WL\\ 2", r"WL\ 2.5"),
        ('"WL 2', "WL 2.5"),
        ('"WL 2.5 x ST 1', "WL 2.5 x ST 1"),
    ],
    ids=["blanks escaped", "in quotes", "a point"],
)
def test_bash_completes_lines_of_the_named_hull(script: Path, typed: str, offered: str) -> None:
    """As the name has to be typed; others are not offered."""
    assert BASH is not None
    assert main(["example", "wigley", "-o", str(script.parent / "ship.hull.json")]) == 0
    text = f"""
        assoc-hull() {{ '{sys.executable}' -m assoc_hull "$@"; }}
        source {script.name}
        typed={shlex.quote(typed)}
        COMP_WORDS=(assoc-hull edit ship.hull.json pull "$typed") COMP_CWORD=4
        _shtab_assoc_hull assoc-hull "$typed" pull
        printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    run = subprocess.run(
        [BASH, "--norc", "-c", text], cwd=script.parent, capture_output=True, text=True, check=True
    )
    found = run.stdout.splitlines()
    assert offered in found
    begin = typed.strip('"')
    assert all(each.startswith(begin) for each in found)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_script_names_every_command(shell: str, capsys: pytest.CaptureFixture[str]) -> None:
    """For each shell; a shell that is at hand reads it without complaint."""
    assert main(["completion", shell]) == 0
    text = capsys.readouterr().out
    for command in ("demo", "example", "import", "info", "check", "verify", "edit", "graph"):
        assert command in text
    program = shutil.which(shell)
    if program is not None:
        run = subprocess.run([program, "-n"], input=text, capture_output=True, text=True)
        assert (run.returncode, run.stderr) == (0, "")


def test_the_schema_is_printed_and_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The same text both ways."""
    assert main(["schema"]) == 0
    text = capsys.readouterr().out
    assert json.loads(text) == hull_schema.hull_json_schema()
    assert main(["schema", "-o", str(tmp_path / "hull.schema.json")]) == 0
    assert (tmp_path / "hull.schema.json").read_text("utf-8") == text
    assert main(["schema", "-o", str(tmp_path / "hull.txt")]) == 2


@pytest.mark.parametrize("document", ["form-catalogue", "form-parameters", "comparison"])
def test_the_schema_of_another_document_is_printed(
    document: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each has the words that its document begins with."""
    assert main(["schema", "--of", document]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema["properties"]["format"] == {"const": f"assoc-hull {document.replace('-', ' ')}"}
