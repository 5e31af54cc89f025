# SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs over the same call from C++, by hand:

    cmake --build build --target bench_recognizer
    PYTHONPATH=build/lib/python3/dist-packages python3 tests/bench/python_cost.py SCAN.ply mm MODEL... [--keep N]

Both sides load the same library and take turns on the same points, the one first in every other pair;
the figures are medians over pairs of what Python took in C++'s measure. --keep N: every N-th point.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import posevote

PAIRS = int(os.environ.get("PAIRS", "21"))
PROGRAM = os.environ.get("BENCH_RECOGNIZER", "build/tests/bench_recognizer")


def read_points(file):
    """The vertices of an ASCII or binary little-endian PLY file."""
    with open(file, "rb") as stream:
        fields, count, ascii_text = [], 0, False
        for line in iter(lambda: stream.readline().split(), [b"end_header"]):
            if line[0] == b"format":
                ascii_text = line[1] == b"ascii"
            elif line[0] == b"element":
                is_vertex = line[1] == b"vertex"
                count = int(line[2]) if is_vertex else count
            elif line[0] == b"property" and is_vertex:
                kinds = {b"float": "<f4", b"float32": "<f4", b"double": "<f8", b"uchar": "u1", b"uint8": "u1"}
                fields.append((line[2].decode(), kinds[line[1]]))
        if ascii_text:
            rows = np.loadtxt(stream, max_rows=count)
            return rows[:, [name for name, _ in fields].index("x"):][:, :3]
        rows = np.frombuffer(stream.read(np.dtype(fields).itemsize * count), np.dtype(fields))
        return np.column_stack([rows["x"], rows["y"], rows["z"]])


keep = 1
arguments = sys.argv[1:]
if "--keep" in arguments:
    at = arguments.index("--keep")
    keep = int(arguments[at + 1])
    del arguments[at:at + 2]
scan, unit, *models = arguments
points = np.ascontiguousarray(read_points(scan)[::keep], np.float32)
recognizer = posevote.Recognizer(models, model_unit=unit, scene_unit=unit)


def in_python():
    start, busy = time.perf_counter(), time.process_time()
    found = [(item.name, item.confidence, item.T) for item in recognizer.detect(points)]
    return len(found), time.perf_counter() - start, time.process_time() - busy


with tempfile.NamedTemporaryFile() as file:
    points.tofile(file.name)
    other = subprocess.Popen([PROGRAM, file.name, unit, *models], text=True, stdin=subprocess.PIPE,
                             stdout=subprocess.PIPE)

    def in_cpp():
        print(file=other.stdin, flush=True)
        found, wall, busy = other.stdout.readline().split()
        return int(found), float(wall), float(busy)

    in_python(), in_cpp()  # the first call finds cold caches
    pairs = []
    for i in range(PAIRS):
        if i % 2:
            second, first = in_cpp(), in_python()
        else:
            first, second = in_python(), in_cpp()
        assert first[0] == second[0], "both sides must find the same"
        pairs.append((first, second))
    other.stdin.close()
    other.wait()

print(f"{len(points)} points, {pairs[0][0][0]} found, {len(pairs)} pairs")
for name, at in (("wall", 1), ("of all threads", 2)):
    ratios = sorted(python[at] / cpp[at] for python, cpp in pairs)
    print(f"{name}: C++ {statistics.median(cpp[at] for _, cpp in pairs) * 1e3:.1f} ms, "
          f"Python {statistics.median(python[at] for python, _ in pairs) * 1e3:.1f} ms, "
          f"ratio {statistics.median(ratios):.4f} (quartiles {ratios[len(ratios) // 4]:.4f} "
          f"to {ratios[-1 - len(ratios) // 4]:.4f})")
