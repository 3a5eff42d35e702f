//! Converts rows of values into columns of Polars, and back.

use model::UtcNs;
use model::results::{CellError, Column as SchemaColumn, ColumnType, Row, Value};
use polars::prelude::{
    BooleanChunked, Column, DataFrame, DataType, Float64Chunked, Int64Chunked, IntoSeries as _, NamedFrom as _,
    NewChunkedArray as _, PolarsResult, Series, StringChunked, TimeUnit, TimeZone, UInt32Chunked,
};

/// Times are written in whole microseconds, rounded down: DuckDB 2.0.0 can neither subtract nor compare times in nanoseconds with a zone.
/// No device has a clock that is better than that.
const NS_PER_US: i64 = 1_000;

/// The type of a column in memory and, through Polars, in the file.
pub(super) fn data_type(column_type: ColumnType) -> DataType {
    match column_type {
        ColumnType::Text => DataType::String,
        ColumnType::Float => DataType::Float64,
        ColumnType::Count => DataType::UInt32,
        ColumnType::Flag => DataType::Boolean,
        ColumnType::TimeUtc => DataType::Datetime(TimeUnit::Microseconds, Some(TimeZone::UTC)),
    }
}

/// The cells of one column, collected row by row.
enum Builder {
    Text(Vec<Option<String>>),
    Float(Vec<Option<f64>>),
    Count(Vec<Option<u32>>),
    Flag(Vec<Option<bool>>),
    TimeUtc(Vec<Option<i64>>),
}

impl Builder {
    fn with_capacity(column_type: ColumnType, rows: usize) -> Self {
        match column_type {
            ColumnType::Text => Self::Text(Vec::with_capacity(rows)),
            ColumnType::Float => Self::Float(Vec::with_capacity(rows)),
            ColumnType::Count => Self::Count(Vec::with_capacity(rows)),
            ColumnType::Flag => Self::Flag(Vec::with_capacity(rows)),
            ColumnType::TimeUtc => Self::TimeUtc(Vec::with_capacity(rows)),
        }
    }

    fn push(&mut self, value: Value, column: &SchemaColumn) -> Result<(), CellError> {
        match (self, value) {
            (Self::Text(cells), Value::Text(text)) => cells.push(Some(text)),
            (Self::Float(cells), Value::Float(number)) => cells.push(Some(number)),
            (Self::Count(cells), Value::Count(count)) => cells.push(Some(count)),
            (Self::Flag(cells), Value::Flag(flag)) => cells.push(Some(flag)),
            (Self::TimeUtc(cells), Value::TimeUtc(time)) => cells.push(Some(time.0.div_euclid(NS_PER_US))),
            (builder, Value::Null) if column.nullable => builder.push_null(),
            (_, got) => return Err(CellError::Type { expected: column.column_type, got }),
        }
        Ok(())
    }

    fn push_null(&mut self) {
        match self {
            Self::Text(cells) => cells.push(None),
            Self::Float(cells) => cells.push(None),
            Self::Count(cells) => cells.push(None),
            Self::Flag(cells) => cells.push(None),
            Self::TimeUtc(cells) => cells.push(None),
        }
    }

    fn finish(self, name: &str) -> Column {
        let series = match self {
            Self::Text(cells) => Series::new(name.into(), cells),
            Self::Float(cells) => Series::new(name.into(), cells),
            Self::Count(cells) => Series::new(name.into(), cells),
            Self::Flag(cells) => Series::new(name.into(), cells),
            Self::TimeUtc(cells) => Int64Chunked::from_slice_options(name.into(), &cells)
                .into_datetime(TimeUnit::Microseconds, Some(TimeZone::UTC))
                .into_series(),
        };
        series.into()
    }
}

/// The columns of these rows. Fails with the name of a column where a cell does not fit it.
pub(super) fn to_columns<R: Row>(rows: &[R]) -> Result<Vec<Column>, (&'static str, CellError)> {
    let mut builders: Vec<Builder> =
        R::COLUMNS.iter().map(|column| Builder::with_capacity(column.column_type, rows.len())).collect();
    for row in rows {
        for ((builder, column), value) in builders.iter_mut().zip(R::COLUMNS).zip(row.values()) {
            builder.push(value, column).map_err(|error| (column.name, error))?;
        }
    }
    Ok(builders.into_iter().zip(R::COLUMNS).map(|(builder, column)| builder.finish(column.name)).collect())
}

/// The cells of a column that was read from a file.
pub(super) enum Cells {
    Text(StringChunked),
    Float(Float64Chunked),
    Count(UInt32Chunked),
    Flag(BooleanChunked),
    TimeUtc(Int64Chunked),
}

impl Cells {
    /// The cells of the column of `frame` that the schema calls `column`. The caller has checked its type.
    pub(super) fn from_column(frame: &DataFrame, column: &SchemaColumn) -> PolarsResult<Self> {
        let series = frame.column(column.name)?.as_materialized_series();
        Ok(match column.column_type {
            ColumnType::Text => Self::Text(series.str()?.clone()),
            ColumnType::Float => Self::Float(series.f64()?.clone()),
            ColumnType::Count => Self::Count(series.u32()?.clone()),
            ColumnType::Flag => Self::Flag(series.bool()?.clone()),
            ColumnType::TimeUtc => Self::TimeUtc(series.to_physical_repr().i64()?.clone()),
        })
    }

    pub(super) fn get(&self, row: usize) -> Value {
        match self {
            Self::Text(cells) => cells.get(row).map(|text| Value::Text(text.to_owned())),
            Self::Float(cells) => cells.get(row).map(Value::Float),
            Self::Count(cells) => cells.get(row).map(Value::Count),
            Self::Flag(cells) => cells.get(row).map(Value::Flag),
            Self::TimeUtc(cells) => cells.get(row).map(|us| Value::TimeUtc(UtcNs(us.saturating_mul(NS_PER_US)))),
        }
        .unwrap_or(Value::Null)
    }
}
