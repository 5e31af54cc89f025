# SPDX-License-Identifier: BSD-3-Clause
r"""Lets every system call by which a batch changes files go wrong once (tests/faults), resumes, and
compares what is written in the end with a run that nobody disturbed: the same but for times.

    fault_batch.py build/posevote --faults build/tests/libinject_fault.so --models MODELS \
        --scans SCAN... --work DIR [--every K] [--kinds NAME...] [--stages run resume train]

Stages: a run that begins, one that goes on with a run that was killed, one that trains (of which
the calls below the cache count). After a kill, or with a full disk, the run goes on when it is
started again; a call that is interrupted or writes half is no event. Exit status: 0 so it is,
1 not; each call that shows otherwise is named.
"""
import argparse
import collections
import os
import pathlib
import re
import shutil
import sys
import time

import batch_runs

KINDS = ("kill_before", "kill_after", "enospc", "full", "eintr", "short")
UNNOTICED = ("eintr", "short")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("posevote")
    parser.add_argument("--faults", required=True)
    parser.add_argument("--models", required=True)
    parser.add_argument("--scans", nargs="+", required=True)
    parser.add_argument("--work", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--every", type=int, default=1, help="each K-th call, others with each kind")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--stages", nargs="+", default=("run", "resume", "train"))
    return parser.parse_args()


class Batch:
    """Three scans, of which one is broken, and a run over them that nobody disturbed."""

    def __init__(self, options):
        self.options = options
        self.trial = options.work / "trial"
        self.scans = batch_runs.make_scans(options.work / "scans", options.scans, 3,
                                           is_broken=lambda i: i == 1)
        self.cache = options.work / "cache"
        self.start(options.work / "whole", self.cache)
        self.whole = batch_runs.without_times(options.work / "whole")
        self.files = files_of(options.work / "whole")

    def start(self, out, cache, folder=None, fault=None, at=0):
        """Its exit status, what it said, and the calls that changed files below `folder`."""
        log = self.options.work / "calls.txt"
        log.unlink(missing_ok=True)
        environment = dict(os.environ)
        if folder:
            environment.update(LD_PRELOAD=self.options.faults, FAULT_FOLDER=str(folder),
                               FAULT_LOG=str(log), FAULT=fault or "", FAULT_AT=str(at))
        run = batch_runs.start(self.options.posevote, self.options.models, self.scans, out, cache,
                               ["--threads", "1"], environment)
        said = run.communicate()[1].decode(errors="replace")
        calls = [tuple(line.split(" ", 1)) for line in log.read_text().splitlines()] if folder else []
        return run.returncode, said, calls


class Stage:
    """What is there before a run that is disturbed, and the folder whose calls count."""

    def __init__(self, batch, name):
        self.batch = batch
        self.name = name
        self.out = batch.trial / "out"
        self.cache = batch.trial / "cache" if name == "train" else batch.cache
        self.watched = self.cache if name == "train" else self.out
        self.killed = batch.options.work / "killed"
        if name == "resume" and not self.killed.exists():
            self.kill_at_last_frame()
        self.prepare()
        self.status, _, self.calls = batch.start(self.out, self.cache, self.watched)

    def kill_at_last_frame(self):
        """It has written the frame's rows, but not yet its record."""
        calls = self.batch.start(self.killed, self.cache, self.killed)[2]
        last = max(i for i, (name, path) in enumerate(calls)
                   if name == "pwrite" and path.endswith("/results.json"))
        shutil.rmtree(self.killed)
        self.batch.start(self.killed, self.cache, self.killed, "kill_before", last + 1)

    def prepare(self):
        shutil.rmtree(self.batch.trial, ignore_errors=True)
        self.batch.trial.mkdir()
        if self.name == "resume":
            shutil.copytree(self.killed, self.out)

    def problem(self, kind, at):
        """What was not as it should be with that fault, or when the run went on after it."""
        self.prepare()
        status, said, calls = self.batch.start(self.out, self.cache, self.watched, kind, at)
        if not calls:
            return "no call was counted"
        if len(calls) < at:  # the undisturbed run was slower, and put more on the disk meanwhile
            return self.difference()
        name, path = calls[at - 1]
        problem = self.problem_of_end(kind, status, said, name, path)
        return f"{name} {path}: {problem}" if problem else self.problem_of_going_on(kind)

    def problem_of_going_on(self, kind):
        if kind not in UNNOTICED:
            again, said, _ = self.batch.start(self.out, self.cache)
            if again != self.status:
                return f"resumed, it ended with {again}: {said}"
        return self.difference()

    def problem_of_end(self, kind, status, said, name, path):
        if kind.startswith("kill"):
            return "" if status == -9 else f"was not killed but ended with {status}"
        if kind in UNNOTICED:
            return "" if status == self.status else f"ended with {status}: {said}"
        if kind == "enospc" and name in ("ftruncate", "unlink"):
            return ""  # these need no space
        if self.name == "train" and (".lock" in path or name == "mkdir"):
            return ""  # a lock spares work, no more; a folder is tried again
        if status not in (1, 2):
            return f"ended with {status}: {said}"
        # The first file for which there is no room may be one that a frame fails for; but then its
        # failure has no room either, which ends the run.
        what = "" if kind == "full" else final_name(path)
        return "" if what in said and "No space left" in said else f"does not name {what}: {said}"

    def difference(self):
        names = ("results.csv", "frames", "detections.csv", "failures.json", "files")
        now = (*batch_runs.without_times(self.out), files_of(self.out))
        then = (*self.batch.whole, self.batch.files)
        wrong = [name for name, a, b in zip(names, now, then) if a != b]
        more = f" ({sorted(set(now[-1]) ^ set(then[-1]))})" if now[-1] != then[-1] else ""
        return f"other {', '.join(wrong)}{more}" if wrong else ""


def files_of(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def final_name(path):
    """Of a file that is written beside its place."""
    return re.sub(r"\.[0-9a-f]+\.tmp$", "", pathlib.Path(path).name)


def main():
    options = arguments()
    shutil.rmtree(options.work, ignore_errors=True)
    batch = Batch(options)
    began, wrong, done = time.monotonic(), 0, collections.Counter()
    for name in options.stages:
        stage = Stage(batch, name)
        for k, kind in enumerate(options.kinds):
            for at in range(1 + k % options.every, len(stage.calls) + 1, options.every):
                done[name] += 1
                if problem := stage.problem(kind, at):
                    wrong += 1
                    print(f"{name}: {kind} at call {at}: {problem}", flush=True)
        print(f"{name}: {len(stage.calls)} calls, {done[name]} faults", flush=True)
    print(f"{sum(done.values())} faults, {wrong} of them wrong, {time.monotonic() - began:.0f} s")
    return 1 if wrong or not done else 0


if __name__ == "__main__":
    sys.exit(main())
