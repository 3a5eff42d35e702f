//! Values that are checked where they stand in the file, so that an error names the line.

use std::fmt::{Display, Formatter};
use std::marker::PhantomData;

use nalgebra::{Point2, Point3};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use crate::world::Rgb;

/// A number from LOW to HIGH.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Within<const LOW: i32, const HIGH: i32>(f64);

impl<const LOW: i32, const HIGH: i32> Within<LOW, HIGH> {
    pub(super) fn get(self) -> f64 {
        self.0
    }
}

impl<'de, const LOW: i32, const HIGH: i32> Deserialize<'de> for Within<LOW, HIGH> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let got = f64::deserialize(deserializer)?;
        if got >= f64::from(LOW) && got <= f64::from(HIGH) {
            return Ok(Self(got));
        }
        Err(D::Error::custom(format!("got {got}, expected {LOW} to {HIGH}")))
    }
}

/// A whole number from LOW to HIGH.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Count<const LOW: u32, const HIGH: u32>(u32);

impl<const LOW: u32, const HIGH: u32> Count<LOW, HIGH> {
    pub(super) fn get(self) -> u32 {
        self.0
    }
}

impl<'de, const LOW: u32, const HIGH: u32> Deserialize<'de> for Count<LOW, HIGH> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let got = u32::deserialize(deserializer)?;
        if (LOW..=HIGH).contains(&got) {
            return Ok(Self(got));
        }
        Err(D::Error::custom(format!("got {got}, expected {LOW} to {HIGH}")))
    }
}

/// A share in per cent.
pub(super) type Percent = Within<0, 100>;
/// A coordinate on the table, in mm.
pub(super) type Place = Within<-2000, 2000>;
/// A turn, in degrees.
pub(super) type Turn = Within<-360, 360>;
/// A colour: the shares of red, green and blue light that are sent back.
pub(super) type Colour = [Within<0, 1>; 3];

pub(super) fn rgb(colour: Colour) -> Rgb {
    colour.map(Within::get)
}

pub(super) fn point([x, y]: [Place; 2]) -> Point2<f64> {
    Point2::new(x.get(), y.get())
}

pub(super) fn point_above([x, y, z]: [Place; 3]) -> Point3<f64> {
    Point3::new(x.get(), y.get(), z.get())
}

/// The value, or the default where there is none.
pub(super) fn or<const LOW: i32, const HIGH: i32>(value: Option<Within<LOW, HIGH>>, default: f64) -> f64 {
    value.map_or(default, Within::get)
}

/// A share from 0 to 1.
pub(super) fn share<const LOW: i32, const HIGH: i32>(percent: Within<LOW, HIGH>) -> f64 {
    percent.get() / 100.0
}

/// A name that labels and the names of folders can hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Name(pub String);

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let is_good = |c: char| c.is_alphanumeric() || " -_.".contains(c);
        if !name.is_empty()
            && name.len() <= 100
            && name.trim() == name
            && !name.starts_with('.')
            && name.chars().all(is_good)
        {
            return Ok(Self(name));
        }
        let expected = "expected up to 100 letters, digits, blanks, '-', '_' and '.', not beginning with '.'";
        Err(D::Error::custom(format!("got '{}', {expected}", name.escape_debug())))
    }
}

/// A value that is made from fields of the file, with an error at their place where they make no sense together.
#[derive(Debug, Clone)]
pub(super) struct Checked<F, T>(pub T, PhantomData<F>);

impl<'de, F: Deserialize<'de>, T: TryFrom<F>> Deserialize<'de> for Checked<F, T>
where
    T::Error: Display,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CheckedVisitor(PhantomData))
    }
}

/// A visitor that makes the value while the table is visited. An error that arises later would have no better place than the
/// whole list of tables.
struct CheckedVisitor<F, T>(PhantomData<(F, T)>);

impl<'de, F: Deserialize<'de>, T: TryFrom<F>> Visitor<'de> for CheckedVisitor<F, T>
where
    T::Error: Display,
{
    type Value = Checked<F, T>;

    fn expecting(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str("a table of keys")
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
        let fields = F::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Checked(T::try_from(fields).map_err(A::Error::custom)?, PhantomData))
    }
}
