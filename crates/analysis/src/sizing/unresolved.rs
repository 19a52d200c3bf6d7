//! Why a recording gives no length.

/// Why there is no length. Angles in degrees.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unresolved {
    /// Nothing repeats with the bearing's frequencies.
    #[error(
        "nothing repeats with a passage frequency of the bearing: of the envelope's variation {0} \
         (named from {1:.1} % on). {2}"
    )]
    NoPattern(String, f64, &'static str),
    /// None could be seen.
    #[error(
        "too short to tell whether there is a fault: in {0:.1} turns of the shaft no line of the bearing stands apart \
         from the shaft's own; give five turns or more"
    )]
    TooFewTurns(f64),
    /// As a bearing without a spall.
    #[error("it sounds as much like the scene's bearing without a spall as like any with one: similarity {0:.3}")]
    Healthy(f64),
    /// Something else repeats.
    #[error(
        "lines at multiples of {1:.2} Hz make up {2:.0} % of the envelope's variation, and are none of this bearing at \
         this speed ({0}): are speed, rate and bearing right? Else another part of the machine makes them"
    )]
    OtherPattern(String, f64, f64),
    /// Another speed would suit it as well.
    #[error("is the speed right? {0}")]
    OtherSpeed(String),
    /// Time runs backwards.
    #[error(
        "is it reversed in time? Its impacts are sharper backwards, and structures ring after an impact, not before \
         it: kurtosis of what prediction leaves {0:.1} forwards, {1:.1} backwards"
    )]
    Reversed(f64, f64),
    /// A rolling element's fault.
    #[error(
        "it looks like a fault of a rolling element, whose length is not read from recordings: of the envelope's \
         variation {0}"
    )]
    OfElement(String),
    /// No kind of fault stands out.
    #[error("no kind of fault leads: of the envelope's variation {0}")]
    TwoKinds(String),
    /// An inner raceway's comb without its load zone.
    #[error(
        "it looks like a fault of the inner raceway, but passages do not grow and fade as it turns through the load \
         zone: strong ones are {0:.2} times as strong as weak ones, limit {1:.1}"
    )]
    NoLoadZone(f64, f64),
    /// Impacts and echoes cannot be distinguished at the rate.
    #[error(
        "a sampling rate of {0:.0} Hz: below {1:.0} Hz the band above the rings' modes is too narrow to distinguish \
         impacts from their echoes"
    )]
    LowRate(f64, f64),
    /// A piece is missing.
    #[error(
        "the passages after about {0:.2} s are shifted by {1:.1} degrees against those before: is a piece of the \
         recording missing, or did the cage skid? No long part of it is without such a shift"
    )]
    Broken(f64, f64),
    /// More than one passage in a period.
    #[error(
        "the same passes {0} times in each ball pass period: are rate and speed right, or are there several spalls?"
    )]
    SeveralTimes(usize),
    /// No impact stands out.
    #[error("no impact stands out of the averaged passages: largest jump of the envelope below {0:.1} dB")]
    NoImpact(f64),
    /// More impacts than a spall makes.
    #[error(
        "impacts at {0:.2?} degrees in each passage: a spall makes two at most, and which of these is the last is \
         unknown"
    )]
    ManyImpacts(Vec<f64>),
    /// What may be an echo or the last impact.
    #[error(
        "the last impact is {0:.2} degrees after the first, or it is what follows at {1:.2} degrees: that is as loud \
         as an impact before, passage by passage, but comes when echoes have died down"
    )]
    PerhapsLast(f64, f64),
    /// The picking does not hold.
    #[error("{0} of {1} resamples of the passages show no entry and impacts: what was picked in all of them is chance")]
    Unstable(usize, usize),
    /// Onset and impacts cannot be distinguished.
    #[error(
        "one impact per passage and no clear entry before it (clearness {0:.1}, limit {1:.1}): entry and exit are not \
         separate"
    )]
    OneImpact(f64, f64),
    /// One impact inside.
    #[error(
        "one impact per passage in the load zone (strong passages are {0:.1} times as strong as weak ones): entry and \
         exit on the inner raceway are not separate"
    )]
    OneInside(f64),
    /// The inner raceway by one speed.
    #[error(
        "on the inner raceway one recording does not show where the spall begins: the onset differs by up to a third \
         of the length from machine to machine. From first to last impact are {0:.2} degrees"
    )]
    InsideAlone(f64),
    /// No entry.
    #[error(
        "{0:.2} degrees between first and last impact, but no clear entry before them (clearness {1:.1}, limit {2:.1})"
    )]
    NoEntry(f64, f64, f64),
    /// Impacts fill the spacing.
    #[error("impacts over {0:.1} of {1:.1} degrees of spacing: first and last are unknown")]
    NoSilence(f64, f64),
    /// The halves of the recording disagree.
    #[error("odd and even passages disagree: {0:.2} and {1:.2} degrees")]
    Halves(f64, f64),
    /// Too short.
    #[error("{0:.2} degrees, uncertain by {1:.2}: not surely above {2:.2}, below which an element never gets free")]
    TooShort(f64, f64, f64),
    /// Too uncertain.
    #[error("{0:.2} degrees, uncertain by {1:.2} (95 %): more than a third of it")]
    TooUncertain(f64, f64),
}

impl Unresolved {
    /// Which recording would settle it.
    pub(super) fn next_step(&self) -> &'static str {
        match self {
            Self::NoPattern(..) | Self::Healthy(_) => {
                "nothing; record again as routine does, at the same place and load"
            }
            Self::OtherPattern(..) | Self::OtherSpeed(_) | Self::SeveralTimes(_) => {
                "measure the shaft's speed (--tacho, --speed-column), and check bearing and sampling rate"
            }
            Self::TooFewTurns(_) => "record five turns or more, better five seconds",
            Self::Reversed(..) | Self::Broken(..) => "record again without gaps, at a steady speed",
            Self::OfElement(_) => "look at the rolling elements: their defects get no length",
            Self::LowRate(..) => "record at 24 kHz or more, better at 50 kHz",
            Self::InsideAlone(_) | Self::OneInside(_) => {
                "record at two speeds, one 1.3 times the other, with the sensor in the load zone"
            }
            Self::TwoKinds(_) | Self::NoLoadZone(..) | Self::NoImpact(_) => {
                "record for longer, under more load, with the sensor in the load zone"
            }
            _ => "record at another speed, slower if possible, and size both recordings together",
        }
    }
}
