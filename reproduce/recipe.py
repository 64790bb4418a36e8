# SPDX-License-Identifier: Apache-2.0
"""A recipe: one figure or table of the papers as a TOML file, and what is to be measured for it (README.md here)."""
import itertools
import math
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

PAPERS = {
    "TH16": "Tokuyoshi and Harada, Stochastic Light Culling, JCGT 5(1), 2016",
    "TH17": "Tokuyoshi and Harada, Stochastic Light Culling for VPLs on GGX Microsurfaces, CGF 36(4), 2017",
}


class RecipeError(Exception):
    """One sentence that names the file and the fault."""


@dataclass
class Value:
    """One place on an axis: a scene, a number of lights, a way of culling ..."""

    name: str
    shot: str = ""
    options: dict = field(default_factory=dict)
    quick_shot: str = ""  # where the shot takes long to load
    quick_options: dict = field(default_factory=dict)
    quick: bool = True  # false: left out of quick runs
    only: dict = field(default_factory=dict)  # taken only with these values of other axes


@dataclass
class Recipe:
    name: str
    paper: str
    figure: str
    title: str
    says: str
    shot: str = ""
    runs: int = 1
    stands_in: list = field(default_factory=list)
    differs: list = field(default_factory=list)
    options: dict = field(default_factory=dict)
    quick: dict = field(default_factory=dict)  # options, runs
    axes: dict = field(default_factory=dict)  # name -> list of Value, in the order of the file
    reference: dict = field(default_factory=dict)  # options; per, where, common: see README.md
    maps: dict = field(default_factory=dict)  # where: of which measurements the lights per pixel are drawn
    sequence: dict = field(default_factory=dict)  # shot, options: of frames in a row, see README.md
    tables: list = field(default_factory=list)
    plots: list = field(default_factory=list)
    claims: list = field(default_factory=list)
    comparisons: list = field(default_factory=list)

    def combinations(self, quick):
        """All choices of one value per axis that belong together, as dictionaries axis -> Value."""
        kept = [[v for v in values if v.quick or not quick] for values in self.axes.values()]
        for choice in itertools.product(*kept):
            combination = dict(zip(self.axes, choice))
            if all(matches(combination, value.only) for value in choice):
                yield combination

    def shot_of(self, combination, quick):
        value = next((v for v in combination.values() if v.shot), None)
        if value is None:
            return self.shot
        return value.quick_shot if quick and value.quick_shot else value.shot

    def options_of(self, combination, quick):
        """Later ones win: the recipe's, the quick ones, each axis' own."""
        options = dict(self.options)
        if quick:
            options.update(self.quick.get("options", {}))
        for value in combination.values():
            options.update(value.options)
            if quick:
                options.update(value.quick_options)
        return options

    def reference_of(self, combination, quick):
        """Shot and options of the picture that this one is held against."""
        shared = {axis: combination[axis] for axis in self.reference.get("per", [])}
        options = self.options_of(shared, quick) | self.common(quick) | self.reference["options"]
        return self.shot_of(combination, quick), options | (self.reference.get("quick_options", {}) if quick else {})

    def common(self, quick):
        """What picture and reference have in common where the measured picture would be too large for a reference."""
        return {} if quick else self.reference.get("common", {})

    def sequence_options(self, quick):
        return self.sequence["options"] | (self.sequence.get("quick_options", {}) if quick else {})

    def is_compared(self, combination):
        return bool(self.reference) and matches(combination, self.reference.get("where", {}))


def matches(combination, where):
    """Whether the names on the axes are those wanted: {axis: name or list of names}."""
    for axis, wanted in where.items():
        names = wanted if isinstance(wanted, list) else [wanted]
        if axis in combination and combination[axis].name not in names:
            return False
    return True


def known_keys(entry, allowed, place):
    for key in entry:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            raise RecipeError(f"{place}: '{key}' is not a key of a recipe here; these are: {keys}")


def read_axis(entry, place):
    known_keys(entry, {"name", "value"}, place)
    values = []
    for value in entry["value"]:
        known_keys(value, set(Value.__dataclass_fields__), f"{place}, axis {entry['name']}")
        values.append(Value(**value))
    return values


ENTRY_KEYS = {
    "table": {"title", "rows", "columns", "row_title", "metric", "metrics", "unit", "where", "paper", "relative_to",
              "note", "digits"},
    "plot": {"title", "x", "y", "x_title", "y_title", "along", "series", "laws", "where", "note"},
    "claim": {"text", "kind", "metric", "numerator", "denominator", "along", "where", "at_least", "at_most", "paper",
              "note"},
    "comparison": {"per", "where", "title"},
}


