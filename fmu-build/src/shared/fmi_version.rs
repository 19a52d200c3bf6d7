//! What an FMU shows its host: the version of the standard, the kinds, how variables are named and listed.

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

/// How an FMU is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Kind {
    /// Co-Simulation: the FMU integrates
    #[default]
    Cs,
    /// Model Exchange: the host integrates
    Me,
    /// Either, as the host wants it
    Both,
}

/// How variables are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Names {
    /// `element[3].force.outer`
    #[default]
    Structured,
    /// `element_3_force_outer`
    Flat,
}

/// What an FMU shows its host.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Interface {
    /// Version of the standard.
    pub version: Version,
    /// Kinds.
    pub kind: Kind,
    /// Names of the variables.
    pub names: Names,
    /// FMI 3.0 without arrays and unsigned counters: a variable for each element, counters as Int64.
    pub scalars: bool,
}

impl Interface {
    /// Whether the host may integrate.
    pub fn exchanges(self) -> bool {
        self.kind != Kind::Cs
    }

    /// Whether the FMU may integrate.
    pub fn steps(self) -> bool {
        self.kind != Kind::Me
    }

    /// A structured name as it is shown.
    pub fn shown(self, name: &str) -> String {
        if self.names == Names::Structured {
            return name.to_owned();
        }
        name.replace(['.', '[', '('], "_").replace([']', ')'], "")
    }

    /// What the library has to know of it, as words of the resources' file `interface`; none for what is usual.
    pub fn marks(self) -> Option<String> {
        let marks = [(self.exchanges(), "model-exchange"), (self.scalars, "scalars")];
        let words: Vec<&str> = marks.into_iter().filter_map(|(is, word)| is.then_some(word)).collect();
        (!words.is_empty()).then(|| words.join(" "))
    }
}

impl From<Version> for Interface {
    fn from(version: Version) -> Self {
        Self { version, ..Self::default() }
    }
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
