//! Where the tool is: what a target leaves out keeps the value that it had.

use crate::syntax::{Component, Coordinates, Directions, Points};
use vcutc_backend_api::geometry::{Orientation, Zyx};
use vcutc_backend_api::units::Angle;

/// What the targets so far say of the tool and of external axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Position(Coordinates);

impl Position {
    /// The value of a component, where it is known.
    #[must_use]
    pub fn get(&self, component: Component) -> Option<f64> {
        self.0.get(component)
    }

    /// The values of some components, where all of them are known.
    #[must_use]
    #[inline]
    pub fn all<const N: usize>(&self, components: [Component; N]) -> Option<[f64; N]> {
        self.0.all(components)
    }

    /// After a motion to a pose; none where a relative one needs what is not known.
    #[must_use]
    pub fn at_pose(&self, target: &Coordinates, points: Points, directions: Directions) -> Option<Self> {
        let mut after = Self(self.0.without(&Component::AXES));
        match (points, directions) {
            (Points::Absolute, _) => after.take(target, |_| Some(0.0))?,
            (Points::Relative, Directions::Base) => after.take(target, |component| self.get(component))?,
            (Points::Relative, Directions::Tool) => after.advance(target)?,
        }
        Some(after)
    }

    /// After a motion to axis values.
    #[must_use]
    pub fn at_axes(&self, target: &Coordinates) -> Self {
        let mut after = Self(self.0.without(&Component::TIP).without(&Component::ANGLES));
        for component in Component::AXES.into_iter().chain(Component::EXTERNAL) {
            if let Some(value) = target.get(component) {
                after.0.set(component, value);
            }
        }
        after
    }

    /// After a motion with an unknown end: external axes stay where they are.
    #[must_use]
    pub fn lost(&self) -> Self {
        let arm = self.0.without(&Component::TIP).without(&Component::ANGLES);
        Self(arm.without(&Component::AXES))
    }

    /// Sets the components of a target, each on top of what it counts from.
    fn take(&mut self, target: &Coordinates, from: impl Fn(Component) -> Option<f64>) -> Option<()> {
        let components = Component::TIP.into_iter().chain(Component::ANGLES);
        for component in components.chain(Component::EXTERNAL) {
            if let Some(value) = target.get(component) {
                self.0.set(component, from(component)? + value);
            }
        }
        Some(())
    }

    /// Moves along the tool's own directions; one that also turns is not followed.
    fn advance(&mut self, target: &Coordinates) -> Option<()> {
        let given = |component| target.get(component).unwrap_or(0.0);
        if Component::ANGLES.into_iter().any(|angle| given(angle) != 0.0) {
            return None;
        }
        let held = orientation(self.all(Component::ANGLES)?);
        let tip = self.all(Component::TIP)?;
        let [x, y, z] = Component::TIP.map(given);
        let [dx, dy, dz] = held.matrix().map(|[a, b, c]| a * x + b * y + c * z);
        let [x0, y0, z0] = tip;
        self.set_tip([x0 + dx, y0 + dy, z0 + dz]);
        Some(())
    }

    /// Puts the tip elsewhere, in mm.
    pub fn set_tip(&mut self, tip: [f64; 3]) {
        for (component, value) in Component::TIP.into_iter().zip(tip) {
            self.0.set(component, value);
        }
    }
}

/// `R = Rz(A) Ry(B) Rx(C)`, from degrees.
#[must_use]
pub fn orientation([a, b, c]: [f64; 3]) -> Orientation {
    Orientation::from_zyx(Zyx {
        a: Angle::deg(a),
        b: Angle::deg(b),
        c: Angle::deg(c),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coordinates(values: &[(Component, f64)]) -> Coordinates {
        let mut coordinates = Coordinates::default();
        for &(component, value) in values {
            coordinates.set(component, value);
        }
        coordinates
    }

    fn start() -> Position {
        let target = [
            (Component::X, 1.0),
            (Component::Y, 2.0),
            (Component::Z, 3.0),
            (Component::A, 90.0),
            (Component::B, 0.0),
            (Component::C, 0.0),
            (Component::E1, 7.0),
        ];
        let start = Position::default();
        start
            .at_pose(&coordinates(&target), Points::Absolute, Directions::Base)
            .unwrap()
    }

    #[test]
    fn what_is_left_out_keeps_its_value() {
        let target = coordinates(&[(Component::Y, 5.0)]);
        let after = |points, directions| start().at_pose(&target, points, directions);
        let tip = |after: Option<Position>| after.unwrap().all(Component::TIP).unwrap();
        assert_eq!(tip(after(Points::Absolute, Directions::Base)), [1.0, 5.0, 3.0]);
        assert_eq!(tip(after(Points::Relative, Directions::Base)), [1.0, 7.0, 3.0]);
        // The tool's y is the base's -x.
        let [x, y, z] = tip(after(Points::Relative, Directions::Tool));
        assert!((x + 4.0).abs() < 1e-12 && (y - 2.0).abs() < 1e-12 && (z - 3.0).abs() < 1e-12);
    }

    #[test]
    fn poses_and_axis_values_replace_one_another() {
        let axes = start().at_axes(&coordinates(&Component::AXES.map(|axis| (axis, 1.0))));
        assert_eq!(
            (axes.get(Component::X), axes.get(Component::A6)),
            (None, Some(1.0))
        );
        assert_eq!(axes.get(Component::E1), Some(7.0));
        let target = coordinates(&[(Component::X, 1.0)]);
        let pose = axes.at_pose(&target, Points::Absolute, Directions::Base).unwrap();
        assert_eq!(
            (pose.get(Component::X), pose.get(Component::A6)),
            (Some(1.0), None)
        );
        assert!(
            axes.at_pose(&target, Points::Relative, Directions::Base)
                .is_none()
        );
    }
}
