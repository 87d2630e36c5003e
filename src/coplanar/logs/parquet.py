"""A run as a Parquet table: what pandas, Polars and DuckDB open.

One column of doubles for each of the run's, for a batch a column of lists of one length; the description stands under
the key "coplanar" in the metadata of the schema. Pages carry checksums.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import numpy as np

from coplanar.errors import InvalidInput, InvalidValue, MissingExtra
from coplanar.logs.description import bare_run, column_of, described, run_of
from coplanar.logs.files import Source, parsed_json, refuse
from coplanar.run import Run
from coplanar.run.files import text_of

KEY = b"coplanar"
_BATCH = 2**16  # rows read at a time
_LONGEST_TEXT = 2**24  # bytes of a text, and entries of a list, in the footer


def write(run: Run, path: Path) -> None:
    """Write the table.

    Raises:
        MissingExtra: If the extra ``logs`` is not installed.
    """
    arrow, parquet = _packages()
    columns = [_as_arrow(arrow, values) for values in run.columns.values()]
    schema = arrow.schema([(n, c.type) for n, c in zip(run.columns, columns, strict=True)], {KEY: described(run)})
    parquet.write_table(arrow.Table.from_arrays(columns, schema=schema), path, write_page_checksum=True)


def read(source: Source) -> Run:
    """The run of such a table, or of any table, of which the columns of numbers are taken.

    Raises:
        InvalidValue: Naming the file and the column that cannot be.
        MissingExtra: If the extra ``logs`` is not installed.
    """
    arrow, parquet = _packages()
    try:
        description, columns = _columns(source, arrow, parquet)
    except InvalidInput:
        raise
    except Exception as error:
        raise InvalidValue(str(source.path), f"{type(error).__name__}: {error}", "a whole Parquet file") from None
    if description is None:
        return bare_run(source, columns)
    return run_of(source.path, columns, description)


def _columns(source: Source, arrow: Any, parquet: Any) -> tuple[Any, dict[str, np.ndarray]]:
    """What is described, None where nothing is, and the columns of numbers."""
    path = source.path
    file = parquet.ParquetFile(
        arrow.BufferReader(source.data),
        page_checksum_verification=True,
        thrift_string_size_limit=_LONGEST_TEXT,
        thrift_container_size_limit=_LONGEST_TEXT,
    )
    schema = file.schema_arrow
    said = (schema.metadata or {}).get(KEY)
    description = None if said is None else parsed_json(path, text_of(path, said))
    widths = {field.name: _width(arrow, field.type) for field in schema}
    names = [name for name, width in widths.items() if width]
    table = _read(source, arrow, file, names, sum(widths.values()))
    return description, {name: _as_numpy(path, table.column(name), name, description) for name in names}


def _read(source: Source, arrow: Any, file: Any, names: list[str], width: int) -> Any:
    """The columns of these names, read in pieces, so that no file can ask for more than is allowed."""
    fitting = source.largest // (8 * max(width, 1))
    batches, rows = [], 0
    for batch in file.iter_batches(max(1, min(_BATCH, fitting)), columns=names, use_threads=False):
        rows += batch.num_rows
        if rows > fitting:
            needed = f"at most {fitting} rows in {source.largest} bytes"
            refuse(source.path, "", f"{rows} rows of {width} numbers, or more", needed, "allow more by largest=")
        batches.append(batch)
    return arrow.Table.from_batches(batches, None if batches else file.schema_arrow)


def _width(arrow: Any, kind: Any) -> int:
    """How many numbers an entry holds; 0 where it is none."""
    if arrow.types.is_fixed_size_list(kind):
        return int(kind.list_size) * _width(arrow, kind.value_type)
    return int(arrow.types.is_floating(kind) or arrow.types.is_integer(kind))


def _as_arrow(arrow: Any, values: np.ndarray) -> Any:
    flat = arrow.array(np.ascontiguousarray(values).ravel())
    return flat if values.ndim == 1 else arrow.FixedSizeListArray.from_arrays(flat, int(np.prod(values.shape[1:])))


def _as_numpy(path: Path, column: Any, name: str, description: Any) -> np.ndarray:
    rows = len(column)
    while hasattr(column.type, "value_type"):
        column = column.combine_chunks().flatten()
    values = np.asarray(column.to_numpy(), np.float64)
    if description is None and values.shape == (rows,):
        return values
    return column_of(path, name, values.astype("<f8").tobytes(), rows, description)


def _packages() -> tuple[Any, Any]:
    try:
        return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    except ImportError:
        raise MissingExtra("pyarrow", "logs") from None
