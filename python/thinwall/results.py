"""The files in the result folder of a run of the program, as arrays."""

from __future__ import annotations

import base64
import contextlib
import csv
import json
import math
import os
import pathlib
import xml.etree.ElementTree as ElementTree
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._core import DataError, Response, read_response

Table = dict[str, np.ndarray]
WORDS = {"bifurcation", "kind", "motion", "reason", "status", "structure"}
"""Columns that contain words, even if all of their cells are empty."""


@contextlib.contextmanager
def _reading(path: str | os.PathLike[str]) -> Iterator[None]:
    """Turns every error that occurs while a file is read into a DataError that names the file."""
    try:
        yield
    except DataError:
        raise
    except OSError as error:
        raise DataError(f"{path}: {error.strerror or error}") from None
    except (csv.Error, ElementTree.ParseError, zlib.error, ArithmeticError, LookupError, TypeError, ValueError) as error:
        raise DataError(f"{path}: {error}; was it written by thinwall?") from error


def read_table(path: str | os.PathLike[str]) -> Table:
    """The columns of a CSV table of the program by their names: numbers, or text if a value is no number and in the
    columns of words (`bifurcation`, `status` …). Raises DataError for a file that is no such table."""
    with _reading(path), open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    if not rows:
        raise DataError(f"{path}: a table begins with a line of column names")
    for number, row in enumerate(rows[1:], start=1):
        if len(row) != len(rows[0]):
            raise DataError(f"{path}: row {number} has {len(row)} values, not {len(rows[0])}")
    return {name: _column(name, [row[i] for row in rows[1:]]) for i, name in enumerate(rows[0])}


def _column(name: str, texts: list[str]) -> np.ndarray:
    if name in WORDS:
        return np.array(texts, dtype=str)
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def _values(array: ElementTree.Element, appended: str) -> np.ndarray:
    """The numbers of a DataArray in the file's appended, compressed section. It consists of two pieces of base64: the
    number of blocks, their size, that of the last one and the compressed size of each; then the blocks."""
    kind = np.dtype(array.attrib["type"].lower())
    start = int(array.attrib["offset"])

    def decoded(begin: int, count: int) -> bytes:
        return base64.b64decode(appended[begin : begin + -(-count // 3) * 4])[:count]

    blocks = int(np.frombuffer(decoded(start, 8), "<u8")[0])
    heading_bytes = 8 * (3 + blocks)
    sizes = np.frombuffer(decoded(start, heading_bytes), "<u8")[3:]
    data = decoded(start + -(-heading_bytes // 3) * 4, int(sizes.sum()))
    ends = np.cumsum(sizes, dtype=int)
    raw = b"".join(zlib.decompress(data[end - int(size) : end]) for end, size in zip(ends, sizes))
    values = np.frombuffer(raw, kind.newbyteorder("<"))
    return values.reshape(-1, int(array.attrib.get("NumberOfComponents", "1"))).squeeze() if values.size else values


def read_vtu(path: str | os.PathLike[str]) -> dict[str, np.ndarray]:
    """All arrays of a VTU or VTP file of the program by their names: ``Points``, ``connectivity``, ``displacement`` …
    Raises DataError for a file of another kind."""
    with _reading(path):
        root = ElementTree.parse(path).getroot()
        section = root.find("AppendedData")
        compressor = root.attrib.get("compressor", "")
        if section is None or section.attrib.get("encoding") != "base64" or compressor != "vtkZLibDataCompressor":
            raise DataError(f"{path}: only the program's own VTU files are read (appended, base64, zlib)")
        appended = (section.text or "").strip().removeprefix("_")
        return {array.attrib["Name"]: _values(array, appended) for array in root.iter("DataArray")}


@dataclass(frozen=True)
class Shape:
    """A mode shape at the nodes of a mesh."""

    frequency_hz: float
    damping_ratio: float
    points: np.ndarray
    """Positions of the nodes, (n, 3) in m."""
    displacement: np.ndarray
    """Displacements of the nodes, (n, 3), with the largest entry 1; of the assembly the robot's end may have it."""
    modal_mass_kg: float = math.nan
    """The modal mass of the shape in this scale: displacement / sqrt(modal_mass_kg) is mass-normalised. NaN of the
    assembly, where it is not known."""


class _Files(Mapping[str, Any]):
    """A mapping from names of files without ending to their contents; each file is read once, at the first access."""

    def __init__(self, paths: list[pathlib.Path], read: Callable[[pathlib.Path], Any]) -> None:
        self._paths = {path.stem: path for path in sorted(paths)}
        self._read = read
        self._known: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._known:
            self._known[name] = self._read(self._paths[name])
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)

    def __repr__(self) -> str:
        return f"<{', '.join(self._paths) or 'no files'}>"


class Results:
    """A result folder. ``summary`` and ``manifest`` are dicts; the others map names to files, read at the first access.

    ``frf["part"]``, ``frf["robot"]``, ``frf["coupled_receptance"]``: Response. ``lobes["part"]``,
    ``lobes["supported_crossings"]``, ``modes["modes"]``, ``robot["postures"]``, ``simulation["points"]``: tables, a dict
    of columns. ``simulated`` has those that ``thinwall simulate`` left beside the run's.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = pathlib.Path(folder)
        self.summary: dict[str, Any] = self._json("summary.json")
        self.manifest: dict[str, Any] = self._json("manifest.json")
        responses = self.folder.glob("frf/*.csv")
        self.frf: Mapping[str, Response] = _Files([p for p in responses if not p.stem.endswith("_error")], read_response)
        self.lobes: Mapping[str, Table] = _Files(list(self.folder.glob("lobes/*.csv")), read_table)
        self.modes: Mapping[str, Table] = _Files(list(self.folder.glob("modes/*.csv")), read_table)
        self.robot: Mapping[str, Table] = _Files(list(self.folder.glob("robot/*.csv")), read_table)
        self.simulation: Mapping[str, Table] = _Files(list(self.folder.glob("simulation/*.csv")), read_table)
        self.simulated: Mapping[str, Table] = _Files(list(self.folder.glob("simulated/*.csv")), read_table)

    def shapes(self, name: str = "part") -> list[Shape]:
        """The mode shapes of "part", or of "coupled", in the order of their modes; the largest entry of each is 1."""
        return [_shape(path) for path in sorted(self.folder.glob(f"modes/{name}_mode_*.vtu"))]

    def _json(self, name: str) -> dict[str, Any]:
        path = self.folder / name
        if not path.is_file():
            raise DataError(f"{self.folder} is no result folder: it has no {name}")
        with _reading(path):
            found = json.loads(path.read_text(encoding="utf-8"))
            if not isinstance(found, dict):
                raise DataError(f"{path}: holds no table of names and values")
            return found

    def __repr__(self) -> str:
        return f"<Results of {self.summary.get('case', '?')} in {self.folder}>"


def _shape(path: pathlib.Path) -> Shape:
    arrays = read_vtu(path)
    with _reading(path):
        ratio, mass = (float(arrays.get(name, math.nan)) for name in ("damping_ratio", "modal_mass_kg"))
        return Shape(float(arrays["frequency_hz"]), ratio, arrays["Points"], arrays["displacement"], mass)


def read_results(folder: str | os.PathLike[str]) -> Results:
    """Reads the folder of a run, ``results/<case>``. Raises DataError for another folder."""
    return Results(folder)
