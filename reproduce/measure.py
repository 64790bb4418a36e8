# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of recipes and keeps what they made, so that nothing is measured twice with the same inputs.

A measurement NAME is done when NAME.done lies beside its files; it holds the hash of all inputs and the command.
"""
import json
import os
import shlex
import statistics
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from inputs import inputs_hash, missing_scene, shot_hash
from recipe import matches


class MeasureError(Exception):
    """One sentence."""


@dataclass
class Job:
    """One process. `outputs` are (option, file name) pairs; an option of None: standard output."""

    name: str
    arguments: list
    outputs: list
    inputs: list  # hashes
    shown: str = ""  # the command as a user would type it
    discarded: list = field(default_factory=list)  # arguments for what is not kept
    frames: range = range(0)  # numbers for #### in the names of outputs

    def files(self):
        """Names of all files that it makes."""
        return [name for _, file in self.outputs for name in numbered(file, self.frames)]


def numbered(file, frames):
    return [file.replace("####", f"{frame:04}") for frame in frames] if "####" in file else [file]


def as_arguments(options):
    """{"near_field": "disc", "jitter": True} -> --jitter --near-field disc. Sorted, so that equal ones hash alike."""
    words = []
    for name, value in sorted(options.items()):
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not False:
            words += [option, str(value)]
    return words


def slug(text):
    """A file name that can be read."""
    return "".join(letter if letter.isalnum() or letter in ".=-" else "_" for letter in text)


def combination_name(combination):
    return slug(",".join(value.name for value in combination.values())) or "picture"


class Folder:
    """Where the files of one recipe lie."""

    def __init__(self, path):
        self.path = Path(path)

    def file(self, name):
        return self.path / name

    def done(self, name):
        try:
            return json.loads(self.file(name + ".done").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None

    def mark_done(self, job, digest):
        entry = {"hash": digest, "command": job.shown, "files": job.files()}
        partial = self.file(job.name + ".done.partial")
        partial.write_text(json.dumps(entry, indent=1) + "\n", encoding="utf-8")
        os.replace(partial, self.file(job.name + ".done"))


class Bench:
    """Runs jobs in folders below `out`. `say` gets one line per process."""

    def __init__(self, program, out, say=print):
        self.program, self.out, self.say = Path(program), Path(out), say
        self.started = 0  # processes
        self.known = {}  # hash -> (folder, entry): figures share references
        for path in sorted(self.out.glob("*/*.done")):
            self.remember(Folder(path.parent), path.name.removesuffix(".done"))

    def remember(self, folder, name):
        entry = folder.done(name)
        if entry and all(folder.file(file).exists() for file in entry["files"]):
            self.known[entry["hash"]] = (folder, entry)

    def do(self, folder, job):
        """Measures, or finds that it was measured."""
        digest = inputs_hash(self.program, job.arguments, job.inputs)
        files = job.files()
        entry = folder.done(job.name)
        if entry and entry["hash"] == digest and all(folder.file(file).exists() for file in files):
            return
        folder.path.mkdir(parents=True, exist_ok=True)
        folder.file(job.name + ".done").unlink(missing_ok=True)
        if digest in self.known:
            self.take_over(folder, job, *self.known[digest])
        else:
            self.start(folder, job)
        folder.mark_done(job, digest)
        self.remember(folder, job.name)

    def take_over(self, folder, job, other, entry):
        for file, known in zip(job.files(), entry["files"]):
            folder.file(file).unlink(missing_ok=True)
            os.link(other.file(known), folder.file(file))

    def start(self, folder, job):
        self.say(f"{folder.path.name}: {job.name}")
        command = [str(self.program), *job.arguments, *job.discarded]
        said = None
        for file in job.files():
            folder.file(file).unlink(missing_ok=True)  # it may share its bytes with another figure's
        for option, file in job.outputs:
            if option:
                command += [option, str(folder.file(file))]
            else:
                said = folder.file(file)
        self.started += 1
        result = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
        if result.returncode == 130:
            raise KeyboardInterrupt
        if result.returncode != 0:
            complaint = f"ended with exit code {result.returncode}: {result.stderr.strip()}"
            raise MeasureError(f"{shlex.join(command)} {complaint}")
        if said:
            said.write_text(result.stdout, encoding="utf-8")


def render_job(folder, name, shot, options, layers="", keep=True, run=1):
    """keep: whether the picture is wanted, or only its times."""
    arguments = ["render", shot, *as_arguments(options), *(["--layers", layers] if layers else [])]
    statistics_file = ("--statistics", f"{name}.json")
    outputs = [("-o", f"{name}.exr"), statistics_file] if keep else [statistics_file]
    words = list(arguments)
    for option, file in outputs:
        words += [option, str(folder.file(file))]
    discarded = [] if keep else ["-o", str(folder.file("discarded.exr"))]
    # Each run is a measurement of its own; the folder must not count.
    inputs = [shot_hash(shot), f"run {run}"]
    return Job(name, [*arguments, "--quiet"], outputs, inputs, "luciole " + shlex.join(words), discarded)


def compare_job(folder, name, pair, exposure, sources=None):
    """pair: names of pictures; sources: the measurements that made them, if these have other names."""
    arguments = ["compare", *(str(folder.file(part + ".exr")) for part in pair), "--exposure", str(exposure), "--json"]
    inputs = [folder.done(part)["hash"] for part in sources or pair]
    return Job(name, arguments, [(None, name + ".json")], inputs, "luciole " + shlex.join(arguments))


class Measured:
    """What was measured for one combination."""

    def __init__(self, folder, name, runs, missing=""):
        self.folder, self.name, self.runs, self.missing = folder, name, runs, missing

    def files(self):
        return [f"{self.name}.json"] + [f"{self.name}.run{i}.json" for i in range(2, self.runs + 1)]

    def figures(self):
        """The statistics of all runs."""
        return [json.loads(self.folder.file(file).read_text(encoding="utf-8")) for file in self.files()]

    def exposure(self):
        return self.figures()[0]["settings"]["exposure"]

    def value(self, metric):
        """Median over the runs of a figure, a sum of figures or a quotient of such: "frame_ms / passes_ms/shading"."""
        above, _, below = metric.partition(" / ")
        values = [sum(self.one_value(part.strip()) for part in side.split(" + ")) for side in (above, below) if side]
        return values[0] / values[1] if below else values[0]

    def one_value(self, metric):
        if metric == "flicker":
            return flicker_of(self.folder, self.name)
        if metric.startswith("compare/"):
            sources = [json.loads(self.folder.file(f"{self.name}.compare.json").read_text(encoding="utf-8"))]
            metric = metric.removeprefix("compare/")
        else:
            sources = self.figures()
        return statistics.median(looked_up(source, metric, self.name) for source in sources)


def looked_up(figures, path, name):
    for key in path.split("/"):
        if not isinstance(figures, dict) or key not in figures:
            raise MeasureError(f"{name}: nothing was measured by the name '{path}'")
        figures = figures[key]
    if not isinstance(figures, (int, float)):
        raise MeasureError(f"{name}: '{path}' is no number")
    return float(figures)


def frame_range(options):
    first, last = options["frames"].split("-")
    return range(int(first), int(last) + 1)


def measure_sequence(bench, folder, name, shot, options):
    """Frames along the shot's path, and the difference of each from the one before."""
    frames, stem = frame_range(options), slug(f"{name}.frames")
    job = render_job(folder, stem, shot, options)
    job.outputs = [("-o", f"{stem}-####.exr"), ("--statistics", f"{stem}.json")]
    job.shown, job.frames = job.shown.replace(f"{stem}.exr", f"{stem}-####.exr"), frames
    bench.do(folder, job)
    shown = json.loads(folder.file(f"{stem}.json").read_text(encoding="utf-8"))["settings"]["exposure"]
    for frame in frames[1:]:
        pair = (f"{stem}-{frame:04}", f"{stem}-{frame - 1:04}")
        bench.do(folder, compare_job(folder, f"{pair[0]}.change", pair, shown, (stem,)))


