"""Runs mezha, and reads what it leaves: one file that needs Python 3.9 and numpy alone.

    import mezha

    result = mezha.run("cases/hertz", ranks=2, mesh__refine=4)     # --set mesh.refine=4
    seam = result.contact("seam")
    seam.s, seam.pressure, seam.gap                                 # arrays along the contact boundary
    fields = result.fields()
    fields.points + 10 * fields.displacement                        # the bodies, deformed
    result.summary["energy"]["total"]                               # everything else

Copy this file to where your script is, or set PYTHONPATH to its folder. Lengths, stresses and forces have the units of the
case; forces are per thickness unless the case gives one. Signs are those of the program: pressure > 0 presses, gap > 0 is open,
and normals point from body 1 to body 2.
"""

from __future__ import annotations

import base64
import csv
import json
import os
import shutil
import subprocess
import warnings
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

__all__ = ["Contact", "Fields", "Forces", "MezhaError", "MezhaWarning", "NotConverged", "Result", "Step", "Study", "run", "study"]

PathLike = Union[str, "os.PathLike[str]"]


class MezhaError(RuntimeError):
    """mezha has ended without a usable result. The words are the program's own.

    Attributes:
        code: the exit code: 1 for a failure of PETSc, MPI or the disk, 2 for bad input, 3 for a run that has not converged;
            negative for a signal.
        command: the command, as a list of words.
    """

    def __init__(self, words: str, code: int, command: Sequence[str]):
        super().__init__(words)
        self.code = code
        self.command = list(command)


class NotConverged(MezhaError):
    """A run has not converged (exit code 3), is not resolved by its mesh, or misses an expected value that must hold.

    Attributes:
        result: what it has left all the same; `result.reason` says why it must not be used.
    """

    def __init__(self, words: str, code: int, command: Sequence[str], result: "Result"):
        super().__init__(words, code, command)
        self.result = result


class MezhaWarning(UserWarning):
    """What the program warns of: pressures that are not to be trusted, say. The words are its own."""


@dataclass(frozen=True)
class Contact:
    """One contact, along the contact boundary: arrays with one value for each point, in the order of the arc length.

    Where the pressure jumps, two points have one place.
    """

    name: str
    #: arc length
    s: np.ndarray
    #: undeformed place
    x: np.ndarray
    y: np.ndarray
    #: unit normal, from body 1 to body 2
    nx: np.ndarray
    ny: np.ndarray
    #: contact pressure λ, positive in compression
    pressure: np.ndarray
    #: gap of the deformed bodies, positive where it is open
    gap: np.ndarray
    #: normal displacement of body 1 and of body 2
    un_1: np.ndarray
    un_2: np.ndarray
    #: normal stress of body 1 and of body 2, tension positive
    sigma_1: np.ndarray
    sigma_2: np.ndarray

    def integral(self, values: np.ndarray) -> float:
        """The integral of values at the points over the arc length, by the trapezoidal rule."""
        return float(np.sum(np.diff(self.s) * (values[1:] + values[:-1]) / 2))


@dataclass(frozen=True)
class Forces:
    """All contacts, one row each, in the order of the case; NaN where something is not known or does not apply."""

    #: names of the contacts, and of the two boundaries of each
    name: list
    between: list
    #: force ∫λ ds, (n,)
    force: np.ndarray
    #: unit vector along the force on body 2, (n, 2)
    direction: np.ndarray
    #: where it acts; where nothing presses, the point with the smallest gap, (n, 2)
    place: np.ndarray
    #: length of what presses, (n,)
    width: np.ndarray
    #: largest pressure, (n,)
    pressure_max: np.ndarray
    #: True, False, or None where nothing tells
    trust: list
    #: the verdict in words: `trusted`, why not, or that it only touches
    verdict: list


@dataclass(frozen=True)
class Fields:
    """The solution in the bodies, at the nodes of the refined mesh. Nodes on the border of two ranks, bodies or parts stand twice."""

    #: undeformed nodes, (n, 2)
    points: np.ndarray
    #: displacement, (n, 2)
    displacement: np.ndarray
    #: stress xx, yy, xy, zz, (n, 4)
    stress: np.ndarray
    #: von Mises stress, (n,)
    von_mises: np.ndarray
    #: nodes of each triangle, (m, 3), or (m, 6) of order 2: corners, then the midsides of edges 01, 12, 20
    triangles: np.ndarray
    #: number of the body, of the part and of the rank of each triangle, (m,)
    body: np.ndarray
    part: np.ndarray
    rank: np.ndarray

    @property
    def corners(self) -> np.ndarray:
        """The three corners of each triangle, (m, 3), as `matplotlib.tri.Triangulation` takes them."""
        return self.triangles[:, :3]


