//! What can be wrong with axial load, contact angle and tilt.

use crate::scene::messages::Plain;

/// Something that needs other degrees of freedom than there are, or that those which there are need.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum FreedomError {
    /// Degrees of freedom that no ring has.
    #[error("bearing.degrees_of_freedom is {given}: it must be 2, 3 or 5")]
    NoneSuch { given: i64 },
    /// A key of the axis or of tilt in a scene without them.
    #[error(
        "{key} is given: it needs bearing.degrees_of_freedom {}, and there are {given}",
        if *least == 5 { "5" } else { "3 or 5" }
    )]
    NeedsMore { key: &'static str, least: usize, given: usize },
    /// Rollers along the axis.
    #[error(
        "bearing.degrees_of_freedom is {given}: with bearing.element = \"cylindrical-roller\" it must be 2; a roller \
         that is tilted or pushed along its axis is not modelled, so far"
    )]
    OfRollers { given: usize },
    /// An outer raceway that yields, along contacts of any angle.
    #[error(
        "outer compliance (bearing.outer_compliance_m_n) is {}: it must be 0 with \
         bearing.degrees_of_freedom = {given}; which way a ring yields to a contact at an angle is not modelled, so \
         far",
        Plain(*compliance_m_n)
    )]
    WithCompliance { compliance_m_n: f64, given: usize },
    /// Grooves too open to lead a ball at a contact angle.
    #[error(
        "groove conformity of the {ring} ring (bearing.groove_diameter_mm/2 over bearing.element_diameter_mm, or \
         bearing.conformity_{ring}) is {conformity}: it must be at most {limit} with bearing.degrees_of_freedom 3 or 5"
    )]
    OpenGroove { ring: &'static str, conformity: f64, limit: f64 },
    /// A contact angle too small to carry anything along the axis.
    #[error(
        "contact angle (bearing.contact_angle_deg) is {contact_angle_deg}: it must be 0 or at least 1 in size; a \
         bearing without one has a clearance instead"
    )]
    TooFlat { contact_angle_deg: f64 },
    /// A clearance from which the balls rise steeper than the model goes.
    #[error(
        "radial clearance (bearing.radial_clearance_um) is {clearance_um}: it must be at most {limit_um} with \
         bearing.degrees_of_freedom 3 or 5, half the distance of the grooves' centres, at which the free contact angle \
         is 60 degrees; bearing.internal_clearance_um is twice as much"
    )]
    TooSteep { clearance_um: f64, limit_um: f64 },
    /// More play than the grooves allow.
    #[error(
        "axial clearance (bearing.axial_clearance_um) is {play_um}: it must be at least 0 and at most {limit_um}, at \
         which the free contact angle is 60 degrees"
    )]
    AxialPlay { play_um: f64, limit_um: f64 },
    /// A clearance that does not belong to the contact angle beside it.
    #[error(
        "contact angle (bearing.contact_angle_deg) is {angle_deg}: its radial clearance is {limit_um} um, and the \
         bearing has {clearance_um} um"
    )]
    AngleAndClearance { angle_deg: f64, clearance_um: f64, limit_um: f64 },
    /// A shoulder that closes the groove.
    #[error("shoulder height ({key}) is {height_mm}: it must be below {limit_mm}, the radius of the groove")]
    ShoulderTooHigh { key: &'static str, height_mm: f64, limit_mm: f64 },
    /// Gyroscopic couples of balls that move.
    #[error(
        "bearing.gyroscopic is given and bearing.element_inertia is \"full\": the couple is held by friction, which \
         only balls in balance are taken to have; it needs bearing.element_inertia = \"none\""
    )]
    GyroscopicInMotion,
    /// A ring that nothing holds along the axis.
    #[error(
        "the {ring} is free along z and nothing presses it: it needs an axial load (the third number of \
         {ring}.load_n), {ring}.preload_n or {ring}.axial_stiffness_n_m above 0, or {ring}.motion other than \
         \"internal\""
    )]
    FreeAlongTheAxis { ring: &'static str },
    /// A shaft that tilts, in a bearing whose balls nothing presses.
    #[error(
        "the shaft is free to tilt and nothing presses the bearing, so that no tilt is its own: it needs \
         shaft.tilt_stiffness_n_m_rad above 0, a load (shaft.load_n, gravity_m_s2), shaft.preload_n, or \
         bearing.radial_clearance_um below 0"
    )]
    FreeInTilt,
    /// Two rings that both slide.
    #[error(
        "axial stiffness to ground (shaft.axial_stiffness_n_m, housing.axial_stiffness_n_m) is 0 for both rings: where \
         both move by themselves, one must be above 0 or nothing holds the bearing"
    )]
    NothingHoldsAxially,
    /// An axial load on a ring that does not move by itself.
    #[error(
        "axial load on the {ring} is {load} N (the third number of {ring}.load_n) and its preload {preload} N \
         ({ring}.preload_n): both must be 0 unless {ring}.motion is \"internal\""
    )]
    AxialLoadNotInternal { ring: &'static str, load: f64, preload: f64 },
    /// A moment on a shaft that does not move by itself.
    #[error(
        "moment on the shaft (shaft.load_moment_n_m) is [{}, {}]: it must be [0, 0] unless shaft.motion is \
         \"internal\"", moment[0], moment[1]
    )]
    MomentNotInternal { moment: [f64; 2] },
    /// A body that cannot be.
    #[error(
        "polar inertia of the shaft (shaft.polar_inertia_kg_m2) is {polar_kg_m2}: it must be at most {limit_kg_m2}, \
         twice shaft.transverse_inertia_kg_m2, which a flat disc has"
    )]
    TooMuchPolarInertia { polar_kg_m2: f64, limit_kg_m2: f64 },
    /// A direction of no length.
    #[error("sensor.direction is [0, 0, 0]: one of its numbers must be other than 0")]
    NoDirection,
}