def flicker_of(folder, name):
    """Mean FLIP between consecutive frames, [0,1]. (Root mean squares tell of the one brightest speckle.)"""
    entry = folder.done(slug(f"{name}.frames"))
    if not entry:
        raise MeasureError(f"{name}: no frames were measured")
    pictures = [file.removesuffix(".exr") for file in entry["files"] if file.endswith(".exr")]
    changes = [json.loads(folder.file(f"{name}.change.json").read_text(encoding="utf-8")) for name in pictures[1:]]
    return statistics.mean(change["flip"] for change in changes)


def reference_name(recipe, combination):
    shared = [combination[axis].name for axis in recipe.reference.get("per", [])]
    return slug(",".join(["reference", *shared]))


def compared_name(recipe, combination, quick):
    """The picture that is held against the reference: the measured one, or a smaller one of the same settings."""
    return combination_name(combination) + (".small" if recipe.common(quick) else "")


def measure(bench, recipe, quick):
    """All measurements of a recipe: {name of the combination: Measured}. Runs alternate, so that a machine that slows
    down does so for all."""
    folder = Folder(bench.out / recipe.name)
    runs = recipe.quick.get("runs", 1) if quick else recipe.runs
    results, present = {}, []
    for combination in recipe.combinations(quick):
        name = combination_name(combination)
        missing = missing_scene(recipe.shot_of(combination, quick))
        results[name] = Measured(folder, name, runs, missing)
        if not missing:
            present.append((name, combination))
    for run in range(1, runs + 1):
        for name, combination in present:
            own = name if run == 1 else f"{name}.run{run}"
            bench.do(folder, render_job(folder, own, recipe.shot_of(combination, quick),
                                        recipe.options_of(combination, quick), keep=run == 1, run=run))
    for name, combination in present:
        shot, options = recipe.shot_of(combination, quick), recipe.options_of(combination, quick)
        if recipe.is_compared(combination):
            common, reference = recipe.common(quick), reference_name(recipe, combination)
            if common:
                bench.do(folder, render_job(folder, f"{name}.small", shot, options | common))
            bench.do(folder, render_job(folder, reference, *recipe.reference_of(combination, quick)))
            pair = (compared_name(recipe, combination, quick), reference)
            bench.do(folder, compare_job(folder, f"{name}.compare", pair, results[name].exposure()))
        if recipe.sequence:
            sequence, path = recipe.sequence_options(quick), recipe.sequence.get("shot", shot)
            measure_sequence(bench, folder, name, path, options | sequence)
        if recipe.maps and matches(combination, recipe.maps.get("where", {})):
            bench.do(folder, render_job(folder, f"{name}.maps", shot, options, "lights_listed,lights_false"))
    folder.file("discarded.exr").unlink(missing_ok=True)
    return results
