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
    _check_size(path, file.metadata, source.largest)
    schema = file.schema_arrow
    said = (schema.metadata or {}).get(KEY)
    description = None if said is None else parsed_json(path, text_of(path, said))
    names = [field.name for field in schema if _is_number(arrow, field.type)]
    table = file.read(columns=names, use_threads=False)
    return description, {name: _as_numpy(path, table.column(name), name, description) for name in names}


def _check_size(path: Path, metadata: Any, largest: int) -> None:
    groups = [metadata.row_group(i) for i in range(metadata.num_row_groups)]
    numbers = sum(group.column(i).num_values for group in groups for i in range(group.num_columns))
    if 8 * max(numbers, metadata.num_rows) > largest:
        refuse(path, "", f"{numbers} numbers", f"at most {largest // 8}", "allow more by largest=")


def _is_number(arrow: Any, kind: Any) -> bool:
    kind = kind.value_type if arrow.types.is_fixed_size_list(kind) or arrow.types.is_list(kind) else kind
    return bool(arrow.types.is_floating(kind) or arrow.types.is_integer(kind))


def _as_arrow(arrow: Any, values: np.ndarray) -> Any:
    flat = arrow.array(np.ascontiguousarray(values).ravel())
    return flat if values.ndim == 1 else arrow.FixedSizeListArray.from_arrays(flat, int(np.prod(values.shape[1:])))


def _as_numpy(path: Path, column: Any, name: str, description: Any) -> np.ndarray:
    rows = len(column)
    if hasattr(column.type, "value_type"):
        column = column.combine_chunks().flatten()
    values = np.asarray(column.to_numpy(), np.float64)
    return values if values.shape == (rows,) and description is None else column_of(
        path, name, values.astype("<f8").tobytes(), rows, description
    )  # fmt: skip


def _packages() -> tuple[Any, Any]:
    try:
        return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    except ImportError:
        raise MissingExtra("pyarrow", "logs") from None
