//! Numbers of several courses side by side, in a vector of the processor.

use core::ops::{Add, Div, Mul, Neg, Sub};
use pulp::{Simd, bytemuck};
use vcutc_geometry::number::Number;
use vcutc_machine::kinematics::trig::{Turn, atan2};

/// Numbers side by side, in a vector of the processor.
///
/// All that is computed with them has to end up in one function that is compiled for the processor's instructions: whatever is on
/// the way there is `inline(always)`, closures are none of it, and of [`Simd`] only what is one instruction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wide<S: Simd> {
    simd: S,
    lanes: S::f64s,
}

impl<S: Simd> Wide<S> {
    /// Of the first numbers, as many as the vector has lanes; 0 everywhere where there are fewer.
    #[inline(always)]
    pub(super) fn new(simd: S, numbers: &[f64]) -> Self {
        let lanes = match numbers.get(..S::F64_LANES) {
            Some(numbers) => bytemuck::pod_read_unaligned(bytemuck::cast_slice(numbers)),
            None => simd.splat_f64s(0.0),
        };
        Self { simd, lanes }
    }

    #[inline(always)]
    pub(super) fn lanes(&self) -> &[f64] {
        bytemuck::cast_slice(core::slice::from_ref(&self.lanes))
    }

    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(core::slice::from_mut(&mut self.lanes))
    }

    #[inline(always)]
    fn with(self, lanes: S::f64s) -> Self {
        Self { lanes, ..self }
    }
}

impl<S: Simd> Number for Wide<S> {
    #[inline(always)]
    fn of(self, constant: f64) -> Self {
        self.with(self.simd.splat_f64s(constant))
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        let without_sign = self.of(f64::from_bits(i64::MAX.cast_unsigned()));
        self.with(self.simd.and_f64s(self.lanes, without_sign.lanes))
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.lanes))
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        self.with(self.simd.min_f64s(self.lanes, other.lanes))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        self.with(self.simd.max_f64s(self.lanes, other.lanes))
    }

    #[inline(always)]
    fn below(self, bound: Self, then: Self, otherwise: Self) -> Self {
        let is_below = self.simd.less_than_f64s(self.lanes, bound.lanes);
        let (then, otherwise) = (bytemuck::cast(then.lanes), bytemuck::cast(otherwise.lanes));
        self.with(bytemuck::cast(self.simd.select_u64s(is_below, then, otherwise)))
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = (self, self);
        for ((angle, sin), cos) in self.lanes().iter().zip(sin.lanes_mut()).zip(cos.lanes_mut()) {
            let turn = Turn::of(*angle);
            (*sin, *cos) = (turn.sin, turn.cos);
        }
        (sin, cos)
    }

    #[inline(always)]
    fn direction(y: Self, x: Self) -> Self {
        let mut angles = y;
        for ((y, x), angle) in y.lanes().iter().zip(x.lanes()).zip(angles.lanes_mut()) {
            *angle = atan2(*y, *x);
        }
        angles
    }
}

impl<S: Simd> Add for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.simd.add_f64s(self.lanes, other.lanes))
    }
}

impl<S: Simd> Sub for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.simd.sub_f64s(self.lanes, other.lanes))
    }
}

impl<S: Simd> Mul for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.simd.mul_f64s(self.lanes, other.lanes))
    }
}

impl<S: Simd> Div for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(self.simd.div_f64s(self.lanes, other.lanes))
    }
}

impl<S: Simd> Neg for Wide<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.xor_f64s(self.lanes, self.of(-0.0).lanes))
    }
}