def check_names(recipe, place):
    """Axes and values that tables, plots and claims speak of exist."""
    def check_where(where, what):
        for axis, wanted in where.items():
            if axis not in recipe.axes:
                raise RecipeError(f"{place}: {what} speaks of the axis '{axis}', which the recipe does not have")
            names = {value.name for value in recipe.axes[axis]}
            for name in wanted if isinstance(wanted, list) else [wanted]:
                if name not in names:
                    raise RecipeError(f"{place}: {what} speaks of '{name}', which is not on the axis '{axis}'")

    def check_axis(axis, what):
        if axis != "metrics" and axis not in recipe.axes:
            raise RecipeError(f"{place}: {what} speaks of the axis '{axis}', which the recipe does not have")

    for table in recipe.tables:
        what = f"the table '{table['title']}'"
        check_axis(table["rows"], what)
        check_axis(table["columns"], what)
        check_where(table.get("where", {}), what)
        check_paper(recipe, table, place)
    for claim in recipe.claims:
        what = f"the claim '{claim['text']}'"
        for key in ("where", "numerator", "denominator"):
            check_where(claim.get(key, {}), what)
        if claim["kind"] not in ("ratio", "exponent", "value"):
            raise RecipeError(f"{place}: {what} is of the kind '{claim['kind']}'; kinds are ratio, exponent, value")
        if "at_least" not in claim and "at_most" not in claim:
            raise RecipeError(f"{place}: {what} has no limit: at_least or at_most")
    for entries, what in ((recipe.plots, "a plot"), (recipe.comparisons, "a comparison")):
        for entry in entries:
            check_where(entry.get("where", {}), what)
            for key in ("along", "series", "per"):
                if key in entry:
                    check_axis(entry[key], what)
    for value in itertools.chain(*recipe.axes.values()):
        check_where(value.only, f"the value '{value.name}'")


def names_on(recipe, table, side):
    """The headings of one side of a table."""
    if table[side] == "metrics":
        return [metric["name"] for metric in table["metrics"]]
    where = table.get("where", {}).get(table[side])
    names = [value.name for value in recipe.axes[table[side]]]
    return names if where is None else [n for n in names if n in (where if isinstance(where, list) else [where])]


def check_paper(recipe, table, place):
    """Published numbers: one list per row, one number per column, nan where the paper prints none."""
    rows, columns = names_on(recipe, table, "rows"), names_on(recipe, table, "columns")
    for row, numbers in table.get("paper", {}).items():
        if row not in rows or len(numbers) != len(columns):
            raise RecipeError(f"{place}: the table '{table['title']}' has no row '{row}' of {len(numbers)} numbers")


def read_recipe(path):
    path = Path(path)
    try:
        text = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise RecipeError(f"{path.name}: {error}") from error
    lists = {"table": "tables", "plot": "plots", "claim": "claims", "comparison": "comparisons"}
    plain = set(Recipe.__dataclass_fields__) - {"name", "axes", *lists.values()}
    known_keys(text, plain | {"axis", *lists}, path.name)
    for key in ("paper", "figure", "title", "says"):
        if not isinstance(text.get(key), str):
            raise RecipeError(f"{path.name}: '{key}' is missing")
    if text["paper"] not in PAPERS:
        raise RecipeError(f"{path.name}: the paper '{text['paper']}' is none of {', '.join(PAPERS)}")
    recipe = Recipe(name=path.stem, **{key: text[key] for key in plain if key in text})
    for entry in text.get("axis", []):
        recipe.axes[entry["name"]] = read_axis(entry, path.name)
    for key, attribute in lists.items():
        for entry in text.get(key, []):
            known_keys(entry, ENTRY_KEYS[key], f"{path.name}, {key}")
        setattr(recipe, attribute, text.get(key, []))
    check_names(recipe, path.name)
    return recipe


def read_recipes(folder):
    """All recipes of a folder by name, in the order of papers and figures."""
    def order(recipe):
        kind, _, number = recipe.name.partition("-")[2].rpartition("-")
        return recipe.paper, recipe.name.rstrip("0123456789"), int("".join(filter(str.isdigit, number)) or 0), kind
    recipes = [read_recipe(path) for path in sorted(Path(folder).glob("*.toml"))]
    return {recipe.name: recipe for recipe in sorted(recipes, key=order)}


def printed(number):
    """Whether the paper prints a number here."""
    return number is not None and not math.isnan(number)
