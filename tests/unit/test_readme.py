"""The first example that a person runs, as a person runs it."""

import re
import subprocess
import sys
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def test_the_example_of_the_readme_runs_twice(tmp_path: Path) -> None:
    """In one folder, in two processes: the second call finds the files of the first."""
    (block,) = re.findall(r"```python\n(.*?)```", README.read_text("utf-8"), re.DOTALL)
    script = tmp_path / "first.py"
    script.write_text(block, encoding="utf-8")
    told = [
        subprocess.run(
            [sys.executable, script.name], cwd=tmp_path, capture_output=True, text=True, check=True
        ).stdout
        for _ in range(2)
    ]
    assert told[0] == told[1]
    assert "back to the last bit: True" in told[1]
