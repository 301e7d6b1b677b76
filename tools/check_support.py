"""The scripts check_* share this: options, drape run under a time limit, files held against those of another run."""
import argparse
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
OK, COMPARISON = 0, 7


def parser(document):
    """With the options that all checks have."""
    made = argparse.ArgumentParser(description=document, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("--build", type=pathlib.Path, default=ROOT / "build", metavar="DIR")
    return made


def sampling_parser(document):
    """With those of checks that try very many things, too."""
    made = parser(document)
    made.add_argument("--sample", type=int, metavar="N")
    made.add_argument("--filter", default="", metavar="TEXT")
    made.add_argument("--quiet", action="store_true", help="only what is wrong, and the end")
    return made


class Program:
    """drape, run in a folder with a shader cache of its own, for so many seconds at most."""

    def __init__(self, build, folder, seconds, **environment):
        self.path, self.folder, self.seconds = build.resolve() / "drape", folder, seconds
        self.environment = dict(os.environ, MESA_SHADER_CACHE_DIR=str(folder / "cache"), **environment)

    def run(self, arguments, **environment):
        """(exit code, or None where the time ended it; stdout; stderr)"""
        try:
            done = subprocess.run([self.path, *arguments], cwd=self.folder, env={**self.environment, **environment},
                                  timeout=self.seconds, capture_output=True, text=True, errors="replace")
        except subprocess.TimeoutExpired:
            return None, "", ""
        return done.returncode, done.stdout, done.stderr


def reports(errors, *marks):
    """The first line on stderr with each of these marks or a sanitizer's."""
    for mark in (*marks, "AddressSanitizer", "LeakSanitizer", "runtime error"):
        if mark in errors:
            yield f"stderr: {next(line for line in errors.splitlines() if mark in line)[:160]}"


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def lasting(name, content):
    """Returns the part of a file in which two equal runs agree: not the times."""
    path = pathlib.PurePath(name)
    if path.name == "manifest.json" or path.match("jobs/*.json"):
        return json.dumps({key: value for key, value in json.loads(content).items() if key not in ("run", "seconds")},
                          sort_keys=True)
    if path.name == "results.csv":
        return [line.rpartition(b",")[0] for line in content.splitlines()]
    return content