class _Files:
    """The files of one solution, and its row of the summary."""

    folder: Path
    summary: dict

    @property
    def status(self) -> str:
        """`converged`, `unresolved`, `not_converged` or `interrupted`."""
        return self.summary["status"]

    @property
    def reason(self) -> str:
        """The verdict in words."""
        return self.summary["reason"]

    @property
    def converged(self) -> bool:
        """Whether the equations of contact are solved, on a mesh that holds what the case says. How good the mesh is for that is another question: see `trusted`."""
        return self.status == "converged"

    @property
    def trusted(self) -> bool:
        """Whether the run has converged, and the pressure of every contact is to be trusted.

        It is false, too, where nothing tells: where `trust` of a contact is null. Forces may be good all the same: see
        `trust_force` in `summary["contact"]`. A run of load steps is trusted if all of them are.
        """
        rows = [self.summary, *(self.summary.get("steps") or [])]
        return self.converged and all(contact["trust"] is True for row in rows for contact in row["contact"].values())

    def _interrupted(self) -> str:
        """Why files may be missing that other results have; empty if the run has come to its end."""
        return f": the run was interrupted: {self.reason}" if self.status == "interrupted" else ""

    def contact(self, name: str) -> Contact:
        """The contact of this name, from `contact_NAME.csv`."""
        file = self.folder / f"contact_{name}.csv"
        if not file.is_file():
            found = sorted(other.stem[len("contact_") :] for other in self.folder.glob("contact_*.csv"))
            raise KeyError(f"{self.folder} has no contact {name!r}; it has {', '.join(found) or 'none'}{self._interrupted()}")
        with open(file, encoding="utf-8") as lines:
            rows = [line for line in lines if not line.startswith("#")]
        columns = dict(zip(rows[0].strip().split(","), np.loadtxt(rows[1:], delimiter=",", ndmin=2).T))
        columns["pressure"] = columns.pop("lambda")
        return Contact(name=name, **columns)

    def forces(self) -> Forces:
        """All contacts, from `contacts.csv`."""
        file = self.folder / "contacts.csv"
        if not file.is_file():
            raise FileNotFoundError(f"{self.folder} has no contacts.csv{self._interrupted()}")
        with open(file, encoding="utf-8", newline="") as lines:
            rows = list(csv.DictReader(lines))
        number = lambda *names: np.array([[float(row[name] or "nan") for name in names] for row in rows]).reshape(-1, len(names))
        return Forces(
            name=[row["name"] for row in rows],
            between=[(row["boundary_1"], row["boundary_2"]) for row in rows],
            force=number("force")[:, 0],
            direction=number("direction_x", "direction_y"),
            place=number("x", "y"),
            width=number("width")[:, 0],
            pressure_max=number("pressure_max")[:, 0],
            trust=[{"true": True, "false": False}.get(row["trust"]) for row in rows],
            verdict=[row["verdict"] for row in rows],
        )

    def fields(self) -> Fields:
        """Displacement and stress of the bodies, from `fields.vtu`, or from the pieces of `fields.pvtu`."""
        whole, parallel = self.folder / "fields.vtu", self.folder / "fields.pvtu"
        if parallel.is_file():
            pieces = [self.folder / piece.attrib["Source"] for piece in xml.parse(parallel).iter("Piece")]
        elif whole.is_file():
            pieces = [whole]
        else:
            why = self._interrupted() or "; was it run with output.fields = false?"
            raise FileNotFoundError(f"{self.folder} has no fields{why}")
        read = [_read_piece(piece) for piece in pieces]
        starts = np.cumsum([0] + [len(piece["points"]) for piece in read])
        for piece, start in zip(read, starts):
            piece["triangles"] = piece["triangles"] + start
        # A rank without a triangle has an empty piece, whose triangles have no number of nodes.
        some = [piece for piece in read if len(piece["triangles"])] or read[:1]
        return Fields(**{name: np.concatenate([piece[name] for piece in some]) for name in read[0]})


class Step(_Files):
    """One load step of a result.

    Attributes:
        number: from 1.
        factors: of each table `[steps.NAME]`, its factor in this step.
        summary: the row of `steps` in `summary.json`.
    """

    def __init__(self, folder: Path, summary: dict):
        self.folder = folder
        self.summary = summary
        self.number = int(summary["step"])
        self.factors: Mapping[str, float] = summary["factors"]

    def __repr__(self) -> str:
        return f"<step {self.number}: {self.status}>"


