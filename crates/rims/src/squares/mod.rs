//! Rims of square and rectangular plates.
//!
//! A level rectangle at any height is a rectangle on the plane Z = 0, as a level circle is a circle. The edges that the search
//! for circles has carried there are cut into straight pieces ([`pieces`]); pieces that end where they meet are corners, and two
//! corners across from each other a rectangle ([`corners`]). It is fitted to the edges along its sides ([`quad`]) and weighed by
//! what supports it ([`support`]), by what lies within it at other levels ([`levels`]): a rectangle alone may be a napkin, a book
//! or a mat, but a well lies below its rim. The likeliest of nested ones is kept, and followed through the full picture
//! ([`follow`]).

mod corners;
mod evidence;
mod follow;
mod found;
mod levels;
mod pieces;
mod quad;
mod support;
#[cfg(test)]
mod tests;

pub(crate) use found::squares;
