//! The values of cells, and their conversion between Rust types and column types.

use std::str::FromStr;

use crate::container::{Kind, Method, Quantity, Shape};
use crate::frame_log::FrameReason;
use crate::fusion::Verdict;
use crate::results::level::Level;
use crate::time::UtcNs;

/// The type of a column in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnType {
    /// A UTF-8 text.
    Text,
    /// A 64-bit float.
    Float,
    /// An unsigned 32-bit integer.
    Count,
    /// Either true or false.
    Flag,
    /// A timestamp in nanoseconds, UTC.
    TimeUtc,
}

/// The value of one cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// An empty cell.
    Null,
    /// A text.
    Text(String),
    /// A float.
    Float(f64),
    /// A count.
    Count(u32),
    /// A flag.
    Flag(bool),
    /// A time.
    TimeUtc(UtcNs),
}

/// The reason why a cell does not fit its column.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CellError {
    /// The cell is empty where it must not be, or has another type.
    #[error("expected {expected:?}, got {got:?}")]
    Type {
        /// The type of the column.
        expected: ColumnType,
        /// The value that was read.
        got: Value,
    },
    /// The text is none of the column's codes.
    #[error(transparent)]
    Code(#[from] crate::codes::UnknownCode),
    /// The row has fewer cells than there are columns.
    #[error("the row ends before this column")]
    Missing,
}

/// A type that can stand in a column.
pub trait Cell: Sized {
    /// The type of the column.
    const TYPE: ColumnType;
    /// Whether the cell may be empty.
    const NULLABLE: bool = false;

    /// The value of the cell in the file.
    fn to_value(&self) -> Value;

    /// The Rust value of a cell that was read from the file.
    ///
    /// # Errors
    /// [`CellError`] when the value is of another type, or not a known code.
    fn from_value(value: Value) -> Result<Self, CellError>;
}

macro_rules! plain_cell {
    ($($rust:ty => $variant:ident),+) => {
        $(impl Cell for $rust {
            const TYPE: ColumnType = ColumnType::$variant;

            fn to_value(&self) -> Value {
                Value::$variant(self.clone())
            }

            fn from_value(value: Value) -> Result<Self, CellError> {
                match value {
                    Value::$variant(inner) => Ok(inner),
                    got => Err(CellError::Type { expected: Self::TYPE, got }),
                }
            }
        })+
    };
}

plain_cell!(String => Text, f64 => Float, u32 => Count, bool => Flag, UtcNs => TimeUtc);

macro_rules! coded_cell {
    ($($rust:ty),+) => {
        $(impl Cell for $rust {
            const TYPE: ColumnType = ColumnType::Text;

            fn to_value(&self) -> Value {
                Value::Text(self.code().to_owned())
            }

            fn from_value(value: Value) -> Result<Self, CellError> {
                Ok(Self::from_str(&String::from_value(value)?)?)
            }
        })+
    };
}

coded_cell!(Kind, Shape, Quantity, Method, Level, FrameReason, Verdict);

impl<T: Cell> Cell for Option<T> {
    const TYPE: ColumnType = T::TYPE;
    const NULLABLE: bool = true;

    fn to_value(&self) -> Value {
        self.as_ref().map_or(Value::Null, Cell::to_value)
    }

    fn from_value(value: Value) -> Result<Self, CellError> {
        match value {
            Value::Null => Ok(None),
            value => T::from_value(value).map(Some),
        }
    }
}
