"""Holds runs from Python to those of the command line, to the bit. Run by cargo's tests."""

import os
import tempfile
from pathlib import Path

import numpy as np

import stillbeam as sb

NAMES = (
    "time",
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    "tip_x",
    "tip_y",
    "deflection",
    "torque",
)


def main() -> None:
    folder = Path(os.environ["STILLBEAM_BITS"])
    files = sorted(folder.glob("*.bin"))
    assert len(files) == 17, files
    for file in files:
        name, method, scalar = file.stem.split(".")
        run = sb.run(sb.Scene.from_toml(name), method=method, scalar=scalar)
        wanted = np.fromfile(file, dtype="<f8").reshape(len(NAMES), -1)
        for column, values in zip(NAMES, wanted):
            assert getattr(run, column).tobytes() == values.tobytes(), f"{file.stem}: {column}"
        with tempfile.TemporaryDirectory() as place:
            written = Path(place) / "run.csv"
            run.to_csv(written)
            assert written.read_bytes() == file.with_suffix(".csv").read_bytes(), file.stem
    print(f"{len(files)} runs, all columns equal to the bit, all files to the byte")


if __name__ == "__main__":
    main()
