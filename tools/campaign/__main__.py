"""Looks for scenes that drape gets wrong: numerical stability, what method auto keeps, and what it says of its errors.

    python3 tools/campaign stability --short                     under 4 minutes on an idle machine
    python3 tools/campaign stability --filter '^single/start'
    python3 tools/campaign stability --filter '^random' --random 5000 -o out/random
    python3 tools/campaign auto --count 20
    python3 tools/campaign auto --generator a --seed 7 --tolerance 0.002 -o out/auto
    python3 tools/campaign auto --first 17 --count 1             scene 17 again
    python3 tools/campaign errors --seed 7                       60 scenes in an hour on two cores

`stability` puts extremes on a small sheet: each alone by every method and set of kernels, all pairs, drawn mixes of
three to six; then random scenes and a long run. `auto` runs scenes of method auto, drawn from a seed. What ends as
done is run again and judged by `drape verify`: frames that are no result by what acts on the cloth, pins that are not
where they are held, free flight, mass, crossings. `errors` compares such scenes, with fewer particles, with finer runs of their
own: what auto states of its position error and what it warns of.

A table on stdout, and every case that falls short of its tier: A must hold, B may be neither wrong without a word nor
unsettled, C must be refused. FOLDER/results.jsonl has a line for each case, FOLDER/scenes the file of each that does
not hold, for `drape verify FILE`. Exit code 7 when a run was silently wrong or ended as no run may, and when method
auto refused more than 1 % of scenes that it could follow. SIGINT ends it, and the same command goes on; another
program, device or option starts anew.

verdicts:
"""
import argparse
import os
import pathlib
import re
import shutil
import sys

import cases
import errors
import judge
import report
from runner import COMPARISON, DEVICE, NoDevice, Runner

USAGE, INTERRUPTED = 2, 130
BUILT = pathlib.Path(__file__).resolve().parents[2] / "build/drape"
NAMES = "single/EXTREME/METHOD[/KERNELS], pair/ONE + OTHER/METHOD, mix/..., random/..., soak/base/METHOD"


def pattern(text):
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}': {error}") from error


def options_of(arguments):
    words = __doc__ + "\n".join(f"  {name:<12}{what}" for name, what in reversed(judge.VERDICTS.items()))
    parser = argparse.ArgumentParser("campaign", description=words,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    kinds = parser.add_subparsers(dest="kind", required=True)
    stability, auto, said = (kinds.add_parser(kind) for kind in ("stability", "auto", "errors"))
    option = stability.add_argument
    option("--short", action="store_true", help="no pairs, the kernels of auto, few mixes and random scenes")
    option("--filter", type=pattern, default="", metavar="REGEX", help=f"only cases whose name contains it: {NAMES}")
    option("--mixes", type=int, metavar="N", help="how many drawn mixes; default: 1000, with --short 60")
    option("--random", type=int, metavar="N", help="how many random scenes; default: 500, with --short 10")
    for kind, count, side in ((auto, 100, 129), (said, 60, 25)):
        option = kind.add_argument
        option("--generator", choices=sorted(cases.GENERATORS), default="b",
               help="a, such as auto is tuned on, or b, written apart and never used for tuning; default: b")
        option("--count", type=int, default=count, metavar="N", help="how many scenes; default: %(default)s")
        option("--first", type=int, default=0, metavar="N", help="number of the first; default: 0")
        option("--side", type=int, default=side, metavar="N", help="most particles a side; default: %(default)s")
        option("--tolerance", type=float, metavar="ERROR", help="the scenes' tolerance; default: they ask for none")
    said.add_argument("--reference-substeps", type=int, default=256, metavar="N",
                      help="of the finest run, in a sixtieth of a second; default: 256")
    for kind in (stability, auto, said):
        option = kind.add_argument
        option("--seed", type=int, default=1, metavar="N", help="another seed, other scenes; default: 1")
        option("-o", "--folder", default=f"campaign_{kind.prog.split()[-1]}", help="default: %(default)s")
        option("--budget", type=float, metavar="MINUTES", help="start no case after so many minutes")
        option("--device", help="as of drape")
        option("--keep", action="store_true", help="keep the scene files of those that hold, too")
        option("--validate", action="store_true", help="under core and synchronization validation")
        option("--program", default=str(BUILT) if BUILT.exists() else shutil.which("drape"), metavar="FILE",
               help="default: the build's drape, else the installed one")
        option("-j", "--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at once; default: cores")
        option("-q", "--quiet", action="store_true", help="no progress")
    options = parser.parse_args(arguments)
    if not options.program:
        parser.error("there is no drape: build it, or name it by --program")
    return options


def cases_of(options):
    if options.kind != "stability":
        return cases.auto_cases(options.generator, options.seed, options.first, options.count, options.tolerance,
                                options.side)
    mixes = (60 if options.short else 1000) if options.mixes is None else options.mixes
    randoms = (10 if options.short else 500) if options.random is None else options.random
    every = cases.stability_cases(options.short, options.seed, mixes, randoms)
    return [case for case in every if options.filter.search(case.name)]


def main(arguments=None):
    options = options_of(arguments)
    every = cases_of(options)
    if not every:
        print("campaign: no case has such a name; they are like 'pair/wind 50 + start line/relax'", file=sys.stderr)
        return USAGE
    try:
        results = (errors.ErrorRunner if options.kind == "errors" else Runner)(options).run_all(every)
    except NoDevice as error:
        print(error, file=sys.stderr)
        return DEVICE
    except KeyboardInterrupt:
        print(f"campaign: stopped; results are kept in {options.folder}, and the same command goes on", file=sys.stderr)
        return INTERRUPTED
    if options.kind == "errors":
        print(errors.text(results))
        fault = errors.fault(results)
    else:
        print(report.text(results, options.kind == "auto"))
        fault = report.fault(results, options.kind == "auto")
    if fault:
        print(f"campaign: {fault}", file=sys.stderr)
    return COMPARISON if fault else 0


if __name__ == "__main__":
    sys.exit(main())
