"""Measures winslow beside its peers: python3 bench/peers [OPTIONS]; README.md beside this file says how."""
import argparse
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import report
from contenders import Bench, Elasticity, Gmsh, OpenFoam, Winslow, outcomes
from measuring import MeasuringError
from mesh_store import MeshStore, NoMesh, default_cache
from rows import ROWS

DONE, FAILED, USAGE, NO_MESH, INTERRUPTED = 0, 1, 2, 3, 130
EPILOG = """\
exit status: 0 all rows were run; 1 a program of winslow failed in a row (it ended with an error, took too long, wrote
inverted elements, wrote other bytes when run again, or did not move the body where it should), or lost more quality
than --allow-loss; 2 wrong usage; 3 a mesh could not be made; 130 interrupted. Peers that fail are results."""
CHECKOUT = Path(__file__).resolve().parents[2]
FAMILIES = [family.family for family in (Elasticity, Gmsh, OpenFoam)]


class UsageError(Exception):
    """Wrong options: a sentence."""


def names(text):
    return [name for name in text.split(",") if name]


def positive(kind):
    def read(text):
        value = kind(text)
        if not 0 < value < float("inf"):
            raise ValueError
        return value

    read.__name__ = f"positive {'number' if kind is float else 'whole number'}"
    return read


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="peers", description="Measures programs of winslow, and linear elasticity, Gmsh and OpenFOAM beside them: "
        "CPU, memory and quality. Fetches nothing.", epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--program", action="append", default=[], metavar="'[LABEL=]PATH [OPTIONS]'", help="a program winslow, "
        "and options that it gets in every row; several, say an old one and a new one, run by turns. Default: that of "
        "build/release, else that of PATH")
    add("--rows", type=names, default=[], metavar="NAME,...", help="only these rows; --list shows them")
    add("--list", action="store_true", help="list the rows and end")
    add("--quick", action="store_true", help="only rows of small bundled meshes, a few seconds in all")
    add("--peers", type=names, default=FAMILIES, metavar="NAME,...", help=f"of {', '.join(FAMILIES)}, or none: who "
        "runs beside winslow; default: all that are installed")
    add("--increments", type=lambda text: tuple(map(positive(int), names(text))), default=(), metavar="N,...",
        help="of elasticity; default: 1, 5, 10 and 50, of the largest meshes 1 and 5")
    add("--repeat", type=positive(int), default=1, metavar="N", help="runs of each program of winslow, by turns; the "
        "one with the least CPU counts [1]")
    add("--timeout", type=positive(float), default=600, metavar="S", help="seconds for one run, by the clock [600]")
    add("--allow-loss", type=float, metavar="PERCENT", help="exit status 1 if any quality of a later program is worse "
        "than that of the first by more")
    add("--elasticity", type=Path, metavar="PATH", help="the program elastic_move; default: that of the same build as "
        "the first program")
    add("--cache", type=Path, default=default_cache(), metavar="DIR", help="where meshes made by Gmsh are kept "
        "[%(default)s]")
    add("--csv", type=Path, metavar="FILE", help="write a line for every contender of every row")
    add("--markdown", type=Path, metavar="FILE", help="write a table for a page of documentation")
    return parser.parse_args(arguments)


def chosen_rows(wanted):
    by_name = {row.name: row for row in ROWS}
    unknown = [name for name in wanted.rows if name not in by_name]
    if unknown:
        raise UsageError(f"no row {unknown[0]!r}; known: {', '.join(by_name)}")
    if wanted.rows:
        return [by_name[name] for name in wanted.rows if by_name[name].quick or not wanted.quick]
    return [row for row in ROWS if row.quick == wanted.quick]


def chosen_peers(wanted, programs):
    unknown = [name for name in wanted.peers if name not in FAMILIES and wanted.peers != ["none"]]
    if unknown:
        raise UsageError(f"no peer {unknown[0]!r}; known: {', '.join(FAMILIES)}, none")
    made = {"elasticity": Elasticity(elastic_program(wanted, programs)), "gmsh": Gmsh(), "openfoam": OpenFoam()}
    return [made[name] for name in wanted.peers if name != "none"]


def elastic_program(wanted, programs):
    """elastic_move; None: not built."""
    if wanted.elasticity:
        return executable(wanted.elasticity)
    # The program lies in BUILD/src/app, elastic_move in BUILD/bench.
    builds = [programs[0].program.resolve().parents[2] if len(programs[0].program.resolve().parents) > 2 else CHECKOUT,
              CHECKOUT / "build/release"]
    return next((path for build in builds if os.access(path := build / "bench/elastic_move", os.X_OK)), None)


def executable(path):
    found = shutil.which(path)
    if found is None:
        raise UsageError(f"{path} is no program that can be run")
    return Path(found).resolve()


