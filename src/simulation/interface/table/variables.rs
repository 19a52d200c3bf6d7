//! The variable table: name, reference, causality, unit and start value of everything a host can see.
//!
//! The table is a function of the scene and is written once, here. The model description, get, set,
//! the derivatives and the documentation's tables all follow from it.

/// A variable that a host can see.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Structured name, as in `element[3].force.outer`.
    pub name: String,
    /// One line for the reader.
    pub description: String,
    /// FMI value reference: the variable's index in the table, whatever its type.
    pub reference: u32,
    /// Type, with what belongs to it.
    pub kind: Kind,
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
}

impl Variable {
    /// The description, of an input without what FMI 2.0's derivatives of inputs do.
    pub fn meaning(&self) -> &str {
        match (self.causality, self.description.rsplit_once("; ")) {
            (Causality::Input, Some((meaning, _))) => meaning,
            _ => &self.description,
        }
    }

    /// Whether its value inside a communication step is one of its own: that of a continuous input or output.
    pub fn changes_within_steps(&self) -> bool {
        matches!(self.causality, Causality::Input | Causality::Output) && self.variability == Variability::Continuous
    }
}

/// What an output depends on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dependencies {
    /// The output's index in the table.
    pub output: u32,
    /// Table indices, ascending, of all inputs that it follows at a communication point, without a step.
    pub direct: Vec<u32>,
    /// Table indices, ascending, of all inputs and parameters that it depends on at the start.
    pub initial: Vec<u32>,
}

/// Type of a variable.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// `fmi2Real`.
    Real {
        /// Unit.
        unit: Unit,
        /// Start value; for inputs and parameters only.
        start: Option<f64>,
        /// Smallest value that may be set.
        min: Option<f64>,
        /// Largest value that may be set.
        max: Option<f64>,
        /// Order of magnitude.
        nominal: f64,
    },
    /// A counter, `fmi2Integer`.
    Integer,
    /// A number from 0 to 2³¹ − 1 that is set, `fmi2Integer`.
    Whole {
        /// Start value.
        start: i32,
    },
    /// An enumeration, set and read as `fmi2Integer`, counted from 1.
    Enumeration {
        /// Name of the type.
        type_name: &'static str,
        /// Names of its items, the first having value 1, with a description each.
        items: &'static [(&'static str, &'static str)],
        /// Start value.
        start: i32,
    },
    /// `fmi2String`.
    Text {
        /// Start value.
        start: String,
    },
}

/// FMI causality, as far as Brinell uses it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Fixed before initialization.
    Parameter,
    /// Set by the host at communication points.
    Input,
    /// Computed: a signal that can be connected.
    Output,
    /// Computed: only to be read.
    Local,
}

/// FMI variability, as far as Brinell uses it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variability {
    /// Does not change after initialization.
    Fixed,
    /// Changes at communication points only.
    Discrete,
    /// Changes with time.
    Continuous,
}

/// Unit of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unit {
    /// 1
    One,
    /// kg
    Kilogram,
    /// m
    Metre,
    /// s
    Second,
    /// rad
    Radian,
    /// m/s
    MetrePerSecond,
    /// m/s2
    MetrePerSecondSquared,
    /// rad/s, shown as rev/min
    RadianPerSecond,
    /// N
    Newton,
    /// N.m
    NewtonMetre,
    /// N/m
    NewtonPerMetre,
    /// N.s/m
    NewtonSecondPerMetre,
    /// s/m
    SecondPerMetre,
    /// rad/s2
    RadianPerSecondSquared,
    /// kg.m2
    KilogramSquareMetre,
    /// N.m.s/rad
    NewtonMetreSecondPerRadian,
    /// N/rad
    NewtonPerRadian,
    /// N.m/rad
    NewtonMetrePerRadian,
    /// Hz
    Hertz,
    /// Pa.s
    PascalSecond,
}
