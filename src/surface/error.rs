//! What can be wrong with a measured surface. Each message gives the line or position, the value and the limit.

/// A measured surface that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The file that the scene names was not handed over.
    #[error("defect profile \"{name}\": the file is missing")]
    NoFile {
        /// Its name in the scene.
        name: String,
    },
    /// A measured crown that cannot be a roller's.
    #[error("roller profile \"{name}\" (bearing.roller_profile): {why}")]
    RollerProfile {
        /// Its name in the scene.
        name: String,
        /// What is wrong with it.
        why: String,
    },
    /// A crown whose axial coordinate does not grow from line to line.
    #[error("profile, line {line}: axial_mm is {axial_mm}, it must be above {previous_mm}, that of the point before")]
    AxialNotAscending {
        /// The line.
        line: usize,
        /// Axial coordinate there (mm).
        axial_mm: f64,
        /// That of the point before (mm).
        previous_mm: f64,
    },
    /// Nothing but comments and blank lines.
    #[error("defect profile: the file is empty, it must begin with a header such as arc_mm,depth_um")]
    Empty,
    /// A column that is needed is not in the header.
    #[error("defect profile, line {line}: column {column} is missing, the header is \"{header}\"")]
    MissingColumn {
        /// Line of the header.
        line: usize,
        /// Name of the column.
        column: &'static str,
        /// The header as it stands.
        header: String,
    },
    /// A column that means nothing here.
    #[error("defect profile, line {line}: unknown column \"{column}\", it must be one of {known}")]
    UnknownColumn {
        /// Line of the header.
        line: usize,
        /// Name of the column.
        column: String,
        /// The columns that are known.
        known: String,
    },
    /// A column that is given twice.
    #[error("defect profile, line {line}: column {column} stands twice")]
    RepeatedColumn {
        /// Line of the header.
        line: usize,
        /// Name of the column.
        column: &'static str,
    },
    /// A line with more or fewer values than the header has columns.
    #[error("defect profile, line {line}: {found} values, the header has {expected} columns")]
    ValueCount {
        /// The line.
        line: usize,
        /// Values found.
        found: usize,
        /// Columns of the header.
        expected: usize,
    },
    /// A value that is not a number.
    #[error("defect profile, line {line}: {column} is \"{text}\", not a number")]
    NotANumber {
        /// The line.
        line: usize,
        /// The column.
        column: &'static str,
        /// What stands there.
        text: String,
    },
    /// NaN or an infinity.
    #[error("defect profile, line {line}: {column} is {value}, it must be finite: fill gaps of the measurement before")]
    NotFinite {
        /// The line.
        line: usize,
        /// The column.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// Too few points to span a surface.
    #[error("defect profile: {found} points along {column}, it must be at least 2")]
    TooFewPoints {
        /// Distinct points found.
        found: usize,
        /// Column of the coordinate.
        column: &'static str,
    },
    /// A trace whose arc does not grow from line to line.
    #[error(
        "defect profile, line {line}: arc_mm is {arc_mm}, it must be above {previous_mm}, the arc of the point before"
    )]
    NotAscending {
        /// The line.
        line: usize,
        /// Arc there (mm).
        arc_mm: f64,
        /// Arc of the point before (mm).
        previous_mm: f64,
    },
    /// Points that do not describe a profile.
    #[error("profile, point {index}: {why}")]
    Points {
        /// Index of the point, from 0.
        index: usize,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A topography that gives one point twice.
    #[error("defect profile, line {line}: the point arc_mm = {arc_mm}, axial_mm = {axial_mm} is given a second time")]
    RepeatedPoint {
        /// The line.
        line: usize,
        /// Arc (mm).
        arc_mm: f64,
        /// Axial coordinate (mm).
        axial_mm: f64,
    },
    /// A topography that is not a full rectangle.
    #[error(
        "defect profile: no depth at arc_mm = {arc_mm}, axial_mm = {axial_mm}: {found} points given, the grid of \
         {arcs} by {axials} coordinates needs {needed}"
    )]
    Hole {
        /// Arc of the first hole (mm).
        arc_mm: f64,
        /// Axial coordinate of the first hole (mm).
        axial_mm: f64,
        /// Points given.
        found: usize,
        /// Distinct arcs.
        arcs: usize,
        /// Distinct axial coordinates.
        axials: usize,
        /// Points needed.
        needed: usize,
    },
    /// Two defects of one body that overlap.
    #[error(
        "[[defect]] numbers {} and {} are on the same body, {gap_mm:.6} mm apart: it must be at least {limit_mm} mm; \
         give one profile where defects overlap", numbers[0], numbers[1]
    )]
    Overlap {
        /// Their numbers in the scene file, from 1.
        numbers: [usize; 2],
        /// Distance from the end of one to the beginning of the other (mm); negative for an overlap.
        gap_mm: f64,
        /// Limit (mm).
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
        /// Distance from which on they are apart (mm).
        limit_mm: f64,
    },
    /// Something wrong with the surface of one of several defects.
    #[error("[[defect]] number {number}: {of}")]
    OfDefect {
        /// Its number in the scene file, from 1.
        number: usize,
        /// What is wrong.
        of: Box<SurfaceError>,
    },
    /// A measurement as long as the raceway or longer.
    #[error("defect profile: it is {length_mm:.6} mm long, it must be below {limit_mm:.6} mm, {limit}")]
    TooLong {
        /// Length (mm).
        length_mm: f64,
        /// Limit (mm).
        limit_mm: f64,
        /// What that is.
        limit: &'static str,
    },
    /// A rim so far above the deepest point that an element there would meet it with its side.
    #[error(
        "defect profile: from its highest point to its deepest it is {height_um:.3} um: it must be below {limit_um:.3} \
         um, the radius of an element"
    )]
    TooRugged {
        /// Height of the highest above the deepest point (µm).
        height_um: f64,
        /// Radius of an element (µm).
        limit_um: f64,
    },
    /// A depth, or a rim, as large as an element's radius.
    #[error(
        "defect profile: the depth is {depth_um:.3} um, {arc_mm:.6} mm from the middle of the trace: its magnitude \
         must be below {limit_um:.3} um, {limit}"
    )]
    TooDeep {
        /// Arc from the middle (mm).
        arc_mm: f64,
        /// Depth (µm).
        depth_um: f64,
        /// Limit (µm).
        limit_um: f64,
        /// What that is.
        limit: &'static str,
    },
}

impl SurfaceError {
    /// A roller's crown whose file, of this name, was not handed over.
    pub(crate) fn no_crown(name: &str) -> Self {
        Self::RollerProfile { name: name.to_owned(), why: "the file is missing".to_owned() }
    }
}