def chosen_programs(wanted):
    given = wanted.program or [shlex.quote(str(default_program()))]
    programs = [program_of(text, "winslow" if len(given) == 1 else text) for text in given]
    labels = [program.name for program in programs]
    if len(set(labels)) < len(labels):
        raise UsageError("two programs have the same name; give each its own: --program old=PATH --program new=PATH")
    return programs


def program_of(text, name):
    """[LABEL=]PATH [OPTIONS], as a shell reads it; name: without a label."""
    try:
        word, *options = shlex.split(text) or [""]
    except ValueError as error:
        raise UsageError(f"--program {text}: {error}") from error
    label, separator, path = word.partition("=")
    if not separator or "/" in label:  # a folder may have a = in its name
        label, path = name, word
    return Winslow(label, executable(path), tuple(options))


def default_program():
    built = CHECKOUT / "build/release/src/app/winslow"
    if os.access(built, os.X_OK):
        return built
    if shutil.which("winslow"):
        return Path(shutil.which("winslow"))
    raise UsageError(f"no program: {built} is not built and there is no winslow in PATH; name one by --program")


def list_rows():
    width = max(len(row.name) for row in ROWS)
    for row in ROWS:
        mesh = row.mesh.bundled or f"{row.mesh.made}.su2, made by Gmsh"
        print(f"{row.name:{width}}  {row.what} [{mesh}]{' --quick' if row.quick else ''}")


def scrambler(program):
    def scramble(mesh, out):
        done = subprocess.run([str(program), "scramble", "--quiet", "--seed", "1", "--allow-inverted", str(mesh), "-o",
                               str(out)], capture_output=True, text=True, check=False)
        if not out.exists():
            raise NoMesh(f"{program} did not scramble {mesh}: {done.stderr.strip()}")

    return scramble


def measure_row(row, bench, programs, peers, repeat):
    """Runs a row and prints it as it goes. Throws NoMesh, MeasuringError."""
    mesh = bench.store.path(row.mesh)
    result = report.RowResult(row, bench.quality_of(mesh), [])
    report.print_row(result)
    result.outcomes += outcomes(programs, row, bench, repeat)
    for outcome in result.outcomes:
        report.print_outcome(result, outcome)
    for peer in peers:
        if peer.family in row.peers:
            for outcome in peer.outcomes(row, bench):
                result.outcomes.append(outcome)
                report.print_outcome(result, outcome)
    return result


def measure(wanted, chosen, programs, peers):
    """All rows: (results, whether all meshes were there, whether it was interrupted)."""
    results, meshes, interrupted = [], True, False
    with tempfile.TemporaryDirectory(prefix="winslow-peers-") as folder:
        store = MeshStore(wanted.cache, Path(folder), scrambler(programs[0].program),
                          lambda line: print(line, file=sys.stderr, flush=True))
        bench = Bench(programs[0].program, store, Path(folder), wanted.timeout, wanted.increments)
        for row in chosen:
            try:
                results.append(measure_row(row, bench, programs, peers, wanted.repeat))
            except (NoMesh, MeasuringError) as error:
                print(f"\n{row.name}: not measured: {error}", flush=True)
                meshes = False
            except KeyboardInterrupt:
                interrupted = True
                break
    return results, meshes, interrupted


def conclude(wanted, results, labels):
    """Prints and writes what was found; returns the sentences about lost quality."""
    sentences = report.conclusions(results, labels)
    lost = list(report.losses(results, labels, wanted.allow_loss)) if wanted.allow_loss is not None else []
    if sentences or lost:
        print()
    for sentence in [*sentences, *(f"LOST: {sentence}" for sentence in lost)]:
        print(sentence)
    if wanted.csv:
        report.write_csv(wanted.csv, results)
    if wanted.markdown:
        report.write_markdown(wanted.markdown, results, sentences)
    return lost


def run(wanted):
    chosen, programs = chosen_rows(wanted), chosen_programs(wanted)
    if not chosen:
        raise UsageError("no row is left: --quick leaves only rows of bundled meshes")
    peers = chosen_peers(wanted, programs)
    for path in filter(None, (wanted.csv, wanted.markdown)):
        path.touch()  # said now rather than after an hour
    labels = [program.name for program in programs]
    print(report.machine())
    for program in programs:
        print(f"{program.name}: {' '.join([str(program.program), *program.options])}")
    report.print_heads()
    results, meshes, interrupted = measure(wanted, chosen, programs, peers)
    lost = conclude(wanted, results, labels)
    if interrupted:
        return INTERRUPTED
    if any(outcome.failure for result in results for outcome in result.outcomes) or lost:
        return FAILED
    return DONE if meshes else NO_MESH


def main(arguments):
    wanted = parse(arguments)
    if wanted.list:
        list_rows()
        return DONE
    # A run that is ended leaves its tables, and no program behind: also where an interrupt would be ignored.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    try:
        return run(wanted)
    except (UsageError, OSError) as error:
        print(f"peers: {error}", file=sys.stderr)
        return USAGE


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
