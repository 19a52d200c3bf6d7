//! The versions of the FMI standard that an FMU can keep to.

/// Version of the standard that an FMU keeps to. The library is the same for both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Version {
    /// FMI 2.0
    #[default]
    #[value(name = "2")]
    Fmi2,
    /// FMI 3.0
    #[value(name = "3")]
    Fmi3,
}

impl Version {
    /// As the standard writes it.
    pub fn number(self) -> &'static str {
        match self {
            Self::Fmi2 => "2.0",
            Self::Fmi3 => "3.0",
        }
    }
}
