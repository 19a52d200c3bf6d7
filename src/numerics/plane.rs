//! Vectors and matrices of the bearing's plane: x to the right, y up, angles counter-clockwise from +x.
//!
//! They are nalgebra's of fixed size, whose sums and products are ordinary IEEE operations one by one, in an order that
//! the size fixes: equal bits on every machine.

use super::number::Scalar;

/// A vector of the plane.
pub type Vector<T = f64> = nalgebra::Vector2<T>;
/// A linear map of the plane.
pub type Matrix = nalgebra::Matrix2<f64>;

/// `v` turned by a right angle counter-clockwise: e_t from e_r.
#[inline(always)]
pub fn turned<T: Scalar>(v: Vector<T>) -> Vector<T> {
    Vector::new(-v.y, v.x)
}

/// Parts of `v` along a direction and counter-clockwise of it.
#[inline(always)]
pub fn parts(v: Vector, direction: Vector) -> [f64; 2] {
    [v.dot(&direction), v.dot(&turned(direction))]
}

/// `v` turned counter-clockwise by an angle with this sine and cosine.
#[inline(always)]
pub fn turned_by(v: Vector, sin: f64, cos: f64) -> Vector {
    Vector::new(v.x * cos - v.y * sin, v.y * cos + v.x * sin)
}
