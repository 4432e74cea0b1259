"""What was measured, as a table to read, as CSV and as Markdown, and what follows from several rows."""
import csv
import math
import os
import platform
from dataclasses import dataclass

import rows

CSV_COLUMNS = ["row", "what", "nodes", "elements", "contender", "runs", "user_s", "system_s", "wall_s", "peak_mb",
               "ratio", "scaled_jacobian_min", "scaled_jacobian_mean", "aspect_max", "inverted", "height_change_95",
               "height_change_max", "state", "notes"]


@dataclass
class RowResult:
    """A row with the quality of the mesh as given and all outcomes, those of winslow's programs first."""

    row: object
    given: object
    outcomes: list

    def ratio(self, outcome):
        """CPU of a contender over that of the first program, where both ran to their ends."""
        first = self.outcomes[0] if self.outcomes else None
        if not first or first.failure or not first.run or not outcome.run or not outcome.quality:
            return None
        return outcome.run.user / first.run.user if first.run.user else None


def machine():
    """The processor, how many of it, and how busy it is."""
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            name = next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), name)
    except OSError:
        pass
    return f"{name}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}"


def number(value, digits):
    """With so many digits after the point; empty for None."""
    if value is None:
        return ""
    return f"{value:.{digits}f}" if abs(value) < 1e6 else f"{value:.3g}"


def seconds(value):
    return number(value, 2 if value is not None and value < 10 else 1)


def cells(result, outcome):
    """The columns of an outcome that all tables have, as words."""
    run, quality = outcome.run, outcome.quality
    heights = " / ".join(number(h, 3) if h < 10 else f"{h:.3g}" for h in outcome.heights)
    return [seconds(run and run.user), number(result.ratio(outcome), 2), seconds(run and run.wall),
            number(run and run.memory / 1e6, 0), *quality_cells(quality), heights]


def quality_cells(quality):
    if quality is None:
        return [""] * 4
    return [number(quality.jacobian_min, 4), number(quality.jacobian_mean, 3), number(quality.aspect_max, 2),
            str(quality.inverted)]


def remarks(outcome):
    words = ["skipped"] if outcome.skipped else ["FAILED: " + outcome.failure] if outcome.failure else []
    return "; ".join([*words, *outcome.notes])


HEADS = ["CPU s", "ratio", "wall s", "MB", "sJ min", "sJ mean", "R/3r max", "inverted", "heights %"]
WIDTHS = [6, 6, 6, 6, 7, 7, 8, 8, 15]
LEGEND = """\
CPU: user seconds of all threads, from file to file. ratio: CPU over that of the first program. MB: most resident
memory. sJ: scaled Jacobian, smallest and mean. R/3r: largest (plane: R/2r). heights: change of the first layer's, per
cent, 95th percentile / worst."""


def print_heads():
    print(LEGEND)


def print_row(result):
    """Title, heads and the mesh as given."""
    print(f"\n{result.row.name}: {result.row.what}, {result.given.nodes:,} nodes, {result.given.elements:,} elements")
    print(f"  {'':32}" + "".join(f" {head:>{width}}" for head, width in zip(HEADS, WIDTHS)))
    print_line("as given", ["", "", "", "", *quality_cells(result.given), ""], "")


def print_outcome(result, outcome):
    print_line(outcome.contender, cells(result, outcome), remarks(outcome))


def print_line(name, columns, remark):
    line = f"  {name:32}" + "".join(f" {cell:>{width}}" for cell, width in zip(columns, WIDTHS)) + f"  {remark}"
    print(line.rstrip(), flush=True)


def write_csv(path, results):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for result in results:
            writer.writerow([result.row.name, result.row.what, result.given.nodes, result.given.elements, "as given",
                             *[""] * 6, *quality_numbers(result.given), "", "", "given", ""])
            writer.writerows(csv_line(result, outcome) for outcome in result.outcomes)


