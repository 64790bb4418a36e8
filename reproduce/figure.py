# SPDX-License-Identifier: Apache-2.0
"""Measurements of a recipe -> one dictionary, figure.json, from which the pages and docs/reproduction.md are made."""
from laws import FITS, exponent
from measure import MeasureError, combination_name, compared_name, reference_name
from recipe import PAPERS, matches, names_on, printed


class View:
    """The measurements of a recipe by the names on its axes."""

    def __init__(self, recipe, results, quick):
        self.recipe, self.results, self.quick = recipe, results, quick
        self.combinations = list(recipe.combinations(quick))

    def measured(self, combination):
        return self.results[combination_name(combination)]

    def where(self, *conditions):
        """Combinations that fulfil all conditions and could be measured here."""
        return [c for c in self.combinations
                if all(matches(c, condition) for condition in conditions) and not self.measured(c).missing]

    def only(self, *conditions):
        """The one combination, as a measurement; none if it was left out (quick runs, scenes that are not there)."""
        found = self.where(*conditions)
        if len(found) > 1:
            raise MeasureError(f"{self.recipe.name}: {len(found)} measurements are meant by {conditions}")
        return self.measured(found[0]) if found else None

    def reason(self, *conditions):
        """Why there is no such measurement."""
        for combination in self.combinations:
            if all(matches(combination, condition) for condition in conditions):
                return self.measured(combination).missing
        return "not part of a quick run" if self.quick else ""


def cell(view, table, row, column):
    """What was measured at one place of a table: a number, or the reason why there is none."""
    where = dict(table.get("where", {}))
    metric = table.get("metric")
    for side, name in (("rows", row), ("columns", column)):
        if table[side] == "metrics":
            entry = next(entry for entry in table["metrics"] if entry["name"] == name)
            if "reason" in entry:
                return None, entry["reason"]
            metric = entry["metric"]
        else:
            where[table[side]] = name
    measured = view.only(where)
    if measured is None:
        reason = view.reason(where)
        if not reason:
            raise MeasureError(f"{view.recipe.name}: the table '{table['title']}' lacks {row}, {column}")
        return None, reason
    return measured.value(metric), ""


def relative(numbers, base, side):
    """Numbers by (row, column) over those of one row or column."""
    def over(place):
        foot = numbers.get((base, place[1]) if side == "rows" else (place[0], base))
        return numbers[place] / foot if numbers[place] is not None and foot else None
    return {place: over(place) for place in numbers}


def table_of(view, table):
    recipe = view.recipe
    rows, columns = names_on(recipe, table, "rows"), names_on(recipe, table, "columns")
    ours, paper, reasons = {}, {}, {}
    for row in rows:
        published = table.get("paper", {}).get(row, [None] * len(columns))
        for column, number in zip(columns, published):
            ours[row, column], reasons[row, column] = cell(view, table, row, column)
            paper[row, column] = number if printed(number) else None
    base = table.get("relative_to")
    if base:
        side = "rows" if base in rows else "columns"
        ours, paper = relative(ours, base, side), relative(paper, base, side)
    def entry(row, column):
        own, theirs = ours[row, column], paper[row, column]
        ratio = own / theirs if own is not None and theirs else None
        return {"ours": own, "paper": theirs, "ratio": ratio, "reason": reasons[row, column]}
    return {
        "title": table["title"], "unit": table.get("unit", ""), "note": table.get("note", ""),
        "row_title": table.get("row_title", ""), "columns": columns,
        "has_paper": any(number is not None for number in paper.values()),
        "rows": [{"name": row, "cells": [entry(row, column) for column in columns]} for row in rows],
    }


def points_of(view, entry, series):
    axis = {entry["series"]: series} if series else {}
    along = view.where(entry.get("where", {}), axis)
    return sorted((view.measured(c).value(entry["x"]), view.measured(c).value(entry["y"])) for c in along)


def law_points(kind, points):
    """The fitted law at 33 places, evenly spread in the logarithm."""
    law = FITS[kind](points)
    low, high = points[0][0], points[-1][0]
    places = [low * (high / low) ** (i / 32) for i in range(33)]
    return [(x, law(x)) for x in places]


def plot_of(view, entry):
    names = [value.name for value in view.recipe.axes[entry["series"]]] if "series" in entry else [""]
    plot = {key: entry.get(key, "") for key in ("title", "x_title", "y_title", "note")}
    plot["series"], plot["laws"] = [], []
    for name in names:
        points = points_of(view, entry, name)
        if not points:
            continue
        plot["series"].append({"name": name or entry["y_title"], "points": points})
        kind = entry.get("laws", {}).get(name)
        if kind and len(points) > 2:
            plot["laws"].append({"name": f"{name}: law ({kind})", "points": law_points(kind, points)})
    return plot


def rest_of(combination, *conditions):
    """What a combination has beside the conditions, as a condition."""
    fixed = {axis for condition in conditions for axis in condition}
    return {axis: value.name for axis, value in combination.items() if axis not in fixed}


