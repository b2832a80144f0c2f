"""Every example runs, with warnings as errors, and leaves its figure."""

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parent.parent / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_and_leaves_its_figure(example: Path, tmp_path: Path) -> None:
    run = subprocess.run([sys.executable, "-W", "error", str(example), str(tmp_path)], capture_output=True, text=True)
    print(run.stdout)
    assert run.returncode == 0, run.stderr[-2000:]
    assert (tmp_path / f"{example.stem}.png").stat().st_size > 10_000
