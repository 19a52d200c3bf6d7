//! What a name says: which bearing, its clearance, its elements' material, and what is without effect or asked about.

use super::{CatalogueBearing, ClearanceRange};
use std::fmt;

/// A name that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Designation {
    /// The bearing of the catalogue.
    pub bearing: CatalogueBearing,
    /// Clearance: that of the class in the name, else of CN; `None` where the contact angle gives it.
    pub clearance: Option<ClearanceRange>,
    /// Whether the name says a class.
    pub says_class: bool,
    /// Whether its elements are ceramic.
    pub hybrid: bool,
    /// The maker.
    pub(super) maker: Option<&'static str>,
    /// Parts without effect, and what each is.
    pub(super) without_effect: Vec<(String, &'static str)>,
    /// Parts that are asked about, and what each would change, where that is known.
    pub(super) asked: Vec<(String, Option<&'static str>)>,
}

impl Designation {
    /// What the name says beside the bearing's own; `None` where it says nothing.
    pub fn remark(&self) -> Option<String> {
        let mut said = Vec::new();
        if let Some(clearance) = self.clearance.filter(|_| self.says_class) {
            said.push(format!(
                "radial internal clearance {clearance} (ISO 5753-1), of which the middle, {} um, is taken",
                clearance.middle_um()
            ));
        }
        if self.hybrid {
            said.push("elements of silicon nitride in rings of steel".to_owned());
        }
        if !self.without_effect.is_empty() {
            let parts = self.without_effect.iter().map(|(code, what)| format!("{code} ({what})"));
            said.push(format!("without effect here: {}", parts.collect::<Vec<_>>().join(", ")));
        }
        said.extend(self.asked.iter().map(|(code, what)| match what {
            Some(what) => format!("{code} is {what}"),
            None => format!(
                "what does {code} say? It is not known here and nothing follows from it; where it changes what is \
                 inside, keys of [bearing] beside the name say so"
            ),
        }));
        (!said.is_empty()).then(|| format!("a {self}: {}", said.join("; ")))
    }
}

impl fmt::Display for Designation {
    /// `6205 of SKF`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.bearing.designation)?;
        self.maker.map_or(Ok(()), |maker| write!(f, " of {maker}"))
    }
}