class Result(_Files):
    """The result of a run, from its folder.

    Attributes:
        folder: where it lies.
        summary: `summary.json` as it is.
    """

    def __init__(self, folder: PathLike):
        """Opens the result in a folder; it must hold a `summary.json`."""
        self.folder = Path(folder)
        file = self.folder / "summary.json"
        if not file.is_file():
            raise FileNotFoundError(f"{self.folder} holds no result of mezha: there is no summary.json")
        self.summary: dict = json.loads(file.read_text(encoding="utf-8"))

    def __repr__(self) -> str:
        return f"<result of {self.summary['case']} in {self.folder}: {self.status}>"

    @property
    def provenance(self) -> Optional[dict]:
        """What made the result: commit, versions, command, hashes, host, date."""
        return self.summary.get("provenance")

    @property
    def contacts(self) -> list:
        """Names of the contacts."""
        return sorted(self.summary["contact"])

    @property
    def history(self) -> dict:
        """One array for each column of `outer` in the summary, with one value for each outer iteration, NaN where there is none."""
        rows = self.summary["outer"]
        number = lambda value: np.nan if value is None else value
        return {name: np.array([number(row[name]) for row in rows], dtype=float) for name in (rows[0] if rows else ())}

    @property
    def steps(self) -> list:
        """The load steps, each a `Step`; an empty list if the case has none."""
        rows = self.summary.get("steps") or []
        folder = lambda row: self.folder if row is rows[-1] else self.folder / "steps" / f"{row['step']:04}"
        return [Step(folder(row), row) for row in rows]


class Study:
    """A grid of runs, from the folder that `mezha study` has written.

    Attributes:
        folder: where it lies.
        table: `study.json` as it is.
        rows: one dictionary for each run.
    """

    def __init__(self, folder: PathLike):
        """Opens the study in a folder; it must hold a `study.json`."""
        self.folder = Path(folder)
        file = self.folder / "study.json"
        if not file.is_file():
            raise FileNotFoundError(f"{self.folder} holds no study of mezha: there is no study.json")
        self.table: dict = json.loads(file.read_text(encoding="utf-8"))
        self.rows: list = self.table["rows"]

    def column(self, name: str) -> np.ndarray:
        """The numbers of a column, one for each run, such as `errors.energy`; NaN where there is none."""
        if not any(name in row for row in self.rows):
            raise KeyError(f"the study has no column {name!r}; it has {', '.join(self.rows[0]) if self.rows else 'no rows'}")
        number = lambda value: value if isinstance(value, (int, float)) else np.nan
        return np.array([number(row.get(name)) for row in self.rows], dtype=float)

    def result(self, index: int) -> Result:
        """The result of the run in this row, from 0.

        Raises:
            MezhaError: the run of this row has left none; the words are the reason of the row.
        """
        row = self.rows[index]
        if not row["result"]:
            code = 2 if row["status"] == "refused" else 1
            raise MezhaError(f"row {index} of {self.folder} has no result ({row['status']}): {row['reason']}", code, [])
        return Result(self.folder / row["result"])


def run(
    case: PathLike,
    ranks: int = 2,
    *,
    out: Optional[PathLike] = None,
    force: bool = False,
    petsc: Sequence[str] = (),
    program: Optional[PathLike] = None,
    verbose: bool = False,
    **sets: Any,
) -> Result:
    """Solves a case and opens its result.

    Args:
        case: the case file, or its folder if it is called case.toml. A result folder is one, too: it repeats its run.
        ranks: processes under mpirun, at least 1; 1 is run without it.
        out: folder of the result; by default out/NAME in the working directory, as on the command line.
        force: replace a result that is there.
        petsc: options for PETSc, one word each, as in `["-ksp_type", "gcr"]`.
        program: the program `mezha`; by default the environment's MEZHA, or that of a clone beside this file, or that of PATH.
        verbose: let the program print; otherwise only its errors are kept, for the exception.
        sets: keys of the case and what they are to be: `mesh__refine=3` or `**{"mesh.refine": 3}`; two underscores stand
            for a dot. Numbers, texts, truth values, lists and arrays are written as TOML; texts that are formulas or names are texts.

    Raises:
        NotConverged: the run has not converged, or is not resolved; the exception has its result.
        MezhaError: it has no result; the words are the program's.
        FileNotFoundError: there is no such program, or no mpirun.

    Warns:
        MezhaWarning: each warning of the program, such as that of pressures that are not to be trusted.
    """
    if isinstance(ranks, bool) or not isinstance(ranks, (int, np.integer)) or ranks < 1:
        raise ValueError(f"ranks = {ranks!r}: must be a whole number of at least 1, the number of processes")
    case = Path(case)
    out = Path(out) if out is not None else Path("out") / _name(case)
    words = ["run", str(case), "--out", str(out)]
    words += [] if verbose else ["--quiet"]
    words += ["--force"] if force else []
    for key, value in sets.items():
        words += ["--set", f"{key if '.' in key else key.replace('__', '.')}={_toml(value)}"]
    if petsc:
        words += ["--", *petsc]
    command = [_program(program), *words]
    if ranks != 1:
        command = ["mpirun", "-n", str(ranks), "--bind-to", "none", *_sharing(ranks), *command]
    ended = _finish(command, verbose)
    if ended.returncode == 3:
        result = Result(out)
        raise NotConverged(result.reason, 3, command, result)
    if ended.returncode != 0:
        raise MezhaError(_own_words(ended), ended.returncode, command)
    return Result(out)