def csv_line(result, outcome):
    run = outcome.run
    times = [run.user, run.system, run.wall, run.memory / 1e6] if run else [""] * 4
    heights = outcome.heights or ("", "")
    ratio = result.ratio(outcome)
    return [result.row.name, result.row.what, result.given.nodes, result.given.elements, outcome.contender,
            outcome.runs, *times, "" if ratio is None else ratio, *quality_numbers(outcome.quality), *heights,
            state(outcome),
            "; ".join(filter(None, [outcome.failure, *outcome.notes]))]


def state(outcome):
    if outcome.skipped or outcome.failure:
        return "skipped" if outcome.skipped else "failed"
    return "measured" if outcome.quality else "ended"


def quality_numbers(quality):
    if quality is None:
        return [""] * 4
    return [quality.jacobian_min, quality.jacobian_mean, quality.aspect_max, quality.inverted]


def write_markdown(path, results, conclusions):
    lines = [f"Machine: {machine()}. " + LEGEND.replace("\n", " "), "",
             "| what | nodes | who | " + " | ".join(HEADS) + " | |", "|---" * (len(HEADS) + 4) + "|"]
    for result in results:
        given = ["", "", "", "", *quality_cells(result.given), "", ""]
        lines.append(markdown_line([result.row.what, f"{result.given.nodes:,}", "as given", *given]))
        lines += [markdown_line(["", "", outcome.contender, *cells(result, outcome), remarks(outcome)])
                  for outcome in result.outcomes]
    lines += ["", *(f"- {sentence}" for sentence in conclusions)] if conclusions else []
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def markdown_line(columns):
    return "| " + " | ".join(column.replace("|", "\\|") for column in columns) + " |"


def conclusions(results, labels):
    """Sentences that need several rows, for each program of winslow."""
    return [sentence for label in labels for sentence in (*exponent(results, label), *scaling(results, label))]


def finished(results, label):
    """Name of a row -> (nodes, run), where the program did not fail."""
    return {result.row.name: (result.given.nodes, outcome.run) for result in results for outcome in result.outcomes
            if outcome.contender == label and outcome.run and not outcome.failure}


def exponent(results, label):
    """CPU as a power of the number of nodes: least squares of the logarithms."""
    done = finished(results, label)
    points = [(math.log(done[name][0]), math.log(done[name][1].user)) for name in rows.SIZES if name in done]
    if len(points) < 2:
        return
    x, y = (sum(values) / len(points) for values in zip(*points))
    slope = sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)
    low, high = (f"{math.exp(end(p[0] for p in points)):,.0f}" for end in (min, max))
    yield f"{label}: time of smoothing grows with the number of nodes to the power {slope:.2f} ({low} to {high} nodes)"


def scaling(results, label):
    done = finished(results, label)
    if all(name in done for name in rows.THREADS):
        many, one = (done[name][1].wall for name in rows.THREADS)
        yield f"{label}: on all threads {one / many:.2f} times as fast as on one, by the clock ({rows.THREADS[0]})"


def losses(results, labels, percent):
    """Sentences for every quality in which a later program is worse than the first by more than so much."""
    for result in results:
        by_name = {outcome.contender: outcome for outcome in result.outcomes}
        first, *later = [by_name[label] for label in labels if label in by_name]
        for outcome in later:
            if first.quality and outcome.quality:
                yield from (f"{result.row.name}: {outcome.contender} {sentence}"
                            for sentence in worse(first.quality, outcome.quality, percent))


def worse(before, now, percent):
    share = percent / 100
    for name, old, new in (("smallest scaled Jacobian", before.jacobian_min, now.jacobian_min),
                           ("mean scaled Jacobian", before.jacobian_mean, now.jacobian_mean)):
        if new < old - share * abs(old):
            yield f"has a {name} of {new:.4f}, before {old:.4f}"
    if now.aspect_max > before.aspect_max * (1 + share):
        yield f"has an R/3r of {now.aspect_max:.3f}, before {before.aspect_max:.3f}"
