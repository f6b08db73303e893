"""The table of a sweep as one HTML file that needs nothing else."""

import html
import os

from parts import outcomes

COLOURS = {outcomes.MET: "#d9f2dc", outcomes.ESTIMATED: "#fff3c9", outcomes.REFUSED: "#ffe0c2",
           outcomes.OUT_OF_TIME: "#f8d0d0", outcomes.CRASH: "#e8b4e0", outcomes.INTERNAL: "#e8b4e0"}
COLUMNS = [("file", "file"), ("outcome", "outcome"), ("wall_s", "wall, s"), ("processor_s", "processor, s"),
           ("memory_bytes", "memory, GB"), ("dofs", "unknowns"), ("order", "order"), ("estimate", "estimate"),
           ("volume_difference", "volume against the surface"), ("rigid_motions", "rigid motions"),
           ("true_error", "true error"), ("error_over_estimate", "over the estimate"),
           ("frequencies_hz", "frequencies, Hz"), ("message", "message")]
STYLE = """body { font: 14px sans-serif; margin: 2em; } table { border-collapse: collapse; margin: 1em 0; }
td, th { border: 1px solid #bbb; padding: 2px 8px; text-align: left; } td.number { text-align: right; }
th { position: sticky; top: 0; background: #eee; cursor: pointer; } details { max-width: 60em; }"""
# A click on a heading sorts by its column, numbers by their value.
SORTING = """for (const heading of document.querySelectorAll('#parts th')) heading.onclick = () => {
  const body = document.querySelector('#parts tbody'), k = heading.cellIndex;
  const key = row => row.cells[k].dataset.value ?? row.cells[k].textContent;
  const down = heading.dataset.down = heading.dataset.down === '1' ? '0' : '1';
  const order = (a, b) => isNaN(key(a) - key(b)) ? key(a).localeCompare(key(b)) : key(a) - key(b);
  [...body.rows].sort((a, b) => (down === '1' ? 1 : -1) * order(a, b)).forEach(row => body.append(row));
};"""


def text_of(key, value):
    """A cell's text; empty where there is no figure."""
    if value is None or value == "":
        return ""
    if key == "memory_bytes":
        return f"{value / 1e9:.2f}"
    if key == "frequencies_hz":
        return " ".join(f"{f:.5g}" for f in value)
    if isinstance(value, float):
        return f"{value:.1f}" if key.endswith("_s") else f"{value:.2g}"
    return str(value)


def cell(key, value, log):
    content = html.escape(text_of(key, value))
    if key == "message" and log:
        content = f"<details><summary>{content or 'log'}</summary><pre>{html.escape(chr(10).join(log))}</pre></details>"
    if isinstance(value, (int, float)):
        return f'<td class="number" data-value="{value!r}">{content}</td>'
    return f"<td>{content}</td>"


def row_of(row):
    cells = "".join(cell(key, row.get(key), row.get("log", [])) for key, _ in COLUMNS)
    return f'<tr style="background: {COLOURS[row["outcome"]]}">{cells}</tr>'


def page(kept, rows):
    """The whole page: conditions, the summary against the bars, and a row for each file."""
    conditions = (f"{kept['time_s']:g} s, {kept['processor_time_s']:g} s of processor time, {kept['memory_gb']:g} GB, "
                  f"{kept['threads']} threads, tolerance {kept['tolerance']:g}; {kept['machine']['processor']}")
    bars = "".join(f"<tr><td>{html.escape(words)}</td><td>{html.escape(figure)}</td><td>{html.escape(bar)}</td>"
                   f"<td>{'' if holds is None else 'met' if holds else 'missed'}</td></tr>"
                   for words, figure, bar, holds in outcomes.summary_of(rows))
    counted = ", ".join(f"{n} {name}" for name, n in outcomes.counts(rows).items() if n)
    heads = "".join(f"<th>{html.escape(words)}</th>" for _, words in COLUMNS)
    return "\n".join(["<!doctype html>", '<html lang="en"><meta charset="utf-8"><title>Parts from files</title>',
                      f"<style>{STYLE}</style>", f"<h1>{len(rows)} parts from files</h1>",
                      f"<p>{html.escape(conditions)}</p><p>{html.escape(counted)}</p>",
                      f"<table><tr><th></th><th>measured</th><th>bar</th><th></th></tr>{bars}</table>",
                      f'<table id="parts"><thead><tr>{heads}</tr></thead><tbody>', *map(row_of, rows),
                      f"</tbody></table><script>{SORTING}</script></html>", ""])


def write(path, kept, rows):
    """In one step."""
    partial = path.with_name(path.name + ".partial")
    partial.write_text(page(kept, rows), encoding="utf-8")
    os.replace(partial, path)
