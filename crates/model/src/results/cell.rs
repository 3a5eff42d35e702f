//! Values of cells, between Rust types and column types.

use std::str::FromStr;

use crate::container::{Kind, Method, Quantity, Shape};
use crate::frame_log::FrameReason;
use crate::fusion::Verdict;
use crate::results::level::Level;
use crate::time::UtcNs;

/// Type of a column in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnType {
    /// UTF-8 text.
    Text,
    /// 64-bit float.
    Float,
    /// Unsigned 32-bit integer.
    Count,
    /// True or false.
    Flag,
    /// Timestamp, nanoseconds, UTC.
    TimeUtc,
}

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Nothing.
    Null,
    /// Text.
    Text(String),
    /// Float.
    Float(f64),
    /// Count.
    Count(u32),
    /// Flag.
    Flag(bool),
    /// Time.
    TimeUtc(UtcNs),
}

/// A cell that does not fit its column.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CellError {
    /// Nothing where something must be, or another type.
    #[error("expected {expected:?}, got {got:?}")]
    Type {
        /// What the column holds.
        expected: ColumnType,
        /// What was read.
        got: Value,
    },
    /// A text that is none of the column's codes.
    #[error(transparent)]
    Code(#[from] crate::codes::UnknownCode),
    /// Fewer cells than columns.
    #[error("the row ends before this column")]
    Missing,
}

/// A type that can stand in a column.
pub trait Cell: Sized {
    /// Type of the column.
    const TYPE: ColumnType;
    /// Whether the cell may be empty.
    const NULLABLE: bool = false;

    /// To the file.
    fn to_value(&self) -> Value;

    /// From the file.
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