def claim_values(view, claim):
    """Pairs (what it was measured at, number)."""
    where, values = claim.get("where", {}), []
    if claim["kind"] == "ratio":
        for combination in view.where(where, claim["numerator"]):
            rest = rest_of(combination, claim["numerator"])
            below = view.only(where, claim["denominator"], rest)
            if below is not None:
                divisor = below.value(claim["metric"])
                number = view.measured(combination).value(claim["metric"])
                values.append((", ".join(rest.values()), number / divisor if divisor else float("inf")))
    elif claim["kind"] == "exponent":
        entry = {"x": claim["along"], "y": claim["metric"], "where": where}
        points = points_of(view, entry, "")
        if len(points) > 1:
            values.append(("", exponent(points)))
    else:
        values = [(", ".join(rest_of(c, where).values()), view.measured(c).value(claim["metric"]))
                  for c in view.where(where)]
    return values


def claim_of(view, claim):
    values = claim_values(view, claim)
    if not values:
        if view.reason(claim.get("where", {}), claim.get("numerator", {})) or view.quick:
            return None
        raise MeasureError(f"{view.recipe.name}: nothing was measured for the claim '{claim['text']}'")
    low, high = min(values, key=lambda v: v[1]), max(values, key=lambda v: v[1])
    at_least, at_most = claim.get("at_least"), claim.get("at_most")
    held = (at_least is None or low[1] >= at_least) and (at_most is None or high[1] <= at_most)
    worst = low if at_least is not None and at_most is None else high
    kept = sum((at_least is None or v >= at_least) and (at_most is None or v <= at_most) for _, v in values)
    return {
        "text": claim["text"], "held": held, "kept": kept, "of": len(values), "low": low[1], "high": high[1],
        "worst": worst[0] if len(values) > 1 else "", "at_least": at_least, "at_most": at_most,
        "paper": claim.get("paper", []), "of_time": is_time(claim["metric"]), "kind": claim["kind"],
        "note": claim.get("note", ""),
    }


def is_time(metric):
    """Times depend on the machine and on what else it does; counts on nothing but the inputs."""
    return "_ms" in metric or "seconds" in metric


def comparisons_of(view):
    """Groups of pictures that share a reference."""
    groups = {}
    for entry in view.recipe.comparisons:
        for combination in view.where(entry.get("where", {})):
            measured = view.measured(combination)
            reference = reference_name(view.recipe, combination)
            title = f"{entry['per']} {combination[entry['per']].name}" if "per" in entry else entry.get("title", "")
            group = groups.setdefault((title, reference), {
                "title": title, "exposure": measured.value("settings/exposure"),
                "reference": {"name": "reference", "file": f"{reference}.exr"}, "pictures": []})
            rest = rest_of(combination, entry.get("where", {}), {entry.get("per", ""): ""})
            file = f"{compared_name(view.recipe, combination, view.quick)}.exr"
            name = ", ".join(rest.values()) or "Luciole"
            group["pictures"].append({"name": name, "file": file, "time": time_of(view, measured)})
    return list(groups.values())


def time_of(view, measured):
    figures = measured.figures()[0]
    if "frame_ms" in figures:
        size = f" at {figures['settings']['size']}" if view.recipe.common(view.quick) else ""  # not that of the picture
        return f"{measured.value('frame_ms'):.4g} ms a frame{size}"
    return f"{measured.value('render_seconds'):.3g} s, {figures['samples_per_pixel']} samples"


def maps_of(view):
    if not view.recipe.maps:
        return []
    return [{"title": ", ".join(f"{axis} {value.name}" for axis, value in combination.items()),
             "file": f"{combination_name(combination)}.maps.exr"}
            for combination in view.where(view.recipe.maps.get("where", {}))]


def machine_of(view):
    for combination in view.where():
        figures = view.measured(combination).figures()[0]
        return {key: figures[key] for key in ("processor", "threads", "instruction_set", "version", "commit")}
    return {}


def commands_of(view):
    """As a user would type them; run 1 of each."""
    names = dict.fromkeys(combination_name(c) for c in view.where())
    if view.recipe.reference:
        compared = view.where(view.recipe.reference.get("where", {}))
        names |= dict.fromkeys(reference_name(view.recipe, combination) for combination in compared)
    folder = next(iter(view.results.values())).folder
    return [folder.done(name)["command"] for name in names]


def figure_of(recipe, results, quick):
    view = View(recipe, results, quick)
    missing = sorted({measured.missing for measured in results.values() if measured.missing})
    claims = [claim_of(view, claim) for claim in recipe.claims]
    return {
        "name": recipe.name, "paper": recipe.paper, "paper_title": PAPERS[recipe.paper], "figure": recipe.figure,
        "title": recipe.title, "says": recipe.says, "stands_in": recipe.stands_in, "differs": recipe.differs,
        "quick": quick, "missing": missing, "machine": machine_of(view),
        "tables": [table_of(view, table) for table in recipe.tables],
        "plots": [plot_of(view, plot) for plot in recipe.plots],
        "claims": [claim for claim in claims if claim], "comparisons": comparisons_of(view), "maps": maps_of(view),
        "commands": commands_of(view) if view.where() else [],
    }