def study(
    file: PathLike,
    out: PathLike,
    *,
    force: bool = False,
    program: Optional[PathLike] = None,
    verbose: bool = False,
) -> Study:
    """Makes the runs of a study that are not made yet, and opens it.

    Args:
        file: the study file, or its folder if it is called study.toml.
        out: folder of the study; runs that are there already are kept.
        force: forget them, and make all anew.
        program, verbose: as of `run`.

    Raises:
        MezhaError: the study cannot be made, or no run of it has a result; the words are the program's.
    """
    command = [_program(program), "study", str(file), "--out", str(out)] + (["--force"] if force else [])
    ended = _finish(command, verbose)
    if ended.returncode != 0:
        raise MezhaError(_own_words(ended), ended.returncode, command)
    return Study(out)


_WARNING = "mezha: warning: "


def _finish(command: Sequence[str], verbose: bool) -> "subprocess.CompletedProcess[str]":
    """Runs a command of the caller's caller to its end, and hands on what the program warns of."""
    output = None if verbose else subprocess.PIPE
    ended = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, text=True, errors="replace")
    for line in ended.stderr.splitlines():
        if line.startswith(_WARNING):
            warnings.warn(line[len(_WARNING) :], MezhaWarning, stacklevel=3)
    return ended


def _own_words(ended: "subprocess.CompletedProcess[str]") -> str:
    """What the program has said of an error: its own words, if there are any among those of mpirun."""
    lines = [line for line in ended.stderr.splitlines() if not line.startswith(_WARNING)]
    said = "\n".join(lines).strip() or (ended.stdout or "").strip()
    begin = said.find("mezha: ")
    if begin < 0:
        return said or f"exit code {ended.returncode}, without a word"
    # mpirun's words stand behind a ruler of dashes.
    return said[begin + len("mezha: ") :].split("\n-----", 1)[0].strip()


def _program(given: Optional[PathLike]) -> str:
    """The program: the one that is given, that of the environment, of a clone around this file, or of PATH."""
    named = str(given) if given is not None else os.environ.get("MEZHA")
    if named:
        # mpirun would tell this in words of its own.
        if shutil.which(named) is None:
            raise FileNotFoundError(f"{named} is no program that can be run; give `program`, or MEZHA, the path of mezha")
        return named
    beside = Path(__file__).resolve().parent.parent / "target" / "release" / "mezha"
    found = str(beside) if beside.is_file() else shutil.which("mezha")
    if found is None:
        raise FileNotFoundError("there is no program mezha: set MEZHA to its path, or give `program`")
    return found


def _sharing(ranks: int) -> list:
    """Words for mpirun where ranks share cores."""
    return ["--oversubscribe"] if ranks > (os.cpu_count() or 1) else []


def _name(case: Path) -> str:
    """The name of a case: that of its folder if the file is called case.toml, else that of the file."""
    if case.is_dir() or case.name == "case.toml":
        return (case if case.is_dir() else case.parent).resolve().name
    return case.stem


def _toml(value: Any) -> str:
    """A value as TOML has it."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(key)} = {_toml(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise TypeError(f"{value!r} cannot be written as TOML: give a number, a text, a truth value, a list or a dictionary")


_TYPES = {"Float64": "<f8", "Int32": "<i4", "UInt8": "u1", "Int64": "<i8"}


def _read_piece(file: Path) -> dict:
    """The arrays of a .vtu file of mezha's: base64 in place, behind the size of the array in eight bytes."""
    piece = next(xml.parse(file).iter("Piece"))

    def array(path: str, name: str) -> np.ndarray:
        element = next(found for found in piece.find(path) if found.attrib["Name"] == name)
        values = np.frombuffer(base64.b64decode((element.text or "").strip())[8:], dtype=_TYPES[element.attrib["type"]])
        components = int(element.attrib.get("NumberOfComponents", 1))
        return values.reshape(-1, components) if components > 1 else values

    offsets = array("Cells", "offsets")
    nodes = int(offsets[0]) if len(offsets) else 3
    return {
        "points": array("Points", "Points")[:, :2],
        "displacement": array("PointData", "displacement")[:, :2],
        "stress": array("PointData", "stress"),
        "von_mises": array("PointData", "von_mises"),
        "triangles": array("Cells", "connectivity").reshape(-1, nodes),
        "body": array("CellData", "body"),
        "part": array("CellData", "part"),
        "rank": array("CellData", "rank"),
    }
