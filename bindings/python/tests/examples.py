"""Runs the examples. Run by cargo's tests; the pictures go to a folder of theirs."""

import os
import runpy
import sys
from pathlib import Path

EXAMPLES = Path(__file__).parent.parent / "examples"


def main() -> None:
    for example in sorted(EXAMPLES.glob("*.py")):
        picture = Path(os.environ["STILLBEAM_PICTURES"]) / example.with_suffix(".png").name
        print(f"== {example.name}")
        sys.argv = [str(example), str(picture)]
        runpy.run_path(str(example), run_name="__main__")


if __name__ == "__main__":
    main()
