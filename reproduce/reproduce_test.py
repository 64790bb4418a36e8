# SPDX-License-Identifier: Apache-2.0
"""Tests of the recipes and their runner: reproduce_test.py LUCIOLE. Most run a stand-in for the program."""
import copy
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import laws  # noqa: E402
from document import document  # noqa: E402
from inputs import SHOTS, shot_file  # noqa: E402
from measure import MeasureError  # noqa: E402
from recipe import RecipeError, read_recipe, read_recipes  # noqa: E402

LUCIOLE = ""

# Writes what it is asked for, and one line per call. Times grow with the lights, counts with their square root.
STAND_IN = f"#!{sys.executable} -S\n" + """
import json, os, sys, time
words = sys.argv[1:]
with open(os.environ["CALLS"], "a") as calls:
    calls.write(" ".join(words) + "\\n")
option = lambda name, other: words[words.index(name) + 1] if name in words else other
if words[0] == "compare":
    print(json.dumps({"rmse": 0.5, "display_rmse": 0.5, "relmse": 0.25, "flip": 0.1, "mean_ratio": 1}))
if words[0] == "render":
    time.sleep(float(os.environ.get("SECONDS_PER_RENDER", 0)))
    first, _, last = option("--frames", "0-0").partition("-")
    for frame in range(int(first), int(last) + 1):
        open(option("-o", "").replace("####", f"{frame:04}"), "w").write("picture")
    lights = int(option("--vpls", 100))
    json.dump({"frame_ms": lights / 10, "lights": lights, "accepted": lights ** 0.5, "settings": {"exposure": 2},
               "processor": "p", "threads": 1, "instruction_set": "i", "version": "1", "commit": "c"},
              open(option("--statistics", ""), "w"))
if words[0] == "report":
    os.makedirs(option("-o", ""), exist_ok=True)
"""

RECIPE = """
paper = "TH16"
figure = "Figure 0"
title = "A test"
says = "something."
shot = "recipe:cornell"
runs = 2
[options]
size = "64x36"
[[axis]]
name = "lights"
value = [{ name = "few", options = { vpls = 100 } }, { name = "many", options = { vpls = 400 } }]
[reference]
options = { culling = "none" }
[[table]]
title = "Cost"
rows = "lights"
columns = "metrics"
metrics = [{ name = "ms", metric = "frame_ms" }, { name = "RMSE", metric = "compare/display_rmse" }]
paper = { "few" = [5.0, nan] }
[[claim]]
text = "sublinear"
kind = "exponent"
metric = "accepted"
along = "lights"
at_most = 0.6
paper = [0.5]
"""


