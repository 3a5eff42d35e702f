//! Numbers in bytes.

use crate::profile::{Endian, Scalar};

/// Appends `count` numbers, the first at `offset`, each `step` bytes after the one before; stops where the bytes end.
pub(super) fn read_column(
    bytes: &[u8],
    (scalar, endian): (Scalar, Endian),
    (offset, step, count): (usize, usize, usize),
    out: &mut Vec<f64>,
) {
    macro_rules! column {
        ($type:ty, $wide:expr) => {
            match endian {
                Endian::Little => each(bytes, offset, step, count, out, |b| $wide(<$type>::from_le_bytes(b))),
                Endian::Big => each(bytes, offset, step, count, out, |b| $wide(<$type>::from_be_bytes(b))),
            }
        };
    }
    match scalar {
        Scalar::I8 => column!(i8, f64::from),
        Scalar::U8 => column!(u8, f64::from),
        Scalar::I16 => column!(i16, f64::from),
        Scalar::U16 => column!(u16, f64::from),
        Scalar::I32 => column!(i32, f64::from),
        Scalar::U32 => column!(u32, f64::from),
        Scalar::I64 => column!(i64, nearest),
        Scalar::U64 => column!(u64, nearest_unsigned),
        Scalar::F32 => column!(f32, f64::from),
        Scalar::F64 => column!(f64, f64::from),
    }
}

/// The number at `offset`; NaN beyond the end.
pub(super) fn read_one(bytes: &[u8], layout: (Scalar, Endian), offset: usize) -> f64 {
    let mut one = Vec::with_capacity(1);
    read_column(bytes, layout, (offset, layout.0.bytes(), 1), &mut one);
    one.first().copied().unwrap_or(f64::NAN)
}

/// The floating-point number at `offset`; NaN beyond the end, and for whole numbers.
pub(super) fn read_float(bytes: &[u8], (scalar, endian): (Scalar, Endian), offset: usize) -> f64 {
    let rest = bytes.get(offset..).unwrap_or_default();
    let value = match (scalar, endian) {
        (Scalar::F32, Endian::Little) => rest.first_chunk().map(|b| f64::from(f32::from_le_bytes(*b))),
        (Scalar::F32, Endian::Big) => rest.first_chunk().map(|b| f64::from(f32::from_be_bytes(*b))),
        (Scalar::F64, Endian::Little) => rest.first_chunk().map(|b| f64::from_le_bytes(*b)),
        (Scalar::F64, Endian::Big) => rest.first_chunk().map(|b| f64::from_be_bytes(*b)),
        _ => None,
    };
    value.unwrap_or(f64::NAN)
}

/// The whole number at `offset`, exactly. None beyond the end, beyond i64, and for floating-point types.
pub(super) fn read_whole(bytes: &[u8], (scalar, endian): (Scalar, Endian), offset: usize) -> Option<i64> {
    let field = bytes.get(offset..)?.get(..scalar.bytes())?;
    let mut wide = [0; 8];
    let used = wide.get_mut(..field.len())?;
    used.copy_from_slice(field);
    if endian == Endian::Big {
        used.reverse();
    }
    let unsigned = u64::from_le_bytes(wide);
    let unused_bits = 64 - 8 * u32::try_from(field.len()).ok()?;
    match scalar {
        Scalar::F32 | Scalar::F64 => None,
        Scalar::U8 | Scalar::U16 | Scalar::U32 | Scalar::U64 => i64::try_from(unsigned).ok(),
        Scalar::I8 | Scalar::I16 | Scalar::I32 | Scalar::I64 => {
            Some((unsigned << unused_bits).cast_signed() >> unused_bits)
        }
    }
}

fn each<const N: usize>(
    bytes: &[u8],
    offset: usize,
    step: usize,
    count: usize,
    out: &mut Vec<f64>,
    value: impl Fn([u8; N]) -> f64,
) {
    let rest = bytes.get(offset..).unwrap_or_default();
    if step == N {
        // The common case, apart from the others so that it is vectorised.
        out.extend(rest.as_chunks::<N>().0.iter().take(count).map(|chunk| value(*chunk)));
        return;
    }
    let at = |i: usize| rest.get(i * step..).and_then(<[u8]>::first_chunk);
    out.extend((0..count).map_while(at).map(|chunk| value(*chunk)));
}

#[expect(clippy::cast_precision_loss, reason = "no sensor counts beyond 2^53; stamps are read by read_whole")]
fn nearest(value: i64) -> f64 {
    value as f64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn nearest_unsigned(value: u64) -> f64 {
    value as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_of_all_widths() {
        let bytes = [0xff, 0xfe, 0x01, 0x00, 0x00, 0x00, 0x00, 0x80];
        let whole = |scalar, endian| read_whole(&bytes, (scalar, endian), 0);
        assert_eq!(whole(Scalar::I8, Endian::Little), Some(-1));
        assert_eq!(whole(Scalar::U8, Endian::Little), Some(255));
        assert_eq!(whole(Scalar::I16, Endian::Little), Some(-257));
        assert_eq!(whole(Scalar::U16, Endian::Big), Some(0xfffe));
        assert_eq!(whole(Scalar::I64, Endian::Little), Some(i64::MIN + 0x01_feff));
        assert_eq!(whole(Scalar::U64, Endian::Little), None);
        assert_eq!(whole(Scalar::F32, Endian::Little), None);
        assert_eq!(read_whole(&bytes, (Scalar::U32, Endian::Little), 5), None);
    }

    #[test]
    fn columns_stop_where_the_bytes_end() {
        let bytes = [1, 0, 2, 0, 3];
        let column = |offset, step, count| {
            let mut out = Vec::new();
            read_column(&bytes, (Scalar::I16, Endian::Little), (offset, step, count), &mut out);
            out
        };
        assert_eq!(column(0, 2, 9), [1.0, 2.0]);
        assert_eq!(column(0, 4, 9), [1.0]);
        assert_eq!(column(9, 2, 9), [] as [f64; 0]);
        assert!(read_one(&bytes, (Scalar::F64, Endian::Big), 0).is_nan());
    }
}
