"""Names for how a run on a part ended, the figures of its row, and their summary against the bars."""

import datetime
import math
import statistics

MET = "within tolerance"
ESTIMATED = "with estimate"
REFUSED = "refused"
OUT_OF_TIME = "out of time"
CRASH = "crash"
INTERNAL = "internal error"
OUTCOMES = [MET, ESTIMATED, REFUSED, OUT_OF_TIME, CRASH, INTERNAL]

# Exit codes of docs/conventions.md: 3 an invalid case, 4 unreadable data, 5 a numerical failure, each with a message;
# with --strict, 5 is also a tolerance that is not met.
REFUSALS = (3, 4, 5)
SIGXCPU = 24
BARS = {"answer": 0.95, "met": 0.85, "first_answer_s": 10.0, "first_answer": 0.90, "beyond_estimate": 0.05,
        "error_over_estimate": 2.0}


def outcome(exit_code, timed_out, message, summary):
    """Of a finished run: `exit_code` is negative for a signal, `summary` is that of its results or None."""
    if timed_out or exit_code == -SIGXCPU:
        return OUT_OF_TIME
    if exit_code < 0:
        return CRASH
    if exit_code == 0 and summary is not None:
        estimate = (summary.get("mesh") or {}).get("error_estimate") or {}
        return MET if estimate.get("met") else ESTIMATED
    if exit_code in REFUSALS and message and "internal error" not in message:
        return REFUSED
    return INTERNAL


def figures(summary):
    """What a row says of an answer."""
    mesh, part = summary.get("mesh") or {}, summary.get("part") or {}
    estimate = mesh.get("error_estimate") or {}
    modes = part.get("modes") or []
    return {"dofs": mesh.get("dofs"), "order": mesh.get("order"), "elements": mesh.get("elements"),
            "estimate": estimate.get("max_relative_frequency_error"),
            "volume_difference": part.get("mass_difference_relative"),
            "rigid_motions": sum(bool(mode.get("rigid_body")) for mode in modes),
            "frequencies_hz": [mode["frequency_hz"] for mode in modes if not mode.get("rigid_body")]}


def seconds_to_first_answer(log):
    """From the first line of a run's log to its first solution with an estimate, the second one of a mesh; None if the
    log has none. The log's clock has whole seconds, so that it is a second off at most."""
    dated = [line for line in log if line[:4].isdigit()]
    first = next((line for line in dated if "frequencies changed by" in line), None)
    if first is None:
        return None
    begun, answered = (datetime.datetime.fromisoformat(line.split()[0]) for line in (dated[0], first))
    return (answered - begun).total_seconds()


def has_answer(row):
    return row["outcome"] in (MET, ESTIMATED)


def largest_error(frequencies, reference):
    """Largest relative difference of the modes that both have; None without any."""
    pairs = list(zip(frequencies, reference))
    return max((abs(a / b - 1.0) for a, b in pairs), default=None)


def compare(row, reference):
    """Adds the true error of a row's frequencies and its ratio to the estimate. The reference's own error, about the
    distance that it was extrapolated over, counts for the program."""
    error = largest_error(row["frequencies_hz"], reference["frequencies_hz"])
    if error is None:
        return
    row["true_error"], row["reference_error"] = error, reference["error"]
    if row["estimate"]:
        row["error_over_estimate"] = max(0.0, error - reference["error"]) / row["estimate"]


def share(rows, holds):
    """Of the rows for which it holds; NaN of none."""
    return sum(map(holds, rows)) / len(rows) if rows else math.nan


def first_answer(row):
    """Seconds to the first solution with an estimate; of a run whose log names none, to its end."""
    return row["wall_s"] if row.get("first_answer_s") is None else row["first_answer_s"]


def summary_of(rows):
    """What is held against the bars: (words, figure, bar in words, True if it holds; None where there is no bar)."""
    ratios = [row["error_over_estimate"] for row in rows if row.get("error_over_estimate") is not None]
    broken = sum(row["outcome"] in (CRASH, INTERNAL) for row in rows)
    unsound = sum(has_answer(row) and row.get("rigid_motions") != 6 for row in rows)
    answered, met = share(rows, has_answer), share(rows, lambda row: row["outcome"] == MET)
    prompt = share(rows, lambda row: has_answer(row) and first_answer(row) <= BARS["first_answer_s"])
    lines = [("parts with an answer", percent(answered), f"≥ {percent(BARS['answer'])}", answered >= BARS["answer"]),
             ("within tolerance by their estimate", percent(met), f"≥ {percent(BARS['met'])}", met >= BARS["met"]),
             ("crashes and internal errors", str(broken), "0", broken == 0),
             ("answers without six rigid motions", str(unsound), "0", unsound == 0),
             (f"first answers within {BARS['first_answer_s']:g} s", percent(prompt),
              f"≥ {percent(BARS['first_answer'])}", prompt >= BARS["first_answer"])]
    whole = share(rows, lambda row: has_answer(row) and row.get("processor_s", math.inf) <= BARS["first_answer_s"])
    lines.append((f"whole runs in {BARS['first_answer_s']:g} s of processor time", percent(whole), "", None))
    lines.append(("runs above the memory given", str(sum(row.get("above_memory", False) for row in rows)), "0",
                  not any(row.get("above_memory", False) for row in rows)))
    if ratios:
        beyond, worst = share(ratios, lambda ratio: ratio > 1.0), max(ratios)
        lines += [("true error above the estimate", percent(beyond), f"≤ {percent(BARS['beyond_estimate'])}",
                   beyond <= BARS["beyond_estimate"]),
                  ("largest true error over estimate", f"{worst:.2f}", f"≤ {BARS['error_over_estimate']:g}",
                   worst <= BARS["error_over_estimate"]),
                  ("median true error over estimate", f"{statistics.median(ratios):.2f}", "", None)]
    return lines


def percent(part):
    return "–" if math.isnan(part) else f"{100.0 * part:.0f} %"


def counts(rows):
    return {name: sum(row["outcome"] == name for row in rows) for name in OUTCOMES}
