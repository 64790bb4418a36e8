# SPDX-License-Identifier: Apache-2.0
"""Remakes figures and tables of the papers: measures what is not measured yet, then makes the report.

  reproduce.py PROGRAM [--quick] [--document FILE] [NAME ...]     names of recipes; none: all of them
"""
import argparse
import json
import os
import shlex
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from document import document  # noqa: E402
from figure import figure_of  # noqa: E402
from measure import Bench, MeasureError, measure  # noqa: E402
from recipe import RecipeError, read_recipes  # noqa: E402

HERE = Path(__file__).resolve().parent
INTERRUPTED = 130


def read_arguments(words):
    parser = argparse.ArgumentParser(prog="./do reproduce", description="Remake the papers' figures and tables.")
    parser.add_argument("program", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("name", nargs="*", help="recipes of reproduce/recipes; none: all")
    parser.add_argument("--quick", action="store_true", help="small pictures, few lights: minutes, and no evidence")
    parser.add_argument("--document", type=Path, metavar="FILE", help="also write docs/reproduction.md, of all recipes")
    parser.add_argument("--out", type=Path, default=Path("out"), help="folder of measurements and report (out)")
    parser.add_argument("--recipes", type=Path, default=HERE / "recipes", help=argparse.SUPPRESS)
    return parser.parse_intermixed_args(words)


def chosen(recipes, names):
    for name in names:
        if name not in recipes:
            raise RecipeError(f"there is no recipe '{name}'; these are there: {', '.join(recipes)}")
    return [recipes[name] for name in names] if names else list(recipes.values())


def write_figure(folder, figure):
    partial = folder / "figure.json.partial"
    partial.write_text(json.dumps(figure, indent=1) + "\n", encoding="utf-8")
    os.replace(partial, folder / "figure.json")


def make_figures(bench, wanted, quick):
    """Measures all, and tells what happened."""
    for number, recipe in enumerate(wanted, 1):
        start, before = time.monotonic(), bench.started
        results = measure(bench, recipe, quick)
        folder = bench.out / recipe.name
        folder.mkdir(parents=True, exist_ok=True)
        figure = figure_of(recipe, results, quick)
        write_figure(folder, figure)
        news = f"{bench.started - before} measured in {time.monotonic() - start:.0f} s"
        bench.say(f"[{number}/{len(wanted)}] {recipe.name}: {news if bench.started > before else 'nothing to measure'}")
        for reason in figure["missing"]:
            bench.say(f"  left out: {reason}")


def make_report(bench, recipes, page):
    """Of all figures that were ever measured, not only of those asked for now."""
    files = [str(bench.out / name / "figure.json") for name in recipes]
    files = [file for file in files if Path(file).exists()]
    command = [str(bench.program), "report", "--figures", *files, "-o", str(page)]
    result = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if result.returncode == INTERRUPTED:
        raise KeyboardInterrupt
    if result.returncode != 0:
        raise MeasureError(f"{shlex.join(command)} ended with exit code {result.returncode}: {result.stderr.strip()}")
    bench.say(f"the report: {(page / 'index.html').resolve()}")


def write_document(bench, recipes, path):
    figures = []
    for name in recipes:
        file = bench.out / name / "figure.json"
        if not file.exists():
            raise MeasureError(f"{path} needs all recipes, and {name} is not measured: ./do reproduce {name}")
        figures.append(json.loads(file.read_text(encoding="utf-8")))
    path.write_text(document(figures), encoding="utf-8")
    bench.say(f"the tables: {path}")


def run(arguments):
    recipes = read_recipes(arguments.recipes)
    wanted = chosen(recipes, arguments.name)
    suffix = "-quick" if arguments.quick else ""
    bench = Bench(arguments.program, arguments.out / f"reproduce{suffix}", lambda line: print(line, flush=True))
    make_figures(bench, wanted, arguments.quick)
    make_report(bench, recipes, arguments.out / f"report{suffix}")
    if arguments.document:
        write_document(bench, recipes, arguments.document)


def main(words):
    arguments = read_arguments(words)
    try:
        run(arguments)
    except (RecipeError, MeasureError) as error:
        print(f"reproduce: {error}", file=sys.stderr)
        return 2 if isinstance(error, RecipeError) else 1
    except KeyboardInterrupt:
        print("reproduce: interrupted; what is measured is kept, the same command goes on from there", file=sys.stderr)
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