class Runner(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        (self.folder / "recipes").mkdir()
        self.write_recipe(RECIPE)
        self.program = self.folder / "luciole"
        self.program.write_text(STAND_IN)
        self.program.chmod(0o755)

    def write_recipe(self, text):
        (self.folder / "recipes/th16-fig0.toml").write_text(text)

    def command(self, *words):
        return [sys.executable, str(HERE / "reproduce.py"), str(self.program), "--out", str(self.folder / "out"),
                "--recipes", str(self.folder / "recipes"), *words]

    def environment(self, **more):
        return os.environ | {"CALLS": str(self.folder / "calls")} | more

    def run_it(self, *words):
        return subprocess.run(self.command(*words), capture_output=True, text=True, env=self.environment(), check=False)

    def calls(self, kind):
        """How many processes of this kind since the last time."""
        path = self.folder / "calls"
        lines = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return sum(line.startswith(kind) for line in lines)

    def figure(self):
        return json.loads((self.folder / "out/reproduce/th16-fig0/figure.json").read_text())

    def test_a_second_run_measures_nothing_and_says_the_same(self):
        first = self.run_it()
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual(self.calls("render"), 2 * 2 + 1)  # two runs of two, and a reference
        figure = self.figure()
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render") + self.calls("compare"), 0)
        self.assertEqual(self.figure(), figure)
        cells = figure["tables"][0]["rows"][0]["cells"]
        self.assertEqual(cells[0], {"ours": 10.0, "paper": 5.0, "ratio": 2.0, "reason": ""})
        self.assertEqual(cells[1]["ours"], 0.5)
        self.assertIsNone(cells[1]["paper"])
        self.assertAlmostEqual(figure["claims"][0]["low"], 0.5)

    def test_what_changed_is_measured_again_and_the_rest_is_not(self):
        self.assertEqual(self.run_it().returncode, 0)
        self.calls("")
        self.write_recipe(RECIPE.replace("vpls = 400", "vpls = 500"))
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render"), 2)
        (self.folder / "out/reproduce/th16-fig0/few.exr").unlink()
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render"), 1)
        self.program.write_text(STAND_IN + "# another version\n")
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render"), 5)

    def test_figures_share_what_they_have_in_common(self):
        (self.folder / "recipes/th16-fig1.toml").write_text(RECIPE)
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render"), 5)

    def test_a_metric_may_be_a_quotient_of_sums(self):
        self.write_recipe(RECIPE.replace('"frame_ms" }', '"frame_ms + frame_ms / lights" }'))
        self.assertEqual(self.run_it().returncode, 0)
        self.assertAlmostEqual(self.figure()["tables"][0]["rows"][0]["cells"][0]["ours"], 0.2)

    def test_flicker_is_what_changes_from_frame_to_frame(self):
        sequence = '[sequence]\noptions = { frames = "3-5" }\n'
        self.write_recipe(RECIPE.replace("[[table]]", sequence + "[[table]]").replace("frame_ms", "flicker"))
        self.assertEqual(self.run_it().returncode, 0)
        cell = self.figure()["tables"][0]["rows"][0]["cells"][0]
        self.assertAlmostEqual(cell["ours"], 0.1)
        self.assertEqual(self.calls("compare"), 2 + 2 * 2)
        self.assertTrue((self.folder / "out/reproduce/th16-fig0/many.frames-0005.exr").exists())
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render") + self.calls("compare"), 0)

    def test_a_wrong_name_is_refused_with_the_list_of_names(self):
        result = self.run_it("th16-fig99")
        self.assertEqual(result.returncode, 2)
        self.assertIn("there is no recipe 'th16-fig99'; these are there: th16-fig0", result.stderr)
        self.assertEqual(self.calls(""), 0)

    def test_after_ctrl_c_the_finished_work_is_kept(self):
        process = subprocess.Popen(self.command(), env=self.environment(SECONDS_PER_RENDER="1"), start_new_session=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        done = self.folder / "out/reproduce/th16-fig0/few.done"
        while not done.exists() and process.poll() is None:
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, complained = process.communicate()
        self.assertEqual(process.returncode, 130, complained)
        self.assertIn("interrupted", complained)
        self.assertNotIn("Traceback", complained)
        self.calls("")
        self.assertEqual(self.run_it().returncode, 0)
        self.assertEqual(self.calls("render"), 4)

    def test_a_program_that_fails_is_named_and_nothing_counts_as_measured(self):
        self.program.write_text("#!/bin/sh\necho no such thing >&2\nexit 3\n")
        result = self.run_it()
        self.assertEqual(result.returncode, 1)
        self.assertIn("ended with exit code 3: no such thing", result.stderr)
        self.assertEqual(list((self.folder / "out").rglob("*.done")), [])

    def test_a_figure_that_was_not_measured_is_an_error_and_no_empty_cell(self):
        self.write_recipe(RECIPE.replace('metric = "frame_ms"', 'metric = "no_such_figure"'))
        result = self.run_it()
        self.assertEqual(result.returncode, 1)
        self.assertIn("nothing was measured by the name 'no_such_figure'", result.stderr)

    def test_the_document_needs_all_recipes(self):
        (self.folder / "recipes/th16-fig1.toml").write_text(RECIPE)
        page = self.folder / "reproduction.md"
        result = self.run_it("th16-fig0", "--document", str(page))
        self.assertEqual(result.returncode, 1)
        self.assertIn("th16-fig1 is not measured", result.stderr)
        self.assertFalse(page.exists())
        self.assertEqual(self.run_it("--document", str(page)).returncode, 0)
        text = page.read_text()
        self.assertIn("| few | 10.00 / 5.00 (2.00) | 0.500 / – |", text)
        self.assertIn("| sublinear | at most 0.600 | 0.500 | 0.500 | held |", text)
        figure = self.figure()
        broken = copy.deepcopy(figure)
        broken["tables"][0]["rows"][1]["cells"][0]["ours"] = None
        with self.assertRaisesRegex(MeasureError, "Cost, many, ms: there is neither a number nor a reason"):
            document([broken])
        missed = copy.deepcopy(figure)
        missed["claims"][0] |= {"held": False, "kept": 0}
        self.assertIn("**not held** (0 of 1)", document([missed]))


class Recipes(unittest.TestCase):
    def refused(self, text, complaint):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "th16-fig0.toml"
            path.write_text(text)
            with self.assertRaisesRegex(RecipeError, complaint):
                read_recipe(path)

    def test_mistakes_are_named(self):
        self.refused("paper = ", "th16-fig0.toml: Invalid value")
        self.refused(RECIPE.replace('"TH16"', '"TH99"'), "the paper 'TH99' is none of TH16, TH17")
        self.refused(RECIPE.replace("runs", "ruins"), "'ruins' is not a key")
        self.refused(RECIPE.replace('rows = "lights"', 'rows = "light"'), "the axis 'light', which")
        self.refused(RECIPE.replace("[5.0, nan]", "[5.0]"), "no row 'few' of 1 numbers")
        self.refused(RECIPE.replace("at_most = 0.6", ""), "has no limit")
        self.refused(RECIPE + 'where = { lights = "most" }', "speaks of 'most', which is not on the axis")

    def test_all_of_the_project_name_shots_and_settings_that_exist(self):
        known = set(re.findall(r"--([a-z-]+)", subprocess.run([LUCIOLE, "render", "--help"], capture_output=True,
                                                              text=True, check=True).stdout))
        recipes = read_recipes(HERE / "recipes")
        self.assertGreaterEqual(len(recipes), 15)
        for recipe in recipes.values():
            for quick in (False, True):
                combinations = list(recipe.combinations(quick))
                self.assertTrue(combinations, recipe.name)
                for combination in combinations:
                    shots_and_options = [(recipe.shot_of(combination, quick), recipe.options_of(combination, quick))]
                    if recipe.reference:
                        shots_and_options.append(recipe.reference_of(combination, quick))
                    for shot, options in shots_and_options:
                        path = shot_file(shot)
                        self.assertTrue(path is None or path.is_file(), f"{recipe.name}: {shot}")
                        for option in options:
                            self.assertIn(option.replace("_", "-"), known, recipe.name)
        self.assertTrue(SHOTS.is_dir())

    def test_claims_keep_to_what_the_paper_says(self):
        """A claim with the paper's numbers must hold for them; a wrong limit would prove nothing."""
        for recipe in read_recipes(HERE / "recipes").values():
            for claim in recipe.claims:
                for number in claim.get("paper", []):
                    self.assertGreaterEqual(number, claim.get("at_least", -math.inf), claim["text"])
                    self.assertLessEqual(number, claim.get("at_most", math.inf), claim["text"])


class Laws(unittest.TestCase):
    def test_a_fit_finds_the_law_that_made_the_points(self):
        law = laws.Plane(2e-4, 1e-3, 0.1)
        places = [4**i for i in range(5, 11)]
        fitted = laws.fitted_plane([(n, law(n)) for n in places])
        for n in places:
            self.assertAlmostEqual(math.log(fitted(n) / law(n)), 0, delta=math.log(1.25) / 2)  # half a step of the grid
        linear = laws.fitted_linear([(n, law(n)) for n in places])
        self.assertGreater(max(abs(math.log(linear(n) / law(n))) for n in places), math.log(1.25))

    def test_exponents_are_those_of_powers(self):
        self.assertAlmostEqual(laws.exponent([(n, 3 * n**0.5) for n in (1, 10, 70)]), 0.5)


if __name__ == "__main__":
    LUCIOLE = sys.argv.pop(1)
    unittest.main(verbosity=1)
