# SPDX-License-Identifier: BSD-3-Clause
"""Batches that are disturbed and resumed: what kill_batch.py and fault_batch.py share."""
import json
import pathlib
import re
import subprocess


def make_scans(folder, sources, count, is_broken):
    """`count` scans in a folder of their own, of which some hold no scan."""
    folder.mkdir(parents=True)
    for i in range(count):
        source = pathlib.Path(sources[i % len(sources)])
        target = folder / f"{i:04}{source.suffix}"
        if is_broken(i):
            target.write_text("broken")
        else:
            target.symlink_to(source.resolve())
    return folder


def start(posevote, models, scans, out, cache, more=(), environment=None):
    """`posevote run`, begun anew or resumed."""
    command = [posevote, "run", "demo", "--models", models, "--scenes", scans, "--out", out]
    command += ["--cache", cache, "--quiet", "--resume", *more]
    return subprocess.Popen([str(word) for word in command], stderr=subprocess.PIPE,
                            stdout=subprocess.DEVNULL, env=environment)


def without_times(out):
    """results.csv, frames, detections.csv and failures.json of a run that has ended."""
    rows = re.sub(r",[^,\n]*\n", "\n", (out / "results.csv").read_text())
    frames = json.loads((out / "results.json").read_text())["frames"]
    for frame in frames:
        for key in ("seconds", "latency_s", "stages", "checksum"):
            del frame[key]
        for found in frame["detections"] + frame["rejected"]:
            del found["seconds"]
    return rows, frames, (out / "detections.csv").read_text(), (out / "failures.json").read_text()
