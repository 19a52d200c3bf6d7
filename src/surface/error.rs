//! What can be wrong with a measured surface. Each message gives the line or position, the value and the limit.

/// A measured surface that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum SurfaceError {
    /// The file that the scene names was not handed over.
    #[error("defect profile \"{name}\": the file is missing")]
    NoFile { name: String },
    /// A measured crown that cannot be a roller's.
    #[error("roller profile \"{name}\" (bearing.roller_profile): {why}")]
    RollerProfile { name: String, why: String },
    /// A crown whose axial coordinate does not grow from line to line.
    #[error("profile, line {line}: axial_mm is {axial_mm}, it must be above {previous_mm}, that of the point before")]
    AxialNotAscending { line: usize, axial_mm: f64, previous_mm: f64 },
    /// Nothing but comments and blank lines.
    #[error("defect profile: the file is empty, it must begin with a header such as arc_mm,depth_um")]
    Empty,
    /// A column that is needed is not in the header.
    #[error("defect profile, line {line}: column {column} is missing, the header is \"{header}\"")]
    MissingColumn { line: usize, column: &'static str, header: String },
    /// A column that means nothing here.
    #[error("defect profile, line {line}: unknown column \"{column}\", it must be one of {known}")]
    UnknownColumn { line: usize, column: String, known: String },
    /// A column that is given twice.
    #[error("defect profile, line {line}: column {column} stands twice")]
    RepeatedColumn { line: usize, column: &'static str },
    /// A line with more or fewer values than the header has columns.
    #[error("defect profile, line {line}: {found} values, the header has {expected} columns")]
    ValueCount { line: usize, found: usize, expected: usize },
    /// A value that is not a number.
    #[error("defect profile, line {line}: {column} is \"{text}\", not a number")]
    NotANumber { line: usize, column: &'static str, text: String },
    /// NaN or an infinity.
    #[error("defect profile, line {line}: {column} is {value}, it must be finite: fill gaps of the measurement before")]
    NotFinite { line: usize, column: &'static str, value: f64 },
    /// Too few points to span a surface.
    #[error("defect profile: {found} points along {column}, it must be at least 2")]
    TooFewPoints { found: usize, column: &'static str },
    /// A trace whose arc does not grow from line to line.
    #[error(
        "defect profile, line {line}: arc_mm is {arc_mm}, it must be above {previous_mm}, the arc of the point before"
    )]
    NotAscending { line: usize, arc_mm: f64, previous_mm: f64 },
    /// Points that do not describe a profile.
    #[error("profile, point {index}: {why}")]
    Points {
        /// Index of the point, from 0.
        index: usize,
        why: &'static str,
    },
    /// Ends that give no circle.
    #[error(
        "defect.profile.remove_form: both ends of the trace, a tenth of it each, have {points} points: it must be at \
         least {fewest}, not all at one arc"
    )]
    NoCircle { points: usize, fewest: usize },
    /// A topography that gives one point twice.
    #[error("defect profile, line {line}: the point arc_mm = {arc_mm}, axial_mm = {axial_mm} is given a second time")]
    RepeatedPoint { line: usize, arc_mm: f64, axial_mm: f64 },
    /// A topography that is not a full rectangle.
    #[error(
        "defect profile: no depth at arc_mm = {arc_mm}, axial_mm = {axial_mm}: {found} points given, the grid of \
         {arcs} by {axials} coordinates needs {needed}"
    )]
    Hole { arc_mm: f64, axial_mm: f64, found: usize, arcs: usize, axials: usize, needed: usize },
    /// Two defects of one body that overlap.
    #[error(
        "[[defect]] numbers {} and {} are on the same body, {gap_mm:.6} mm apart: it must be at least {limit_mm} mm; \
         give one profile where defects overlap", numbers[0], numbers[1]
    )]
    Overlap {
        /// Their numbers in the scene file, from 1.
        numbers: [usize; 2],
        gap_mm: f64,
        limit_mm: f64,
    },
    /// A topography beside another defect that one contact may meet with it.
    #[error(
        "[[defect]] number {} is a topography and number {} is less than {limit_mm:.3} mm from it: contacts of the \
         largest force would meet both; give one topography of both, or profiles", numbers[0], numbers[1]
    )]
    TopographyClose {
        /// Their numbers in the scene file, from 1.
        numbers: [usize; 2],
        limit_mm: f64,
    },
    /// Something wrong with the surface of one of several defects.
    #[error("[[defect]] number {number}: {of}")]
    OfDefect {
        /// Its number in the scene file, from 1.
        number: usize,
        of: Box<SurfaceError>,
    },
    /// A measurement as long as the raceway or longer.
    #[error("defect profile: it is {length_mm:.6} mm long, it must be below {limit_mm:.6} mm, {limit}")]
    TooLong { length_mm: f64, limit_mm: f64, limit: &'static str },
    /// A topography wider than any raceway.
    #[error(
        "defect profile: axial_mm has a width of {width_mm:.3} mm: it must be below {limit_mm:.3} mm, the pitch \
         diameter; are these micrometres?"
    )]
    TooWide { width_mm: f64, limit_mm: f64 },
    /// A rim so far above the deepest point that an element there would meet it with its side.
    #[error(
        "defect profile: from its highest point to its deepest it is {height_um:.3} um: it must be below {limit_um:.3} \
         um, the radius of an element"
    )]
    TooRugged { height_um: f64, limit_um: f64 },
    /// A depth, or a rim, as large as an element's radius.
    #[error(
        "defect profile: the depth is {depth_um:.3} um, {arc_mm:.6} mm from the middle of the trace: its magnitude \
         must be below {limit_um:.3} um, {limit}"
    )]
    TooDeep { arc_mm: f64, depth_um: f64, limit_um: f64, limit: &'static str },
}

impl SurfaceError {
    /// A roller's crown whose file, of this name, was not handed over.
    pub(crate) fn no_crown(name: &str) -> Self {
        Self::RollerProfile { name: name.to_owned(), why: "the file is missing".to_owned() }
    }
}
