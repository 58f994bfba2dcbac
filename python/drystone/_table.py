"""Parts of a result: :class:`Record`, an object, and :class:`Table`, a table stored by column."""

from __future__ import annotations

import html
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from . import _drystone

if TYPE_CHECKING:
    import numpy


class Record(dict[str, Any]):
    """An object in a result: a dict whose keys can also be read as attributes."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name}; there are {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]


class Table:
    """A table of a result, stored by column.

    Libraries that read Arrow's ``__arrow_c_stream__`` accept a table directly: ``pyarrow.table(t)``,
    ``polars.DataFrame(t)``.
    """

    def __init__(self, native: _drystone.Table, name: str) -> None:
        self._native = native
        self._name = name

    @property
    def columns(self) -> list[str]:
        """The names of the columns."""
        return self._native.names()

    def __len__(self) -> int:
        return len(self._native)

    def __getitem__(self, column: str) -> numpy.ndarray[Any, Any]:
        """Returns the column with this name as an array."""
        for name, (kind, values) in zip(self._native.names(), self._native.columns()):
            if name == column:
                return _array(kind, values)
        raise KeyError(f"there is no column {column}; there are {', '.join(self.columns)}")

    def __iter__(self) -> Iterator[str]:
        """Iterates over the names of the columns."""
        return iter(self.columns)

    def to_numpy(self) -> numpy.ndarray[Any, Any]:
        """Returns the table as a structured array with a field for each column."""
        import numpy

        columns = self._arrays()
        rows = numpy.empty(len(self), dtype=[(name, column.dtype) for name, column in columns.items()])
        for name, column in columns.items():
            rows[name] = column
        return rows

    def to_pandas(self) -> Any:
        """Returns the table as a pandas DataFrame."""
        import pandas

        return pandas.DataFrame(self._arrays())

    def _arrays(self) -> dict[str, numpy.ndarray[Any, Any]]:
        return {name: _array(*column) for name, column in zip(self._native.names(), self._native.columns())}

    def to_dicts(self) -> list[dict[str, Any]]:
        """Returns the table as a list with a dict for each row. The method needs no other package."""
        columns: list[Any] = []
        for kind, values in self._native.columns():
            if kind == "U":
                columns.append(values)
            else:
                columns.append(memoryview(values).cast(_CODES[kind]))
        names = self.columns
        return [dict(zip(names, row)) for row in zip(*columns)]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> numpy.ndarray[Any, Any]:
        rows = self.to_numpy()
        return rows if dtype is None else rows.astype(dtype)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self._native.__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        rows = len(self)
        return f"<{self._name}: {rows} {'row' if rows == 1 else 'rows'} of {', '.join(self.columns)}>"

    def _repr_html_(self) -> str:
        shown = self.to_dicts()[:50]
        head = "".join(f"<th>{html.escape(name)}</th>" for name in self.columns)
        body = "".join("<tr>" + "".join(f"<td>{_cell(value)}</td>" for value in row.values()) + "</tr>" for row in shown)
        more = f"<p>… {len(self)} rows in all</p>" if len(self) > len(shown) else ""
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


_CODES: dict[str, Any] = {"f8": "d", "i8": "q", "?": "?"}
"""For each numpy type of a column, the format code of ``memoryview``."""


def _array(kind: str, values: Any) -> numpy.ndarray[Any, Any]:
    """Converts the values of a column to an array. ``kind`` is the numpy type of the values, or "U" for text."""
    import numpy

    return numpy.array(values, dtype=str) if kind == "U" else numpy.frombuffer(values, dtype=kind)


def _cell(value: object) -> str:
    return f"{value:.5g}" if isinstance(value, float) else html.escape(str(value))
