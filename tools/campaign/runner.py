"""Runs cases by the program, several at once, and keeps their results."""
import concurrent.futures
import contextlib
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import cases
import judge

DEVICE, COMPARISON = 4, 7
SECONDS = 1800  # a run may take


class NoDevice(Exception):
    pass


class Runner:
    def __init__(self, options):
        self.options, self.folder = options, pathlib.Path(options.folder)
        self.environment = dict(os.environ, LP_NUM_THREADS="0")  # every core has a run of its own
        self.device = ["--device", options.device] if options.device else []
        self.program = hashlib.sha256(pathlib.Path(options.program).read_bytes()).hexdigest()
        (self.folder / "scenes").mkdir(parents=True, exist_ok=True)

    def drape(self, *arguments):
        """(exit code, or None where the time ended it; stdout; stderr)"""
        try:
            done = subprocess.run([self.options.program, *map(str, arguments), *self.device], env=self.environment,
                                  timeout=SECONDS, capture_output=True, text=True, errors="replace")
        except subprocess.TimeoutExpired:
            return None, "", ""
        return done.returncode, done.stdout, done.stderr

    def simulate(self, path, kernels):
        """(exit code; stderr; manifest, where it ended as done)"""
        with tempfile.TemporaryDirectory() as folder:
            code, _, said = self.drape("simulate", path, "-q", "-o", folder, "--export", "npy", "--checkpoint", "never",
                                       "--kernels", kernels, *(["--validate"] if self.options.validate else []))
            return code, said, json.loads(pathlib.Path(folder, "manifest.json").read_text()) if code == 0 else None

    def broken(self, path, kernels, manifest):
        """The faults that `drape verify` finds in a run that ended as done; kernels must leave the bytes of auto's."""
        if kernels == "auto":
            validate = [] if self.options.validate else ["--no-validate"]
            code, said, errors = self.drape("verify", path, "--json", *validate)
            if code in (0, COMPARISON):
                return judge.missed(json.loads(said)[0])
            return [f"verify ends with {code}: {errors}"]
        usual = self.simulate(path, "auto")[2]
        same = usual and [each["hash"] for each in usual["files"]] == [each["hash"] for each in manifest["files"]]
        return [] if same or kernels in cases.OTHER_BYTES else ["other bytes than with the kernels that auto takes"]

    def attempt(self, case, path, frames):
        """The result of so many frames; nothing where the device has not what the kernels need."""
        scene = dict(case.scene, time=dict(case.scene["time"], frames=frames))
        path.write_text(cases.text_of(dict(scene, oracles=judge.promises(scene))))
        begun = time.monotonic()
        code, said, manifest = self.simulate(path, case.kernels)
        seconds, numbers = time.monotonic() - begun, {}
        if code == DEVICE and case.kernels == "auto":
            raise NoDevice(said.strip())
        if code == DEVICE:
            return None
        if manifest:
            numbers = dict(judge.numbers_of(manifest, scene), frame_s=seconds / max(frames - 1, 1))
            broken = judge.over_limits(manifest, scene, numbers) + self.broken(path, case.kernels, manifest)
            verdict, reason = judge.verdict(judge.told(manifest, path), numbers, broken)
        else:
            verdict, reason = judge.refusal(code, said)
        return {"name": case.name, "tier": case.tier, "verdict": verdict, "reason": reason, "kernels": case.kernels,
                "method": manifest["solver"]["method"] if manifest else "", "numbers": numbers, "scene": str(path),
                "seconds": round(time.monotonic() - begun, 2)}

    def run(self, case):
        """A case with all the frames that it needs to calm down."""
        path = self.folder / "scenes" / (re.sub(r"[^\w.+-]+", "_", case.name) + ".json")
        frames = case.scene["time"]["frames"]
        result = self.attempt(case, path, frames)
        if case.recovery and result and result["numbers"] and judge.beyond(result["numbers"]):
            result = self.attempt(case, path, frames + case.recovery)
        if not result or (result["verdict"] == "holds" and not self.options.keep):
            path.unlink()
        return result

    def key(self, case):
        parts = [self.program, case.name, cases.text_of(case.scene), case.recovery, self.device, self.options.validate]
        return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:32]

    def run_all(self, every):
        """The results in the order of the cases; those that were left out for want of time or kernels are missing."""
        keys, known, path = [self.key(case) for case in every], {}, self.folder / "results.jsonl"
        for line in path.read_text().splitlines() if path.exists() else ():
            with contextlib.suppress(ValueError):  # the last one of a run that was killed may be cut short
                known[json.loads(line)["key"]] = json.loads(line)
        todo = [(key, case) for key, case in zip(keys, every) if key not in known]
        end = time.monotonic() + 60 * (self.options.budget or 1e9)

        def run(key, case):
            return dict(self.run(case) or {}, key=key) if time.monotonic() < end else {"key": key}

        ran = 0
        with path.open("a") as file, concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            try:
                file.write("\n")  # behind what a kill may have cut short
                for future in concurrent.futures.as_completed([pool.submit(run, *each) for each in todo]):
                    result = future.result()
                    if "name" in result:
                        ran += 1
                        known[result["key"]] = result
                        print(json.dumps(result), file=file, flush=True)
                        self.say(f"{ran}/{len(todo)} {result['name']}: {result['verdict']}, {result['seconds']:.1f} s")
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        self.say(f"{ran} cases run, {len(every) - len(todo)} kept from before, {len(todo) - ran} left out")
        return [known[key] for key in keys if key in known]

    def say(self, text):
        if not self.options.quiet:
            print(text, file=sys.stderr)
