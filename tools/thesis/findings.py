# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""The thesis's findings as checks on what the studies measured.

A function that is a `finding` gives its checks as (text with the measured figures, does it hold). A
finding is seen again when all hold, in part when some do. Values are in SI units.
"""
import dataclasses
import math

CHECKS = {}


def finding(function):
    CHECKS[function.__name__.upper()] = function
    return function


@dataclasses.dataclass
class Verdict:
    """What was found of one finding."""
    id: str
    section: str
    statement: str
    why: str
    checks: list

    @property
    def word(self):
        held = [holds for _, holds in self.checks]
        return "yes" if all(held) else "partly" if any(held) else "no"


def verdicts_of(expected, results):
    """One verdict a finding, in their order."""
    return [Verdict(e["id"], e["section"], e["statement"], e.get("why", "No reason was found."),
                    checked(CHECKS[e["id"]], results)) for e in expected]


def checked(checks, results):
    """Its checks; what a variant that failed leaves unmeasured counts as not seen."""
    found = []
    try:
        found.extend(checks(results))
    except KeyError as error:
        found.append((f"not measured: {error.args[0]}", False))
    return found


def mm(value):
    return f"{1e3 * value:.3g} mm"


def deg(value):
    return f"{math.degrees(value):.2g} deg"


def percent(value):
    return f"{100 * value:.1f} %"


def listed(values, show=str):
    return ", ".join(show(value) for value in values)


def counts(values):
    return ", ".join(f"{value:.0f}" for value in values)
