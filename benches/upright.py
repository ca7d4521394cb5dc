#!/usr/bin/env python3
"""Drops of an upright disc, beside those of opencamlib's cylinder: times, and whether both come down to the same heights.

    python3 -m pip install opencamlib==2023.1.11
    python3 benches/upright.py

Both get the same binary STL and the same places, on one thread. opencamlib knows no leaning discs, no hubs and no moves, so
upright ones are compared. Its time is that of BatchDropCutter.run, which finds the triangles below the cutter by a tree.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import opencamlib

HERE = Path(__file__).resolve().parent
RADIUS = 25.0
# Longer than the sheet is high.
LENGTH = 500.0
# opencamlib takes milliseconds a place.
MOST_PLACES = 500


def ours(triangles, folder):
    """Writes sheet and places, and returns our time in us."""
    command = ["cargo", "run", "--quiet", "--release", "--manifest-path", HERE / "Cargo.toml", "--bin", "upright"]
    done = subprocess.run([*command, "--", str(triangles), folder], check=True, capture_output=True, text=True)
    return float(done.stdout)


def theirs(folder):
    """Their time in us, and how far their heights are off ours at most, in mm."""
    sheet = opencamlib.STLSurf()
    # The reader keeps a reference to the text it was given.
    reader = opencamlib.STLReader(str(folder / "sheet.stl"), sheet)
    cutter = opencamlib.CylCutter(2.0 * RADIUS, LENGTH)
    drops = opencamlib.BatchDropCutter()
    drops.setSTL(sheet)
    drops.setCutter(cutter)
    drops.setThreads(1)
    rows = [line.split(",") for line in (folder / "places.csv").read_text().splitlines()]
    rows = [tuple(map(float, row)) for row in rows][:MOST_PLACES]
    # Kept alive: opencamlib refers to the points of Python.
    points = [opencamlib.CLPoint(x, y, -1000.0) for x, y, _ in rows]
    for point in points:
        drops.appendPoint(point)
    start = time.perf_counter()
    drops.run()
    seconds = time.perf_counter() - start
    heights = {(point.x, point.y): point.z for point in drops.getCLPoints()}
    off = max(abs(heights[x, y] - z) for x, y, z in rows)
    del reader
    return seconds * 1e6 / len(rows), off


def main():
    print("| triangles | vcutc, us | opencamlib, us | ratio | heights apart, mm |")
    print("|---|---|---|---|---|")
    for triangles in [int(text) for text in sys.argv[1:]] or [5_000, 20_000, 50_000]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            mine = ours(triangles, folder)
            other, off = theirs(folder)
        print(f"| {triangles} | {mine:.2f} | {other:.1f} | {other / mine:.0f} | {off:.1e} |", flush=True)


if __name__ == "__main__":
    main()
