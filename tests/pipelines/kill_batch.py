# SPDX-License-Identifier: BSD-3-Clause
"""Kills a batch (SIGKILL) at random moments, resumes it each time, and compares what it has written
in the end with a run that nobody disturbed: the same but for times.

    kill_batch.py build/posevote --models MODELS --scans SCAN... --work DIR --count 200 --kills 50

Every tenth scan is broken. Exit status: 0 the same, 1 not.
"""
import argparse
import json
import pathlib
import random
import shutil
import subprocess
import sys
import time

import batch_runs
from batch_runs import without_times


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("posevote")
    parser.add_argument("--models", required=True)
    parser.add_argument("--scans", nargs="+", required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    return parser.parse_args()


def start(options, scans, out):
    pictures = ["--set", "write_picture.every=0", "--set", "write_overlay.every=0"]
    return batch_runs.start(options.posevote, options.models, scans, out, options.work / "cache",
                            pictures)


def finish(run):
    errors = run.communicate()[1].decode()
    if run.returncode not in (0, 1):
        sys.exit(f"ended with {run.returncode}: {errors}")


def status(options, out):
    said = subprocess.run([options.posevote, "status", "--json", str(out)], capture_output=True)
    return json.loads(said.stdout)["runs"][0] if said.returncode == 0 else None


def main():
    options = arguments()
    chance = random.Random(options.seed)
    scans = batch_runs.make_scans(options.work / "scans", options.scans, options.count,
                                  is_broken=lambda i: i % 10 == 9)
    began = time.monotonic()
    finish(start(options, scans, options.work / "whole"))
    whole = time.monotonic() - began
    out = options.work / "killed"
    killed, seen = 0, 0
    while killed < options.kills:
        run = start(options, scans, out)
        try:
            run.wait(chance.uniform(0, 0.6 + 2 * whole / options.kills))
            shutil.rmtree(out)  # done already: once more from the start
            continue
        except subprocess.TimeoutExpired:
            pass
        said = status(options, out)
        if said and said["state"] == "running":
            seen += 1
            if said["process"] != run.pid:
                sys.exit(f"status names process {said['process']}, not {run.pid}")
        run.kill()
        run.communicate()
        killed += 1
        said = status(options, out)
        if said and said["state"] == "running":
            sys.exit("status says that a killed run is running")
    finish(start(options, scans, out))
    same = [a == b for a, b in zip(without_times(options.work / "whole"), without_times(out))]
    print(f"{options.count} scans in {whole:.1f} s, killed {killed} times, seen running {seen} times: "
          + ("the same" if all(same) else f"results.csv, frames, detections, failures same: {same}"))
    return 0 if all(same) else 1


if __name__ == "__main__":
    sys.exit(main())
